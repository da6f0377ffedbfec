# SPDX-License-Identifier: MIT
"""Enumerations of the wire format, as in include/ardee_message.h."""
import enum


class MessageType(enum.IntEnum):
    """ArdeeMessageType; 9 is FRONT_CAM and IMU, told apart by the data type. From 16 on: extensions."""

    SET_PORT = 0
    CONTROL = 1
    DATA_GPS = 2
    DATA_GYRO = 3
    DATA_ACCELERATION = 4
    DATA_RCCOMMANDS = 5
    DATA_LIDAR = 6
    DATA_ORIENTATION = 7
    DATA_ENCODER = 8
    DATA_FRONT_CAM = 9
    DATA_IMU = 9
    DATA_BATTERY = 10
    DATA_TIME = 16
    DATA_IMAGE = 17
    DATA_POINT_CLOUD = 18
    ACK = 19


class DataType(enum.IntEnum):
    """ArdeeDataType. From 16 on: extensions."""

    NONE = 0
    ALL = 1
    GPS = 2
    GYRO = 3
    ACCELERATION = 4
    LIDAR = 5
    ORIENTATION = 6
    ENCODER = 7
    FRONT_CAM = 8
    IMU = 9
    BATTERY = 10
    TIME = 16
    IMAGE = 17
    POINT_CLOUD = 18


class MeasurementType(enum.IntEnum):
    """ArdeeMeasurementType."""

    SINGLE = 0
    MULTIPLE = 1


class ControlCode(enum.IntEnum):
    """ArdeeControlCode."""

    STOP = 0
    START = 1
    PAUSE = 2
    RESUME = 3


class ImageEncoding(enum.IntEnum):
    """Pixels of an image message, row by row; integers little-endian."""

    JPEG = 0
    MONO8 = 1
    RGB8 = 2
    BGR8 = 3
    DEPTH_16U_MM = 4
    DEPTH_32F_M = 5
