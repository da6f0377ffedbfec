# SPDX-License-Identifier: MIT
"""Tests packages of robots in the style of published ones, unchanged for this simulator: the robot drives."""
from pathlib import Path

import probes
import pytest

from ardee_common.ros_graph import Process, RosGraph

FOREIGN = Path(__file__).parent / "data" / "foreign"


def launch(graph: RosGraph, package: str, file: str, **env: str) -> Process:
    """Starts a launch file of a package beside these tests."""
    path = f"{FOREIGN}:{graph.env['ROS_PACKAGE_PATH']}"
    return graph.spawn("roslaunch", package, file, ROS_PACKAGE_PATH=path, **env)


def distance_m(graph: RosGraph, speed_m_s: float) -> float:
    """Returns how far the robot goes along x in 2 s of simulated time."""
    first, last = graph.call(probes.drive, "/cmd_vel", "/odom", speed_m_s, 0.0, 2.0)
    return last.pose.pose.position.x - first.pose.pose.position.x


def test_a_vehicle_as_clearpaths(graph: RosGraph) -> None:
    process = launch(graph, "tractor_gazebo", "world.launch")
    assert distance_m(graph, 0.5) == pytest.approx(1.0, abs=0.2)
    scan = graph.call(probes.collect, "/scan", "sensor_msgs/LaserScan", 1)[0]
    assert len(scan.ranges) == 181 and scan.header.frame_id == "laser"
    errors = [line for line in process.output().splitlines() if "ERROR" in line]
    named = ("house_of_the_model_database", "fire_hydrant", "tractor_description")
    assert len(errors) == 3 and all(name in line for name, line in zip(named, errors)), errors


def test_a_robot_as_turtlebot3(graph: RosGraph) -> None:
    process = launch(graph, "burger_gazebo", "burger_world.launch", ROBOT_MODEL="burger")
    assert distance_m(graph, 0.2) == pytest.approx(0.4, abs=0.1)
    names = graph.call(
        probes.call_service, "/gazebo/get_world_properties", "gazebo_msgs/GetWorldProperties", {}
    ).model_names
    assert {"ground_plane", "crate", "burger"} <= set(names)
    assert "ERROR" not in process.output()


def test_a_robot_of_the_days_of_hydro(graph: RosGraph) -> None:
    process = launch(graph, "mule_gazebo", "mule.launch")
    assert distance_m(graph, 0.3) == pytest.approx(0.6, abs=0.15)
    assert "-J no_such_joint: passed over" in process.output()
    assert "'-s libgazebo_ros_init.so' has no use here and is left out" in process.output()
    assert process.output().count("found 'model://willowgarage'") == 1
    hatch = graph.call(
        probes.call_service,
        "/gazebo/get_joint_properties",
        "gazebo_msgs/GetJointProperties",
        {"joint_name": "mule::hatch"},
    )
    assert hatch.success and hatch.position[0] > 0.3


def test_a_model_spawned_from_a_shell(graph: RosGraph) -> None:
    graph.launch("gazebo_ros", "shapes_world.launch", "gui:=false")
    urdf = graph.folder / "burger.urdf"
    urdf.write_text(graph.run("xacro", str(FOREIGN / "burger_gazebo/urdf/burger.urdf.xacro")))
    words = ["-urdf", "-file", str(urdf), "-model", "burger", "-x", "-2", "-wait", "cylinder"]
    graph.run("rosrun", "gazebo_ros", "spawn_model", *words)
    assert distance_m(graph, 0.2) == pytest.approx(0.4, abs=0.1)
