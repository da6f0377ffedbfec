# SPDX-License-Identifier: MIT
"""Robots on wheels whose drive is ros_control, described and configured as their makers do, drive on a plane: the
wheels' odometry and the true pose agree, and a turn to the left turns left."""
import math
import pathlib
from typing import Any, Tuple

import probes
import pytest
from ros_graph import RosGraph

ROBOTS = pathlib.Path(__file__).parent / "robots_with_ros_control"
STATE = ("/gazebo/get_model_state", "gazebo_msgs/GetModelState")
# the controller's name, speed [m/s], turn [rad/s; hunter: steering angle in rad]
DRIVES = {
    "husky": ("/husky_velocity_controller", 0.5, 0.8),
    "jackal": ("/jackal_velocity_controller", 0.5, 0.8),
    "warthog": ("/warthog_velocity_controller", 0.5, 0.8),
    "summit_xl": ("/summit_xl/robotnik_base_control", 0.5, 0.8),
    "leo": ("/leo/controllers/diff_drive", 0.3, 0.8),
    "mir100": ("/mobile_base_controller", 0.5, 0.8),
    "rosbot": ("/rosbot_base_controller", 0.3, 0.8),
    "thorvald": ("/four_wheel_steering_controller", 0.5, 0.4),
    "hunter": ("/ackermann_steering_controller", 0.5, 0.3),
}
# the topic of each wheel's speed, its radius [m]
MOTORS = {
    "scout": (["/scout/scout_motor_{}_controller/command".format(s) for s in ("fl", "rl")],
              ["/scout/scout_motor_{}_controller/command".format(s) for s in ("fr", "rr")], 0.165),
    "tracer": (["/tracer/tracer_motor_l_controller/command"],
               ["/tracer/tracer_motor_r_controller/command"], 0.06),
}  # fmt: skip


def _yaw(pose: Any) -> float:
    return 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)


def _truth(graph: RosGraph, robot: str) -> Tuple[float, float]:
    """How far from the start the robot stands [m], and its yaw [rad]."""
    state = graph.call(probes.call_service, *STATE, {"model_name": robot})
    assert state.success, state.status_message
    return math.hypot(state.pose.position.x, state.pose.position.y), _yaw(state.pose)


@pytest.mark.parametrize("robot", DRIVES)
def test_drives_as_its_odometry_says(graph: RosGraph, robot: str) -> None:
    controller, speed_m_s, turn = DRIVES[robot]
    topics = (controller + "/cmd_vel", controller + "/odom")
    graph.spawn("roslaunch", str(ROBOTS / f"{robot}.launch"))
    first, last = graph.call(probes.drive, *topics, speed_m_s, 0.0, 3.0)
    assert first.pose.pose.position.x == pytest.approx(0.0, abs=0.05)
    assert last.pose.pose.position.x > 0.7 * speed_m_s * 3.0  # less a ramp
    assert last.twist.twist.linear.x == pytest.approx(speed_m_s, rel=0.1)
    graph.call(probes.drive, *topics, 0.0, 0.0, 1.0)
    distance_m, yaw = _truth(graph, robot)
    _, last = graph.call(probes.drive, *topics, 0.0, 0.0, 0.2)
    assert distance_m == pytest.approx(last.pose.pose.position.x, rel=0.05)
    assert yaw == pytest.approx(0.0, abs=0.05)
    graph.call(probes.drive, *topics, 0.3, turn, 2.0)
    assert _truth(graph, robot)[1] > 0.1


@pytest.mark.parametrize("robot", MOTORS)
def test_drives_by_the_speeds_of_its_wheels(graph: RosGraph, robot: str) -> None:
    left, right, radius_m = MOTORS[robot]
    graph.spawn("roslaunch", str(ROBOTS / f"{robot}.launch"))
    rate = 0.5 / radius_m
    graph.call(probes.command_joints, dict.fromkeys(left + right, rate), 3.0)
    graph.call(probes.command_joints, dict.fromkeys(left + right, 0.0), 0.5)
    distance_m, yaw = _truth(graph, robot)
    assert distance_m > 0.9 * 0.5 * 3.0
    assert yaw == pytest.approx(0.0, abs=0.05)
    turn = {**dict.fromkeys(left, -rate), **dict.fromkeys(right, rate)}
    graph.call(probes.command_joints, turn, 0.5)
    assert _truth(graph, robot)[1] > 0.1
