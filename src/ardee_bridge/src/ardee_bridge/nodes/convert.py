# SPDX-License-Identifier: MIT
"""Converts ROS messages to data structs of the wire; reads only their fields, without rospy."""
import io
import math
import re
from typing import Any, Callable, Dict, NamedTuple, Optional, Type

import numpy as np
from PIL import Image

from ardee_bridge.wire import codec
from ardee_bridge.wire.c_struct import INT32, NO_VALUE, CStruct, S, Scalar
from ardee_bridge.wire.chunks import MAX_TOTAL

Vector = codec.Xyz


class ConvertError(ValueError):
    """A message that the wire cannot carry: what was found, what was expected."""


class Reading(NamedTuple):
    """Data datagram of a measurement, and how many values it has (None: one)."""

    data: bytes
    count: Optional[int] = None


class Frame(NamedTuple):
    """An image or cloud, to be cut into chunks; the payload may be the message's own bytes."""

    head: Any
    payload: codec.Buffer


def _copied(message: Any, kind: Type[S], **others: Any) -> S:
    """Returns a struct of the message's values that its scalar fields name, and of the others."""
    names = [
        name for name, field in kind.FIELDS if isinstance(field, Scalar) and name not in others
    ]
    return kind(**{name: getattr(message, name) for name in names}, **others)


def _reading(data: CStruct) -> Reading:
    return Reading(data.to_raw().pack())


def _diagonal(matrix: Any) -> Vector:
    return Vector(x=matrix[0], y=matrix[4], z=matrix[8])


def _motion(v: Any, covariance: Any) -> codec.MotionData:
    return _copied(v, codec.MotionData, covariance=_diagonal(covariance))


def _orientation(message: Any) -> codec.OrientationData:
    c = message.orientation_covariance
    covariance = codec.Euler(roll=c[0], pitch=c[4], yaw=c[8])
    return _copied(message.orientation, codec.OrientationData, covariance=covariance)


def imu(message: Any) -> Reading:
    """Converts a sensor_msgs/Imu with all its fields."""
    data = codec.IMUData(
        accel=_motion(message.linear_acceleration, message.linear_acceleration_covariance),
        gyro=_motion(message.angular_velocity, message.angular_velocity_covariance),
        orientation=_orientation(message),
    )
    return _reading(data)


def gyro(message: Any) -> Reading:
    """Converts the angular velocity of a sensor_msgs/Imu."""
    return _reading(_copied(message.angular_velocity, codec.GyroData))


def acceleration(message: Any) -> Reading:
    """Converts the specific force of a sensor_msgs/Imu."""
    return _reading(_copied(message.linear_acceleration, codec.AccelerationData))


def orientation(message: Any) -> Reading:
    """Converts the orientation of a sensor_msgs/Imu."""
    return _reading(_orientation(message))


def gps(message: Any, velocity: Any = None) -> Reading:
    """Converts a sensor_msgs/NavSatFix, with the latest geometry_msgs/Vector3 of velocity [m/s] if there is one.

    Without a fix, position and velocity have no value.
    """
    has_fix = message.status.status >= 0
    nothing = Vector(x=math.nan, y=math.nan, z=math.nan)
    stamp_ms = message.header.stamp.secs * 1000 + message.header.stamp.nsecs // 1_000_000
    data = codec.GPSData(
        latitude=message.latitude if has_fix else math.nan,
        longitude=message.longitude if has_fix else math.nan,
        altitude=message.altitude if has_fix else math.nan,
        velocity=_copied(velocity, Vector) if has_fix and velocity is not None else nothing,
        covariance=_diagonal(message.position_covariance),
        covariance_type=message.position_covariance_type,
        service=message.status.service,
        status=message.status.status,
    ).to_raw()
    data.time = stamp_ms & 0x7FFFFFFF
    return Reading(data.pack())


def lidar(message: Any) -> Reading:
    """Converts a sensor_msgs/LaserScan of at most 1081 beams."""
    count = len(message.ranges)
    if count > codec.LIDAR_SLOTS:
        raise ConvertError(f"a scan of {count} beams, expected at most {codec.LIDAR_SLOTS}")
    steps = dict(dAngle=message.angle_increment, dTime=message.time_increment)
    intensities = message.intensities[:count]
    raw = _copied(message, codec.LidarData, intensities=intensities, **steps).to_raw()
    raw.ranges = codec.range_counts(message.ranges, message.range_min, message.range_max)
    return Reading(raw.pack(), count)


