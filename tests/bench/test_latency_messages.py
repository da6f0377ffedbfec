# SPDX-License-Identifier: MIT
"""Tests that the benchmark's messages are serialized as by genpy, and that their time begins before that."""
import io
import time
from typing import Any

import pytest
from bench import latency_messages, latency_sensors
from sensor_msgs.msg import CompressedImage, Image, PointCloud2

IMAGE, DEPTH = (latency_messages.make("image", topic) for topic in ("/camera", "/depth"))
CLOUD = latency_messages.make("point_cloud", "/points")


@pytest.mark.parametrize(
    "message, kind",
    [
        (IMAGE, Image),
        (DEPTH, Image),
        (latency_messages.compressed(IMAGE), CompressedImage),
        (CLOUD, PointCloud2),
    ],
)
def test_frames_are_written_as_genpy_does(message: Any, kind: Any) -> None:
    message.header.seq, message.header.frame_id = 7, "camera"
    plain = kind(**{name: getattr(message, name) for name in kind.__slots__})
    found, expected = io.BytesIO(b"abcd"), io.BytesIO(b"abcd")
    for buffer, each in ((found, message), (expected, plain)):
        buffer.seek(4)  # rospy reserves space for the length
        each.serialize(buffer)
    assert found.getvalue() == expected.getvalue() and found.tell() == expected.tell()
    assert isinstance(message, kind) and len(message.data) > 10_000


def test_a_message_is_published_when_rospy_is_asked_to() -> None:
    class Publisher:
        called_ns = 0

        def publish(self, message: Any) -> None:
            self.called_ns = time.time_ns()
            time.sleep(0.01)

    publisher, before_ns = Publisher(), time.time_ns()
    assert before_ns <= latency_sensors.publish_at(publisher, IMAGE) <= publisher.called_ns
