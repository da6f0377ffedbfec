# SPDX-License-Identifier: MIT
"""Keeps a robot in the middle between two crop rows; a plain algorithm that knows neither ROS nor UDP."""
import math
from statistics import median
from typing import Sequence, Tuple

SPEED_M_S = 0.5
HALF_LANE_M = 0.38
GAIN_RAD_S_M = 2.0  # turn rate for each metre that the middle lies to the left


def command(
    ranges_m: Sequence[float], angle_min_rad: float, step_rad: float
) -> Tuple[float, float]:
    """Returns speed [m/s] and turn rate [rad/s] for a scan; both 0 where no row is in sight."""
    left, right = [], []
    for number, range_m in enumerate(ranges_m):
        if math.isfinite(range_m):
            angle = angle_min_rad + number * step_rad
            x, y = range_m * math.cos(angle), range_m * math.sin(angle)
            if 0.0 < x < 1.5 and 0.12 < abs(y) < 0.7:
                (left if y > 0.0 else right).append(y)
    if not left and not right:
        return 0.0, 0.0
    left_m = median(left) if left else median(right) + 2.0 * HALF_LANE_M
    right_m = median(right) if right else left_m - 2.0 * HALF_LANE_M
    return SPEED_M_S, max(-0.8, min(0.8, GAIN_RAD_S_M * (left_m + right_m) / 2.0))
