# SPDX-License-Identifier: MIT
"""Distances that a controller perceives in recorded scans, whatever the robot then did; distributions and distances."""
from dataclasses import dataclass
from typing import Any, Callable, Dict, List, Mapping, NamedTuple, Sequence

import numpy as np
from ardee_sim import LidarReading
from scipy import stats

from ardee_campaigns.controllers import seen
from ardee_campaigns.lane.scans import Scans
from ardee_campaigns.report.statistics import Quantity
from ardee_campaigns.robot import Robot

PAUSE_S = 0.5  # between two scans: the robot may have been carried, so the controller begins anew
CONSECUTIVE_S = 0.1  # scans farther apart are not compared
SIDE_DEG = 30.0  # half width of the sectors abeam


@dataclass(frozen=True)
class Looked:
    """A run as a controller perceives it.

    time_s : (n,) from the first scan
    left_m, right_m : (n,) distances from the lidar to the rows
    points : (n, 2) returns that make the left and the right line, NaN if the controller does not say
    """

    name: str
    scans: Scans
    time_s: np.ndarray
    left_m: np.ndarray
    right_m: np.ndarray
    points: np.ndarray

    def half(self, number: int) -> "Looked":
        """Returns the first (0) or the second (1) half."""
        middle = len(self.time_s) // 2
        part = slice(None, middle) if number == 0 else slice(middle, None)
        first, increment = self.scans.angle_min_rad, self.scans.increment_rad
        scans = Scans(self.scans.time_s[part], self.scans.ranges_m[part], first, increment)
        columns = (self.time_s, self.left_m, self.right_m, self.points)
        return Looked(self.name, scans, *(column[part] for column in columns))


def look(
    name: str,
    scans: Scans,
    make: Callable[..., Any],
    params: Mapping[str, Any],
    lidar_ahead_m: float,
) -> Looked:
    """Shows each scan to a controller, with the lidar so far before the robot's middle."""
    period_s = float(np.median(np.diff(scans.time_s)))
    ahead = np.array([lidar_ahead_m, 0.0, 0.0])
    robot = Robot("robot", {"scan": "scan"}, "scan", period_s, np.zeros((0, 2)), ahead)
    controller, answers, before_s = make(dict(params), robot, 0), [], -np.inf
    controller.reset()
    for time_s, ranges in zip(scans.time_s.tolist(), scans.ranges_m):
        if time_s - before_s > PAUSE_S:
            controller.reset()
        controller.step({"scan": _reading(scans, time_s, ranges, period_s)}, time_s)
        points = getattr(controller, "points", None) or (np.nan, np.nan)
        answers.append((*seen(controller), *points))
        before_s = time_s
    columns = np.array(answers, dtype=float)
    began_s = scans.time_s[0]
    return Looked(name, scans, scans.time_s - began_s, *columns[:, :2].T, columns[:, 2:])


def _reading(scans: Scans, time_s: float, ranges_m: np.ndarray, period_s: float) -> LidarReading:
    ranges = np.where(ranges_m > 0.0, ranges_m, -np.inf).astype(np.float32)  # as messages have them
    first, increment = float(scans.angle_min_rad), float(scans.increment_rad)
    last = first + increment * (len(ranges) - 1)
    farthest = float(ranges[np.isfinite(ranges)].max(initial=0.0))
    nothing = np.zeros(len(ranges), np.float32)
    angles, times = (first, last, increment), (0.0, period_s)
    return LidarReading(
        round(time_s * 1e9), "lidar", *angles, *times, 0.0, farthest, ranges, nothing
    )


QUANTITIES = (
    Quantity("width_m", "perceived row width [cm]", 100.0, 2),
    Quantity("change_m", "change of a perceived distance, scan to scan [mm]", 1e3, 2),
    Quantity("offset_m", "offset from the middle between the perceived rows [cm]", 100.0, 2),
    Quantity("points", "inliers: returns that make a line", 1.0, 1),
    Quantity("period_s", "period of the scans [ms]", 1e3, 2),
    Quantity("side_range_m", "range of the beams abeam, ± 30° [m]", 1.0, 3),
    Quantity("side_change_m", "change of a beam abeam, scan to scan [mm]", 1e3, 1),
)


def distributions(runs: Sequence[Looked]) -> Dict[str, np.ndarray]:
    """Returns the finite values of each quantity in all runs together."""
    found = [_values(run) for run in runs]
    joined = {one.name: np.concatenate([part[one.name] for part in found]) for one in QUANTITIES}
    return {name: values[np.isfinite(values)] for name, values in joined.items()}


def _values(run: Looked) -> Dict[str, np.ndarray]:
    period_s = np.diff(run.time_s)
    near = period_s < CONSECUTIVE_S
    degrees = np.degrees(run.scans.angles_rad)
    sides_m = run.scans.ranges_m[:, np.abs(np.abs(degrees) - 90.0) <= SIDE_DEG + 1e-6]
    changes = [_changes(values, near) for values in (run.left_m, run.right_m)]
    return {
        "width_m": run.left_m + run.right_m,
        "change_m": np.concatenate(changes),
        "offset_m": (run.right_m - run.left_m) / 2.0,
        "points": run.points.ravel(),
        "period_s": period_s[period_s <= PAUSE_S],
        "side_range_m": sides_m.ravel(),
        "side_change_m": _changes(sides_m, near).ravel(),
    }


def _changes(values: np.ndarray, near: np.ndarray) -> np.ndarray:
    with np.errstate(invalid="ignore"):  # no return twice
        return np.abs(np.diff(values, axis=0))[near]


class Distance(NamedTuple):
    """Distance of two distributions; NaN where one is empty."""

    wasserstein: float  # mean way that a value must be moved, in the quantity's unit
    ks: float  # largest difference of the two cumulative shares (Kolmogorov and Smirnov)


def distance(one: np.ndarray, other: np.ndarray) -> Distance:
    """Returns the distance of two samples' distributions."""
    if not len(one) or not len(other):
        return Distance(np.nan, np.nan)
    ks = stats.ks_2samp(one, other, method="asymp").statistic
    return Distance(float(stats.wasserstein_distance(one, other)), float(ks))


@dataclass(frozen=True)
class Line:
    """A quantity of the real run and of the simulated ones."""

    quantity: Quantity
    real: np.ndarray
    simulated: np.ndarray
    distance: Distance
    halves: Distance  # of the two halves of the real run: so far apart are two parts of one field
    each: List[Distance]  # of each simulated run from the real one


def compare(real: Looked, runs: Sequence[Looked]) -> List[Line]:
    """Compares a real run with simulated ones."""
    ours, theirs = distributions([real]), distributions(runs)
    parts = [distributions([real.half(number)]) for number in (0, 1)]
    each = [distributions([run]) for run in runs]
    return [
        Line(
            one,
            ours[one.name],
            theirs[one.name],
            distance(ours[one.name], theirs[one.name]),
            distance(*(part[one.name] for part in parts)),
            [distance(ours[one.name], run[one.name]) for run in each],
        )
        for one in QUANTITIES
    ]
