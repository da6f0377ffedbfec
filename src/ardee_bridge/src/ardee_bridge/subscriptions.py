# SPDX-License-Identifier: MIT
"""Subscriptions of a sensor server, in the node or in its process for images and clouds."""
import threading
from typing import Any, Callable, Dict, Iterable, List

import numpy
import rospy
from geometry_msgs.msg import Vector3Stamped
from sensor_msgs.msg import Image, Imu, LaserScan, NavSatFix, PointCloud2

from ardee_bridge.reader import Kind, Reader
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
# Room for a whole uncompressed image, so that it is read at one go.
LARGE_BUFFER_BYTES = 1 << 24

# Of a topic, a message's class, a callback: a subscription that ends with unregister().
Subscribe = Callable[[str, Any, Callable[[Any], None]], Any]


def by_rospy(topic: str, message: Any, callback: Callable[[Any], None]) -> rospy.Subscriber:
    """Subscribe with a thread for the topic: for large messages, several of which are converted at a time."""
    return rospy.Subscriber(
        topic, message, callback, buff_size=LARGE_BUFFER_BYTES, tcp_nodelay=True
    )


def by_reader(reader: Reader) -> Subscribe:
    """Subscribe with the one thread of a reader: for small messages."""

    def subscribe(topic: str, message: Any, callback: Callable[[Any], None]) -> Any:
        def decode(data: bytes) -> Any:
            if message is LaserScan:  # its arrays become numpy's, without a list between
                return message().deserialize_numpy(data, numpy)
            return message().deserialize(data)

        kind = Kind(message._type, message._md5sum, decode)
        return reader.subscribe(rospy.resolve_name(topic), kind, callback)

    return subscribe


class Subscriptions:
    """Subscribed to the topics of those sources that somebody wants, so that no unwanted camera is rendered."""

    def __init__(
        self, sources: Iterable[Source], server: SensorServer, subscribe: Subscribe
    ) -> None:
        self._sources, self._server, self._subscribe = tuple(sources), server, subscribe
        self._lock = threading.Lock()
        self._active: Dict[str, List[Any]] = {}

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

    def _follow(self, source: Source) -> List[Any]:
        latest: Dict[str, Any] = {}
        subscribers = []
        if source.velocity_topic:

            def keep(message: Vector3Stamped) -> None:
                latest["velocity"] = message.vector

            subscribers.append(self._subscribe(source.velocity_topic, Vector3Stamped, keep))

        def publish(message: Any) -> None:
            self._server.publish(source, message, latest.get("velocity"))

        subscribers.append(self._subscribe(source.topic, TYPES[source.kind], publish))
        return subscribers
