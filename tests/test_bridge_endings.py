# SPDX-License-Identifier: MIT
"""Tests the ends of the bridge's nodes: the robot stops, and nodes end when another ROS master replaces theirs."""
import socket
import time
from typing import Any, List

from bridge_bench import free_port, start_in

from ardee_bridge.wire import codec
from ardee_common.ros_graph import Process, RosGraph, wait_until

NODES = ("sensor_server_node", "controls_client_node")


def keep_speeds(pipe: Any) -> None:
    """Reports, as the body of a process, a first command; when asked, the last commanded speed [m/s]."""
    import rospy
    from geometry_msgs.msg import Twist

    speeds = []  # type: List[float]
    rospy.init_node("robot", anonymous=True, disable_signals=True)
    rospy.Subscriber("/cmd_vel", Twist, lambda twist: speeds.append(twist.linear.x))
    wait_until(lambda: speeds, "a command", 60.0)
    pipe.send("moving")
    pipe.recv()
    pipe.send(speeds[-1])


def drive_until(answered: Any, port: int) -> None:
    """Sends commands to a controls client until the robot has got one."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        while not answered.poll(0.05):
            for datagram in codec.encode_motion(0.5, 0.0):
                opened.sendto(datagram, ("127.0.0.1", port))


def test_a_controls_client_that_ends_stops_the_robot(graph: RosGraph) -> None:
    port = free_port()
    settings = (f"_port:={port}", "_watchdog_s:=60")
    node = graph.spawn("rosrun", "ardee_bridge", "controls_client_node", *settings)
    robot, pipe = start_in(graph, keep_speeds)
    drive_until(pipe, port)
    assert pipe.recv() == "moving"
    node.interrupt()
    assert node.wait(30.0) == 0
    time.sleep(0.5)
    pipe.send("and now?")
    assert pipe.recv() == 0.0
    robot.join(30.0)


def is_answered(port: int) -> bool:
    """Returns whether a controls client answers a control message."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        opened.settimeout(10.0)
        for datagram in codec.encode_control(codec.ControlCode.STOP, 7):
            opened.sendto(datagram, ("127.0.0.1", port))
        return codec.Header.unpack(opened.recv(64)).msg_type == codec.MessageType.ACK


def test_without_their_master_they_go_on_and_with_another_one_they_end(graph: RosGraph) -> None:
    ports = {name: free_port() for name in NODES}
    nodes = {
        name: graph.spawn("rosrun", "ardee_bridge", name, f"_port:={port}")
        for name, port in ports.items()
    }
    for name, node in nodes.items():
        wait_until(lambda: f"127.0.0.1:{ports[name]}" in node.output(), f"{name} starts", 60.0)
    graph.end_master()
    for name, node in nodes.items():
        wait_until(lambda: "the ROS master is away" in node.output(), f"{name} notices", 60.0)
        assert node.exit_code() is None
    assert is_answered(ports["controls_client_node"])
    before = {name: len(complaints(node)) for name, node in nodes.items()}
    graph.start_master()
    for name, node in nodes.items():
        assert node.wait(60.0) == 3
        assert complaints(node)[before[name] :] == [
            f"/{name}: the ROS master knows this node no more"
        ]


def complaints(node: Process) -> List[str]:
    """Returns the node's lines without those of its log."""
    return [line for line in node.output().splitlines() if line and "[INFO]" not in line]
