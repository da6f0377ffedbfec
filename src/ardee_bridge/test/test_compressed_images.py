# SPDX-License-Identifier: MIT
"""Tests images that a camera compresses: unchanged, preferred to raw ones, and none sent twice at a change."""
import io

import pytest
from PIL import Image as Picture
from sensor_msgs.msg import CompressedImage, Image

from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.sensor_server import SensorServer
from ardee_bridge.nodes.settings import ServerSettings
from ardee_bridge.nodes.subscriptions import PATIENCE_S, CameraTopics
from ardee_bridge.wire import chunks, codec
from ardee_bridge.wire.pairing import Pairer
from ardee_bridge.wire.udp import open_socket
from ardee_common.config import from_values

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
    """Server of a camera, and its target."""

    def __init__(self):
        self._target, self._socket = open_socket("127.0.0.1", 0), open_socket("127.0.0.1", 0)
        self._target.settimeout(5.0)
        sources = [dict(name="front", kind="image", topic="/front", component_id=3)]
        port = self._target.getsockname()[1]
        peers = [dict(address="127.0.0.1", port=port, data_types=["all"])]
        values = dict(bind_address="127.0.0.1", port=0, allowed_clients=[], max_clients=0)
        values.update(client_lease_s=1.0, multicast_ttl=0)
        settings = from_values(ServerSettings, dict(values, sources=sources, peers=peers))
        self.raw, self.said = settings.sources[0], []
        self.compressed = self.raw.of_camera()
        self.counters = Counters(self.said.append)
        self._server = SensorServer(settings, self._socket, self.counters)

    def publish(self, message):
        is_compressed = isinstance(message, CompressedImage)
        self._server.publish(self.compressed if is_compressed else self.raw, message)
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
        ("jpeg", b"\xff\xd8\xff", "3 bytes that are no JPEG file"),
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
    """Published topics as the test sets them, and the choice among them; with a clock."""

    def __init__(self, camera):
        self.now_s, self.published, self._camera = 0.0, set(), camera
        self._topics = CameraTopics(lambda: self.now_s)

    def publish(self, *topics):
        kinds = {"/front": Image._type, "/front/compressed": CompressedImage._type}
        self.published = {(topic, kinds[topic]) for topic in topics}

    def choice(self):
        found = {source.topic for source in self._topics.choose([self._camera], self.published)}
        return {"/front/compressed": "compressed", "/front": "raw"}[found.pop()] if found else ""

    def nobody_wants_it(self):
        return self._topics.choose([], self.published)


@pytest.fixture
def publishers(bench):
    return Publishers(bench.raw)


def test_only_wanted_cameras_are_chosen_and_each_anew(publishers):
    publishers.publish("/front", "/front/compressed")
    assert publishers.nobody_wants_it() == []
    assert publishers.choice() == "compressed"
    assert publishers.nobody_wants_it() == []
    publishers.publish()
    assert publishers.choice() == ""


def test_a_topic_of_another_type_is_no_camera_s(publishers):
    publishers.published = {("/front/compressed", "std_msgs/String")}
    assert publishers.choice() == ""


def test_compressed_images_are_preferred_and_raw_ones_taken_when_there_are_no_others(publishers):
    assert publishers.choice() == ""
    publishers.publish("/front", "/front/compressed")
    assert publishers.choice() == "compressed"
    publishers.publish("/front")
    assert publishers.choice() == "compressed"
    publishers.now_s += PATIENCE_S
    assert publishers.choice() == "raw"
    publishers.publish("/front", "/front/compressed")
    assert publishers.choice() == "compressed"


def test_a_publisher_that_announces_raw_images_first(publishers):
    publishers.publish("/front")
    assert publishers.choice() == ""
    publishers.now_s += 0.9 * PATIENCE_S
    assert publishers.choice() == ""
    publishers.publish("/front", "/front/compressed")
    publishers.now_s += PATIENCE_S
    assert publishers.choice() == "compressed"


def test_a_publisher_that_goes_and_comes_back(publishers):
    publishers.publish("/front/compressed", "/front")
    assert publishers.choice() == "compressed"
    publishers.publish()
    publishers.now_s += 10 * PATIENCE_S
    assert publishers.choice() == "compressed"
    publishers.publish("/front")
    assert publishers.choice() == "compressed"
