# SPDX-License-Identifier: MIT
"""The sensor server as a ROS node."""
import threading
from typing import Any, Callable, Dict

import rospy
from geometry_msgs.msg import Vector3Stamped
from sensor_msgs.msg import Image, Imu, LaserScan, NavSatFix, PointCloud2

from ardee_bridge import ros_node
from ardee_bridge.counters import Counters
from ardee_bridge.sensor_server import SensorServer
from ardee_bridge.settings import Source, read_server
from ardee_bridge.udp import open_socket
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


class Subscriptions:
    """Subscribed to the topics of those sources that somebody wants, so that no unwanted camera is rendered."""

    def __init__(self, sources: Any, server: SensorServer) -> None:
        self._sources, self._server = sources, server
        self._lock = threading.Lock()
        self._active: Dict[str, Any] = {}

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

    def _subscribe(self, source: Source) -> Any:
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
        is_large = source.kind in ("image", "point_cloud")
        subscribers.append(
            rospy.Subscriber(
                source.topic,
                TYPES[source.kind],
                lambda message: self._server.publish(source, message, latest.get("velocity")),
                buff_size=LARGE_BUFFER_BYTES if is_large else 65536,
                tcp_nodelay=True,
            )
        )
        return subscribers


def _make() -> Callable[[float], None]:
    settings = read_server(ros_node.read_parameters("sensor_server.yaml"))
    counters = Counters(rospy.logwarn)
    opened = open_socket(settings.bind_address, settings.port, settings.multicast_ttl)
    subscriptions = None

    def on_targets() -> None:
        subscriptions.update()

    server = SensorServer(settings, opened, counters, on_targets)
    subscriptions = Subscriptions(settings.sources, server)
    subscriptions.update()
    ros_node.start_diagnostics(rospy.get_name(), counters)
    peers = ", ".join(f"{peer.address}:{peer.port}" for peer in settings.destinations)
    here = "%s:%d" % opened.getsockname()
    rospy.loginfo("sensors leave %s for %s", here, peers or "whoever asks by SET_PORT")
    return server.receive


def main(name: str = "sensor_server_node") -> int:
    """Exit code of the node."""
    return ros_node.run(name, _make)
