# SPDX-License-Identifier: MIT
"""Table of scales of the wire format, from which the C header and docs/wire_format.md are generated.

A field carries round(value * counts_per_unit); fields without a unit (counts_per_unit None) carry plain integers.
A row holds for the field of that path and for all fields below it, unless a longer path says otherwise.
"""
from typing import NamedTuple, Optional


class Scale(NamedTuple):
    """Scale of a field: its physical value is integer / counts_per_unit, in `unit`."""

    struct: str
    path: str
    counts_per_unit: Optional[int]
    unit: str
    constant: str
    meaning: str


_IMU, _GPS, _LIDAR = "Ardee_Msg_IMUData", "Ardee_Msg_GPSData", "Ardee_Msg_LidarData"
_ORIENTATION, _ENCODER = "Ardee_Msg_OrientationData", "Ardee_Msg_EncoderData"
_VARIANCES = "variances about x, y, z; -1 in x: not known"

_ROWS = (
    (_IMU, "accel", 10**6, "m/s²", "IMU_ACCEL", "specific force x, y, z; bias and offset too"),
    (_IMU, "accel.covariance", 10**6, "(m/s²)²", "IMU_ACCEL_COVARIANCE", _VARIANCES),
    (_IMU, "gyro", 10**6, "rad/s", "IMU_GYRO", "angular velocity x, y, z; bias and offset too"),
    (_IMU, "gyro.covariance", 10**9, "(rad/s)²", "IMU_GYRO_COVARIANCE", _VARIANCES),
    (_IMU, "orientation", 10**9, "1", "IMU_ORIENTATION", "unit quaternion; bias too"),
    (_IMU, "orientation.covariance", 10**9, "rad²", "IMU_ORIENTATION_COVARIANCE", _VARIANCES),
    (_ORIENTATION, "", 10**9, "1", "ORIENTATION", "unit quaternion; bias too"),
    (_ORIENTATION, "covariance", 10**9, "rad²", "ORIENTATION_COVARIANCE", _VARIANCES),
    ("Ardee_Msg_GyroData", "", 10**6, "rad/s", "GYRO", "angular velocity"),
    ("Ardee_Msg_AccelerationData", "", 10**6, "m/s²", "ACCELERATION", "specific force"),
    (_GPS, "time", 10**3, "s", "GPS_TIME", "simulated time, modulo 2^31 counts (24.8 days)"),
    (_GPS, "latitude", 10**7, "deg", "GPS_LATITUDE", "WGS-84, north positive"),
    (_GPS, "longitude", 10**7, "deg", "GPS_LONGITUDE", "WGS-84, east positive"),
    (_GPS, "altitude", 10**3, "m", "GPS_ALTITUDE", "above the WGS-84 ellipsoid"),
    (_GPS, "velocity", 10**3, "m/s", "GPS_VELOCITY", "north, west, up as on the ROS topic"),
    (_GPS, "covariance", 10**6, "m²", "GPS_COVARIANCE", "variances east, north, up"),
    (_GPS, "covariance_type", None, "", "", "as in sensor_msgs/NavSatFix"),
    (_GPS, "service", None, "", "", "as in sensor_msgs/NavSatStatus"),
    (_GPS, "status", None, "", "", "as in sensor_msgs/NavSatStatus; -1: no fix"),
    (_LIDAR, "angle_min", 10**6, "rad", "LIDAR_ANGLE", "of the first beam"),
    (_LIDAR, "angle_max", 10**6, "rad", "LIDAR_ANGLE", "of the last beam"),
    (_LIDAR, "dAngle", 10**9, "rad", "LIDAR_ANGLE_STEP", "from beam to beam"),
    (_LIDAR, "scan_time", 10**6, "s", "LIDAR_SCAN_TIME", "from scan to scan"),
    (_LIDAR, "dTime", 10**9, "s", "LIDAR_TIME_STEP", "from beam to beam"),
    (_LIDAR, "range_min", 10**3, "m", "LIDAR_RANGE", "least range"),
    (_LIDAR, "range_max", 10**3, "m", "LIDAR_RANGE", "greatest range"),
    (
        _LIDAR,
        "ranges",
        10**3,
        "m",
        "LIDAR_RANGE",
        "-1000: beyond range_max, -2000: below range_min",
    ),
    (_LIDAR, "intensities", 10**3, "1", "LIDAR_INTENSITY", "0 where the lidar gives none"),
    ("Ardee_Msg_MotionCommands", "", None, "", "", "see Motion"),
    (_ENCODER, "id", None, "", "", "which encoder"),
    (_ENCODER, "position", 10**4, "rad", "ENCODER_POSITION", "angle of the wheel"),
    (_ENCODER, "speed", 10**6, "m/s", "ENCODER_SPEED", "of the wheel's rim"),
    (_ENCODER, "qpps", 10**3, "1/s", "ENCODER_QPPS", "quadrature pulses a second"),
    ("Ardee_Msg_BatteryData", "", 10**3, "V", "BATTERY", "voltage, when full, when empty"),
    ("Ardee_Ext_Point", "", 10**3, "m", "POINT", "x, y, z in the sensor's frame"),
    ("Ardee_Ext_Point", "intensity", 10**3, "1", "POINT_INTENSITY", "0 where there is none"),
)
SCALES = tuple(
    Scale(*place, constant and f"ARDEE_SCALE_{constant}", meaning)
    for *place, constant, meaning in _ROWS
)

_UNSCALED = Scale("", "", None, "", "", "")


def scale_of(struct: str, path: str) -> Scale:
    """Returns the row of the table with the longest path that contains the field; plain integers without a row."""
    fitting = [
        row
        for row in SCALES
        if row.struct == struct and (not row.path or f"{path}.".startswith(f"{row.path}."))
    ]
    return max(fitting, key=lambda row: len(row.path)) if fitting else _UNSCALED
