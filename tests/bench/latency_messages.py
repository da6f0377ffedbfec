# SPDX-License-Identifier: MIT
"""Makes messages of full size for the benchmark, numbered in a field that survives the wire."""
import io
from typing import Any, BinaryIO, Callable, Dict

from sensor_msgs.msg import (
    CompressedImage,
    Image,
    Imu,
    LaserScan,
    NavSatFix,
    PointCloud2,
    PointField,
)

from ardee_bridge.nodes import convert
from ardee_bridge.wire.codec import LIDAR_SLOTS
from ardee_msgs.msg import Battery, Encoder

WIDTH, HEIGHT = 640, 480
JPEG_QUALITY = 80
# A revolution of a lidar of 16 rings and 1800 columns.
CLOUD_POINTS = 28_800
POINT_FLOAT32 = 7


class _Direct:
    """Message whose `data` go into the publisher's buffer without a copy; genpy would copy a frame once more."""

    AFTER_DATA = 0  # bytes of its fields after `data`

    def serialize(self, buff: BinaryIO) -> None:
        """Serializes as genpy does, which is used for all fields but `data`."""
        data, self.data = self.data, b""
        try:
            super().serialize(buff)
        finally:
            self.data = data
        buff.seek(-4 - self.AFTER_DATA, io.SEEK_CUR)
        rest = buff.read()[4:]
        buff.seek(-4 - self.AFTER_DATA, io.SEEK_CUR)
        buff.write(len(data).to_bytes(4, "little"))
        buff.write(data)
        buff.write(rest)


class _Image(_Direct, Image):
    pass


class _CompressedImage(_Direct, CompressedImage):
    pass


class _PointCloud2(_Direct, PointCloud2):
    AFTER_DATA = 1


def _scan() -> LaserScan:
    scan = LaserScan(angle_min=-2.356, angle_max=2.356, angle_increment=4.712 / 1080)
    scan.range_min, scan.range_max = 0.06, 10.0
    scan.ranges = [0.5 + 0.009 * beam for beam in range(LIDAR_SLOTS)]
    scan.intensities = [float(beam % 256) for beam in range(LIDAR_SLOTS)]
    return scan


def _image(encoding: str, pixel_bytes: int) -> Image:
    image = _Image(encoding=encoding, width=WIDTH, height=HEIGHT, step=WIDTH * pixel_bytes)
    row = bytes((7 * x + x * x // 50) % 256 for x in range(image.step))
    image.data = b"".join(row[y:] + row[:y] for y in range(HEIGHT))
    return image


def _cloud() -> PointCloud2:
    cloud = _PointCloud2(width=CLOUD_POINTS, height=1, point_step=16, row_step=16 * CLOUD_POINTS)
    names = ("x", "y", "z", "intensity")
    cloud.fields = [PointField(name, 4 * i, POINT_FLOAT32, 1) for i, name in enumerate(names)]
    cloud.data = b"\x00\x00\x80\x3f" * (4 * CLOUD_POINTS)
    return cloud


_MAKERS: Dict[str, Callable[[], Any]] = {
    "imu": Imu,
    "gps": NavSatFix,
    "lidar": _scan,
    "encoder": Encoder,
    "battery": Battery,
    "point_cloud": _cloud,
}


def make(kind: str, topic: str) -> Any:
    """Makes a message of this kind of sensor; an image on a topic named depth is a depth image."""
    if kind == "image":
        return _image("32FC1", 4) if topic.endswith("depth") else _image("rgb8", 3)
    return _MAKERS[kind]()


def compressed(image: Image) -> CompressedImage:
    """Makes the same image as JPEG, as a camera's driver publishes it beside the raw one."""
    frame = convert.image(image, "jpeg", JPEG_QUALITY)
    return _CompressedImage(format="jpeg", data=frame.payload)


def number(kind: str, message: Any, serial: int) -> None:
    """Writes the running number where latency.serial_of() finds it; the sensor server numbers frames itself."""
    if kind == "imu":
        message.linear_acceleration.x = serial * 1e-6
    elif kind == "gps":
        message.altitude = serial * 1e-3
    elif kind == "lidar":
        message.scan_time = serial * 1e-6
    elif kind == "battery":
        message.vmin = serial * 1e-3
    elif kind == "encoder":
        message.id = serial
