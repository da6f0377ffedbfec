# SPDX-License-Identifier: MIT
"""The row follower by camera as a controller of a campaign: ardee_navigation.vision.control:make."""
from typing import Any, Mapping, Tuple

import numpy as np

from ardee_common.config import from_values
from ardee_navigation.lane_following import State
from ardee_navigation.vision.follower import VisionFollower
from ardee_navigation.vision.parameters import VisionParameters


class Controller:
    """Answers each picture by speed [m/s] and turn rate [rad/s].

    seen : distances (left_m, right_m) from the camera to the rows in use
    is_finished : whether the rows have ended
    """

    def __init__(self, parameters: VisionParameters) -> None:
        self._parameters = parameters
        self._follower = VisionFollower(parameters)
        self.reset()

    def reset(self) -> None:
        """Begins anew, as after the robot was set down."""
        self._follower.reset()
        self.seen: Tuple[float, float] = (np.nan, np.nan)
        self.is_finished = False

    def step(self, observation: Mapping[str, Any], time_s: float) -> Tuple[float, float]:
        """Returns the command for the ImageReading of use `picture`."""
        output = self._follower.update(observation["picture"].pixels, time_s)
        half_m = self._parameters.lane_width_m / 2.0
        left_m = output.centre.distance_m
        self.seen = (half_m + left_m, half_m - left_m)
        self.is_finished = output.state is State.FINISHED
        return output.speed_m_s, output.turn_rad_s


def make(params: Mapping[str, Any], robot: Any, seed: int) -> Controller:
    """Returns the row follower; params: any of VisionParameters, camera_ahead_m by default as the robot has it."""
    ahead_m = round(float(robot.sensor_xyz_m[0]), 6)
    return Controller(from_values(VisionParameters, {"camera_ahead_m": ahead_m, **params}))
