# SPDX-License-Identifier: MIT
"""Tests launch files written for gazebo_ros on this simulator: its empty_world.launch, spawn_model and gzserver."""
from pathlib import Path
from typing import Any

import probes
import pytest

from ardee_common.ros_graph import RosGraph, wait_until

ROBOT = """<robot name="block"><link name="base_link">
  <inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>
  <visual><geometry><box size="0.2 0.2 0.2"/></geometry></visual>
  <collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision>
</link></robot>"""
# These are the arguments of robots' packages.
LAUNCH = """<launch>
  <include file="$(find gazebo_ros)/launch/empty_world.launch">
    <arg name="world_name" value="worlds/empty.world"/>
    <arg name="gui" value="false"/>
    <arg name="use_sim_time" value="true"/>
    <arg name="extra_gazebo_args" value="--verbose"/>
  </include>
  <param name="robot_description" textfile="{robot}"/>
  <node name="urdf_spawner" pkg="gazebo_ros" type="spawn_model" respawn="false" output="screen"
        args="-urdf -model block -param robot_description -x 1 -z 0.1"/>
</launch>"""
STATE = ("/gazebo/get_model_state", "gazebo_msgs/GetModelState")
STANDS_IN = Path(__file__).parents[1] / "src/gazebo_ros"

pytestmark = pytest.mark.skipif(not STANDS_IN.exists(), reason="this machine has a gazebo_ros")


def test_a_robots_own_launch_file(graph: RosGraph) -> None:
    robot = graph.folder / "block.urdf"
    robot.write_text(ROBOT)
    launch = graph.folder / "block.launch"
    launch.write_text(LAUNCH.format(robot=robot))
    graph.spawn("roslaunch", str(launch))

    def state() -> Any:
        found = graph.call(probes.call_service, *STATE, {"model_name": "block"})
        return found if found.success else None

    found = wait_until(state, "the robot to be there", 30.0)
    assert found.pose.position.x == pytest.approx(1.0, abs=1e-3)


def test_gzserver_takes_a_world_and_leaves_out_what_it_does_not_know(graph: RosGraph) -> None:
    server = graph.spawn(
        "rosrun",
        "gazebo_ros",
        "gzserver",
        "worlds/empty.world",
        "-u",
        "-e",
        "bullet",
        "--minimal_comms",
        "-s",
        "libsome_plugin.so",
        "--no_such_option",
    )
    graph.call(probes.call_service, *STATE, {"model_name": "none"})
    assert "found engine 'bullet', expected ode, which is used" in server.output()
    assert "'--minimal_comms' has no use here and is left out" in server.output()
    assert "'-s libsome_plugin.so' has no use here and is left out" in server.output()
    assert "'--no_such_option' is no option known here and is left out" in server.output()
    assert graph.call(probes.clock_stands_still)


def test_gazebo_is_server_and_window_and_ends_with_ctrl_c(graph: RosGraph) -> None:
    gazebo = graph.spawn("rosrun", "gazebo_ros", "gazebo", "worlds/empty.world", "--seed", "3")
    assert graph.call(probes.clock_at_least, 0.1) >= 0.1
    assert "seed 3, " in gazebo.output()
    assert gazebo.output().count("gzclient: there is no display") == 1
    gazebo.interrupt()
    assert gazebo.wait(20.0) == 0, gazebo.output()
