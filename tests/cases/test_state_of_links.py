# SPDX-License-Identifier: MIT
"""Loads a world that was saved while a gate stood open: <state> gives the poses of its links in the world's frame. The
leaf stands at (0.05, 4.55, 1), turned by 1.571 rad, and so does the hinge.
"""
import math
import pathlib

import probes
import pytest

from ardee_common.ros_graph import RosGraph

WORLD = pathlib.Path(__file__).parent / "state-of-links" / "yard.world"


def test_the_gate_stands_open(graph: RosGraph) -> None:
    graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD), "-u")
    leaf, hinge = graph.call(
        probes.call_services,
        [
            (
                "/gazebo/get_link_state",
                "gazebo_msgs/GetLinkState",
                {"link_name": "gate::leaf", "reference_frame": "world"},
            ),
            (
                "/gazebo/get_joint_properties",
                "gazebo_msgs/GetJointProperties",
                {"joint_name": "gate::hinge"},
            ),
        ],
    )
    pose = leaf.link_state.pose
    place = (pose.position.x, pose.position.y, pose.position.z)
    assert place == pytest.approx((0.05, 4.55, 1), abs=0.01)
    yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
    assert yaw == pytest.approx(math.pi / 2, abs=0.01)
    assert hinge.position[0] == pytest.approx(math.pi / 2, abs=0.01)
