# SPDX-License-Identifier: MIT
"""Tests malformed messages of publishers: each is sent or counted as dropped, and no error leaves the server."""
import random

import pytest
from sensor_msgs.msg import Image, Imu, PointCloud2, PointField

from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.sensor_server import SensorServer
from ardee_bridge.nodes.settings import ServerSettings
from ardee_bridge.wire import chunks, codec
from ardee_bridge.wire.udp import open_socket
from ardee_common.config import from_values

DROPPED = "sensor messages that the wire cannot carry"
SIZES = (0, 1, 2, 3, 12, 16, 255, 65500, 65501, 2**31 - 1, 2**31, 2**32 - 1)
ENCODINGS = ("rgb8", "mono8", "32FC1", "bayer_rggb8", "", "\u2603")


class Bench:
    """Server whose only target wants everything, time stamps too."""

    def __init__(self):
        self.said = []
        self._target, self._socket = open_socket("127.0.0.1", 0), open_socket("127.0.0.1", 0)
        sources = [dict(name="imu", kind="imu", topic="imu")]
        sources += [dict(name="raw", kind="image", topic="raw", format="raw")]
        sources += [dict(name="jpeg", kind="image", topic="jpeg", component_id=1)]
        sources += [dict(name="cloud", kind="point_cloud", topic="cloud")]
        port = self._target.getsockname()[1]
        peers = [dict(address="127.0.0.1", port=port, data_types=["all", "time"])]
        values = dict(bind_address="127.0.0.1", port=0, allowed_clients=[], max_clients=0)
        values.update(client_lease_s=1.0, multicast_ttl=0)
        settings = from_values(ServerSettings, dict(values, sources=sources, peers=peers))
        self._sources = {source.name: source for source in settings.sources}
        self.counters = Counters(self.said.append)
        self._server = SensorServer(settings, self._socket, self.counters)

    def publish(self, name, message):
        """Returns True if the message was sent, False if it was dropped."""
        before = self.counters.dropped().get(DROPPED, 0), self.counters.done()
        self._server.publish(self._sources[name], message)
        dropped = self.counters.dropped().get(DROPPED, 0) - before[0]
        sent = self.counters.done().get(f"sent {name}", 0) - before[1].get(f"sent {name}", 0)
        assert sent + dropped == 1
        return bool(sent)

    def close(self):
        self._target.close()
        self._socket.close()


@pytest.mark.parametrize(
    "secs, nsecs", [(2**31, 0), (2**32 - 1, 0), (1, 10**9), (1, 2**32 - 1)]
)
def test_a_time_that_the_wire_cannot_carry(bench, secs, nsecs):
    message = Imu()
    message.header.stamp.secs, message.header.stamp.nsecs = secs, nsecs
    assert not bench.publish("imu", message)
    assert f"a time stamp of {secs} s and {nsecs} ns, expected at most" in bench.said[0]
    assert bench.publish("imu", Imu())


@pytest.mark.parametrize("width, height", [(65501, 1), (1, 65501), (0, 1)])
def test_an_image_that_jpeg_cannot_hold(bench, width, height):
    step = max(1, width)
    message = Image(width=width, height=height, step=step, encoding="mono8")
    message.data = bytes(step * height)
    assert not bench.publish("jpeg", message)
    assert "expected 1 to 65500 pixels a side" in bench.said[0]


def test_a_cloud_that_receivers_refuse(bench):
    count = chunks.MAX_TOTAL // codec.Point.size + 1
    message = PointCloud2(width=count, height=1, point_step=1, row_step=count, data=bytes(count))
    message.fields = [PointField(name, 0, PointField.UINT8, 1) for name in "xyz"]
    assert not bench.publish("cloud", message)
    assert f"{count} points, expected at most {count - 1}" in bench.said[0]


def stamped(rng, message):
    message.header.stamp.secs, message.header.stamp.nsecs = rng.choice(SIZES), rng.choice(SIZES)
    return message


def an_image(rng):
    message = Image(encoding=rng.choice(ENCODINGS), is_bigendian=rng.choice((0, 1, 255)))
    message.width, message.height = rng.choice(SIZES), rng.choice(SIZES)
    message.step = rng.choice(SIZES + (message.width, 3 * message.width))
    size = message.step * message.height
    message.data = bytes(size if size < 1e5 else rng.randrange(1000))
    return message


def a_cloud(rng):
    message = PointCloud2(is_bigendian=rng.random() < 0.5, width=rng.choice(SIZES))
    message.height, message.point_step = rng.choice(SIZES), rng.choice(SIZES)
    message.row_step = rng.choice(SIZES + (message.width * message.point_step,))
    names = rng.choice((("x", "y", "z"), ("x", "y", "z", "intensity"), ("x", "x", "", "z")))
    message.fields = [
        PointField(name, rng.choice((0, 0, 4, 8, 2**31)), rng.randrange(10), 1) for name in names
    ]
    size = message.row_step * message.height
    message.data = rng.randbytes(size if size < 1e5 else rng.randrange(1000))
    return message


@pytest.mark.parametrize("name, make", [("raw", an_image), ("jpeg", an_image), ("cloud", a_cloud)])
def test_any_fields_are_sent_or_dropped(bench, name, make):
    rng = random.Random(1)
    sent = sum(bench.publish(name, stamped(rng, make(rng))) for _ in range(2000))
    assert 5 < sent < 1000
