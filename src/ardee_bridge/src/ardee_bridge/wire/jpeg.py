# SPDX-License-Identifier: MIT
"""Size of a JPEG picture, from its frame header (ITU-T T.81, annex B); what is compressed is not looked at."""
import struct
from typing import Tuple

from ardee_bridge.wire import codec

_SOI, _SOS, _EOI, _FILL = 0xD8, 0xDA, 0xD9, 0xFF
# Baseline, extended and progressive, Huffman coded; what decoders read.
_FRAMES = (0xC0, 0xC1, 0xC2)
_OTHER_FRAMES = (0xC3, 0xC5, 0xC6, 0xC7, 0xC9, 0xCA, 0xCB, 0xCD, 0xCE, 0xCF)
# Markers without a length: TEM, RST0 to RST7.
_BARE = (0x01, *range(0xD0, 0xD8))
_LENGTH, _FRAME = struct.Struct(">H"), struct.Struct(">HBHHB")
_COMPONENTS = (1, 3, 4)
# Before the frame header, fill bytes too; an embedded colour profile has 255 segments at most.
_MOST_STEPS = 1000


def size(data: codec.Buffer) -> Tuple[int, int]:
    """Width and height [pixels]; ValueError where the data do not begin as a JPEG file does."""
    if bytes(data[:2]) != bytes((_FILL, _SOI)):
        raise ValueError(f"{len(data)} bytes that are no JPEG file")
    at = 2
    try:
        for _ in range(_MOST_STEPS):
            if data[at] != _FILL:
                raise ValueError(f"JPEG data with byte {data[at]} at {at}, expected a marker")
            marker = data[at + 1]
            if marker == _FILL:
                at += 1
            elif marker in _BARE:
                at += 2
            elif marker in _FRAMES:
                return _size_of_frame(data, at + 2)
            elif marker in (0, _SOI, _SOS, _EOI, *_OTHER_FRAMES):
                raise ValueError(f"JPEG data with marker {marker:#x} at {at}, expected a frame")
            else:
                at += 2 + _segment_bytes(data, at + 2)
    except (IndexError, struct.error):
        raise ValueError(f"{len(data)} bytes of JPEG, expected a frame header in them") from None
    raise ValueError(f"JPEG data without a frame header in {_MOST_STEPS} segments")


def _segment_bytes(data: codec.Buffer, at: int) -> int:
    (length,) = _LENGTH.unpack_from(data, at)
    if length < _LENGTH.size:
        raise ValueError(f"a JPEG segment of {length} bytes at {at}, expected 2 or more")
    return length


def _size_of_frame(data: codec.Buffer, at: int) -> Tuple[int, int]:
    length, bits, height, width, components = _FRAME.unpack_from(data, at)
    if at + length > len(data):
        raise IndexError
    if components not in _COMPONENTS or length != _FRAME.size + 3 * components or bits != 8:
        found = f"{length} bytes, {components} components of {bits} bits"
        raise ValueError(f"a JPEG frame header of {found}, expected 1, 3 or 4 of 8 bits")
    if not width or not height:
        raise ValueError(f"a JPEG picture of {width}x{height} pixels")
    return width, height
