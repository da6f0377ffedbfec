# SPDX-License-Identifier: MIT
"""Images and point clouds of a connection's bytes, without a copy of their pixels and points.

The layout is ROS 1's (https://wiki.ros.org/ROS/Technical%20Overview, "Message serialization") of the definitions of
sensor_msgs 1.13: the fields in their order, little-endian, arrays and strings after their length as uint32.
"""
import struct
from typing import Any

from sensor_msgs.msg import CompressedImage, Image, PointCloud2, PointField

_U8, _U32 = struct.Struct("<B"), struct.Struct("<I")
_LEAST_FIELD_BYTES = 4 + 4 + 1 + 4  # an empty name, offset, datatype, count


class _Cursor:
    """Reads one field after another; ValueError beyond the end."""

    def __init__(self, data: memoryview) -> None:
        self._data, self._at = data, 0

    def _number(self, kind: struct.Struct) -> int:
        (value,) = kind.unpack(self.block(kind.size))
        return value

    def u8(self) -> int:
        return self._number(_U8)

    def u32(self) -> int:
        return self._number(_U32)

    def block(self, size: int) -> memoryview:
        """So many bytes."""
        self._at += size
        if self._at > len(self._data):
            raise ValueError(f"{len(self._data)} bytes, expected {self._at} or more")
        return self._data[self._at - size : self._at]

    def array(self) -> memoryview:
        """Bytes after their number."""
        return self.block(self.u32())

    def text(self) -> str:
        return str(self.array(), "utf-8", "replace")

    def header(self, message: Any) -> None:
        """std_msgs/Header."""
        message.header.seq = self.u32()
        message.header.stamp.secs, message.header.stamp.nsecs = self.u32(), self.u32()
        message.header.frame_id = self.text()


def image(data: memoryview) -> Image:
    """sensor_msgs/Image; its data is a part of the bytes."""
    message, cursor = Image(), _Cursor(data)
    cursor.header(message)
    message.height, message.width = cursor.u32(), cursor.u32()
    message.encoding = cursor.text()
    message.is_bigendian = cursor.u8()
    message.step = cursor.u32()
    message.data = cursor.array()
    return message


def compressed_image(data: memoryview) -> CompressedImage:
    """sensor_msgs/CompressedImage; its data is a part of the bytes."""
    message, cursor = CompressedImage(), _Cursor(data)
    cursor.header(message)
    message.format = cursor.text()
    message.data = cursor.array()
    return message


def point_cloud(data: memoryview) -> PointCloud2:
    """sensor_msgs/PointCloud2; its data is a part of the bytes."""
    message, cursor = PointCloud2(), _Cursor(data)
    cursor.header(message)
    message.height, message.width = cursor.u32(), cursor.u32()
    count = cursor.u32()
    if count * _LEAST_FIELD_BYTES > len(data):
        raise ValueError(f"{len(data)} bytes, expected {count} fields")
    message.fields = [
        PointField(cursor.text(), cursor.u32(), cursor.u8(), cursor.u32()) for _ in range(count)
    ]
    message.is_bigendian = bool(cursor.u8())
    message.point_step, message.row_step = cursor.u32(), cursor.u32()
    message.data = cursor.array()
    message.is_dense = bool(cursor.u8())
    return message
