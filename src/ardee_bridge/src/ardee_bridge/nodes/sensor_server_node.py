# SPDX-License-Identifier: MIT
"""ROS node sensor_server_node: sends the robot's sensors to target computers over UDP.

The parameters, such as _port:=30001, are the keys of config/sensor_server.yaml in the package
ardee_bridge; the defaults stand there.
"""
import dataclasses
from typing import Callable

import rospy

from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.diagnostics import start_diagnostics
from ardee_bridge.nodes.sensor_server import SensorServer
from ardee_bridge.nodes.settings import ServerSettings, Source, kept_here
from ardee_bridge.nodes.subscriptions import Subscriptions
from ardee_bridge.wire.udp import open_socket
from ardee_common import ros_node


def _resolved(source: Source) -> Source:
    """Returns the source with the full names of its topics."""
    names = {"topic": rospy.resolve_name(source.topic)}
    if source.velocity_topic:
        names["velocity_topic"] = rospy.resolve_name(source.velocity_topic)
    return dataclasses.replace(source, **names)


def _make() -> Callable[[float], None]:
    settings = ros_node.read_parameters(ServerSettings, "ardee_bridge", "sensor_server.yaml")
    sources = tuple(map(_resolved, settings.sources))
    settings = dataclasses.replace(settings, sources=sources)
    counters = Counters(rospy.logwarn)
    opened = open_socket(settings.bind_address, settings.port, settings.multicast_ttl)
    server = SensorServer(settings, opened, counters, lambda: subscriptions.update())
    subscriptions = Subscriptions(sources, server)
    start_diagnostics(counters)
    peers = ", ".join(f"{peer.address}:{peer.port}" for peer in settings.peers)
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
    """Runs the node; returns its exit code."""
    return ros_node.run(name, __doc__, _make, disable_rostime=True)
