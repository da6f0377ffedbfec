# SPDX-License-Identifier: MIT
"""Measures the controls client on loopback: from a command's datagram to its Twist in a subscriber's callback."""
import time
from typing import Any, Dict

from bench.latency import (
    SETTLE_S,
    START_LIMIT_S,
    Spread,
    answer,
    hear,
    in_process,
    node,
    own_master,
    spread,
)

from ardee_bridge.wire import codec
from ardee_bridge.wire.udp import open_socket

COMMAND_RATE_HZ = 100.0


def receive_commands(pipe: Any, topic: str) -> None:
    """Runs as the robot: reports that it listens and, when told to end, when each command came."""
    import rospy
    from geometry_msgs.msg import Twist

    arrivals = {}  # type: Dict[int, int]

    def keep(twist: Any) -> None:
        arrivals[round(twist.linear.x * 1e6)] = time.time_ns()

    rospy.init_node("latency_robot", anonymous=True, disable_signals=True, disable_rostime=True)
    robot = rospy.Subscriber(topic, Twist, keep, tcp_nodelay=True)
    while not robot.get_num_connections():
        time.sleep(0.05)
    pipe.send("listening")
    while not arrivals:
        time.sleep(0.05)
    pipe.send("moving")
    pipe.recv()
    pipe.send(arrivals)


def measure_controls(seconds: float) -> Spread:
    """Measures from the data datagram of a motion command to its Twist."""
    with own_master() as env, open_socket("127.0.0.1", 0) as probe:
        port = probe.getsockname()[1]
        probe.close()
        robot, from_robot = in_process(env, receive_commands, "/cmd_vel")
        with node(env, "controls_client_node", f"_port:={port}", "_max_speed_m_s:=1.0"):
            hear(from_robot, START_LIMIT_S)
            _wake(port, from_robot)
            sent = _send_commands(port, round(seconds * COMMAND_RATE_HZ))
            time.sleep(SETTLE_S)
            arrivals = answer(robot, from_robot, "end", START_LIMIT_S)
    found = [arrivals[serial] - at_ns for serial, at_ns in sent.items() if serial in arrivals]
    return spread(found, len(sent))


def _wake(port: int, from_robot: Any) -> None:
    """Sends commands until the first arrives: only then do both ends of the topic know each other."""
    with open_socket("127.0.0.1", 0) as opened:
        deadline = time.monotonic() + START_LIMIT_S
        while not from_robot.poll(0.1):
            if time.monotonic() > deadline:
                raise TimeoutError("no command arrives")
            for datagram in codec.encode_motion(0.0, 0.0):
                opened.sendto(datagram, ("127.0.0.1", port))
    hear(from_robot, START_LIMIT_S)


def _send_commands(port: int, count: int) -> Dict[int, int]:
    sent = {}
    with open_socket("127.0.0.1", 0) as opened:
        for serial in range(1, count + 1):
            header, data = codec.encode_motion(serial / codec.DEFAULT_MULTIPLIER, 0.0)
            opened.sendto(header, ("127.0.0.1", port))
            sent[serial] = time.time_ns()
            opened.sendto(data, ("127.0.0.1", port))
            time.sleep(1.0 / COMMAND_RATE_HZ)
    return sent
