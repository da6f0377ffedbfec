# SPDX-License-Identifier: MIT
"""ROS node controls_client_node: drives the robot as target computers command over UDP.

The parameters, such as _watchdog_s:=0.3, are the keys of config/controls_client.yaml in the package
ardee_bridge; the defaults stand there.
"""
import queue
import threading
from typing import Callable, Dict

import rospy
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty

from ardee_bridge.nodes import controls
from ardee_bridge.nodes.controls import MOST_AT_ONCE, STANDSTILL, ControlsClient, Motion
from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.diagnostics import start_diagnostics
from ardee_bridge.nodes.settings import ControlSettings, silent
from ardee_bridge.wire.udp import open_socket
from ardee_common import ros_node

# Time for a last command to leave before the topic is closed.
FAREWELL_S = 0.1
TELL_PERIOD_S = 1.0
# Some 700 datagrams by Linux's count: in a flood a command waits at most behind these, some 0.1 s.
RECEIVE_BYTES = 256 << 10


class Mover:
    """Publishes motions on cmd_vel, and logs once a second what was obeyed, from a thread of its own."""

    def __init__(self, topic: str, counters: Counters) -> None:
        self._publisher = rospy.Publisher(topic, Twist, queue_size=MOST_AT_ONCE, tcp_nodelay=True)
        self._counters, self._latest = counters, STANDSTILL
        threading.Thread(target=self._tell, daemon=True).start()

    def move(self, motion: Motion) -> None:
        """Passes a motion on to the robot."""
        twist = Twist()
        twist.linear.x, twist.angular.z = motion.speed_m_s, motion.yaw_rate_rad_s
        self._publisher.publish(twist)
        self._latest = motion

    def _tell(self) -> None:
        before: Dict[str, int] = {}
        while not rospy.core.is_shutdown():
            done = self._counters.done()
            line = controls.what_was_obeyed(done, before, self._latest)
            if line:
                rospy.loginfo(line)
            before = done
            rospy.rostime.wallsleep(TELL_PERIOD_S)


class SimulationPauser:
    """Pauses and unpauses the simulation from a thread of its own: a simulation that hangs must not hold up motion."""

    def __init__(self, settings: ControlSettings, counters: Counters) -> None:
        self._services = {
            True: rospy.ServiceProxy(settings.pause_service, Empty),
            False: rospy.ServiceProxy(settings.unpause_service, Empty),
        }
        self._counters = counters
        self._wanted: "queue.SimpleQueue[bool]" = queue.SimpleQueue()
        threading.Thread(target=self._serve, daemon=True).start()

    def want(self, paused: bool) -> None:
        """Requests that the simulation be paused or run; the newest request counts."""
        self._wanted.put(paused)

    def _serve(self) -> None:
        while True:
            paused = self._wanted.get()
            while not self._wanted.empty():
                paused = self._wanted.get()
            try:
                self._services[paused]()
            except (
                Exception
            ) as error:  # the thread must survive any error, so that it serves the next request
                self._counters.drop("control codes that the simulation did not take", str(error))


def _make() -> Callable[[float], None]:
    settings = ros_node.read_parameters(ControlSettings, "ardee_bridge", "controls_client.yaml")
    counters = Counters(rospy.logwarn)
    opened = open_socket(settings.bind_address, settings.port, receive_bytes=RECEIVE_BYTES)
    mover = Mover(settings.cmd_vel_topic, counters)
    pauser = SimulationPauser(settings, counters)
    client = ControlsClient(settings, opened, counters, mover.move, pauser.want)

    def stop() -> None:
        client.stop()
        rospy.rostime.wallsleep(FAREWELL_S)

    rospy.on_shutdown(stop)
    start_diagnostics(counters)
    if not settings.peers.networks:
        rospy.logwarn("peers: found none, so nobody can drive")
    for each in silent(settings.peers):
        rospy.logwarn("peers: nobody sends from %s; expected the addresses of who may drive", each)
    rospy.loginfo("controls arrive at %s:%d", *opened.getsockname())
    return client.receive


def main(name: str = "controls_client_node") -> int:
    """Runs the node; returns its exit code."""
    return ros_node.run(name, __doc__, _make, disable_rostime=True)
