# SPDX-License-Identifier: MIT
"""Parameters of following a lane, whichever sensor finds it, with units, limits and where they come from.

[field] one published field deployment of LBIRNT on this robot: PID 25 / 0 / 5 on a turn command of 0 to 100 with 50 as
straight ahead, about 0.5 m/s, lane 0.756 m. [robot] limits of the TerraSentia. [real run] what the figures of
real_lane.yaml speak for (README). [own] chosen here.
"""
import math
from dataclasses import dataclass, fields

from ardee_common.options import bounded


@dataclass(frozen=True)
class LaneParameters:
    """Numbers of a lane, of the checks of what a sensor finds of it, of control and of the row's end."""

    lane_width_m: float = bounded(0.2, 3.0, 0.762)  # 30 in (thesis 5.2); [field] 0.756

    # Checks of a line, update heuristics (thesis 5.1.2)
    max_angle_rad: float = bounded(0.01, 1.5, 0.45)  # of a row to the robot [own]
    max_angle_change_rad: float = bounded(0.01, 3.2, 0.20)  # from the line used before [own]
    max_change_m: float = bounded(0.005, 3.0, 0.15)  # of lateral distance, likewise [own]
    blend: float = bounded(0.01, 1.0, 1.0)  # weight of a new line against the one before [real run]
    max_coast_s: float = bounded(0.0, 60.0, 0.5)  # a line lost for longer: any is taken [own]

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
    end_after_s: float = bounded(0.0, 60.0, 1.0)  # rows gone for so long: the end [own]
    max_gap_s: float = bounded(0.1, 60.0, 0.5)  # sensor silent for longer: find the rows anew [own]

    def __post_init__(self) -> None:
        """Raises ValueError for a value beyond its limits, or a speed above the largest."""
        for one in fields(self):
            value, choices = getattr(self, one.name), one.metadata["choices"]
            if choices:
                if value not in choices:
                    expected = " or ".join(choices)
                    raise ValueError(f"{one.name}: found {value!r}, expected {expected}")
                continue
            low, high = one.metadata["limits"]
            if not (math.isfinite(value) and low <= value <= high):
                raise ValueError(f"{one.name}: found {value}, expected {low:g} to {high:g}")
        if self.speed_m_s > self.max_speed_m_s:
            raise ValueError(
                f"speed_m_s: found {self.speed_m_s}, expected at most max_speed_m_s, {self.max_speed_m_s}"
            )

    @property
    def max_turn_rad_s(self) -> float:
        """Turn rate of a full turn command: largest speed on the smallest radius."""
        return self.max_speed_m_s / self.min_turn_radius_m
