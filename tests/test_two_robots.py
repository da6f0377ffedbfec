# SPDX-License-Identifier: MIT
"""Tests two robots in one world, the second in a namespace: neither gets the other's commands."""
from typing import List

import probes

from ardee_common.ros_graph import RosGraph


def models(graph: RosGraph) -> List[str]:
    """Returns the names of all models in the world."""
    return graph.call(probes.collect, "/gazebo/model_states", "gazebo_msgs/ModelStates", 1)[0].name


def launch_robot(graph: RosGraph, *args: str) -> None:
    graph.launch("terrasentia_description", "launch_default_tsv1.launch", "use_rviz:=false", *args)


def test_each_robot_has_its_own_topics_and_commands(graph: RosGraph) -> None:
    graph.launch("ardee_world", "custom_world.launch", "world:=farm.world")
    graph.call(probes.clock_at_least, 0.2)
    scenery = models(graph)
    launch_robot(graph)
    graph.call(probes.wait_for_topics, ["/odom", "/ardee/hokuyo"], [])
    launch_robot(graph, "ns:=robot2", "y:=-0.76")
    second = ["/robot2/odom", "/robot2/ardee/hokuyo", "/robot2/joint_states"]
    graph.call(probes.wait_for_topics, second, [])
    assert sorted(models(graph)) == sorted([*scenery, "TerraSentia_0", "TerraSentia_robot2"])

    graph.call(probes.clock_at_least, 4.0)
    still = graph.call(probes.collect, "/odom", "nav_msgs/Odometry", 1)[0].pose.pose.position
    first, last = graph.call(probes.drive, "/robot2/cmd_vel", "/robot2/odom", 0.4, 0.0, 1.5)
    start, end = first.pose.pose.position, last.pose.pose.position
    assert ((end.x - start.x) ** 2 + (end.y - start.y) ** 2) ** 0.5 > 0.3
    after = graph.call(probes.collect, "/odom", "nav_msgs/Odometry", 1)[0].pose.pose.position
    assert ((after.x - still.x) ** 2 + (after.y - still.y) ** 2) ** 0.5 < 2e-3
