# SPDX-License-Identifier: MIT
"""Images that a camera compresses: sent as they came, chosen over raw ones, and none twice when that changes."""
import io

import pytest
from PIL import Image as Picture
from sensor_msgs.msg import CompressedImage, Image

from ardee_bridge import chunks, codec
from ardee_bridge.camera_topics import PATIENCE_S, REFRESH_S, CameraTopics
from ardee_bridge.counters import Counters
from ardee_bridge.pairing import Pairer
from ardee_bridge.reader import Watch
from ardee_bridge.sensor_server import SensorServer
from ardee_bridge.settings import read_server
from ardee_bridge.udp import PairLock, open_socket

DROPPED = "sensor messages that the wire cannot carry"


def jpeg_bytes(width=64, height=48):
    opened = io.BytesIO()
    Picture.new("RGB", (width, height), (200, 40, 90)).save(opened, "JPEG")
    return opened.getvalue()


def at(message, secs, nsecs=0):
    message.header.stamp.secs, message.header.stamp.nsecs = secs, nsecs
    return message


def compressed(secs, text="rgb8; jpeg compressed bgr8", data=None):
    return at(CompressedImage(format=text, data=jpeg_bytes() if data is None else data), secs)


def raw(secs):
    return at(Image(encoding="rgb8", width=8, height=6, step=24, data=bytes(144)), secs)


class Bench:
    """Two servers that share a lock, as processes do: one of compressed images, one of raw ones; and their target."""

    def __init__(self):
        self._target, self._socket = open_socket("127.0.0.1", 0), open_socket("127.0.0.1", 0)
        self._target.settimeout(5.0)
        sources = [dict(name="front", kind="image", topic="/front", component_id=3)]
        port = self._target.getsockname()[1]
        peers = [dict(address="127.0.0.1", port=port, data_types=["all"])]
        values = dict(bind_address="127.0.0.1", port=0, allowed_clients=[], max_clients=0)
        values.update(client_lease_s=1.0, multicast_ttl=0, realtime_priority=0)
        settings = read_server(dict(values, sources=sources, peers=peers))
        self.raw, self.said = settings.sources[0], []
        self.compressed = self.raw.of_camera()
        self.counters = Counters(self.said.append)
        lock = PairLock.make()
        self._servers = [
            SensorServer(
                settings._replace(sources=(source,)),
                self._socket,
                self.counters,
                lock=PairLock(lock.file, is_shared=True),
            )
            for source in (self.compressed, self.raw)
        ]

    def publish(self, message):
        is_compressed = isinstance(message, CompressedImage)
        source = self.compressed if is_compressed else self.raw
        self._servers[0 if is_compressed else 1].publish(source, message)
        return self.counters.done().get("sent front", 0)

    def next_frame(self):
        pairer, assembler, whole = Pairer(), chunks.Assembler(), None
        while whole is None:
            message = pairer.feed("s", self._target.recv(65535), 0.0)
            whole = message and assembler.feed(*message)
        return whole

    def close(self):
        self._target.close()
        self._socket.close()


@pytest.fixture
def bench():
    made = Bench()
    yield made
    made.close()


@pytest.mark.parametrize("text", ["rgb8; jpeg compressed bgr8", "jpeg", "mono8;jpg", "JPEG"])
def test_the_camera_s_bytes_are_sent(bench, text):
    data = jpeg_bytes(640, 480) + bytes(200_000)
    bench.publish(compressed(7, text, memoryview(data)))
    whole = bench.next_frame()
    assert whole.payload == data and whole.head.encoding == codec.ImageEncoding.JPEG
    assert (whole.head.width, whole.head.height, whole.head.step) == (640, 480, 0)
    assert (whole.head.chunk.sec, whole.head.chunk.nsec, whole.component_id) == (7, 0, 3)
    assert whole.head.chunk.count > 3


