# SPDX-License-Identifier: MIT
"""The technique as a whole: a scan in, a motion command and all that was seen on the way out (thesis Figure 5.1)."""
import math
from dataclasses import dataclass
from typing import Optional, Tuple

import numpy as np

from ardee_navigation.lane_following.control import centre_error_m
from ardee_navigation.lane_following.follower import LaneFollower, State
from ardee_navigation.lane_following.line import turned
from ardee_navigation.lbirnt import preprocess
from ardee_navigation.lbirnt.lane import Lane, straight_lane, update_lane
from ardee_navigation.lbirnt.lines import Estimate, estimate
from ardee_navigation.lbirnt.parameters import Parameters
from ardee_navigation.lbirnt.validity import leading_side, valid_sides


@dataclass(frozen=True)
class Output:
    """Command and perception after one scan."""

    state: State
    speed_m_s: float
    turn_rad_s: float
    lane: Lane  # lines in use
    valid: Tuple[bool, bool]  # whether the left and the right line were valid in this scan
    sides: Tuple[np.ndarray, np.ndarray]  # points of each side that were fitted
    error_m: float


class RowFollower:
    """Follows the lane between two rows, scan by scan."""

    def __init__(self, parameters: Parameters = Parameters()) -> None:
        self._parameters = parameters
        self._run = LaneFollower(parameters)
        self.reset()

    def reset(self) -> None:
        """Restores the state before the first scan; call it after the robot was set down anew."""
        self._run.reset()
        self._forget()

    def _forget(self) -> None:
        """Forgets the lane, as before the first scan."""
        self._lane = straight_lane(self._parameters)
        self._lead = 0  # side whose line gave the lane its direction: 0 left, 1 right
        self._unseen_s = (
            math.inf,
            math.inf,
        )  # how long the left, the right line has not been valid

    def update(
        self, ranges_m: np.ndarray, angle_min_rad: float, increment_rad: float, time_s: float
    ) -> Output:
        """Returns the output for the scan taken at `time_s`."""
        dt_s = self._run.elapsed_s(time_s)
        if dt_s is None:
            self._forget()
            dt_s = 0.0
        points = preprocess.to_cartesian(ranges_m, angle_min_rad, increment_rad)
        predicted = self._predict(dt_s)
        sides = self._preprocess(points, predicted)
        valid = self._update_lane(sides, predicted, dt_s)
        centre = self._lane.centre
        command = self._run.steer(centre, any(valid), self._is_gone(sides), dt_s)
        error_m = centre_error_m(centre, self._parameters)
        return Output(self._run.state, *command, self._lane, valid, sides, error_m)

    def _predict(self, dt_s: float) -> Lane:
        """The lane in use, seen from where the last command has taken the robot."""
        speed, turn = self._run.command
        motion = (turn * dt_s, speed * dt_s, self._parameters.lidar_ahead_m)
        return Lane(turned(self._lane.left, *motion), turned(self._lane.right, *motion))

    def _preprocess(self, points: np.ndarray, lane: Lane) -> Tuple[np.ndarray, np.ndarray]:
        slope = lane.centre.slope
        chosen = []
        for side in preprocess.split_sides(points, slope, 0.0):
            inside = preprocess.keep_rectangle(side, self._parameters, slope)
            chosen.append(preprocess.choose_subset(inside, self._parameters, slope))
        return chosen[0], chosen[1]

    def _update_lane(
        self, sides: Tuple[np.ndarray, np.ndarray], before: Lane, dt_s: float
    ) -> Tuple[bool, bool]:
        left, right = estimate(sides[0], before.left), estimate(sides[1], before.right)
        known = [unseen_s <= self._parameters.max_coast_s for unseen_s in self._unseen_s]
        lines = (before.left if known[0] else None, before.right if known[1] else None)
        valid = valid_sides(left, right, lines, self._parameters)
        seconds = (0.0 if good else old_s + dt_s for good, old_s in zip(valid, self._unseen_s))
        self._unseen_s = (next(seconds), next(seconds))
        if left and right and all(valid):
            self._lead = leading_side(left, right, self._lead, self._parameters)
        elif any(valid):
            self._lead = int(valid[1])
        found = (_if(valid[0], left), _if(valid[1], right))
        self._lane = update_lane(before, *found, self._lead, self._parameters)
        return valid

    def _is_gone(self, sides: Tuple[np.ndarray, np.ndarray]) -> bool:
        ahead = [np.count_nonzero(side[:, 0] > 0.0) for side in sides]
        return max(ahead) < self._parameters.end_points


def _if(valid: bool, found: Optional[Estimate]) -> Optional[Estimate]:
    return found if valid else None
