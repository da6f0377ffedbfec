# SPDX-License-Identifier: MIT
"""Pre-processing of a scan (thesis 5.1.1): Cartesian points, left and right, rectangle, histogram, subset.

Points are arrays (n, 2) of x [m] forward and y [m] left in the lidar's frame.
"""
from typing import Tuple

import numpy as np

from ardee_navigation.lbirnt.parameters import Parameters


def to_cartesian(ranges_m: np.ndarray, angle_min_rad: float, increment_rad: float) -> np.ndarray:
    """Polar to Cartesian; beams without a return (infinite, NaN, not above zero) are dropped."""
    ranges = np.asarray(ranges_m, dtype=float)
    angles = angle_min_rad + increment_rad * np.arange(len(ranges))
    good = np.isfinite(ranges) & (ranges > 0.0)
    r, a = ranges[good], angles[good]
    return np.column_stack((r * np.cos(a), r * np.sin(a)))


def split_sides(points: np.ndarray, slope: float, offset_m: float) -> Tuple[np.ndarray, np.ndarray]:
    """Points left and right of the line y = slope x + offset: the robot's axis, or the centre line last used."""
    left = points[:, 1] > slope * points[:, 0] + offset_m
    return points[left], points[~left]


def keep_rectangle(points: np.ndarray, parameters: Parameters, slope: float) -> np.ndarray:
    """Points in the rectangle beside the robot where a crop row is expected, turned along the rows by their slope."""
    along, across = rotate(points, slope)
    beside = np.abs(across)
    inside = (along >= -parameters.behind_m) & (along <= parameters.ahead_m)
    inside &= (beside >= parameters.beside_min_m) & (beside <= parameters.beside_max_m)
    return points[inside]


def rotate(points: np.ndarray, slope: float) -> Tuple[np.ndarray, np.ndarray]:
    """Coordinates along and across a direction of the given slope dy/dx."""
    length = np.hypot(1.0, slope)
    x, y = points[:, 0], points[:, 1]
    return (x + slope * y) / length, (y - slope * x) / length


def fullest_bin(distances_m: np.ndarray, bin_m: float) -> int:
    """Index of the fullest bin [i bin_m, (i + 1) bin_m) of a histogram of at least one; of several the nearest."""
    index = np.floor(np.asarray(distances_m) / bin_m + 1e-9).astype(int)
    return int(np.argmax(np.bincount(index)))


def choose_subset(points: np.ndarray, parameters: Parameters, slope: float) -> np.ndarray:
    """Points whose distance across the rows lies in the fullest bin of their histogram or just beside it."""
    if len(points) == 0:
        return points
    across = np.abs(rotate(points, slope)[1])
    fullest = fullest_bin(across, parameters.bin_m)
    low = fullest * parameters.bin_m - parameters.keep_beside_m
    high = (fullest + 1) * parameters.bin_m + parameters.keep_beside_m
    return points[(across >= low) & (across < high)]