@pytest.mark.parametrize(
    "text, data, message",
    [
        ("mono16; png compressed ", b"\x89PNG", "of format 'mono16; png compressed ', expected"),
        ("", None, "of format '', expected jpeg"),
        ("jpegxl", None, "of format 'jpegxl'"),
        ("32FC1; compressedDepth png", None, "compressedDepth"),
        ("jpeg", b"", "0 bytes that are no JPEG file"),
        ("jpeg", b"\x89PNG\r\n", "no JPEG file"),
        ("jpeg", b"\xff\xd8\xff", "3 bytes of JPEG"),
    ],
)
def test_what_is_no_jpeg_is_dropped(bench, text, data, message):
    assert bench.publish(compressed(1, text, data)) == 0
    assert bench.counters.dropped() == {DROPPED: 1} and message in bench.said[0]
    assert bench.publish(compressed(2)) == 1


def test_an_image_in_both_forms_is_sent_once(bench):
    assert [bench.publish(raw(secs)) for secs in (1, 2)] == [1, 2]
    assert bench.publish(compressed(2)) == 2
    assert [bench.publish(compressed(secs)) for secs in (3, 4)] == [3, 4]
    assert bench.publish(raw(4)) == 4
    assert bench.publish(raw(5)) == 5
    assert bench.publish(compressed(5)) == 5


def test_images_of_one_form_may_have_the_same_stamp(bench):
    assert [bench.publish(compressed(9)) for _ in range(3)] == [1, 2, 3]
    assert [bench.publish(raw(9)) for _ in range(3)] == [3, 4, 5]


class Publishers:
    """In the reader's place: who publishes what, as the test says; and a clock."""

    def __init__(self):
        self.watches, self.now_s, self.refreshed = [], 0.0, []

    def watch_publishers(self, name, kind):
        self.watches.append(Watch(name, kind, len(self.watches)))
        return self.watches[-1]

    def refresh(self, watch):
        self.refreshed.append(watch)

    def end_watch(self, watch):
        self.watches.remove(watch)

    def publish(self, *topics):
        for watch in self.watches:
            watch.hear(["http://a:1"] if watch.name in topics else [])


@pytest.fixture
def publishers():
    return Publishers()


@pytest.fixture
def topics(bench, publishers):
    return CameraTopics([bench.raw], publishers, lambda: publishers.now_s)


def choice(topics):
    found = topics.choice({"front"})
    return "compressed" * bool(found.compressed) + "raw" * bool(found.raw)


def test_only_wanted_cameras_are_watched(topics, publishers):
    assert topics.choice(set()) == (frozenset(), frozenset()) and publishers.watches == []
    assert choice(topics) == ""
    names = {(watch.name, watch.kind) for watch in publishers.watches}
    compressed = ("/front/compressed", "sensor_msgs/CompressedImage")
    assert names == {compressed, ("/front", "sensor_msgs/Image")}
    topics.choice(set())
    assert publishers.watches == []


def test_compressed_images_are_preferred_and_raw_ones_taken_when_there_are_no_others(
    topics, publishers
):
    assert choice(topics) == ""
    publishers.publish("/front", "/front/compressed")
    assert choice(topics) == "compressed"
    publishers.publish("/front")
    assert choice(topics) == "compressed"
    publishers.now_s += PATIENCE_S
    assert choice(topics) == "raw"
    publishers.publish("/front", "/front/compressed")
    assert choice(topics) == "compressed"


def test_a_publisher_that_announces_raw_images_first(topics, publishers):
    choice(topics)
    publishers.publish("/front")
    assert choice(topics) == ""
    publishers.now_s += 0.9 * PATIENCE_S
    assert choice(topics) == ""
    publishers.publish("/front", "/front/compressed")
    publishers.now_s += PATIENCE_S
    assert choice(topics) == "compressed"


def test_a_publisher_that_goes_and_comes_back(topics, publishers):
    choice(topics)
    publishers.publish("/front/compressed", "/front")
    assert choice(topics) == "compressed"
    publishers.publish()
    publishers.now_s += 10 * PATIENCE_S
    assert choice(topics) == "compressed"
    publishers.publish("/front")
    assert choice(topics) == "compressed"


def test_the_master_is_asked_again_and_again(topics, publishers):
    for _ in range(3):
        publishers.now_s += 0.5 * REFRESH_S
        choice(topics)
    assert publishers.refreshed == publishers.watches
