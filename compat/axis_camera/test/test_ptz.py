# SPDX-License-Identifier: MIT
"""Degrees and zoom of axis_camera/Axis against joint angles and fields of view that are known by hand."""
import math
import re

import pytest

from axis_camera.ptz import Camera, read_camera, to_degrees

NARROW_RAD, WIDE_RAD = 2 * math.atan(1 / 3), math.pi / 2  # focal lengths of 3 and 1 half widths
CAMERA = Camera(pan_rad=(-math.pi, math.pi), tilt_rad=(-0.5, 1.5), fov_rad=(NARROW_RAD, WIDE_RAD))

JOINT = """<joint name="{}" type="{}"><parent link="body" /><child link="{}" />{}</joint>"""
LIMIT = '<limit lower="-3" upper="2" effort="1" velocity="1" />'
ZOOM = """<gazebo reference="head"><sensor type="camera"><plugin>
  <horizontalFovMin>{}</horizontalFovMin><horizontalFovMax>0.9</horizontalFovMax></plugin></sensor></gazebo>"""


def robot(*parts: str) -> str:
    """A description of a camera's pan joint, and more."""
    return f"<robot>{JOINT.format('pan', 'revolute', 'yoke', LIMIT)}{''.join(parts)}</robot>"


TILT = JOINT.format("tilt", "revolute", "head", LIMIT.replace("2", "1"))


def test_pan_is_to_the_right_and_tilt_up_where_joints_turn_left_and_down() -> None:
    assert CAMERA.pan_joint_rad(30) == pytest.approx(-math.pi / 6)
    assert CAMERA.pan_joint_rad(-90) == pytest.approx(math.pi / 2)
    assert CAMERA.tilt_joint_rad(-45) == pytest.approx(math.pi / 4)
    assert to_degrees(-math.pi / 6) == pytest.approx(30)
    assert to_degrees(math.pi / 4) == pytest.approx(-45)


def test_joints_stop_at_their_limits() -> None:
    assert (CAMERA.pan_joint_rad(200), CAMERA.pan_joint_rad(-1e30)) == (-math.pi, math.pi)
    assert (CAMERA.tilt_joint_rad(90), CAMERA.tilt_joint_rad(-90)) == (-0.5, 1.5)


@pytest.mark.parametrize(
    "zoom, half_widths", [(1, 1), (5000, 2), (9999, 3), (0, 1), (-5, 1), (20000, 3)]
)
def test_focal_length_grows_evenly_with_the_zoom(zoom: float, half_widths: float) -> None:
    fov_rad = CAMERA.fov_of_zoom_rad(zoom)
    assert fov_rad == pytest.approx(2 * math.atan(1 / half_widths))
    assert NARROW_RAD <= fov_rad <= WIDE_RAD, "the simulator refuses what is beyond"


@pytest.mark.parametrize("focal_px, zoom", [(400, 1), (800, 5000), (1200, 9999), (300, 1)])
def test_zoom_is_told_by_the_focal_length(focal_px: float, zoom: float) -> None:
    assert CAMERA.zoom_of_focal(focal_px, width_px=800) == pytest.approx(zoom)


def test_a_description_tells_limits_and_zoom() -> None:
    camera = read_camera(robot(TILT, ZOOM.format(0.1)), "pan", "tilt")
    assert camera == Camera((-3, 2), (-3, 1), (0.1, 0.9))


@pytest.mark.parametrize("zoom", ["", ZOOM.format(0.9)])
def test_a_camera_without_zoom_is_always_wide(zoom: str) -> None:
    camera = read_camera(robot(TILT, zoom), "pan", "tilt")
    assert camera.fov_rad is None
    assert camera.zoom_of_focal(800, 800) == 1


@pytest.mark.parametrize(
    "urdf, message",
    [
        (robot(), "no joint 'tilt'; expected a PTZ camera's"),
        (
            robot(JOINT.format("tilt", "fixed", "head", "")),
            "joint 'tilt': fixed; expected revolute",
        ),
        (robot(JOINT.format("tilt", "revolute", "head", "")), "expected revolute, with a limit"),
        ("<robot>", "robot_description: no element found"),
    ],
)
def test_a_description_without_the_camera_is_refused(urdf: str, message: str) -> None:
    with pytest.raises(ValueError, match=re.escape(message)):
        read_camera(urdf, "pan", "tilt")
