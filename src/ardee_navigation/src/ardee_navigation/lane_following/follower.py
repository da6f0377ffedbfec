# SPDX-License-Identifier: MIT
"""A run along a lane: when to drive, by which turn rate, and when the row has ended."""
from enum import Enum
from typing import Optional, Tuple

from ardee_navigation.lane_following.control import Pid, centre_error_m, turn_rate_rad_s
from ardee_navigation.lane_following.line import Line
from ardee_navigation.lane_following.parameters import LaneParameters


class State(Enum):
    """Phase of an experimental run (thesis 5.2.1)."""

    WAITING = "waiting"  # no row seen yet
    FOLLOWING = "following"
    FINISHED = "finished"  # the rows are gone


class LaneFollower:
    """Steers along a centre line; at each reading of the sensor call `elapsed_s`, then `steer`.

    state : phase of the run
    command : speed [m/s] and turn rate [rad/s] in force
    """

    def __init__(self, parameters: LaneParameters) -> None:
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
        """Restores the state before the first reading; call it after the robot was set down anew."""
        self.state = State.WAITING
        self._last_s = None  # type: Optional[float]
        self._forget()

    def _forget(self) -> None:
        self._gone_s, self._has_seen = 0.0, False
        self.command = (0.0, 0.0)
        self._pid.reset()

    def elapsed_s(self, time_s: float) -> Optional[float]:
        """Returns the time since the reading before; None without one, or if the robot may have been moved since."""
        last_s, self._last_s = self._last_s, time_s
        if last_s is not None and time_s - last_s <= self._parameters.max_gap_s:
            return max(time_s - last_s, 0.0)
        self._forget()
        return None

    def steer(
        self, centre: Line, is_valid: bool, is_gone: bool, dt_s: float
    ) -> Tuple[float, float]:
        """Returns the command for the lane's centre line in use.

        is_valid : whether this reading showed a row; is_gone : whether it shows that none lies ahead.
        """
        self._has_seen = self._has_seen or is_valid
        if self.state is State.WAITING and is_valid:
            self.state = State.FOLLOWING
        self._gone_s = self._gone_s + dt_s if is_gone else 0.0
        if self.state is State.FOLLOWING and self._gone_s >= self._parameters.end_after_s:
            self.state = State.FINISHED
        self.command = (0.0, 0.0)
        if self.state is State.FOLLOWING and self._has_seen:
            turn = self._pid.update(centre_error_m(centre, self._parameters), dt_s)
            self.command = (self._parameters.speed_m_s, turn_rate_rad_s(turn, self._parameters))
        return self.command
