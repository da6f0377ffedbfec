# SPDX-License-Identifier: MIT
"""Speed of a robot from its scans alone, as a log of a real run may not have it."""
import math

import numpy as np
from scipy.spatial import cKDTree

from ardee_campaigns.lane.scans import Scans

LAG_S = 0.2  # between the two scans of a pair
PAIRS = 8  # of a run, evenly spread
WITHIN_M = 0.03  # points farther from each other are not of the same thing: a few SD of the lidar
NEAREST_M, FARTHEST_M = 0.15, 3.0  # nearer is the robot itself, farther beams are sparse
SPEEDS_M_S = np.arange(-0.2, 1.21, 0.05)
TURNS_RAD = np.radians(np.arange(-2.0, 2.1, 1.0))


def _points(scans: Scans, number: int) -> np.ndarray:
    ranges = scans.ranges_m[number]
    near = (ranges > NEAREST_M) & (ranges < FARTHEST_M)
    angles = scans.angles_rad[near]
    return ranges[near, None] * np.column_stack((np.cos(angles), np.sin(angles)))


def _agreement(points: np.ndarray, others: cKDTree) -> float:
    """Number of points that lie on others, those halfway to WITHIN_M counted half."""
    apart_m = others.query(points, distance_upper_bound=WITHIN_M)[0]
    return float(np.sum(1.0 - np.minimum(apart_m, WITHIN_M) / WITHIN_M))


def _pair_speed(scans: Scans, first: int, second: int) -> float:
    """Speed forward, of those tried, with which the first scan lies best on the second."""
    elapsed_s = scans.time_s[second] - scans.time_s[first]
    points, others = _points(scans, first)[::2], cKDTree(_points(scans, second))  # half are enough
    best, found = -1.0, math.nan
    for speed in SPEEDS_M_S:
        moved = points - (speed * elapsed_s, 0.0)
        for turn in TURNS_RAD:
            cosine, sine = math.cos(turn), math.sin(turn)
            agreement = _agreement(moved @ [[cosine, -sine], [sine, cosine]], others)
            if agreement > best:
                best, found = agreement, float(speed)
    return found


def scan_speed_m_s(scans: Scans) -> float:
    """Returns the mean speed forward [m/s]; nan for scans of less than LAG_S in a row."""
    time_s = scans.time_s
    seconds = np.searchsorted(time_s, time_s + LAG_S - 1e-3)
    firsts = np.flatnonzero(seconds < len(time_s))
    elapsed_s = time_s[seconds[firsts]] - time_s[firsts]
    firsts = firsts[elapsed_s < 1.5 * LAG_S]  # else the robot was set down anew
    if len(firsts) == 0:
        return math.nan
    chosen = firsts[np.unique(np.linspace(0, len(firsts) - 1, PAIRS).astype(int))]
    return float(np.mean([_pair_speed(scans, i, seconds[i]) for i in chosen]))
