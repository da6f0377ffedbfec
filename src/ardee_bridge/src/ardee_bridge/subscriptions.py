# SPDX-License-Identifier: MIT
"""Subscriptions of a sensor server, in the node or in its process for images and clouds."""
import threading
from typing import Any, Dict, Iterable, List

import rospy
from geometry_msgs.msg import Vector3Stamped
from sensor_msgs.msg import Image, Imu, LaserScan, NavSatFix, PointCloud2

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
LARGE_BUFFER_BYTES, BUFFER_BYTES = 1 << 24, 1 << 16


class Subscriptions:
    """Subscribed to the topics of those sources that somebody wants, so that no unwanted camera is rendered."""

    def __init__(self, sources: Iterable[Source], server: SensorServer) -> None:
        self._sources, self._server = tuple(sources), server
        self._lock = threading.Lock()
        self._active: Dict[str, List[Any]] = {}

    def update(self) -> None:
        """Subscribe and unsubscribe as the targets of the server want it."""
        with self._lock:
            wanted = self._server.wanted()
            for source in self._sources:
                if source.name in wanted and source.name not in self._active:
                    self._active[source.name] = self._subscribe(source)
                elif source.name not in wanted and source.name in self._active:
                    for subscriber in self._active.pop(source.name):
                        subscriber.unregister()

    def _subscribe(self, source: Source) -> List[Any]:
        latest: Dict[str, Any] = {}
        subscribers = []
        if source.velocity_topic:
            subscribers.append(
                rospy.Subscriber(
                    source.velocity_topic,
                    Vector3Stamped,
                    lambda message: latest.update(velocity=message.vector),
                    tcp_nodelay=True,
                )
            )
        subscribers.append(
            rospy.Subscriber(
                source.topic,
                TYPES[source.kind],
                lambda message: self._server.publish(source, message, latest.get("velocity")),
                buff_size=LARGE_BUFFER_BYTES if source.is_frame else BUFFER_BYTES,
                tcp_nodelay=True,
            )
        )
        return subscribers
