# SPDX-License-Identifier: MIT
"""Subscriptions of a sensor server, in the node or in one of its processes for images and clouds."""
import threading
from typing import AbstractSet, Any, Callable, Dict, Iterable, List, Optional

import numpy
from geometry_msgs.msg import Vector3Stamped
from sensor_msgs.msg import CompressedImage, Image, Imu, LaserScan, NavSatFix, PointCloud2

from ardee_bridge import frame_messages
from ardee_bridge.fix_velocity import FixWithVelocity
from ardee_bridge.reader import Kind, Reader, Subscription
from ardee_bridge.sensor_server import SensorServer
from ardee_bridge.settings import COMPRESSED, Source
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
    CompressedImage: frame_messages.compressed_image,
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

    def update(self, names: Optional[AbstractSet[str]] = None) -> None:
        """Subscribe and unsubscribe as the targets of the server want it, of these sources alone if they are given."""
        with self._lock:
            wanted = self._server.wanted()
            wanted = wanted if names is None else wanted & names
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
            is_compressed = source.image_format == COMPRESSED
            kind = CompressedImage if is_compressed else TYPES[source.kind]
            return [self._subscribe(source.topic, kind, publish)]
        both = FixWithVelocity(publish)
        return [
            self._subscribe(source.velocity_topic, Vector3Stamped, both.on_velocity),
            self._subscribe(source.topic, TYPES[source.kind], both.on_fix),
        ]

    def _subscribe(self, topic: str, message: Any, callback: Callable[[Any], None]) -> Subscription:
        return self._reader.subscribe(topic, _kind(message), callback)
