# SPDX-License-Identifier: MIT
"""Tests names of the topics of a robot's sensors; with an invalid topic the robot is spawned without that sensor."""
import pathlib
from typing import List

import gazebo_calls
import probes
import pytest

from ardee_common.ros_graph import RosGraph

WORLD = """<sdf version="1.5"><world name="default"><physics type="ode">
  <max_step_size>0.005</max_step_size></physics></world></sdf>"""
INERTIAL = """<inertial><mass value="1" />
  <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0" /></inertial>"""
ROBOT = (
    """<robot name="robot" xmlns:xacro="http://ros.org/wiki/xacro">{before}
  <xacro:include filename="$(find ardee_sensors)/urdf/all_sensors.urdf.xacro" />
  <link name="base_footprint">"""
    + INERTIAL
    + """</link>{calls}</robot>"""
)
SONAR = """<xacro:sensor_sonar name="{}" parent="base_footprint" topic="{}">
  <origin xyz="0 0 0" /></xacro:sensor_sonar>"""


@pytest.fixture(scope="module")
def world(shared_graph: RosGraph) -> RosGraph:
    """Yields an empty world."""
    file = shared_graph.folder / "empty.world"
    file.write_text(WORLD)
    shared_graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(file))
    shared_graph.call(probes.clock_at_least, 0.1)
    return shared_graph


def spawn(graph: RosGraph, name: str, calls: str, before: str = "") -> None:
    """Spawns a robot in the namespace of its name; fails if it is refused."""
    file = graph.folder / f"{name}.urdf.xacro"  # type: pathlib.Path
    file.write_text(ROBOT.format(before=before, calls=calls))
    xml = graph.run("rosrun", "xacro", "xacro", str(file))
    at = gazebo_calls.pose()
    robot = gazebo_calls.spawn(name, xml, at, "urdf", robot_namespace="/" + name)
    (answer,) = gazebo_calls.call(graph, robot)
    assert answer.success, answer.status_message


def errors(graph: RosGraph, part: str) -> List[str]:
    """Returns the simulator's errors that contain `part`."""
    return [line for line in graph.logs().splitlines() if "ERROR" in line and part in line]


def test_topics_lie_where_the_robot_is_spawned_unless_it_says_otherwise(world: RosGraph) -> None:
    spawn(world, "one", SONAR.format("sonar", ""))
    named = '<xacro:property name="robot_namespace" value="/elsewhere" />'
    spawn(world, "two", SONAR.format("sonar", ""), named)
    topics = world.call(probes.topics)
    assert topics["/one/ardee/sonar"] == topics["/elsewhere/ardee/sonar"] == "sensor_msgs/Range"
    assert "/ardee/sonar" not in topics and "/two/ardee/sonar" not in topics


@pytest.mark.parametrize(
    "name, topic, said",
    [
        ("not_a_name", "two words", "expected a valid name"),
        ("taken", "/clock", "/clock is already published with another type"),
    ],
)
def test_a_sensor_whose_topic_cannot_be_is_left_out(
    world: RosGraph, name: str, topic: str, said: str
) -> None:
    spawn(world, name, SONAR.format("good", "good") + SONAR.format("bad", topic))
    (line,) = errors(world, f"'{name}'")
    assert "'bad_sensor'" in line and said in line and "left out" in line
    assert world.call(probes.collect, f"/{name}/good", "sensor_msgs/Range", 2)


IMU = """<xacro:sensor_imu_hector name="imu" parent="base_footprint">
  <origin xyz="0 0 0" /></xacro:sensor_imu_hector>"""
EYE = """<xacro:sensor_ueye_cp_gige name="eye" parent="base_footprint">
  <origin xyz="0 0 0" /></xacro:sensor_ueye_cp_gige>"""


def test_a_second_robot_of_one_namespace_is_told_once_of_services(world: RosGraph) -> None:
    shared = '<xacro:property name="robot_namespace" value="/shared" />'
    spawn(world, "first", IMU + EYE, shared)
    spawn(world, "second", IMU + EYE, shared)
    logs = world.logs()
    assert "already advertised in this node" not in logs
    (said,) = [line for line in logs.splitlines() if "WARN" in line and "'second'" in line]
    assert "service /shared/ardee/imu/data/calibrate and 5 more are there already" in said
    assert world.call(probes.collect, "/shared/ardee/imu/data", "sensor_msgs/Imu", 2)