def encoder(message: Any) -> Reading:
    """Converts an ardee_msgs/Encoder."""
    return _reading(_copied(message, codec.EncoderData))


def battery(message: Any) -> Reading:
    """Converts an ardee_msgs/Battery."""
    return _reading(_copied(message, codec.BatteryData))


# Kind of sensor -> converter; gps() also takes a velocity.
SINGLES: Dict[str, Callable[..., Reading]] = {
    each.__name__: each
    for each in (imu, gyro, acceleration, orientation, gps, lidar, encoder, battery)
}

# ROS encoding -> encoding on the wire, bytes a pixel, PIL's names of the mode and of the order of its bytes
_ENCODINGS = {
    "rgb8": (codec.ImageEncoding.RGB8, 3, "RGB", "RGB"),
    "bgr8": (codec.ImageEncoding.BGR8, 3, "RGB", "BGR"),
    "mono8": (codec.ImageEncoding.MONO8, 1, "L", "L"),
    "8UC1": (codec.ImageEncoding.MONO8, 1, "L", "L"),
    "16UC1": (codec.ImageEncoding.DEPTH_16U_MM, 2, "", ""),
    "32FC1": (codec.ImageEncoding.DEPTH_32F_M, 4, "", ""),
}
# A side of a JPEG picture: libjpeg's JPEG_MAX_DIMENSION.
_MOST_JPEG_PIXELS = 65500


def image(message: Any, image_format: str, quality: int) -> Frame:
    """Converts a sensor_msgs/Image; depth is never compressed."""
    if message.encoding not in _ENCODINGS:
        known = ", ".join(_ENCODINGS)
        raise ConvertError(f"an image of encoding {message.encoding!r}, expected one of {known}")
    encoding, pixel_bytes, mode, order = _ENCODINGS[message.encoding]
    width, height, step = message.width, message.height, message.step
    if step < width * pixel_bytes or len(message.data) != step * height or not len(message.data):
        found = f"{len(message.data)} bytes, {width}x{height}, {step} bytes a row"
        raise ConvertError(f"an image of {found}, expected rows of {pixel_bytes} bytes a pixel")
    if message.is_bigendian and not mode:
        raise ConvertError("a big-endian depth image, expected little-endian")
    payload = message.data
    if image_format == "jpeg" and mode:
        if not 0 < width <= _MOST_JPEG_PIXELS or height > _MOST_JPEG_PIXELS:
            most = f"expected 1 to {_MOST_JPEG_PIXELS} pixels a side"
            raise ConvertError(f"an image of {width}x{height} to compress, {most}")
        file = io.BytesIO()
        picture = Image.frombuffer(mode, (width, height), bytes(payload), "raw", order, step, 1)
        picture.save(file, "JPEG", quality=quality)
        encoding, step, payload = codec.ImageEncoding.JPEG, 0, file.getvalue()
    head = codec.ImageChunk(chunk=_stamped(message), encoding=encoding, step=step)
    head.width, head.height = width, height
    return Frame(head, payload)


# sensor_msgs/CompressedImage.format: "jpeg" as drivers have it, "rgb8; jpeg compressed bgr8" as image_transport does
_IS_JPEG = re.compile(r"([^;]*;)?\s*jpe?g\b", re.IGNORECASE)

# The part of a JPEG file that is read: its header with embedded data.
_JPEG_HEADER_BYTES = 1 << 18


def compressed_image(message: Any) -> Frame:
    """Wraps the bytes of a sensor_msgs/CompressedImage of JPEG, unchanged."""
    if not _IS_JPEG.match(message.format):
        raise ConvertError(f"a compressed image of format {message.format[:80]!r}, expected jpeg")
    try:
        opened = Image.open(io.BytesIO(message.data[:_JPEG_HEADER_BYTES]), formats=["JPEG"])
    except (OSError, ValueError, Image.DecompressionBombError):
        raise ConvertError(f"{len(message.data)} bytes that are no JPEG file") from None
    head = codec.ImageChunk(chunk=_stamped(message), encoding=codec.ImageEncoding.JPEG)
    head.width, head.height = opened.size
    return Frame(head, message.data)


