# SPDX-License-Identifier: MIT
"""Robot control (thesis 5.1.3): a PID on the turn rate, whose error is where the centre line lies before the robot."""
import math
from typing import Optional

from ardee_navigation.lane_following.line import Line
from ardee_navigation.lane_following.parameters import LaneParameters


def centre_error_m(centre: Line, parameters: LaneParameters) -> float:
    """Lateral position of the centre line `target_ahead_m` before the sensor: offset, and angle times distance."""
    return centre.at(parameters.target_ahead_m)


class Pid:
    """A classic PID; the derivative, of the error, passes a first-order low pass, the integral stops at the limits."""

    def __init__(
        self, kp: float, ki: float, kd: float, limit: float, derivative_time_s: float = 0.0
    ) -> None:
        self._gains, self._limit, self._derivative_time_s = (kp, ki, kd), limit, derivative_time_s
        self.reset()

    def reset(self) -> None:
        """Resets the integral and the derivative."""
        self._integral, self._derivative, self._last = (
            0.0,
            0.0,
            None,
        )  # type: float, float, Optional[float]

    def update(self, error: float, dt_s: float) -> float:
        """Output within the limits for the error at `dt_s` after the one before."""
        kp, ki, kd = self._gains
        if self._last is not None and dt_s > 0.0:
            slope = (error - self._last) / dt_s
            self._derivative += dt_s / (dt_s + self._derivative_time_s) * (slope - self._derivative)
        self._last = error
        integral = self._integral + error * max(dt_s, 0.0)
        output = kp * error + ki * integral + kd * self._derivative
        if abs(output) <= self._limit:
            self._integral = integral
        return math.copysign(min(abs(output), self._limit), output)


def turn_rate_rad_s(turn_units: float, parameters: LaneParameters) -> float:
    """Turn command, counted from straight ahead, to a turn rate, positive to the left."""
    return turn_units / parameters.turn_half_range * parameters.max_turn_rad_s
