# SPDX-License-Identifier: MIT
"""The sensor server as a ROS node."""
from typing import Callable, Dict, List

import rospy

from ardee_bridge import priority, ros_node
from ardee_bridge.counters import Counters, Counts
from ardee_bridge.frames import FrameProcess, Job
from ardee_bridge.reader import Reader
from ardee_bridge.sensor_server import SensorServer
from ardee_bridge.settings import ServerSettings, Source, read_server
from ardee_bridge.subscriptions import Subscriptions
from ardee_bridge.udp import PairLock, open_socket


def _resolved(source: Source) -> Source:
    """With the full names of its topics."""
    velocity_topic = source.velocity_topic and rospy.resolve_name(source.velocity_topic)
    return source._replace(topic=rospy.resolve_name(source.topic), velocity_topic=velocity_topic)


def _jobs(settings: ServerSettings) -> List[Job]:
    """Of the processes for images and clouds: one for what is sent as it is, one for each camera that is compressed."""
    frames = [source for source in settings.sources if source.is_frame]
    plain = tuple(source for source in frames if source.image_format != "jpeg")
    name = rospy.get_name()
    jobs = [Job(f"{name}_frames", settings._replace(sources=plain), True)] if plain else []
    for source in frames:
        if source not in plain:
            of_camera = f"{name}_jpeg_{source.component_id}"
            jobs.append(Job(of_camera, settings._replace(sources=(source,)), False))
    return jobs


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
    processes = [FrameProcess(job, opened, lock, rospy.logwarn) for job in _jobs(settings)]
    for process in processes:
        rospy.on_shutdown(process.stop)

    def on_targets() -> None:
        subscriptions.update()
        for process in processes:
            process.serve(server.clients())

    def others() -> Dict[str, Counts]:
        return {process.name: process.counts() for process in processes}

    on_targets()
    ros_node.start_diagnostics(rospy.get_name(), counters, others)
    peers = ", ".join(f"{peer.address}:{peer.port}" for peer in settings.destinations)
    here = "%s:%d" % opened.getsockname()
    rospy.loginfo("sensors leave %s for %s", here, peers or "whoever asks by SET_PORT")
    if settings.realtime_priority and not priority.go_first(settings.realtime_priority):
        rospy.loginfo("no real-time priority is granted: where all cores are busy, messages wait")
    return server.receive


def main(name: str = "sensor_server_node") -> int:
    """Exit code of the node."""
    return ros_node.run(name, _make)
