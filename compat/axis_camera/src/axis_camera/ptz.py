# SPDX-License-Identifier: MIT
"""Converts axis_camera/Axis (degrees, zoom 1 to 9999) to joints and field of view of a simulated camera, and back."""
import math
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from typing import Optional, Tuple

ZOOM_WIDE, ZOOM_TELE = 1.0, 9999.0  # the scale of Axis's network interface (VAPIX)
Range = Tuple[float, float]


def clamp(value: float, within: Range) -> float:
    """Returns the value, or the nearer end of the range."""
    return min(max(value, within[0]), within[1])


def magnification(fov_rad: float) -> float:
    """Focal length over half the image's width."""
    return 1.0 / math.tan(fov_rad / 2.0)


def to_degrees(joint_rad: float) -> float:
    """Pan or tilt [deg] of its joint: the device counts to the right and up, the joints to the left and down."""
    return 0.0 - math.degrees(joint_rad)


@dataclass(frozen=True)
class Camera:
    """Limits of a camera, from its robot's description."""

    pan_rad: Range
    tilt_rad: Range
    fov_rad: Optional[Range]  # narrowest, widest; None: it has no zoom

    def pan_joint_rad(self, pan_deg: float) -> float:
        """Angle of the pan joint, at its limits for a pan beyond them."""
        return clamp(-math.radians(pan_deg), self.pan_rad)

    def tilt_joint_rad(self, tilt_deg: float) -> float:
        """Angle of the tilt joint, at its limits for a tilt beyond them."""
        return clamp(-math.radians(tilt_deg), self.tilt_rad)

    def fov_of_zoom_rad(self, zoom: float) -> float:
        """Horizontal field of view; the focal length grows evenly with the zoom."""
        share = (clamp(zoom, (ZOOM_WIDE, ZOOM_TELE)) - ZOOM_WIDE) / (ZOOM_TELE - ZOOM_WIDE)
        tele, wide = (magnification(fov_rad) for fov_rad in self.fov_rad)
        return clamp(2.0 * math.atan(1.0 / (wide + share * (tele - wide))), self.fov_rad)

    def zoom_of_focal(self, focal_px: float, width_px: int) -> float:
        """Zoom of a camera with that focal length in camera_info."""
        if self.fov_rad is None:
            return ZOOM_WIDE
        tele, wide = (magnification(fov_rad) for fov_rad in self.fov_rad)
        share = (2.0 * focal_px / width_px - wide) / (tele - wide)
        return ZOOM_WIDE + clamp(share, (0.0, 1.0)) * (ZOOM_TELE - ZOOM_WIDE)


def read_camera(urdf: str, pan_joint: str, tilt_joint: str) -> Camera:
    """Returns the camera on the tilt joint; raises ValueError if the description has no such joints."""
    try:
        robot = ElementTree.fromstring(urdf)
    except ElementTree.ParseError as error:
        raise ValueError(f"robot_description: {error}; expected URDF") from None
    joints = {joint.get("name"): joint for joint in robot.findall("joint")}
    for name in (pan_joint, tilt_joint):
        if name not in joints:
            raise ValueError(f"robot_description: no joint {name!r}; expected a PTZ camera's")
    head = joints[tilt_joint].find("child").get("link")
    return Camera(_limits(joints[pan_joint]), _limits(joints[tilt_joint]), _fov_rad(robot, head))


def _limits(joint: ElementTree.Element) -> Range:
    limit = joint.find("limit")
    if limit is None or joint.get("type") != "revolute":
        name, kind = joint.get("name"), joint.get("type")
        raise ValueError(f"joint {name!r}: {kind}; expected revolute, with a limit")
    return float(limit.get("lower", "0")), float(limit.get("upper", "0"))


def _fov_rad(robot: ElementTree.Element, head: str) -> Optional[Range]:
    """Returns the zoom range of the camera on a link; None if there is none, or if its ends are equal."""
    for plugin in robot.findall(f"gazebo[@reference='{head}']/sensor/plugin"):
        ends = [plugin.findtext(key) for key in ("horizontalFovMin", "horizontalFovMax")]
        if None not in ends and float(ends[0]) < float(ends[1]):
            return float(ends[0]), float(ends[1])
    return None
