# SPDX-License-Identifier: MIT
"""A robot on two wheels of velocity joints, driven by gazebo_ros_control with a diff_drive_controller, from one launch
file with controller_manager's spawner: 0.5 m/s for 3 s are 1.5 m, it stops without commands for 0.25 s, and odometry,
tf and joint states are there at 50 Hz."""
import pathlib
import time
from typing import Any, List

import probes
import pytest
from gazebo_calls import call, state

from ardee_common.ros_graph import RosGraph, wait_until

CASE = pathlib.Path(__file__).parent / "ros-control-diff-drive"
PERIOD_S = 0.02


def drive_and_let_go(speed_m_s: float, drive_s: float, wait_s: float) -> List[Any]:
    """Odometry at the first command, at the last one, and `wait_s` of simulated time later."""
    import rospy
    from geometry_msgs.msg import Twist
    from nav_msgs.msg import Odometry

    rospy.init_node("driver", anonymous=True, disable_signals=True)
    found = []  # type: List[Any]
    rospy.Subscriber("/base/odom", Odometry, found.append, queue_size=1000)
    publisher = rospy.Publisher("/base/cmd_vel", Twist, queue_size=1)
    wait_until(lambda: found and publisher.get_num_connections(), "odometry", 60.0)
    command = Twist()
    command.linear.x = speed_m_s
    moments = [found[-1]]
    end = moments[0].header.stamp + rospy.Duration.from_sec(drive_s)
    while found[-1].header.stamp < end:
        publisher.publish(command)
        time.sleep(0.02)
    moments.append(found[-1])
    end = moments[1].header.stamp + rospy.Duration.from_sec(wait_s)
    wait_until(lambda: found[-1].header.stamp >= end, "simulated time", 60.0)
    return [*moments, found[-1]]


def assert_rate(messages: List[Any]) -> None:
    passed_s = (messages[-1].header.stamp - messages[0].header.stamp).to_sec()
    assert passed_s / (len(messages) - 1) == pytest.approx(PERIOD_S, abs=1e-4)


def test_ros_control_diff_drive(graph: RosGraph) -> None:
    graph.spawn("roslaunch", str(CASE / "test.launch"))
    first, last, rest = graph.call(drive_and_let_go, 0.5, 3.0, 0.5)
    assert last.pose.pose.position.x - first.pose.pose.position.x == pytest.approx(1.5, rel=0.03)
    assert abs(rest.twist.twist.linear.x) < 0.02
    at = call(graph, state("wheels"))[0].pose.position
    assert at.x == pytest.approx(rest.pose.pose.position.x, rel=0.03)
    assert abs(at.y) < 0.02
    variances = [0.001, 0.001, 0.001, 0.001, 0.001, 0.03]
    diagonal = [variances[i // 6] if i % 7 == 0 else 0.0 for i in range(36)]
    assert list(rest.pose.covariance) == diagonal and list(rest.twist.covariance) == diagonal
    assert rest.header.frame_id == "odom" and rest.child_frame_id == "base_link"
    assert_rate(graph.call(probes.collect, "/base/odom", "nav_msgs/Odometry", 51))
    joints = graph.call(probes.collect, "/joint_states", "sensor_msgs/JointState", 51)
    assert_rate(joints)
    assert all(message.name == ["left", "right"] for message in joints)
    assert graph.call(probes.transform, "odom", "base_link").transform.rotation.w == pytest.approx(
        1.0, abs=0.01
    )
