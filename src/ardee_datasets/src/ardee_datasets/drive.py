# SPDX-License-Identifier: MIT
"""A robot that follows a lane of a field by the truth, and the poses of its cameras on the way."""

import math

import numpy as np
from ardee_sim import Twist
from scipy.spatial.transform import Rotation

from ardee_common.errors import GeneratorError
from ardee_datasets.robots import MountedCamera, Robot
from ardee_datasets.scenery import CameraPose, Scenery
from ardee_datasets.seeds import stream

_SETTLE_S = 1.0  # in which a robot comes to rest on its springs
_PERIOD_S = 0.05  # of control
_AHEAD_M = 0.6  # of the point at which it steers (pure pursuit: Coulter, CMU-RI-TR-92-01, 1992)
_SLOW = 5.0  # times as long as planned, a drive is given up


class Drive:
    """A robot in the simulation of a scene, from the beginning of a drawn lane on, until close()."""

    def __init__(self, scenery: Scenery, name: str, robot: Robot, seed: int) -> None:
        rng = stream(seed, "drive", name)
        self._sim, self.name, self._robot = scenery.simulation, name, robot
        self._lane = scenery.draw_lane(rng)
        self._offset_m = float(rng.uniform(*robot.keys.offset_m))
        self._speed_m_s = float(rng.uniform(*robot.keys.speed_m_s))
        begin = self._lane.centre.at(0.0)
        side = begin.yaw_rad + math.pi / 2
        x = begin.x_m + self._offset_m * math.cos(side)
        y = begin.y_m + self._offset_m * math.sin(side)
        z = scenery.standing_m(begin._replace(x_m=x, y_m=y))
        self._sim.set_parameters(robot.parameters)
        self._sim.spawn(name, robot.urdf, xyz_m=(x, y, z), rpy_rad=(0.0, 0.0, begin.yaw_rad))
        if robot.keys.controllers:
            self._sim.start_controllers(name, *robot.keys.controllers)
        self._command(0.0, 0.0)
        self._sim.step(round(_SETTLE_S * 1e9 / self._sim.step_ns))

    @property
    def length_m(self) -> float:
        """Length of the way."""
        return self._lane.centre.length_m

    def _command(self, speed_m_s: float, turn_rad_s: float) -> None:
        twist = Twist(linear_x_m_s=speed_m_s, angular_z_rad_s=turn_rad_s)
        self._sim.command(self._robot.keys.command, twist)

    def to(self, along_m: float) -> None:
        """Drives until the robot's origin is that far along the lane. Raises GeneratorError if it stays behind."""
        steps = max(round(_PERIOD_S * 1e9 / self._sim.step_ns), 1)
        give_up_s = _SLOW * (self.length_m / self._speed_m_s + _SETTLE_S)
        end_ns = self._sim.time_ns + round(give_up_s * 1e9)
        while True:
            state = self._sim.state(self.name)
            seen = self._lane.centre.project(*state.xyz_m[:2])
            if seen.along_m >= along_m:
                return
            if self._sim.time_ns > end_ns:
                found = f"found robot {self.name} {seen.along_m:.2f} m along its lane after {give_up_s:.0f} s"
                raise GeneratorError(f"{found}, expected {along_m:.2f} m")
            goal = self._lane.centre.at(seen.along_m + _AHEAD_M)
            side = goal.yaw_rad + math.pi / 2
            x = goal.x_m + self._offset_m * math.cos(side) - state.xyz_m[0]
            y = goal.y_m + self._offset_m * math.sin(side) - state.xyz_m[1]
            aside = math.sin(math.atan2(y, x) - state.yaw_rad)
            self._command(self._speed_m_s, 2.0 * self._speed_m_s * aside / math.hypot(x, y))
            self._sim.step(steps)

    def pose(self, camera: MountedCamera) -> CameraPose:
        """Returns the present pose and motion of a camera."""
        link = self._sim.state(f"{self.name}::{camera.link}")
        rotation = Rotation.from_quat(link.quat_xyzw)
        arm_m = rotation.apply(camera.xyz_m)
        v_m_s = link.v_m_s + np.cross(link.w_rad_s, arm_m)
        return CameraPose(link.xyz_m + arm_m, rotation * camera.rotation, v_m_s, link.w_rad_s)

    def close(self) -> None:
        """Takes the robot out of the field."""
        self._sim.remove(self.name)
