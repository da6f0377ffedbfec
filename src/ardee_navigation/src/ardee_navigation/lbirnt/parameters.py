# SPDX-License-Identifier: MIT
"""Parameters of the lidar-based in-row navigation technique (LBIRNT), with units, limits and where they come from.

[field] one published field deployment on this robot: lane 0.756 m, lateral window 0.5 m, longitudinal -1 to 2 m,
0.1 m bins, PID 25 / 0 / 5 on a turn command of 0 to 100 with 50 as straight ahead, about 0.5 m/s. [robot] limits of the
TerraSentia. [real run] what the figures of config/real_lane.yaml speak for (README). [own] chosen here; the thesis
(5.1) names the check but no number.
"""
import math
from dataclasses import dataclass, fields

from ardee_common.options import bounded


@dataclass(frozen=True)
class Parameters:
    """All numbers of the technique. Frame: the lidar's, x forward, y left."""

    # Pre-processing (thesis 5.1.1)
    lidar_ahead_m: float = bounded(-2.0, 2.0, 0.22)  # before the turning centre [robot]
    behind_m: float = bounded(0.0, 10.0, 1.0)  # rectangle: from here behind the lidar [field]
    ahead_m: float = bounded(0.1, 20.0, 2.0)  # to here before it [field]
    beside_min_m: float = bounded(0.0, 2.0, 0.10)  # nearer is the robot itself [own]
    beside_max_m: float = bounded(0.1, 3.0, 0.50)  # farther is the next lane [field]
    bin_m: float = bounded(0.005, 1.0, 0.1)  # of the histogram of lateral distance [field]
    keep_bins: int = bounded(0, 20, 1)  # kept on each side of the fullest [own]

    # Single-line checks (5.1.2)
    min_points: int = bounded(2, 1081, 8)  # fewer returns make no line [own]
    min_length_m: float = bounded(0.0, 20.0, 0.3)  # shorter lines have no angle [own]
    lateral_min_m: float = bounded(0.0, 3.0, 0.15)  # acceptable distance of a row [own]
    lateral_max_m: float = bounded(0.1, 3.0, 0.60)  # [own]
    max_angle_rad: float = bounded(0.01, 1.5, 0.45)  # of a row to the robot [own]
    max_angle_change_rad: float = bounded(0.01, 3.2, 0.20)  # from the line used before [own]
    max_change_m: float = bounded(0.005, 3.0, 0.15)  # of lateral distance, likewise [own]

    # Checks of both lines, update heuristics (5.1.2)
    lane_width_m: float = bounded(0.2, 3.0, 0.762)  # 30 in (5.2); [field] 0.756
    lane_width_tolerance_m: float = bounded(0.01, 1.0, 0.15)  # [own]
    max_angle_between_rad: float = bounded(0.01, 3.2, 0.25)  # rows are parallel [own]
    blend: float = bounded(0.01, 1.0, 1.0)  # weight of a new line against the one before [real run]
    max_coast_s: float = bounded(0.0, 60.0, 0.5)  # a side lost for longer takes any line [own]

    # Control (5.1.3)
    speed_m_s: float = bounded(0.0, 1.2, 0.5)  # [field]
    target_ahead_m: float = bounded(0.0, 5.0, 0.8)  # where the error is taken [own]
    kp: float = bounded(0.0, 1e4, 25.0)  # turn units per m [field]
    ki: float = bounded(0.0, 1e4, 0.0)  # turn units per m s [field]
    kd: float = bounded(0.0, 1e4, 5.0)  # turn units s per m [field]
    derivative_time_s: float = bounded(0.0, 10.0, 0.1)  # low pass of the derivative [own]
    turn_half_range: float = bounded(1.0, 1e4, 50.0)  # turn units of a full turn [field]
    max_speed_m_s: float = bounded(0.01, 10.0, 1.2)  # [robot]
    min_turn_radius_m: float = bounded(0.01, 10.0, 0.381)  # at full speed and full turn [robot]

    # Start and end (5.2.1)
    end_points: int = bounded(1, 1081, 8)  # fewer returns ahead: no row there [own]
    end_after_s: float = bounded(0.0, 60.0, 1.0)  # both rows gone for so long: the end [own]
    max_gap_s: float = bounded(0.1, 60.0, 0.5)  # no scan for longer: find the rows anew [own]

    def __post_init__(self) -> None:
        """Raises ValueError for a value beyond its limits, or values with which no row would ever be followed."""
        for one in fields(self):
            value, (low, high) = getattr(self, one.name), one.metadata["limits"]
            if not (math.isfinite(value) and low <= value <= high):
                raise ValueError(f"{one.name}: found {value}, expected {low:g} to {high:g}")
        half_m = self.lane_width_m / 2.0
        for low, high in (("beside_min_m", "beside_max_m"), ("lateral_min_m", "lateral_max_m")):
            if not getattr(self, low) < half_m <= getattr(self, high):
                raise ValueError(
                    f"{low}, {high}: found {getattr(self, low)} and {getattr(self, high)}, expected half the"
                    f" lane_width_m between them, {half_m:g}"
                )
        if self.speed_m_s > self.max_speed_m_s:
            raise ValueError(
                f"speed_m_s: found {self.speed_m_s}, expected at most max_speed_m_s, {self.max_speed_m_s}"
            )

    @property
    def max_turn_rad_s(self) -> float:
        """Turn rate of a full turn command: largest speed on the smallest radius."""
        return self.max_speed_m_s / self.min_turn_radius_m
