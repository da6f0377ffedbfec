# SPDX-License-Identifier: MIT
"""ROS node sensor_server_node: sends the robot's sensors to target computers over UDP.

The parameters, such as _port:=30001, are the keys of config/sensor_server.yaml in the package
ardee_bridge; the defaults stand there.
"""
from typing import Callable

import rospy

from ardee_bridge.nodes import ros_node
from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.sensor_server import SensorServer
from ardee_bridge.nodes.settings import Source, kept_here, read_server
from ardee_bridge.nodes.subscriptions import Subscriptions
from ardee_bridge.wire.udp import open_socket


def _resolved(source: Source) -> Source:
    """With the full names of its topics."""
    velocity_topic = source.velocity_topic and rospy.resolve_name(source.velocity_topic)
    return source._replace(topic=rospy.resolve_name(source.topic), velocity_topic=velocity_topic)


def _make() -> Callable[[float], None]:
    settings = read_server(ros_node.read_parameters("sensor_server.yaml"))
    settings = settings._replace(sources=tuple(map(_resolved, settings.sources)))
    counters = Counters(rospy.logwarn)
    opened = open_socket(settings.bind_address, settings.port, settings.multicast_ttl)
    server = SensorServer(settings, opened, counters, lambda: subscriptions.update())
    subscriptions = Subscriptions(settings.sources, server)
    ros_node.start_diagnostics(counters)
    peers = ", ".join(f"{peer.address}:{peer.port}" for peer in settings.destinations)
    here = "%s:%d" % opened.getsockname()
    rospy.loginfo("sensors leave %s for %s", here, peers or "whoever asks by SET_PORT")
    for group in kept_here(settings):
        found = (
            f"messages to {group} stay on this computer: found bind_address {settings.bind_address}"
        )
        rospy.logwarn(f"{found}, expected that of an interface towards others")
    if settings.realtime_priority:
        rospy.logwarn(
            "realtime_priority: found %d, which has no effect", settings.realtime_priority
        )
    return server.receive


def main(name: str = "sensor_server_node") -> int:
    """Exit code of the node."""
    return ros_node.run(name, __doc__, _make)
