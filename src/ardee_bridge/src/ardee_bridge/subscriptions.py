# SPDX-License-Identifier: MIT
"""Subscriptions of a sensor server, in the node or in one of its processes for images and clouds."""
import threading
from typing import Any, Callable, Dict, Iterable, List

import numpy
from geometry_msgs.msg import Vector3Stamped
from sensor_msgs.msg import Image, Imu, LaserScan, NavSatFix, PointCloud2

from ardee_bridge import frame_messages
from ardee_bridge.fix_velocity import FixWithVelocity
from ardee_bridge.reader import Kind, Reader, Subscription
from ardee_bridge.sensor_server import SensorServer
from ardee_bridge.settings import Source
from ardee_msgs.msg import Battery, Encoder

TYPES = {
    "imu": Imu,
    "gyro": Imu,
    "acceleration": Imu,
    "orientation": Imu,
    "gps": NavSatFix,
    "lidar": LaserScan,
    "encoder": Encoder,
    "battery": Battery,
    "image": Image,
    "point_cloud": PointCloud2,
}
# Those whose fields are not all made objects of.
_DECODERS: Dict[Any, Callable[[memoryview], Any]] = {
    LaserScan: lambda data: LaserScan().deserialize_numpy(bytes(data), numpy),
    Image: frame_messages.image,
    PointCloud2: frame_messages.point_cloud,
}


def _kind(message: Any) -> Kind:
    """Of a message's class."""
    decode = _DECODERS.get(message, lambda data: message().deserialize(bytes(data)))
    return Kind(message._type, message._md5sum, decode)


class Subscriptions:
    """Subscribed to the topics of those sources that somebody wants, so that no unwanted camera is rendered.

    Their topics are full names.
    """

    def __init__(self, sources: Iterable[Source], server: SensorServer, reader: Reader) -> None:
        self._sources, self._server, self._reader = tuple(sources), server, reader
        self._lock = threading.Lock()
        self._active: Dict[str, List[Subscription]] = {}

    def update(self) -> None:
        """Subscribe and unsubscribe as the targets of the server want it."""
        with self._lock:
            wanted = self._server.wanted()
            for source in self._sources:
                if source.name in wanted and source.name not in self._active:
                    self._active[source.name] = self._follow(source)
                elif source.name not in wanted and source.name in self._active:
                    for subscriber in self._active.pop(source.name):
                        subscriber.unregister()

    def _follow(self, source: Source) -> List[Subscription]:
        def publish(message: Any, velocity: Any = None) -> None:
            self._server.publish(source, message, velocity)

        if not source.velocity_topic:
            return [self._subscribe(source.topic, TYPES[source.kind], publish)]
        both = FixWithVelocity(publish)
        return [
            self._subscribe(source.velocity_topic, Vector3Stamped, both.on_velocity),
            self._subscribe(source.topic, TYPES[source.kind], both.on_fix),
        ]

    def _subscribe(self, topic: str, message: Any, callback: Callable[[Any], None]) -> Subscription:
        return self._reader.subscribe(topic, _kind(message), callback)
