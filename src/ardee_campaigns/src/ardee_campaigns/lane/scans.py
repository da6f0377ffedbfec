# SPDX-License-Identifier: MIT
"""Scans of a lidar down a lane, and what a row follower perceived in them, of a real robot or of a simulated one."""
import math
from dataclasses import dataclass
from typing import List, Tuple

import numpy as np

from ardee_navigation.lbirnt import Output, Parameters, RowFollower


@dataclass(frozen=True)
class Scans:
    """Consecutive scans in the lidar's frame, x forward, angles counter-clockwise."""

    time_s: np.ndarray  # (n,)
    ranges_m: np.ndarray  # (n, beams), infinite without a return, 0 nearer than the lidar measures
    angle_min_rad: float
    increment_rad: float

    @property
    def angles_rad(self) -> np.ndarray:
        """Returns the angle of each beam."""
        return self.angle_min_rad + self.increment_rad * np.arange(self.ranges_m.shape[1])


@dataclass(frozen=True)
class Perceived:
    """Answers of a row follower to scans."""

    time_s: np.ndarray  # (n,)
    left_m: np.ndarray  # from the lidar to the left row
    right_m: np.ndarray
    heading_rad: np.ndarray  # of the robot in the lane, positive to the left
    spread_m: np.ndarray  # (n, 2) SD of the left, the right points about their line; nan without one


def returns_m(
    ranges_m: np.ndarray, range_min_m: float = 0.0, range_max_m: float = math.inf
) -> np.ndarray:
    """Ranges of Scans from those of messages: -inf (REP 117) and less than the least are too near to measure.

    0 is no return, as some drivers write it.
    """
    near = (ranges_m == -math.inf) | (ranges_m > 0.0) & (ranges_m < range_min_m)
    measured = (ranges_m > 0.0) & (ranges_m <= range_max_m)
    return np.where(near, 0.0, np.where(measured, ranges_m, math.inf))


def _spread_m(points: np.ndarray) -> float:
    """Standard deviation of points about their fitted line, across it."""
    if len(points) < 3 or np.ptp(points[:, 0]) == 0.0:
        return math.nan
    slope, offset = np.polyfit(points[:, 0], points[:, 1], 1)
    return float(np.std(points[:, 1] - slope * points[:, 0] - offset)) / math.hypot(1.0, slope)


def answer(output: Output) -> Tuple[float, ...]:
    """Returns what the row follower perceived: a line of Perceived without its time."""
    lane = output.lane
    spreads = (_spread_m(side) for side in output.sides)
    return (lane.left.distance_m, -lane.right.distance_m, -lane.centre.angle_rad, *spreads)


def perceived(answers: List[Tuple[float, ...]]) -> Perceived:
    """Returns times and answers together."""
    columns = np.array(answers)
    return Perceived(*columns[:, :4].T, columns[:, 4:])


def follow(scans: Scans, parameters: Parameters) -> Perceived:
    """Returns the answers of this workspace's row follower to recorded scans, whatever the robot then did."""
    follower = RowFollower(parameters)
    answers = []
    for time_s, ranges in zip(scans.time_s, scans.ranges_m):
        output = follower.update(ranges, scans.angle_min_rad, scans.increment_rad, float(time_s))
        answers.append((float(time_s), *answer(output)))
    return perceived(answers)
