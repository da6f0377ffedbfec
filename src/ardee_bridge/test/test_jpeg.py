# SPDX-License-Identifier: MIT
"""Sizes of JPEG files from their headers, as PIL has them; and bytes that are no JPEG file."""
import io
import random
import struct
import time

import pytest
from PIL import Image

from ardee_bridge.wire import jpeg


def file_of(width, height, mode="RGB", **options):
    opened = io.BytesIO()
    Image.new(mode, (width, height), 99).save(opened, "JPEG", **options)
    return opened.getvalue()


def segment(marker, data):
    return struct.pack(">BBH", 0xFF, marker, len(data) + 2) + data


def frame(width=640, height=480, bits=8, components=3, marker=0xC0):
    head = struct.pack(">BHHB", bits, height, width, components)
    return segment(marker, head + bytes(3 * components))


SOI = b"\xff\xd8"


@pytest.mark.parametrize("width, height", [(1, 1), (640, 480), (37, 65500), (65500, 8)])
@pytest.mark.parametrize("options", [{}, {"progressive": True}, {"mode": "L"}, {"mode": "CMYK"}])
def test_as_pil_wrote_it(width, height, options):
    assert jpeg.size(memoryview(file_of(width, height, **options))) == (width, height)


def test_thumbnails_fill_bytes_and_bare_markers_before_the_frame():
    thumbnail = segment(0xE1, b"Exif\0\0" + file_of(160, 120))
    for before in (
        thumbnail,
        b"\xff\xff\xff\xfe\x00\x04hi",
        b"\xff\x01",
        b"\xff\xd0",
        thumbnail * 99,
    ):
        assert jpeg.size(SOI + before + frame()) == (640, 480)


def test_a_header_that_ends_early_is_refused():
    whole = SOI + segment(0xE0, b"JFIF\0") + frame()
    assert jpeg.size(whole) == (640, 480)
    for size in range(len(whole)):
        with pytest.raises(ValueError, match="bytes"):
            jpeg.size(whole[:size])


@pytest.mark.parametrize(
    "data, message",
    [
        (b"\x89PNG\r\n", "6 bytes that are no JPEG file"),
        (SOI + b"\x00\x00", "with byte 0 at 2, expected a marker"),
        (SOI + segment(0xDA, b"") + frame(), "marker 0xda at 2, expected a frame"),
        (SOI + b"\xff\xd9", "marker 0xd9 at 2"),
        (SOI + b"\xff\xd8" + frame(), "marker 0xd8 at 2"),
        (SOI + frame(marker=0xC3), "marker 0xc3 at 2"),
        (SOI + b"\xff\xe0\x00\x01" + frame(), "a JPEG segment of 1 bytes at 4"),
        (SOI + frame(height=0), "a JPEG picture of 640x0 pixels"),
        (SOI + frame(width=0), "a JPEG picture of 0x480 pixels"),
        (SOI + frame(bits=12), "3 components of 12 bits, expected 1, 3 or 4 of 8 bits"),
        (SOI + frame(components=2), "2 components of 8 bits"),
        (SOI + frame()[:3] + b"\x20" + frame()[4:] + bytes(99), "header of 32 bytes"),
    ],
)
def test_what_is_no_jpeg_file(data, message):
    with pytest.raises(ValueError, match=message):
        jpeg.size(data)


def test_a_long_run_of_nothing_is_given_up_soon():
    begin = time.monotonic()
    for filling in (b"\xff", b"\xff\x01", b"\xff\xe0\x00\x02"):
        with pytest.raises(ValueError, match="without a frame header in 1000 segments"):
            jpeg.size(SOI + filling * 4_000_000)
    assert time.monotonic() - begin < 5.0


def test_any_bytes_have_a_size_or_none():
    rng, refused = random.Random(1), 0
    whole = bytearray(file_of(64, 48))
    for _ in range(3000):
        data = bytearray(whole)
        for _ in range(rng.randrange(1, 4)):
            data[rng.randrange(160)] = rng.choice((0, 1, 0x7F, 0xC0, 0xFF))
        try:
            width, height = jpeg.size(data)
            assert 0 < width < 65536 and 0 < height < 65536
        except ValueError as error:
            assert "JPEG" in str(error)
            refused += 1
    assert 100 < refused < 2900
