# SPDX-License-Identifier: MIT
"""The simulator in this process, on a world with one robot, driven step by step.

Its numbers are those that sensor_msgs/LaserScan carries, so that a run over ROS (ros_simulation.py) is the same, byte
for byte.
"""
import math
from pathlib import Path
from typing import List, Tuple

import ardee_sim
import numpy as np
from ardee_sim.packages import find_package

from ardee_common.errors import GeneratorError
from ardee_navigation.evaluation.scan import Scan
from ardee_world.row_truth import Pose

ROBOT, SCANS, COMMANDS = "robot", "ardee/hokuyo", "cmd_vel"
_MOST_SCANS = 1000  # that may wait to be read


class SimulationError(RuntimeError):
    """Error of a simulator that did not do what was asked."""


def robot_urdf(bot_model: str = "tsv1_default.urdf.xacro") -> str:
    """URDF of an assembly file in terrasentia_description/robots, or of a path."""
    try:
        return ardee_sim.robot(find_package("terrasentia_description") / "robots" / bot_model)
    except ardee_sim.ArdeeError as error:
        why = str(error).splitlines()[-1]
        raise GeneratorError(
            f"--bot-model: found {bot_model!r}, of which xacro says: {why}"
        ) from None


class Simulation:
    """A world with one robot; a context manager."""

    def __init__(self, world: Path, seed: int, models: List[Path]) -> None:
        self._sim = ardee_sim.Simulation(
            ardee_sim.World.from_file(world, model_paths=models), seed=seed
        )
        self._scans = []  # type: List[ardee_sim.LidarReading]

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(self, *_: object) -> None:
        self._sim.close()

    def spawn(self, urdf: str, pose: Pose, z_m: float) -> None:
        """Spawns the robot."""
        place = (pose.x_m, pose.y_m, z_m)
        self._sim.spawn(ROBOT, urdf, xyz_m=place, rpy_rad=(0.0, 0.0, pose.yaw_rad))
        self._sim.demand(SCANS, keep=_MOST_SCANS)

    def step(self, steps: int) -> float:
        """Takes this many physics steps; returns the simulated time [s] after them."""
        self._sim.step(steps)
        self._scans += self._sim.drain(SCANS)
        return self._sim.time_ns * 1e-9

    def scan(self) -> Scan:
        """Returns the next scan."""
        if not self._scans:
            raise SimulationError(f"found no scan on {SCANS}, expected one of every lidar period")
        reading = self._scans.pop(0)
        seconds, nanoseconds = divmod(reading.stamp_ns, 10**9)
        return Scan(
            seconds + nanoseconds / 1e9,
            reading.ranges_m,
            float(np.float32(reading.angle_min_rad)),
            float(np.float32(reading.angle_increment_rad)),
        )

    def command(self, speed_m_s: float, turn_rad_s: float) -> Pose:
        """Commands the robot; returns its pose."""
        twist = ardee_sim.Twist(linear_x_m_s=speed_m_s, angular_z_rad_s=turn_rad_s)
        self._sim.command(COMMANDS, twist)
        return self.pose()

    def pose(self) -> Pose:
        """Returns the pose of the robot in the world frame."""
        state = self._sim.state(ROBOT)
        x_m, y_m, _ = (float(value) for value in state.xyz_m)
        return Pose(x_m, y_m, state.yaw_rad)

    def tilt(self) -> Tuple[float, float]:
        """Returns the robot's roll and pitch [rad], about the fixed axes turned by its yaw."""
        x, y, z, w = (float(value) for value in self._sim.state(ROBOT).quat_xyzw)
        roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
        return roll, math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))

    def set_pose(self, pose: Pose, z_m: float) -> None:
        """Sets the robot down at a pose, at rest."""
        quat = (0.0, 0.0, math.sin(pose.yaw_rad / 2), math.cos(pose.yaw_rad / 2))
        self._sim.set_state(ROBOT, xyz_m=(pose.x_m, pose.y_m, z_m), quat_xyzw=quat)
