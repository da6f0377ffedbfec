# SPDX-License-Identifier: MIT
"""A package that exports its media and its model folder by two <gazebo_ros> elements: both are read, and the tree
stands at (2, 0, 1)."""
from pathlib import Path

import probes
import pytest

from ardee_common.ros_graph import RosGraph

FOLDER = Path(__file__).with_name("two-gazebo-exports")


def test_models_of_the_second_export_are_found(graph: RosGraph) -> None:
    graph.env["ROS_PACKAGE_PATH"] = f"{FOLDER}:{graph.env['ROS_PACKAGE_PATH']}"
    graph.launch("gazebo_ros", "empty_world.launch", "world_name:=worlds/row.world", "gui:=false")
    state = {"model_name": "tree"}
    tree = graph.call(
        probes.call_service, "/gazebo/get_model_state", "gazebo_msgs/GetModelState", state
    )
    at = tree.pose.position
    assert tree.success and (at.x, at.y, at.z) == pytest.approx((2.0, 0.0, 1.0))
