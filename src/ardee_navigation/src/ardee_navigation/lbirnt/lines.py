# SPDX-License-Identifier: MIT
"""Lines fitted to the points of a row, and quantities that validate them (thesis 5.1.1, equations 5.1 and 5.2)."""
import math
from dataclasses import dataclass
from typing import Optional

import numpy as np

from ardee_navigation.lane_following.line import Line


@dataclass(frozen=True)
class Estimate:
    """A fitted line with the quantities that validate it."""

    line: Line
    points: int  # np of equation 5.3
    length_m: float  # ly: of the fitted line
    deviation_m: float  # sd: standard deviation of measured minus fitted y
    change_m: float  # dd: of the orthogonal distance from the line used before


def least_squares(points: np.ndarray) -> Optional[Line]:
    """Slope by equation 5.1 and intercept by 5.2; None where all x are equal."""
    n = len(points)
    if n < 2:
        return None
    x, y = points[:, 0], points[:, 1]
    sx, sy, sxx, sxy = x.sum(), y.sum(), (x * x).sum(), (x * y).sum()
    denominator = n * sxx - sx**2
    if denominator <= 1e-12 * n * sxx:
        return None
    slope = (n * sxy - sx * sy) / denominator
    intercept = (sy * sxx - sx * sxy) / denominator
    return Line(float(slope), float(intercept))


def estimate(points: np.ndarray, before: Line) -> Optional[Estimate]:
    """The line through the points of one side and its qualities; `before` is the line used for that side until now."""
    line = least_squares(points)
    if line is None:
        return None
    x, y = points[:, 0], points[:, 1]
    deviation = float(np.std(y - (line.slope * x + line.offset_m)))
    length = float(np.ptp(x)) * math.hypot(1.0, line.slope)
    change = abs(line.distance_m - before.distance_m)
    return Estimate(line, len(points), length, deviation, change)
