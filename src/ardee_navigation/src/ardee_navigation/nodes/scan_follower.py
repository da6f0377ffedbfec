# SPDX-License-Identifier: MIT
"""The row follower by lidar (LBIRNT) in the node row_follower: LaserScan in, and what it sees for rviz as markers."""
from typing import List

import numpy as np
import rospy
from geometry_msgs.msg import Point
from sensor_msgs.msg import LaserScan
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from ardee_navigation.lane_following.line import Line
from ardee_navigation.lbirnt import Output, Parameters, RowFollower

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


class ScanFollower:
    """Answers scans and publishes markers."""

    message, readings = LaserScan, "scans"

    def __init__(self, parameters: Parameters) -> None:
        self._parameters, self._follower = parameters, RowFollower(parameters)
        self._markers = rospy.Publisher("~markers", MarkerArray, queue_size=1)
        self.reset = self._follower.reset

    def update(self, scan: LaserScan, time_s: float) -> Output:
        """Returns the answer to a scan taken at `time_s`."""
        ranges = np.asarray(scan.ranges)
        return self._follower.update(ranges, scan.angle_min, scan.angle_increment, time_s)

    def show(self, scan: LaserScan, output: Output) -> None:
        """Publishes what was seen in the scan, if anyone looks."""
        if self._markers.get_num_connections():
            self._markers.publish(markers(scan.header, output, self._parameters))
