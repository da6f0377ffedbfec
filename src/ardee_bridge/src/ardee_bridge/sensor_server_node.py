# SPDX-License-Identifier: MIT
"""The sensor server as a ROS node."""
from typing import Callable

import rospy

from ardee_bridge import ros_node
from ardee_bridge.counters import Counters
from ardee_bridge.frames import FrameProcess
from ardee_bridge.reader import Reader
from ardee_bridge.sensor_server import SensorServer
from ardee_bridge.settings import read_server
from ardee_bridge.subscriptions import Subscriptions, by_reader
from ardee_bridge.udp import PairLock, open_socket


def _make() -> Callable[[float], None]:
    values = ros_node.read_parameters("sensor_server.yaml")
    settings = read_server(values)
    counters = Counters(rospy.logwarn)
    opened = open_socket(settings.bind_address, settings.port, settings.multicast_ttl)
    lock = PairLock.make()
    server = SensorServer(settings, opened, counters, lambda: on_targets(), lock=lock)
    small = [source for source in settings.sources if not source.is_frame]
    reader = Reader(f"{rospy.get_name()}_small", rospy.logwarn, rospy.signal_shutdown)
    rospy.on_shutdown(reader.close)
    subscriptions = Subscriptions(small, server, by_reader(reader))
    frames = FrameProcess(values, opened, lock)
    rospy.on_shutdown(frames.stop)

    def on_targets() -> None:
        subscriptions.update()
        frames.serve(server.clients())

    on_targets()
    ros_node.start_diagnostics(rospy.get_name(), counters)
    peers = ", ".join(f"{peer.address}:{peer.port}" for peer in settings.destinations)
    here = "%s:%d" % opened.getsockname()
    rospy.loginfo("sensors leave %s for %s", here, peers or "whoever asks by SET_PORT")
    if settings.realtime_priority and not ros_node.go_first(settings.realtime_priority):
        rospy.loginfo("no real-time priority is granted: where all cores are busy, messages wait")
    return server.receive


def main(name: str = "sensor_server_node") -> int:
    """Exit code of the node."""
    return ros_node.run(name, _make)
