# SPDX-License-Identifier: MIT
"""Tests that every node that drives leaves the robot at rest when it ends, even while its input goes on."""
import os
import pty
import signal
import socket
import subprocess
import time
import xmlrpc.client
from typing import Any, Callable, Dict, List, Tuple

import pytest
from bridge_bench import free_port, start_in

from ardee_bridge.wire import codec
from ardee_common.ros_graph import RosGraph, wait_until

PERIOD_S = 0.01
HELD_BUTTON = 0
PORT = free_port()


def joystick() -> Callable[[], None]:
    """Publishes a joystick with its stick held forward and its button pressed."""
    import rospy
    from sensor_msgs.msg import Joy

    topic = rospy.Publisher("/joy", Joy, queue_size=1)
    return lambda: topic.publish(Joy(axes=[0.0, 1.0], buttons=[1]))


def rows() -> Callable[[], None]:
    """Publishes scans between two rows, and odometry."""
    import numpy as np
    import rospy
    from nav_msgs.msg import Odometry
    from sensor_msgs.msg import LaserScan

    scans = rospy.Publisher("/ardee/hokuyo", LaserScan, queue_size=1)
    odometry = rospy.Publisher("/odom", Odometry, queue_size=1)
    sines = np.abs(np.sin(np.linspace(-2.35, 2.35, 1081)))
    scan = LaserScan(angle_min=-2.35, angle_increment=4.7 / 1080)
    scan.ranges = (0.381 / np.maximum(sines, 0.05)).tolist()

    def publish() -> None:
        odometry.publish(Odometry())
        scan.header.stamp = rospy.Time.now()
        scans.publish(scan)

    return publish


def target(port: int) -> Callable[[], None]:
    """Sends motion commands to that port."""
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)

    def send() -> None:
        for datagram in codec.encode_motion(0.5, 0.0):
            opened.sendto(datagram, ("127.0.0.1", port))

    return send


def keys() -> Callable[[], None]:
    """Starts the keyboard's teleop in a terminal, and holds a key."""
    terminal, slave = pty.openpty()
    command = ["rosrun", "terrasentia_description", "keyboard_teleop"]
    subprocess.Popen(command, stdin=slave, stdout=slave, stderr=slave)
    os.set_blocking(terminal, False)

    def press() -> None:
        try:
            os.write(terminal, b"i")
            os.read(terminal, 4096)  # the teleop's output must be read
        except OSError:
            pass

    return press


FEEDS: Dict[str, Callable[..., Callable[[], None]]] = {
    "joystick": joystick,
    "rows": rows,
    "target": target,
    "keys": keys,
}


def feed(pipe: Any) -> None:
    """Feeds, as a process's body, an input (name, arguments); reports the first command; when asked, the last [m/s]."""
    import rospy
    from geometry_msgs.msg import Twist

    speeds: List[float] = []
    rospy.init_node("probe", anonymous=True, disable_signals=True)
    rospy.Subscriber("/cmd_vel", Twist, lambda twist: speeds.append(twist.linear.x))
    name, *arguments = pipe.recv()
    feed_once, has_told = FEEDS[name](*arguments), False
    while not pipe.poll(PERIOD_S):
        feed_once()
        if len(speeds) > 10 and not has_told:
            pipe.send("moving")
            has_told = True
    pipe.recv()
    pipe.send(speeds[-1])


def pid_of(graph: RosGraph, node: str) -> int:
    """Returns the process id that the node itself reports."""
    _, _, address = xmlrpc.client.ServerProxy(graph.uri).lookupNode("/test", node)
    return xmlrpc.client.ServerProxy(address).getPid("/test")[2]


def end_by_name(graph: RosGraph, node: str) -> None:
    """Ends a node as `rosnode kill` does."""
    assert "killed" in graph.run("rosnode", "kill", node)


def ctrl_c(graph: RosGraph, node: str) -> None:
    """Ends a node by SIGINT."""
    os.kill(pid_of(graph, node), signal.SIGINT)


def terminate(graph: RosGraph, node: str) -> None:
    """Ends a node by SIGTERM."""
    os.kill(pid_of(graph, node), signal.SIGTERM)


@pytest.mark.parametrize("end", [end_by_name, ctrl_c, terminate])
@pytest.mark.parametrize(
    "feeding, node, command",
    [
        (
            ("target", PORT),
            "/controls_client_node",
            ("rosrun", "ardee_bridge", "controls_client_node", f"_port:={PORT}"),
        ),
        (
            ("joystick",),
            "/teleop_twist_joy_node",
            ("rosrun", "teleop_twist_joy", "teleop_node", f"_enable_button:={HELD_BUTTON}"),
        ),
        (("rows",), "/row_follower", ("rosrun", "ardee_navigation", "row_follower")),
        (("rows",), "/drive_row", ("scripts/drive_row",)),
        (("keys",), "/keyboard_teleop", ()),
    ],
    ids=["controls client", "joystick", "row follower", "drive_row", "keyboard"],
)
def test_a_driver_commands_a_stand_last(
    feeding: Tuple[Any, ...],
    node: str,
    command: Tuple[str, ...],
    end: Callable[[RosGraph, str], None],
    graph: RosGraph,
) -> None:
    process = graph.spawn(*command) if command else None
    robot, pipe = start_in(graph, feed)
    pipe.send(feeding)
    wait_until(lambda: pipe.poll(0.1), "the robot moves", 60.0)
    assert pipe.recv() == "moving"
    end(graph, node)
    if process:
        assert process.wait(30.0) == 0
    time.sleep(0.5)
    pipe.send("and now?")
    assert pipe.recv() == 0.0
    robot.join(30.0)
