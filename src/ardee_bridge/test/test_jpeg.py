# SPDX-License-Identifier: MIT
"""Tests sizes of JPEG files that a camera compressed; and bytes that are not a JPEG file."""
import io
import random
import time

import pytest
from PIL import Image
from sensor_msgs.msg import CompressedImage

from ardee_bridge.nodes import convert

SOI = b"\xff\xd8"


def file_of(width, height, mode="RGB", **options):
    opened = io.BytesIO()
    Image.new(mode, (width, height), 99).save(opened, "JPEG", **options)
    return opened.getvalue()


def size(data):
    head = convert.compressed_image(CompressedImage(format="jpeg", data=bytes(data))).head
    return head.width, head.height


@pytest.mark.parametrize("width, height", [(1, 1), (640, 480), (37, 65500), (65500, 8)])
@pytest.mark.parametrize("options", [{}, {"progressive": True}, {"mode": "L"}, {"mode": "CMYK"}])
def test_as_it_was_written(width, height, options):
    assert size(file_of(width, height, **options)) == (width, height)


def test_a_thumbnail_before_the_frame_is_not_the_picture():
    exif = b"Exif\0\0" + file_of(160, 120)
    thumbnail = b"\xff\xe1" + (len(exif) + 2).to_bytes(2, "big") + exif
    assert size(SOI + 9 * thumbnail + file_of(640, 480)[2:]) == (640, 480)


@pytest.mark.parametrize("end", [0, 1, 2, 20, 100])
def test_a_header_that_ends_early_is_refused(end):
    with pytest.raises(convert.ConvertError, match=f"^{end} bytes that are no JPEG file"):
        size(file_of(640, 480)[:end])


@pytest.mark.parametrize("filling", [b"\xff", b"\xff\x01", b"\xff\xe0\x00\x02"])
def test_a_long_run_of_nothing_is_given_up_soon(filling):
    begin = time.monotonic()
    with pytest.raises(convert.ConvertError, match="no JPEG file"):
        size(SOI + filling * 4_000_000)
    assert time.monotonic() - begin < 5.0


def test_any_bytes_have_a_size_or_none():
    rng, refused = random.Random(1), 0
    whole = bytearray(file_of(64, 48))
    for _ in range(2000):
        data = bytearray(whole)
        for _ in range(rng.randrange(1, 4)):
            data[rng.randrange(160)] = rng.choice((0, 1, 0x7F, 0xC0, 0xFF))
        try:
            width, height = size(data)
            assert 0 < width < 65536 and 0 < height < 65536
        except convert.ConvertError:
            refused += 1
    assert 20 < refused < 1900
