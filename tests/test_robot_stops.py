# SPDX-License-Identifier: MIT
"""A TerraSentia stops soon after its last command, keeps to it where told so, and hears no number that is none."""
import math
import os
import signal
import time
from typing import Any, List, Tuple

import probes
import pytest

from ardee_common.ros_graph import RosGraph, wait_until

SPEED_M_S = 0.5
TIMEOUT_S = 0.5  # the default of the launch file


@pytest.fixture(scope="module")
def robots(shared_graph: RosGraph) -> RosGraph:
    """An empty world with a robot that stops by itself, and one below /robot2 that does not."""
    shared_graph.launch("ardee_world", "custom_world.launch", "world:=empty.world")
    shared_graph.call(probes.clock_at_least, 0.1)
    place = ("use_rviz:=false", "yaw:=0")
    file = ("terrasentia_description", "launch_default_tsv1.launch")
    shared_graph.launch(*file, *place)
    shared_graph.launch(*file, *place, "y:=3", "ns:=robot2", "command_timeout:=0")
    shared_graph.call(probes.wait_for_topics, ["/odom", "/robot2/odom"], [])
    return shared_graph


def coast(space: str, simulated_s: float) -> Tuple[float, List[Tuple[float, float]]]:
    """Drives at SPEED_M_S for 1.5 s and falls silent; stops the robot afterwards.

    Returns the time [s] of the last command, and times [s] and speeds [m/s] from then on.
    """
    import rospy
    from geometry_msgs.msg import Twist
    from nav_msgs.msg import Odometry

    probes._start()
    speeds = []  # type: List[Tuple[float, float]]

    def add(odometry: Any) -> None:
        speeds.append((odometry.header.stamp.to_sec(), odometry.twist.twist.linear.x))

    rospy.Subscriber(f"{space}/odom", Odometry, add, queue_size=1000)
    publisher = rospy.Publisher(f"{space}/cmd_vel", Twist, queue_size=1)
    wait_until(lambda: speeds and publisher.get_num_connections(), "the robot")
    command = Twist()
    command.linear.x = SPEED_M_S
    begin_s = speeds[-1][0]
    while speeds[-1][0] < begin_s + 1.5:
        publisher.publish(command)
        time.sleep(0.02)
    last_s = speeds[-1][0]
    wait_until(lambda: speeds[-1][0] >= last_s + simulated_s, "simulated time")
    publisher.publish(Twist())
    wait_until(lambda: abs(speeds[-1][1]) < 0.01, "a stand")
    return last_s, [(at_s, speed) for at_s, speed in speeds if 0.0 <= at_s - last_s < simulated_s]


def test_a_robot_whose_commander_has_died_stops(robots: RosGraph) -> None:
    last_s, speeds = robots.call(coast, "", 2.0)
    # odometry is 0.02 s apart, and the last command arrives some 0.1 s after the odometry that it followed
    before = [speed for at_s, speed in speeds if at_s < last_s + TIMEOUT_S - 0.05]
    after = [speed for at_s, speed in speeds if at_s > last_s + TIMEOUT_S + 0.5]
    assert min(before) == pytest.approx(SPEED_M_S, abs=0.03)
    assert max(map(abs, after)) < 0.02


def test_without_a_timeout_it_keeps_to_the_last_command(robots: RosGraph) -> None:
    _, speeds = robots.call(coast, "/robot2", 2.0)
    assert min(speed for _, speed in speeds) == pytest.approx(SPEED_M_S, abs=0.03)


def tell(space: str, numbers: List[float], forward: bool) -> float:
    """Commands a stand until the robot stands, then each number as speed or turn; the greatest speed [m/s] since."""
    import rospy
    from geometry_msgs.msg import Twist
    from nav_msgs.msg import Odometry

    probes._start()
    speeds = []  # type: List[float]
    add = lambda m: speeds.append(abs(m.twist.twist.linear.x))  # noqa: E731
    rospy.Subscriber(f"{space}/odom", Odometry, add, queue_size=1000)
    publisher = rospy.Publisher(f"{space}/cmd_vel", Twist, queue_size=10)
    wait_until(publisher.get_num_connections, "the robot")

    def stands() -> bool:
        publisher.publish(Twist())
        return bool(speeds) and speeds[-1] < 0.01

    wait_until(stands, "a stand")
    count = len(speeds)
    for number in numbers:
        command = Twist()
        command.linear.x, command.angular.z = (number, 0.0) if forward else (SPEED_M_S, number)
        publisher.publish(command)
    wait_until(lambda: len(speeds) > count + 50, "a simulated second")
    return max(speeds[count:])


@pytest.mark.parametrize("forward", [True, False])
def test_a_command_that_is_not_finite_is_ignored_and_told(robots: RosGraph, forward: bool) -> None:
    assert robots.call(tell, "", [math.nan, math.inf, -math.inf], forward) < 0.02
    world = robots.processes[0]
    wait_until(lambda: "cmd_vel: found a command that is not finite" in world.output(), "a warning")
    assert world.output().count("found a command that is not finite") <= 2  # once a test


def speed_of(model: str) -> float:
    """True speed [m/s] of a model."""
    fields = {"model_name": model, "relative_entity_name": "world"}
    answer = probes.call_service(
        "/gazebo/get_model_state", "gazebo_msgs/GetModelState", fields
    )  # type: Any
    return math.hypot(answer.twist.linear.x, answer.twist.linear.y)


def wait_for_speed(space: str, speed_m_s: float) -> None:
    """Waits until a robot is at least that fast."""
    import rospy
    from nav_msgs.msg import Odometry

    probes._start()
    speeds = [0.0]
    add = lambda m: speeds.append(m.twist.twist.linear.x)  # noqa: E731
    rospy.Subscriber(f"{space}/odom", Odometry, add, queue_size=1000)
    wait_until(lambda: speeds[-1] >= speed_m_s, f"{speed_m_s} m/s")


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_measure_motion_leaves_the_robot_at_rest_when_ended(
    robots: RosGraph, number: signal.Signals
) -> None:
    arguments = ("--ns", "/robot2", "--model", "TerraSentia_robot2")
    measuring = robots.spawn("rosrun", "terrasentia_description", "measure_motion", *arguments)
    robots.call(wait_for_speed, "/robot2", 0.4)
    os.kill(measuring.pid, number)
    assert measuring.wait(30.0) == 128 + number
    assert measuring.output().endswith("measure_motion: interrupted\n")
    time.sleep(1.0)
    assert robots.call(speed_of, "TerraSentia_robot2") < 0.01


@pytest.mark.parametrize("option", ["--speed-m-s", "--turn-rad-s", "--duration-s"])
@pytest.mark.parametrize("text", ["nan", "inf", "0"])
def test_measure_motion_refuses_what_is_no_motion(robots: RosGraph, option: str, text: str) -> None:
    refused = robots.spawn("rosrun", "terrasentia_description", "measure_motion", option, text)
    assert refused.wait(30.0) == 2
    assert f"argument {option}: found {text}, expected a finite number" in refused.output()
