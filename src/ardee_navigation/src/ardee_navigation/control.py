# SPDX-License-Identifier: MIT
"""The row follower as a controller of a campaign: ardee_navigation.control:make."""
from typing import Any, Mapping, Optional, Tuple

import numpy as np

from ardee_common.config import from_values
from ardee_navigation.lbirnt import Output, Parameters, RowFollower, State


class Controller:
    """Answers each scan by speed [m/s] and turn rate [rad/s].

    seen : distances (left_m, right_m) from the lidar to the rows in use
    points : numbers of returns to which the left and the right line were fitted
    output : all of the last answer, None before the first
    is_finished : whether both rows have ended
    """

    def __init__(self, parameters: Parameters) -> None:
        self._follower = RowFollower(parameters)
        self.reset()

    def reset(self) -> None:
        """Begins anew, as after the robot was set down."""
        self._follower.reset()
        self.seen: Tuple[float, float] = (np.nan, np.nan)
        self.points = (0, 0)
        self.output: Optional[Output] = None
        self.is_finished = False

    def step(self, observation: Mapping[str, Any], time_s: float) -> Tuple[float, float]:
        """Returns the command for the LidarReading of use `scan`."""
        scan = observation["scan"]
        # as sensor_msgs/LaserScan carries them, so that the answers are those of the ROS node
        angle_min, increment = (
            float(np.float32(value)) for value in (scan.angle_min_rad, scan.angle_increment_rad)
        )
        output = self.output = self._follower.update(scan.ranges_m, angle_min, increment, time_s)
        self.seen = (output.lane.left.distance_m, -output.lane.right.distance_m)
        self.points = (len(output.sides[0]), len(output.sides[1]))
        self.is_finished = output.state is State.FINISHED
        return output.speed_m_s, output.turn_rad_s


def make(params: Mapping[str, Any], robot: Any, seed: int) -> Controller:
    """Returns the row follower; params: any of lbirnt.Parameters, lidar_ahead_m by default as the robot has it."""
    ahead_m = round(float(robot.sensor_xyz_m[0]), 6)
    return Controller(from_values(Parameters, {"lidar_ahead_m": ahead_m, **params}))
