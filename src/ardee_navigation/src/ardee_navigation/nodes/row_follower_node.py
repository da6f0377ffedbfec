# SPDX-License-Identifier: MIT
"""ROS node row_follower: scans in, commands out, and what it sees for rviz.

Parameters:
  _scan:=ardee/hokuyo, _odom:=odom, _cmd:=cmd_vel   topics
  _scenario:=NAME     the technique's parameters are those of this scenario
  _parameters:=FILE   those in this YAML file differ from the scenario's
  _drive:=true        false: send no commands, only show
"""
import threading
import time
from dataclasses import dataclass
from pathlib import Path as FilePath
from typing import Callable, List, Optional

import numpy as np
import rospy
from geometry_msgs.msg import Point, PoseStamped, Twist
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import LaserScan
from std_msgs.msg import ColorRGBA, Header, String
from visualization_msgs.msg import Marker, MarkerArray

from ardee_common import ros_node
from ardee_common.errors import GeneratorError, known_names
from ardee_common.options import option, ros_name
from ardee_navigation.evaluation.scenario_files import read_parameters
from ardee_navigation.evaluation.scenarios import known_scenarios
from ardee_navigation.lane_following.line import Line
from ardee_navigation.lbirnt import Output, Parameters, RowFollower
from ardee_navigation.nodes.silence import Silence

FAREWELL_S = 0.1  # for the last command to leave before the node ends
PATH_STEP_M = 0.05
LONGEST_PATH = 20_000  # poses: a kilometre
VALID, INVALID, CENTRE, CHOSEN = (
    ColorRGBA(0.1, 0.9, 0.2, 1.0),
    ColorRGBA(0.9, 0.5, 0.1, 1.0),
    ColorRGBA(0.2, 0.5, 1.0, 1.0),
    ColorRGBA(1.0, 1.0, 0.2, 1.0),
)


def line_marker(
    header: Header, name: str, line: Line, colour: ColorRGBA, parameters: Parameters
) -> Marker:
    """Returns a line in the scan's frame, as long as the rectangle in which rows are looked for."""
    marker = Marker(header=header, ns=name, type=Marker.LINE_STRIP, color=colour)
    marker.scale.x, marker.pose.orientation.w = 0.02, 1.0
    ends = (-parameters.behind_m, parameters.ahead_m)
    marker.points = [Point(x, line.at(x), 0.0) for x in ends]
    return marker


def points_marker(header: Header, sides: List[np.ndarray]) -> Marker:
    """Returns the points that lines were fitted to."""
    marker = Marker(header=header, ns="chosen points", type=Marker.POINTS, color=CHOSEN)
    marker.scale.x = marker.scale.y = 0.02
    marker.pose.orientation.w = 1.0
    marker.points = [Point(x, y, 0.0) for side in sides for x, y in side.tolist()]
    if not marker.points:
        marker.action = Marker.DELETE
    return marker


def markers(header: Header, output: Output, parameters: Parameters) -> MarkerArray:
    """Returns markers of everything the follower sees."""
    lane, valid = output.lane, output.valid
    lines = (
        ("left line", lane.left, VALID if valid[0] else INVALID),
        ("right line", lane.right, VALID if valid[1] else INVALID),
        ("centre line", lane.centre, CENTRE),
    )
    made = [line_marker(header, *line, parameters) for line in lines]
    return MarkerArray([*made, points_marker(header, list(output.sides))])


@dataclass(frozen=True)
class Settings:
    """Topics; the file or scenario that the technique's parameters are in; whether to drive or only to show."""

    scan: str = ros_name("ardee/hokuyo")
    odom: str = ros_name("odom")
    cmd: str = ros_name("cmd_vel")
    scenario: str = option("")
    parameters: str = option("")
    drive: bool = option(True)


class Node:
    """Answers every scan."""

    def __init__(self, settings: Settings, parameters: Parameters) -> None:
        self._parameters, self._follower = parameters, RowFollower(parameters)
        self._last_s, self._state = None, ""  # type: Optional[float], str
        self._path, self._drive = Path(), settings.drive
        self._silence, self._sending = Silence(parameters.max_gap_s), threading.Lock()
        self._has_ended = False
        self._commands = rospy.Publisher(settings.cmd, Twist, queue_size=1)
        self._markers = rospy.Publisher("~markers", MarkerArray, queue_size=1)
        self._paths = rospy.Publisher("~path", Path, queue_size=1, latch=True)
        self._status = rospy.Publisher("~status", String, queue_size=1, latch=True)
        rospy.Subscriber(settings.odom, Odometry, self._on_odometry, queue_size=10)
        rospy.Subscriber(settings.scan, LaserScan, self._on_scan, queue_size=1, buff_size=1 << 20)

    def _on_scan(self, scan: LaserScan) -> None:
        now_s = scan.header.stamp.to_sec()
        if self._last_s is not None and now_s < self._last_s:
            self._follower.reset()  # the simulation was started again
            self._path.poses = []
        self._last_s = now_s
        ranges = np.asarray(scan.ranges)
        output = self._follower.update(ranges, scan.angle_min, scan.angle_increment, now_s)
        with self._sending:
            self._silence.end(rospy.get_time(), time.monotonic())
            self._send(output.speed_m_s, output.turn_rad_s)
        if self._markers.get_num_connections():
            self._markers.publish(markers(scan.header, output, self._parameters))
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
        """Waits; stops the robot once if scans have stopped, because it keeps its last command."""
        time.sleep(wait_s)
        with self._sending:
            if self._drive and self._silence.begins(rospy.get_time(), time.monotonic()):
                self._send(0.0, 0.0)
                rospy.logwarn("no scans for %g s: stopped", self._parameters.max_gap_s)

    def stop(self) -> None:
        """Tells the robot to stand still, for good: scans may still come while the node ends."""
        with self._sending:
            self._send(0.0, 0.0)
            self._has_ended = True
        time.sleep(FAREWELL_S)


def _parameters(settings: Settings) -> Parameters:
    """Returns the parameters of the file, over those of the scenario, over the defaults."""
    usual, name = Parameters(), settings.scenario
    if name:
        known = known_scenarios()
        if name not in known:
            raise GeneratorError(f"scenario: found {name!r}, {known_names(name, known)}")
        usual = known[name].parameters
    return read_parameters(FilePath(settings.parameters), usual) if settings.parameters else usual


def _make() -> Callable[[float], None]:
    settings = ros_node.read_parameters(Settings)
    node = Node(settings, _parameters(settings))
    rospy.on_shutdown(node.stop)
    return node.watch


def main() -> int:
    """Runs the node; returns the exit code, 2 for bad parameters."""
    return ros_node.run("row_follower", __doc__, _make)
