# SPDX-License-Identifier: MIT
"""Markers for readings without a display in rviz: fixes, inertial units, magnetometers, encoders, batteries."""
from typing import Any, Callable, Dict, List, Sequence, Tuple

from geometry_msgs.msg import Point, Quaternion
from std_msgs.msg import ColorRGBA
from visualization_msgs.msg import Marker

from ardee_common.geodesy import to_metres

WORLD = "world"
TEXT_HEIGHT_M = 0.045  # height of a capital letter
FAR_TEXT_HEIGHT_M = 0.16  # for the distance at which a GPS's errors fit into the view
TEXT_ABOVE_M = 0.85  # height above the foot of the post
DOT_M = 0.08
FIELD_SCALE_M = 4000.0  # length of an arrow, for each T
FORCE_SCALE_M = 0.025  # length of an arrow, for each m/s2
RATE_SCALE_M = 0.3  # length of an arrow, for each rad/s
MOST_DOTS = 300
RED, GREEN, WHITE = (0.9, 0.2, 0.1), (0.2, 0.8, 0.3), (1.0, 1.0, 1.0)


def _marker(number: int, kind: int, frame: str, color: Tuple[float, float, float]) -> Marker:
    marker = Marker(ns="readings", id=number, type=kind, action=Marker.ADD)
    marker.header.frame_id = frame
    marker.pose.orientation = Quaternion(0, 0, 0, 1)
    marker.color = ColorRGBA(*color, 1)
    return marker


def text(lines: Sequence[str], height_m: float = TEXT_HEIGHT_M) -> Marker:
    """Marker of text lines above the post."""
    marker = _marker(0, Marker.TEXT_VIEW_FACING, WORLD, WHITE)
    marker.pose.position.z = TEXT_ABOVE_M + height_m * len(lines) / 2
    marker.scale.z = height_m
    marker.text = "\n".join(lines)
    return marker


def arrow(
    number: int, frame: str, vector: Any, scale: float, color: Tuple[float, float, float]
) -> Marker:
    """An arrow from the frame's origin along a vector of the frame."""
    marker = _marker(number, Marker.ARROW, frame, color)
    marker.points = [Point(), Point(scale * vector.x, scale * vector.y, scale * vector.z)]
    marker.scale.x, marker.scale.y, marker.scale.z = 0.008, 0.02, 0.03
    return marker


def _three(vector: Any, digits: int) -> str:
    return "  ".join(f"{value:.{digits}f}" for value in (vector.x, vector.y, vector.z))


def local_m(fix: Any, numbers: Dict[str, Any]) -> Point:
    """Returns east, north, up of a fix from the reference in the numbers."""
    origin_deg = numbers["reference_latitude_deg"], numbers["reference_longitude_deg"]
    east_m, north_m = to_metres(fix.latitude, fix.longitude, origin_deg)
    return Point(east_m, north_m, fix.altitude - numbers["reference_altitude_m"])


class FixMarks:
    """Dots at the fixes of the receiver."""

    def __init__(self, numbers: Dict[str, Any]):
        self._numbers = numbers
        self._points: List[Point] = []

    def __call__(self, fix: Any) -> List[Marker]:
        if fix.status.status < 0:
            return [text(["no fix"], FAR_TEXT_HEIGHT_M)]
        place = local_m(fix, self._numbers)
        self._points = (self._points + [place])[-MOST_DOTS:]
        dots = _marker(1, Marker.SPHERE_LIST, WORLD, GREEN)
        dots.points = self._points
        dots.scale.x = dots.scale.y = dots.scale.z = DOT_M
        where = f"{fix.latitude:.8f}, {fix.longitude:.8f} deg, {fix.altitude:.3f} m"
        lines = [where, f"from the post  {_three(place, 3)} m"]
        return [text(lines, FAR_TEXT_HEIGHT_M), dots]


def imu_marks(imu: Any) -> List[Marker]:
    """Arrows of specific force, red, and of the rate of turn, green."""
    force, rate = imu.linear_acceleration, imu.angular_velocity
    lines = [f"acceleration  {_three(force, 3)} m/s2", f"rate  {_three(rate, 4)} rad/s"]
    frame = imu.header.frame_id
    return [
        text(lines),
        arrow(1, frame, force, FORCE_SCALE_M, RED),
        arrow(2, frame, rate, RATE_SCALE_M, GREEN),
    ]


def magnetic_marks(reading: Any) -> List[Marker]:
    """Arrow of the field."""
    field = reading.magnetic_field
    micro = type(field)(1e6 * field.x, 1e6 * field.y, 1e6 * field.z)
    frame = reading.header.frame_id
    lines = [f"magnetic field  {_three(micro, 2)} microtesla"]
    return [text(lines), arrow(1, frame, field, FIELD_SCALE_M, RED)]


def encoder_marks(encoder: Any) -> List[Marker]:
    """Text of angle and speed."""
    return [text([f"{encoder.position:.3f} rad", f"{encoder.qpps:.0f} pulses a second"])]


def battery_marks(battery: Any) -> List[Marker]:
    """Text of the voltage and its bounds."""
    return [text([f"{battery.voltage:.2f} V", f"{battery.vmin:g} to {battery.vmax:g} V"])]


def marks_for(kind: str, numbers: Dict[str, Any]) -> Callable[[Any], List[Marker]]:
    """Returns the function from a message of type `kind` to markers; KeyError for types that rviz displays itself."""
    return {
        "sensor_msgs/NavSatFix": FixMarks(numbers),
        "sensor_msgs/Imu": imu_marks,
        "sensor_msgs/MagneticField": magnetic_marks,
        "ardee_msgs/Encoder": encoder_marks,
        "ardee_msgs/Battery": battery_marks,
    }[kind]
