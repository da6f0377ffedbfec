# SPDX-License-Identifier: MIT
"""Subscribes the sensor server to the topics that a target wants, and to the better one of a camera's two."""
import functools
import http.client
import threading
import time
import xmlrpc.client
from typing import AbstractSet, Any, Callable, Dict, Iterable, List, Tuple

import rospy
from geometry_msgs.msg import Vector3Stamped
from sensor_msgs.msg import CompressedImage, Image, Imu, LaserScan, NavSatFix, PointCloud2

from ardee_bridge.nodes.fix_velocity import FixWithVelocity
from ardee_bridge.nodes.sensor_server import SensorServer
from ardee_bridge.nodes.settings import COMPRESSED, Source
from ardee_msgs.msg import Battery, Encoder

TYPES = {
    **dict.fromkeys(("imu", "gyro", "acceleration", "orientation"), Imu),
    "gps": NavSatFix,
    "lidar": LaserScan,
    "encoder": Encoder,
    "battery": Battery,
    "image": Image,
    "point_cloud": PointCloud2,
}
# Time for which compressed images must be missing beside raw ones, because a publisher announces its topics one by one.
PATIENCE_S = 1.0
LOOK_S = 0.5  # between two looks at the publishers of cameras
Topics = AbstractSet[Tuple[str, str]]  # names and types


class CameraTopics:
    """Chooses between a camera's own JPEG images and its raw ones, which the server compresses."""

    def __init__(self, clock: Callable[[], float] = time.monotonic) -> None:
        self._clock = clock
        self._chosen: Dict[str, Source] = {}  # by name
        self._raw_alone_since_s: Dict[str, float] = {}

    def choose(self, cameras: Iterable[Source], published: Topics) -> List[Source]:
        """Returns the wanted cameras whose form is known, each with the topic to read.

        Compressed images are preferred; while nobody publishes, the form stays.
        """
        wanted, now_s = {each.name: each for each in cameras}, self._clock()
        for name in self._chosen.keys() - wanted.keys():
            del self._chosen[name]
        for name, source in wanted.items():
            own = source.of_camera()
            has_raw = (source.topic, Image._type) in published
            if (own.topic, CompressedImage._type) in published:
                self._chosen[name], has_raw = own, False
            if not has_raw:
                self._raw_alone_since_s.pop(name, None)
            elif now_s - self._raw_alone_since_s.setdefault(name, now_s) >= PATIENCE_S:
                self._chosen[name] = source
        return list(self._chosen.values())


class Subscriptions:
    """Follows the targets' wishes, so that no unwanted camera is rendered. Topics are full names.

    A thread of its own calls the ROS master, whose silence then delays nothing else.
    """

    def __init__(self, sources: Iterable[Source], server: SensorServer) -> None:
        self._sources, self._server, self._cameras = tuple(sources), server, CameraTopics()
        self._active: Dict[Source, List[rospy.Subscriber]] = {}
        self._changed = threading.Event()
        threading.Thread(target=self._repeat, daemon=True).start()

    def update(self) -> None:
        """Reports that the targets of the server have changed."""
        self._changed.set()

    def _repeat(self) -> None:
        while not rospy.core.is_shutdown():
            try:
                self._follow(self._to_read())
            except (OSError, xmlrpc.client.Error, http.client.HTTPException):
                pass  # the master is away; watch_master reports it
            self._changed.wait(LOOK_S)
            self._changed.clear()

    def _to_read(self) -> AbstractSet[Source]:
        names = self._server.wanted()
        wanted = [source for source in self._sources if source.name in names]
        cameras = [source for source in wanted if source.format == "jpeg"]
        topics = _published() if cameras else set()
        return set(wanted) - set(cameras) | set(self._cameras.choose(cameras, topics))

    def _follow(self, to_read: AbstractSet[Source]) -> None:
        for source in self._active.keys() - to_read:
            for subscriber in self._active.pop(source):
                subscriber.unregister()
        for source in to_read - self._active.keys():
            self._active[source] = self._subscribe(source)

    def _subscribe(self, source: Source) -> List[rospy.Subscriber]:
        def publish(message: Any, velocity: Any = None) -> None:
            self._server.publish(source, message, velocity)

        if source.velocity_topic:
            both = FixWithVelocity(publish)
            return [
                _subscriber(source.velocity_topic, Vector3Stamped, both.on_velocity),
                _subscriber(source.topic, NavSatFix, both.on_fix),
            ]
        is_compressed = source.format == COMPRESSED
        kind = CompressedImage if is_compressed else TYPES[source.kind]
        return [_subscriber(source.topic, kind, publish)]


def _published() -> Topics:
    """Returns names and types of all topics that somebody publishes."""
    code, text, topics = rospy.get_master().getPublishedTopics("/")
    if code != 1:
        raise xmlrpc.client.Error(text)
    return set(map(tuple, topics))


_subscriber = functools.partial(rospy.Subscriber, tcp_nodelay=True)
