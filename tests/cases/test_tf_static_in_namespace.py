# SPDX-License-Identifier: MIT
"""A robot in a namespace with a tf_prefix, its map given by static_transform_publisher: the map alone is the parent of
r1/odom, and the robot is at (3, 1) in the map."""
from pathlib import Path

import probes
import pytest

from ardee_common.ros_graph import RosGraph

CART = Path(__file__).with_name("tf-static-in-namespace") / "cart.urdf"


def test_the_map_is_the_only_parent_of_the_robots_odom(graph: RosGraph) -> None:
    graph.launch("gazebo_ros", "empty_world.launch", "gui:=false")
    graph.run("rosparam", "set", "/r1/tf_prefix", "r1")
    place = ["-x", "3", "-y", "1", "-robot_namespace", "r1"]
    words = ["-urdf", "-file", str(CART), "-model", "r1", *place]
    graph.run("rosrun", "gazebo_ros", "spawn_model", *words)
    publisher = ["rosrun", "tf2_ros", "static_transform_publisher"]
    graph.spawn(*publisher, "3", "1", "0", "0", "0", "0", "map", "r1/odom")
    for _ in range(3):
        at = graph.call(probes.transform, "map", "r1/base_footprint").transform.translation
        assert (at.x, at.y) == pytest.approx((3.0, 1.0), abs=0.01)
    assert graph.call(probes.parents_in_tf, "r1/odom", 1.5) == {"map"}
