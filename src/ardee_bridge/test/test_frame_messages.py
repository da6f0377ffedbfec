# SPDX-License-Identifier: MIT
"""Images and clouds of their bytes, against what genpy makes of the same; and bytes that are none."""
import io
import random

import pytest
from sensor_msgs.msg import CompressedImage, Image, PointCloud2, PointField

from ardee_bridge import frame_messages


def serialized(message):
    file = io.BytesIO()
    message.serialize(file)
    return bytearray(file.getvalue())


def header(message, rng):
    message.header.seq, message.header.frame_id = rng.getrandbits(32), "Kamera vörn"
    message.header.stamp.secs, message.header.stamp.nsecs = rng.getrandbits(32), 999_999_999


def an_image(rng):
    message = Image(encoding="rgb8", height=rng.randrange(9), width=7, is_bigendian=1, step=21)
    header(message, rng)
    message.data = rng.randbytes(message.step * message.height)
    return message


def a_cloud(rng):
    message = PointCloud2(height=2, width=rng.randrange(9), point_step=16, is_bigendian=True)
    header(message, rng)
    message.row_step, message.is_dense = 16 * message.width, rng.random() < 0.5
    names = ("x", "y", "z", "", "intensity")[: rng.randrange(6)]
    message.fields = [PointField(name, rng.getrandbits(32), 7, 1) for name in names]
    message.data = rng.randbytes(2 * message.row_step)
    return message


def a_compressed_image(rng):
    message = CompressedImage(format="bgr8; jpeg compressed bgr8")
    header(message, rng)
    message.data = rng.randbytes(rng.randrange(99))
    return message


def assert_same(found, sent):
    """All that was read, by the names of the message; and that is all but these."""
    if not hasattr(found, "_fields"):
        assert found == sent
        return
    assert set(sent.__slots__) - set(found._fields) <= {"seq", "frame_id", "is_dense", "count"}
    for name in found._fields:
        mine, genpys = getattr(found, name), getattr(sent, name)
        are_many = name == "fields"
        assert not are_many or len(mine) == len(genpys)
        for each in zip(mine, genpys) if are_many else [(mine, genpys)]:
            assert_same(*each)


KINDS = [(an_image, frame_messages.image), (a_cloud, frame_messages.point_cloud)]
KINDS += [(a_compressed_image, frame_messages.compressed_image)]


@pytest.mark.parametrize("make, read", KINDS)
def test_as_genpy_reads_them(make, read):
    rng = random.Random(1)
    for _ in range(50):
        sent = make(rng)
        found = read(memoryview(serialized(sent)))
        assert_same(found, sent)


@pytest.mark.parametrize("make, read", KINDS)
def test_pixels_and_points_are_not_copied(make, read):
    rng, sent = random.Random(2), Image()
    while not sent.data:
        sent = make(rng)
    data = serialized(sent)
    found = read(memoryview(data))
    at = data.index(sent.data)
    data[at] ^= 0xFF
    assert found.data[0] == sent.data[0] ^ 0xFF


@pytest.mark.parametrize("make, read", KINDS)
def test_bytes_that_end_early_are_refused(make, read):
    data = memoryview(serialized(make(random.Random(3))))
    for size in range(len(data)):
        with pytest.raises(ValueError, match="bytes, expected"):
            read(data[:size])


@pytest.mark.parametrize("make, read", KINDS)
def test_any_bytes_are_read_or_refused(make, read):
    rng, refused = random.Random(4), 0
    for _ in range(3000):
        data = serialized(make(rng))
        for _ in range(rng.randrange(1, 4)):
            data[rng.randrange(len(data))] = rng.choice((0, 1, 0x7F, 0xFF))
        try:
            assert len(read(memoryview(data)).data) <= len(data)
        except ValueError as error:
            assert "bytes, expected" in str(error)
            refused += 1
    assert 100 < refused < 2900
