# SPDX-License-Identifier: MIT
"""The technique as a whole: a scan in, a motion command and all that was seen on the way out (thesis Figure 5.1)."""
import math
from dataclasses import dataclass
from enum import Enum
from typing import Optional, Tuple

import numpy as np

from ardee_navigation.lbirnt import preprocess
from ardee_navigation.lbirnt.control import Pid, centre_error_m, turn_rate_rad_s
from ardee_navigation.lbirnt.lane import Lane, straight_lane, turned, update_lane
from ardee_navigation.lbirnt.lines import Estimate, estimate
from ardee_navigation.lbirnt.parameters import Parameters
from ardee_navigation.lbirnt.validity import valid_sides


class State(Enum):
    """Phase of an experimental run (thesis 5.2.1)."""

    WAITING = "waiting"  # no row seen yet
    FOLLOWING = "following"
    FINISHED = "finished"  # both rows are gone


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
        self._pid = Pid(
            parameters.kp,
            parameters.ki,
            parameters.kd,
            parameters.turn_half_range,
            parameters.derivative_time_s,
        )
        self.reset()

    def reset(self) -> None:
        """Restores the state before the first scan; call it after the robot was set down anew."""
        self._state = State.WAITING
        self._forget()

    def _forget(self) -> None:
        """Forgets the lane and the robot's motion, as before the first scan."""
        self._lane = straight_lane(self._parameters)
        self._last_s = None  # type: Optional[float]
        self._unseen_s = (
            math.inf,
            math.inf,
        )  # how long the left, the right line has not been valid
        self._gone_s = 0.0
        self._command = (0.0, 0.0)
        self._pid.reset()

    def update(
        self, ranges_m: np.ndarray, angle_min_rad: float, increment_rad: float, time_s: float
    ) -> Output:
        """Returns the output for the scan taken at `time_s`."""
        if self._last_s is not None and time_s - self._last_s > self._parameters.max_gap_s:
            self._forget()  # the robot's place is unknown: it may have been stopped meanwhile
        dt_s = 0.0 if self._last_s is None else max(time_s - self._last_s, 0.0)
        self._last_s = time_s
        points = preprocess.to_cartesian(ranges_m, angle_min_rad, increment_rad)
        predicted = self._predict(dt_s)
        sides = self._preprocess(points, predicted)
        valid = self._update_lane(sides, predicted, dt_s)
        self._update_state(sides, valid, dt_s)
        error_m = centre_error_m(self._lane.centre, self._parameters)
        self._command = self._control(error_m, dt_s)
        return Output(self._state, *self._command, self._lane, valid, sides, error_m)

    def _predict(self, dt_s: float) -> Lane:
        """The lane in use, seen from where the last command has taken the robot."""
        speed, turn = self._command
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
        self._lane = update_lane(
            before, _if(valid[0], left), _if(valid[1], right), self._parameters
        )
        return valid

    def _update_state(
        self, sides: Tuple[np.ndarray, np.ndarray], valid: Tuple[bool, bool], dt_s: float
    ) -> None:
        if self._state is State.WAITING and any(valid):
            self._state = State.FOLLOWING
        ahead = [np.count_nonzero(side[:, 0] > 0.0) for side in sides]
        gone = max(ahead) < self._parameters.end_points
        self._gone_s = self._gone_s + dt_s if gone else 0.0
        if self._state is State.FOLLOWING and self._gone_s >= self._parameters.end_after_s:
            self._state = State.FINISHED

    def _control(self, error_m: float, dt_s: float) -> Tuple[float, float]:
        seen = min(self._unseen_s) < math.inf  # a row, since the start or the last gap
        if self._state is not State.FOLLOWING or not seen:
            return 0.0, 0.0
        turn = self._pid.update(error_m, dt_s)
        return self._parameters.speed_m_s, turn_rate_rad_s(turn, self._parameters)


def _if(valid: bool, found: Optional[Estimate]) -> Optional[Estimate]:
    return found if valid else None
