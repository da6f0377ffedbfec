# SPDX-License-Identifier: MIT
"""Parameters of the lidar-based in-row navigation technique (LBIRNT), with units, limits and where they come from.

[field] one published field deployment on this robot: longitudinal window -1 to 2 m, 0.1 m bins. [real run] what the
robot's own LBIRNT logged in the run of ardee_campaigns' real_lane.yaml (README). [robot] the TerraSentia.
[own] chosen here; the thesis (5.1) names the check but no number. Those of the lane, of control and of
the row's end are lane_following's.
"""
from dataclasses import dataclass

from ardee_common.options import bounded
from ardee_navigation.lane_following.parameters import LaneParameters


@dataclass(frozen=True)
class Parameters(LaneParameters):
    """All numbers of the technique. Frame: the lidar's, x forward, y left."""

    # Pre-processing (thesis 5.1.1)
    lidar_ahead_m: float = bounded(-2.0, 2.0, 0.22)  # before the turning centre [robot]
    behind_m: float = bounded(0.0, 10.0, 1.0)  # rectangle: from here behind the lidar [field]
    ahead_m: float = bounded(0.1, 20.0, 2.0)  # to here before it [field]
    beside_min_m: float = bounded(0.0, 2.0, 0.15)  # nearer is no row [real run]
    beside_max_m: float = bounded(0.1, 3.0, 1.0)  # farther is the next lane [real run]
    bin_m: float = bounded(0.005, 1.0, 0.1)  # of the histogram of lateral distance [field]
    keep_beside_m: float = bounded(0.0, 1.0, 0.05)  # kept on each side of the fullest [real run]

    # Single-line checks (5.1.2)
    min_points: int = bounded(2, 1081, 8)  # fewer returns make no line [own]
    min_length_m: float = bounded(0.0, 20.0, 0.8)  # the shortest of 706 had 0.86 [real run]
    lateral_min_m: float = bounded(0.0, 3.0, 0.15)  # acceptable distance of a row [own]
    lateral_max_m: float = bounded(0.1, 3.0, 0.60)  # [own]

    # Checks of both lines (5.1.2)
    lane_width_tolerance_m: float = bounded(0.01, 1.0, 0.15)  # [own]
    max_angle_between_rad: float = bounded(0.01, 3.2, 0.25)  # rows are parallel [own]
    lead_bonus: float = bounded(0.0, 4.0, 0.1)  # line grade of the side that led before [real run]

    # The end of the row (5.2.1)
    end_points: int = bounded(1, 1081, 8)  # fewer returns ahead: no row there [own]

    def __post_init__(self) -> None:
        """Raises ValueError for a value beyond its limits, or values with which no row would ever be followed."""
        super().__post_init__()
        half_m = self.lane_width_m / 2.0
        for low, high in (("beside_min_m", "beside_max_m"), ("lateral_min_m", "lateral_max_m")):
            if not getattr(self, low) < half_m <= getattr(self, high):
                raise ValueError(
                    f"{low}, {high}: found {getattr(self, low)} and {getattr(self, high)}, expected half the"
                    f" lane_width_m between them, {half_m:g}"
                )
