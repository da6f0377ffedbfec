# SPDX-License-Identifier: MIT
"""ROS node row_follower: readings of a lidar or a camera in, commands out, and what it sees for rviz.

Parameters:
  _follower:=lbirnt   by lidar; vision: by camera
  _scan:=ardee/hokuyo, _picture:=ardee/camera/front/image_raw, _odom:=odom, _cmd:=cmd_vel   topics
  _scenario:=NAME     the technique's parameters are those of this scenario
  _parameters:=FILE   those in this YAML file differ from the scenario's
  _drive:=true        false: send no commands, only show
"""
import threading
import time
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Any, Callable, Optional, Union

import numpy as np
import rospy
from geometry_msgs.msg import PoseStamped, Twist
from nav_msgs.msg import Odometry, Path
from std_msgs.msg import String

from ardee_common import ros_node
from ardee_common.config import Mapping, build
from ardee_common.errors import GeneratorError, known_names
from ardee_common.options import option, ros_name
from ardee_navigation.evaluation.scenario_files import read_parameters
from ardee_navigation.evaluation.scenarios import known_scenarios
from ardee_navigation.lane_following import LaneParameters
from ardee_navigation.lbirnt import Parameters
from ardee_navigation.nodes.picture_follower import PictureFollower
from ardee_navigation.nodes.scan_follower import ScanFollower
from ardee_navigation.nodes.silence import Silence
from ardee_navigation.vision import VisionParameters

FAREWELL_S = 0.1  # for the last command to leave before the node ends
PATH_STEP_M = 0.05
LONGEST_PATH = 20_000  # poses: a kilometre


@dataclass(frozen=True)
class Settings:
    """Topics; the technique; the file or scenario that its parameters are in; whether to drive or only to show."""

    follower: str = option("lbirnt", choices=("lbirnt", "vision"))
    scan: str = ros_name("ardee/hokuyo")
    picture: str = ros_name("ardee/camera/front/image_raw")
    odom: str = ros_name("odom")
    cmd: str = ros_name("cmd_vel")
    scenario: str = option("")
    parameters: str = option("")
    drive: bool = option(True)


class Node:
    """Answers every reading of the follower's sensor."""

    def __init__(self, settings: Settings, parameters: LaneParameters) -> None:
        is_vision = settings.follower == "vision"
        self._follower: Union[ScanFollower, PictureFollower] = (
            PictureFollower(parameters) if is_vision else ScanFollower(parameters)
        )
        self._last_s, self._state = None, ""  # type: Optional[float], str
        self._path, self._drive = Path(), settings.drive
        self._max_gap_s, self._sending = parameters.max_gap_s, threading.Lock()
        self._silence = Silence(parameters.max_gap_s)
        self._has_ended = False
        self._commands = rospy.Publisher(settings.cmd, Twist, queue_size=1)
        self._paths = rospy.Publisher("~path", Path, queue_size=1, latch=True)
        self._status = rospy.Publisher("~status", String, queue_size=1, latch=True)
        rospy.Subscriber(settings.odom, Odometry, self._on_odometry, queue_size=10)
        topic = settings.picture if is_vision else settings.scan
        rospy.Subscriber(
            topic, self._follower.message, self._on_reading, queue_size=1, buff_size=1 << 24
        )

    def _on_reading(self, reading: Any) -> None:
        now_s = reading.header.stamp.to_sec()
        if self._last_s is not None and now_s < self._last_s:
            self._follower.reset()  # the simulation was started again
            self._path.poses = []
        self._last_s = now_s
        try:
            output = self._follower.update(reading, now_s)
        except GeneratorError as error:
            rospy.logwarn_throttle(5.0, str(error))
            return
        with self._sending:
            self._silence.end(rospy.get_time(), time.monotonic())
            self._send(output.speed_m_s, output.turn_rad_s)
        self._follower.show(reading, output)
        if output.state.value != self._state:
            self._state = output.state.value
            self._status.publish(self._state)
            if self._drive:  # otherwise the node that drives logs it
                rospy.loginfo("%s", self._state)

    def _on_odometry(self, odometry: Odometry) -> None:
        here, poses = odometry.pose.pose.position, self._path.poses
        last = poses[-1].pose.position if poses else None
        if last and np.hypot(here.x - last.x, here.y - last.y) < PATH_STEP_M:
            return
        poses.append(PoseStamped(header=odometry.header, pose=odometry.pose.pose))
        del poses[:-LONGEST_PATH]
        self._path.header = odometry.header
        self._paths.publish(self._path)

    def _send(self, speed_m_s: float, turn_rad_s: float) -> None:
        if not self._drive or self._has_ended:
            return
        if not np.isfinite([speed_m_s, turn_rad_s]).all():
            found = f"{speed_m_s:g} m/s, {turn_rad_s:g} rad/s"
            rospy.logwarn_throttle(
                5.0, f"found a command of {found}, expected finite ones: stopped"
            )
            speed_m_s = turn_rad_s = 0.0
        command = Twist()
        command.linear.x, command.angular.z = speed_m_s, turn_rad_s
        self._commands.publish(command)

    def watch(self, wait_s: float) -> None:
        """Waits; stops the robot once if readings have stopped, because it keeps its last command."""
        time.sleep(wait_s)
        with self._sending:
            if self._drive and self._silence.begins(rospy.get_time(), time.monotonic()):
                self._send(0.0, 0.0)
                rospy.logwarn("no %s for %g s: stopped", self._follower.readings, self._max_gap_s)

    def stop(self) -> None:
        """Tells the robot to stand still, for good: readings may still come while the node ends."""
        with self._sending:
            self._send(0.0, 0.0)
            self._has_ended = True
        time.sleep(FAREWELL_S)


def _parameters(settings: Settings) -> LaneParameters:
    """Returns the technique's parameters of the file, over those of the scenario, over the defaults."""
    usual, of_camera, name = Parameters(), Mapping("vision"), settings.scenario
    if name:
        known = known_scenarios()
        if name not in known:
            raise GeneratorError(f"scenario: found {name!r}, {known_names(name, known)}")
        usual, of_camera = known[name].parameters, known[name].vision or of_camera
    if settings.follower == "vision":
        of_camera.setdefault("lane_width_m", usual.lane_width_m)
        usual = build(VisionParameters, of_camera)
    return read_parameters(FilePath(settings.parameters), usual) if settings.parameters else usual


def _make() -> Callable[[float], None]:
    settings = ros_node.read_parameters(Settings)
    node = Node(settings, _parameters(settings))
    rospy.on_shutdown(node.stop)
    return node.watch


def main() -> int:
    """Runs the node; returns the exit code, 2 for bad parameters."""
    return ros_node.run("row_follower", __doc__, _make)