def _stamped(message: Any) -> codec.Chunk:
    return codec.Chunk(sec=message.header.stamp.secs, nsec=message.header.stamp.nsecs)


_POINT_FIELDS = tuple(leaf.path for leaf in codec.Point.leaves)
_POINT_SCALES = [leaf.scale.counts_per_unit for leaf in codec.Point.leaves]
# sensor_msgs/PointField.datatype -> numpy
_POINT_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}


def _point_fields(message: Any) -> np.ndarray:
    """(height, width) structured array over the message's bytes."""
    wanted = {f.name: f for f in message.fields if f.name in _POINT_FIELDS}
    missing = {"x", "y", "z"} - set(wanted)
    if missing:
        raise ConvertError(f"a point cloud without field {sorted(missing)[0]}, expected x, y, z")
    if any(f.datatype not in _POINT_TYPES for f in wanted.values()):
        raise ConvertError("a point cloud with a field of unknown type, expected types 1 to 8")
    for f in wanted.values():  # numpy's own check overflows
        if f.offset + int(_POINT_TYPES[f.datatype][1:]) > message.point_step:
            found = f"a point cloud with field {f.name} at byte {f.offset}"
            raise ConvertError(f"{found}, expected it within the {message.point_step} of a point")
    order = ">" if message.is_bigendian else "<"
    try:
        formats = [order + _POINT_TYPES[f.datatype] for f in wanted.values()]
        places = dict(offsets=[f.offset for f in wanted.values()], itemsize=message.point_step)
        kind = np.dtype(dict(names=list(wanted), formats=formats, **places))
        shape, strides = (message.height, message.width), (message.row_step, message.point_step)
        if message.row_step < message.width * message.point_step:
            raise ValueError("rows overlap")
        return np.ndarray(shape, kind, message.data, strides=strides)
    except (TypeError, ValueError) as error:
        found = f"{len(message.data)} bytes, {message.width}x{message.height} points"
        raise ConvertError(f"a point cloud of {found} that does not fit: {error}") from None


def point_cloud(message: Any) -> Frame:
    """Converts a sensor_msgs/PointCloud2; leaves out points without finite coordinates."""
    head = codec.PointCloudChunk(chunk=_stamped(message))
    if message.width == 0 or message.height == 0:
        return Frame(head, b"")
    points = message.width * message.height
    if points * codec.Point.size > MAX_TOTAL:
        most = MAX_TOTAL // codec.Point.size
        raise ConvertError(f"a point cloud of {points} points, expected at most {most}")
    fields = _point_fields(message).reshape(-1)
    points = np.zeros((fields.size, len(_POINT_FIELDS)))
    with np.errstate(all="ignore"):  # numbers that are not finite
        for column, name in enumerate(_POINT_FIELDS):
            if name in fields.dtype.names:
                points[:, column] = fields[name]
                points[:, column] *= _POINT_SCALES[column]
        counts = _counts(points[np.isfinite(points[:, :3]).all(axis=1)])
    return Frame(head, counts.tobytes())


def _counts(values: np.ndarray) -> np.ndarray:
    """Returns the values rounded and saturated as by the codec; NaN becomes NO_VALUE."""
    limit = INT32.limits[1]
    is_nan = np.isnan(values)
    counts = np.rint(np.clip(np.where(is_nan, 0.0, values), -limit, limit)).astype("<i4")
    counts[is_nan] = NO_VALUE
    return counts


def stamp_s(message: Any) -> float:
    """Time of a message [s]; raises ConvertError for a time beyond the wire's int32_t."""
    stamp = message.header.stamp
    if stamp.secs > INT32.limits[1] or stamp.nsecs >= 1_000_000_000:
        found = f"a time stamp of {stamp.secs} s and {stamp.nsecs} ns"
        raise ConvertError(f"{found}, expected at most {INT32.limits[1]} s and 999999999 ns")
    return stamp.secs + stamp.nsecs * 1e-9
