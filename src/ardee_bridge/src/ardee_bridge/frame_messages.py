# SPDX-License-Identifier: MIT
"""Images and point clouds of a connection's bytes, without a copy of their pixels and points.

The layout is ROS 1's (https://wiki.ros.org/ROS/Technical%20Overview, "Message serialization") of the definitions of
sensor_msgs 1.13: the fields in their order, little-endian, arrays and strings after their length as uint32. What is
made of it has the names of sensor_msgs, but only the fields that the bridge needs: a frame waits while they are read.
"""
import struct
from typing import NamedTuple, Tuple

_ONE, _TWO, _THREE = struct.Struct("<I"), struct.Struct("<II"), struct.Struct("<III")
_FLAG, _FLAG_ONE, _FLAG_TWO = struct.Struct("<B"), struct.Struct("<BI"), struct.Struct("<BII")
_FIELD = struct.Struct("<IB4x")  # of a PointField, after its name; without its count
_LEAST_FIELD_BYTES = 4 + _FIELD.size


class Stamp(NamedTuple):
    """genpy.Time."""

    secs: int
    nsecs: int


class Header(NamedTuple):
    """std_msgs/Header."""

    stamp: Stamp


class Image(NamedTuple):
    """sensor_msgs/Image."""

    header: Header
    height: int
    width: int
    encoding: str
    is_bigendian: int
    step: int
    data: memoryview


class CompressedImage(NamedTuple):
    """sensor_msgs/CompressedImage."""

    header: Header
    format: str
    data: memoryview


class PointField(NamedTuple):
    """sensor_msgs/PointField."""

    name: str
    offset: int
    datatype: int


class PointCloud2(NamedTuple):
    """sensor_msgs/PointCloud2."""

    header: Header
    height: int
    width: int
    fields: Tuple[PointField, ...]
    is_bigendian: int
    point_step: int
    row_step: int
    data: memoryview


class _Cursor:
    """Reads one field after another; ValueError beyond the end."""

    def __init__(self, data: memoryview) -> None:
        self._data, self._at = data, 0

    def _pass(self, size: int) -> int:
        """Where a block of this size begins; the cursor is moved to its end."""
        begin, self._at = self._at, self._at + size
        if self._at > len(self._data):
            raise ValueError(f"{len(self._data)} bytes, expected {self._at} or more")
        return begin

    def numbers(self, kind: struct.Struct) -> Tuple[int, ...]:
        """As many as the struct has."""
        return kind.unpack_from(self._data, self._pass(kind.size))

    def array(self) -> memoryview:
        """Bytes after their number."""
        (size,) = self.numbers(_ONE)
        begin = self._pass(size)
        return self._data[begin : self._at]

    def text(self) -> str:
        return str(self.array(), "utf-8", "replace")

    def header(self) -> Header:
        _, secs, nsecs = self.numbers(_THREE)
        self.array()  # frame_id
        return Header(Stamp(secs, nsecs))


def image(data: memoryview) -> Image:
    """Its `data` shows these bytes and is no copy of them."""
    cursor = _Cursor(data)
    header, (height, width) = cursor.header(), cursor.numbers(_TWO)
    encoding, (is_bigendian, step) = cursor.text(), cursor.numbers(_FLAG_ONE)
    return Image(header, height, width, encoding, is_bigendian, step, cursor.array())


def compressed_image(data: memoryview) -> CompressedImage:
    """Its `data` shows these bytes and is no copy of them."""
    cursor = _Cursor(data)
    return CompressedImage(cursor.header(), cursor.text(), cursor.array())


def point_cloud(data: memoryview) -> PointCloud2:
    """Its `data` shows these bytes and is no copy of them."""
    cursor = _Cursor(data)
    header, (height, width, count) = cursor.header(), cursor.numbers(_THREE)
    if count * _LEAST_FIELD_BYTES > len(data):
        raise ValueError(f"{len(data)} bytes, expected {count} fields")
    fields = tuple(PointField(cursor.text(), *cursor.numbers(_FIELD)) for _ in range(count))
    is_bigendian, point_step, row_step = cursor.numbers(_FLAG_TWO)
    points = cursor.array()
    cursor.numbers(_FLAG)  # is_dense
    return PointCloud2(header, height, width, fields, is_bigendian, point_step, row_step, points)
