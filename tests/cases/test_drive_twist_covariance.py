# SPDX-License-Identifier: MIT
"""Checks that localisation can use the velocity of a skid-steer drive: pose and twist have Gazebo's variances."""
import pathlib

import probes
from gazebo_calls import call, pose, simulate, spawn

from ardee_common.ros_graph import RosGraph

QUAD = (pathlib.Path(__file__).parent / "drive-twist-covariance/quad.urdf").read_text()
VARIANCES = (1e-4, 1e-4, 1e12, 1e12, 1e12, 1e-2)


def test_drive_twist_covariance(graph: RosGraph) -> None:
    simulate(graph)
    answer = call(graph, spawn("quad", QUAD, pose(z=0.1), "urdf"))[0]
    assert answer.success, answer.status_message
    odometry = graph.call(probes.collect, "/odom", "nav_msgs/Odometry", 1)[0]
    diagonal = [VARIANCES[i // 6] if i % 7 == 0 else 0.0 for i in range(36)]
    assert list(odometry.pose.covariance) == diagonal
    assert list(odometry.twist.covariance) == diagonal
