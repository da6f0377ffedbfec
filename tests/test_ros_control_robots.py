# SPDX-License-Identifier: MIT
"""Tests robots on wheels with drives of ros_control, described and configured as by their makers: they drive as far as
commanded on a plane, by their odometry and in truth. A turn to the left turns left.
"""
import math
import pathlib
from typing import Any, List, NamedTuple, Tuple

import probes
import pytest

from ardee_common.ros_graph import RosGraph, wait_until

ROBOTS = pathlib.Path(__file__).parent / "robots_with_ros_control"
STATE = ("/gazebo/get_model_state", "gazebo_msgs/GetModelState")
TIME_S = 4.0  # duration of each command
IN_PLACE = (0.0, 0.5)


class Drive(NamedTuple):
    """Speeds of a robot that drives straight on and turns, for TIME_S each."""

    controller: str
    yaw: Tuple[float, float] = (1.8, 2.2)  # bounds of the turn [rad]; 2.0 is commanded
    turn: Tuple[float, float] = IN_PLACE  # [m/s], [rad/s; hunter: steering angle in rad]
    speed_m_s: float = 0.5


SLIPS = (0.8, 2.6)  # the wheels of a long or wide robot skid
DRIVES = {
    "husky": Drive("/husky_velocity_controller"),
    "jackal": Drive("/jackal_velocity_controller"),
    "warthog": Drive("/warthog_velocity_controller", SLIPS),
    "summit_xl": Drive("/summit_xl/robotnik_base_control", SLIPS),
    "leo": Drive("/leo/controllers/diff_drive", speed_m_s=0.4),  # its own limit
    "mir100": Drive("/mobile_base_controller"),
    "rosbot": Drive("/rosbot_base_controller", SLIPS),
    "thorvald": Drive("/four_wheel_steering_controller", (1.44, 1.76), (0.3, 0.4)),
    # The value without slip is 0.57; all four wheels have one speed, so they scrub.
    "hunter": Drive("/ackermann_steering_controller", (0.2, 0.6), (0.3, 0.3)),
}
# Topics of the wheels' speeds, and their radii [m].
MOTORS = {
    "scout": (["/scout/scout_motor_{}_controller/command".format(s) for s in ("fl", "rl")],
              ["/scout/scout_motor_{}_controller/command".format(s) for s in ("fr", "rr")], 0.165),
    "tracer": (["/tracer/tracer_motor_l_controller/command"],
               ["/tracer/tracer_motor_r_controller/command"], 0.06),
}  # fmt: skip


def _yaw(pose: Any) -> float:
    return 2.0 * math.atan2(pose.orientation.z, pose.orientation.w)


def _truth(graph: RosGraph, robot: str) -> Tuple[float, float]:
    """Returns how far from the start the robot stands [m], and its yaw [rad]."""
    state = graph.call(probes.call_service, *STATE, {"model_name": robot})
    assert state.success, state.status_message
    return math.hypot(state.pose.position.x, state.pose.position.y), _yaw(state.pose)


def _drives(controller: str, robot: str, commands: List[Tuple[float, float]]) -> List[Any]:
    """Returns for each command (speed, turn) the odometry and the true pose at its end, and those after a stop. The
    simulation is paused and stepped, so that the times are exact.
    """
    import rospy
    from geometry_msgs.msg import Twist, Vector3
    from nav_msgs.msg import Odometry
    from std_srvs.srv import Empty

    from ardee_msgs.srv import Step
    from gazebo_msgs.srv import GetModelState

    rospy.init_node("probe", anonymous=True, disable_signals=True)
    odometry = []  # type: List[Any]
    rospy.Subscriber(controller + "/odom", Odometry, odometry.append, queue_size=1000)
    # Without a queue publish() returns when the command is written, and not some steps later.
    publisher = rospy.Publisher(controller + "/cmd_vel", Twist, queue_size=None)
    wait_until(lambda: odometry and publisher.get_num_connections(), "odometry and a listener")
    advance = rospy.ServiceProxy("/ardee/step", Step)
    state = rospy.ServiceProxy("/gazebo/get_model_state", GetModelState)
    rospy.ServiceProxy("/gazebo/pause_physics", Empty)()

    def keep(speed_m_s: float, turn: float, time_s: float) -> Any:
        for _ in range(round(time_s / 0.1)):  # a command counts for 0.25 s at least
            publisher.publish(Twist(Vector3(x=speed_m_s), Vector3(z=turn)))
            now = advance(steps=100).sim_time
        wait_until(lambda: (now - odometry[-1].header.stamp).to_sec() < 0.25, "the latest odometry")
        return odometry[-1], state(robot, "").pose

    return [keep(*command, TIME_S) + keep(0.0, 0.0, 1.0) for command in commands]


@pytest.mark.parametrize("robot", DRIVES)
def test_drives_as_commanded_and_as_its_odometry_says(graph: RosGraph, robot: str) -> None:
    drive = DRIVES[robot]
    graph.spawn("roslaunch", str(ROBOTS / f"{robot}.launch"))
    ahead, turned = graph.call(
        _drives, drive.controller, robot, [(drive.speed_m_s, 0.0), drive.turn]
    )
    driving, _, odometry, pose = ahead
    distance_m = drive.speed_m_s * TIME_S
    assert driving.twist.twist.linear.x == pytest.approx(drive.speed_m_s, rel=0.05)
    assert odometry.pose.pose.position.x == pytest.approx(distance_m, rel=0.05)
    assert pose.position.x == pytest.approx(distance_m, rel=0.05)
    assert _yaw(pose) == pytest.approx(0.0, abs=0.05)
    low, high = drive.yaw
    assert low < _yaw(turned[3]) < high


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
