# SPDX-License-Identifier: MIT
"""ROS node sensor_server_node: sends the robot's sensors to target computers over UDP.

The parameters, such as _port:=30001, are the keys of config/sensor_server.yaml in the package
ardee_bridge; the defaults stand there.
"""
from typing import Callable

import rospy

from ardee_bridge import priority, ros_node
from ardee_bridge.counters import Counters
from ardee_bridge.frames import FrameProcesses, Shared
from ardee_bridge.reader import Reader
from ardee_bridge.sensor_server import SensorServer
from ardee_bridge.settings import Source, kept_here, read_server
from ardee_bridge.subscriptions import Subscriptions
from ardee_bridge.udp import PairLock, open_socket


def _resolved(source: Source) -> Source:
    """With the full names of its topics."""
    velocity_topic = source.velocity_topic and rospy.resolve_name(source.velocity_topic)
    return source._replace(topic=rospy.resolve_name(source.topic), velocity_topic=velocity_topic)


def _make() -> Callable[[float], None]:
    settings = read_server(ros_node.read_parameters("sensor_server.yaml"))
    settings = settings._replace(sources=tuple(map(_resolved, settings.sources)))
    counters = Counters(rospy.logwarn)
    opened = open_socket(settings.bind_address, settings.port, settings.multicast_ttl)
    lock = PairLock.make()
    server = SensorServer(settings, opened, counters, lambda: on_targets(), lock=lock)
    small = [source for source in settings.sources if not source.is_frame]
    own_name = f"{rospy.get_name()}_small"
    reader = Reader(own_name, rospy.logwarn, rospy.signal_shutdown, counters.drop_unreadable)
    rospy.on_shutdown(reader.close)
    subscriptions = Subscriptions(small, server, reader)
    frames = FrameProcesses(rospy.get_name(), settings, reader, Shared(opened, lock, rospy.logwarn))
    rospy.on_shutdown(frames.stop)

    def on_targets() -> None:
        subscriptions.update()
        frames.serve(server)

    def step(timeout_s: float) -> None:
        server.receive(timeout_s)
        frames.follow(server)

    on_targets()
    ros_node.start_diagnostics(rospy.get_name(), counters, frames.counts)
    peers = ", ".join(f"{peer.address}:{peer.port}" for peer in settings.destinations)
    here = "%s:%d" % opened.getsockname()
    rospy.loginfo("sensors leave %s for %s", here, peers or "whoever asks by SET_PORT")
    for group in kept_here(settings):
        rospy.logwarn(
            "messages to %s stay on this computer: found bind_address %s, expected that of an interface towards others",
            group,
            settings.bind_address,
        )
    if settings.realtime_priority and not priority.go_first(settings.realtime_priority):
        rospy.loginfo("no real-time priority is granted: where all cores are busy, messages wait")
    return step


def main(name: str = "sensor_server_node") -> int:
    """Exit code of the node."""
    return ros_node.run(name, __doc__, _make)
