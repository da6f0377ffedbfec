# SPDX-License-Identifier: MIT
"""Makes scans of rows in known places."""
import math
from typing import Optional, Tuple

import numpy as np

ANGLE_MIN_RAD, INCREMENT_RAD, BEAMS = -2.35619, 2 * 2.35619 / 1080, 1081  # a UST-10LX
ANGLES_RAD = ANGLE_MIN_RAD + INCREMENT_RAD * np.arange(BEAMS)
Wall = Tuple[float, float, float, float]  # slope, offset m, from x m, to x m


def scan_of(*walls: Wall, noise: Optional[Tuple[np.random.Generator, float]] = None) -> np.ndarray:
    """Returns ranges to the nearest of walls y = slope x + offset between two x; infinite without a wall."""
    ranges = np.full(BEAMS, np.inf)
    for slope, offset, low, high in walls:
        with np.errstate(divide="ignore", invalid="ignore"):
            r = offset / (np.sin(ANGLES_RAD) - slope * np.cos(ANGLES_RAD))
            x = r * np.cos(ANGLES_RAD)
        hit = (r > 0.0) & (r < 10.0) & (x >= low) & (x <= high)
        ranges = np.where(hit & (r < ranges), r, ranges)
    if noise:
        ranges = ranges + noise[1] * noise[0].standard_normal(BEAMS)
    return ranges


def lane_walls(
    lateral_m: float,
    heading_rad: float,
    width_m: float = 0.762,
    low: float = -5.0,
    high: float = 5.0,
) -> Tuple[Wall, Wall]:
    """Returns two walls of a lane, for a lidar so far left of its middle and turned left by the heading."""
    slope = -math.tan(heading_rad)

    def wall(distance_m: float) -> Wall:
        return slope, (distance_m - lateral_m) / math.cos(heading_rad), low, high

    return wall(width_m / 2), wall(-width_m / 2)
