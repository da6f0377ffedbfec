# SPDX-License-Identifier: MIT
"""The benchmark's messages: on a connection they are what genpy writes, and they know when it has written them."""
import io
import time
from typing import Any

import pytest
from sensor_msgs.msg import CompressedImage, Image, Imu

from ardee_bridge import latency_messages

IMU, IMAGE = (latency_messages.make(kind, f"/{kind}") for kind in ("imu", "image"))


class Buffer(io.BytesIO):
    """Knows when it was written to."""

    written_ns = 0

    def write(self, data: bytes) -> int:
        size = super().write(data)
        self.written_ns = time.time_ns()
        return size


@pytest.mark.parametrize(
    "message, kind",
    [(IMU, Imu), (IMAGE, Image), (latency_messages.compressed(IMAGE), CompressedImage)],
)
def test_the_time_is_that_of_the_bytes(message: Any, kind: Any) -> None:
    assert isinstance(message, kind)
    plain = kind(**{name: getattr(message, name) for name in kind.__slots__})
    found, expected = Buffer(), io.BytesIO()
    message.serialize(found)
    plain.serialize(expected)
    assert found.getvalue() == expected.getvalue()
    assert 0 < found.written_ns <= message.made_ns <= time.time_ns()
