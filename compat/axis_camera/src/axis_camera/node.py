# SPDX-License-Identifier: MIT
"""axis_ptz.py: axis_camera/Axis on `cmd` and `state` for a simulated camera that pans, tilts and zooms."""
import math
import time
from typing import Dict, Optional

import rospy
from sensor_msgs.msg import CameraInfo, JointState
from std_msgs.msg import Float64

from axis_camera.msg import Axis
from axis_camera.ptz import ZOOM_WIDE, Camera, read_camera, to_degrees

NUMBERS = ("pan", "tilt", "zoom", "focus", "brightness", "iris")
REFUSED = ("flip", "speed_control")  # the original's, which the simulated camera has not
RETRY_S = 0.2  # between looks for the robot's description
WARN_S = 5.0  # simulated, between warnings of one kind


def wait_for_description() -> Optional[str]:
    """robot_description of this namespace or of one above; None when the node is shut down before there is one."""
    waited = False
    while not rospy.is_shutdown():
        name = rospy.search_param("robot_description")
        if name:
            return str(rospy.get_param(name))
        if not waited:
            rospy.logwarn("no robot_description in %s or above: waiting", rospy.get_namespace())
        waited = True
        time.sleep(RETRY_S)
    return None


def read_rate_hz() -> float:
    """Returns the rate of the state messages [Hz]; ValueError for an invalid parameter."""
    for name in REFUSED:
        if rospy.get_param(f"~{name}", False):
            raise ValueError(f"~{name}: true; the simulated camera has only false")
    rate_hz = rospy.get_param("~rate_hz", 10.0)
    number = isinstance(rate_hz, (int, float)) and not isinstance(rate_hz, bool)
    if not (number and 0.0 < rate_hz <= 1000.0):
        raise ValueError(f"~rate_hz: {rate_hz!r}; expected a number above 0, at most 1000")
    return float(rate_hz)


class PtzNode:
    """Passes commands on to the camera's controllers, and publishes the camera's position."""

    def __init__(self, camera: Camera, pan_joint: str, tilt_joint: str) -> None:
        self._camera, self._pan_joint, self._tilt_joint = camera, pan_joint, tilt_joint
        self._angles_rad: Dict[str, float] = {}
        self._state = Axis(zoom=ZOOM_WIDE, autofocus=True)
        # latched: a camera that comes later goes where it was told to
        self._pan = self._leader("pan_position_controller/command")
        self._tilt = self._leader("tilt_position_controller/command")
        self._fov = self._leader("set_hfov")
        self._publisher = rospy.Publisher("state", Axis, queue_size=1)
        rospy.Subscriber("joint_states", JointState, self._on_joints, queue_size=10)
        rospy.Subscriber("camera_info", CameraInfo, self._on_info, queue_size=1)
        rospy.Subscriber("cmd", Axis, self._on_command, queue_size=1)

    @staticmethod
    def _leader(topic: str) -> rospy.Publisher:
        return rospy.Publisher(topic, Float64, queue_size=1, latch=True)

    def _on_joints(self, message: JointState) -> None:
        self._angles_rad.update(zip(message.name, message.position))

    def _on_info(self, message: CameraInfo) -> None:
        self._state.zoom = self._camera.zoom_of_focal(message.K[0], message.width)

    def _on_command(self, command: Axis) -> None:
        for name in NUMBERS:
            value = getattr(command, name)
            if not math.isfinite(value):
                text = "cmd: found %s %s, expected a finite number; ignored"
                rospy.logwarn_throttle(WARN_S, text % (name, value))
                return
        self._pan.publish(self._camera.pan_joint_rad(command.pan))
        self._tilt.publish(self._camera.tilt_joint_rad(command.tilt))
        if self._camera.fov_rad is not None:
            self._fov.publish(self._camera.fov_of_zoom_rad(command.zoom))
        for name in ("focus", "brightness", "iris", "autofocus"):
            setattr(self._state, name, getattr(command, name))

    def tell(self) -> None:
        """Publishes the camera's position once its joint states have arrived."""
        for name in (self._pan_joint, self._tilt_joint):
            if name not in self._angles_rad:
                rospy.logwarn_throttle(WARN_S, f"nothing of {name} on joint_states yet: no state")
                return
        self._state.pan = to_degrees(self._angles_rad[self._pan_joint])
        self._state.tilt = to_degrees(self._angles_rad[self._tilt_joint])
        self._publisher.publish(self._state)

    def run(self, rate_hz: float) -> None:
        """Publishes the state until the node is shut down."""
        rate = rospy.Rate(rate_hz, reset=True)
        while not rospy.is_shutdown():
            try:
                rate.sleep()
            except rospy.ROSInterruptException:
                return
            self.tell()


def main() -> int:
    """Runs the node; returns 1 when a parameter is wrong."""
    try:
        rospy.init_node("axis_ptz_driver")
    except rospy.ROSInitException:  # ended while there was no ROS master
        return 130
    try:
        rate_hz = read_rate_hz()
        joints = [
            rospy.get_param(f"~{axis}_joint", f"axis_{axis}_joint") for axis in ("pan", "tilt")
        ]
        description = wait_for_description()
        if description is not None:
            PtzNode(read_camera(description, *joints), *joints).run(rate_hz)
    except ValueError as error:
        rospy.logfatal("%s", error)
        return 1
    return 0
