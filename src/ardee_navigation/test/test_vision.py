# SPDX-License-Identifier: MIT
"""Tests what pictures of rows in known places say, and by driving a robot of unicycle kinematics."""
import math
from dataclasses import astuple

import numpy as np
import pytest
from pictures import picture_of, rotation

from ardee_common.errors import GeneratorError
from ardee_navigation.lane_following import State
from ardee_navigation.vision import VisionFollower, VisionParameters
from ardee_navigation.vision.camera import Camera
from ardee_navigation.vision.classical import Classical
from ardee_navigation.vision.follower import camera_of
from ardee_navigation.vision.overlay import CENTRE, VALID, drawn
from ardee_navigation.vision.rows import RowModel
from ardee_navigation.vision.vegetation import excess_green

P = VisionParameters(estimator="classical")
CAMERA = camera_of(320, 240, P)
CLASSICAL = Classical(CAMERA, P.lane_width_m)
DT_S = 0.05


@pytest.mark.parametrize("heading_rad, pitch_rad", [(0.0, 0.0), (0.2, 0.1), (-0.3, 0.3)])
@pytest.mark.parametrize("lateral_m", [-0.1, 0.05])
def test_the_lines_of_two_rows_give_heading_and_offset(
    lateral_m: float, heading_rad: float, pitch_rad: float
) -> None:
    """Projects four points of both rows, and reads the rows' model off them by its definition."""
    along, left = np.array([[2.0, 2.0], [4.0, 4.0]]), 0.381 * np.array([[1.0, -1.0]] * 2)
    points = np.stack((along, left - lateral_m, np.full((2, 2), -CAMERA.height_m)))
    x, y, z = np.tensordot(rotation(heading_rad, pitch_rad).T, points, 1)
    u, v = CAMERA.focal_px * x / z, CAMERA.focal_px * y / z + CAMERA.height_px / 2.0
    slopes = (u[1] - u[0]) / (v[1] - v[0])
    horizon_px = CAMERA.height_px / 2.0 - CAMERA.focal_px * math.tan(pitch_rad)
    heading_px = u[0, 0] + slopes[0] * (horizon_px - v[0, 0])
    spacing = slopes[1] - slopes[0]
    rows = RowModel(horizon_px, spacing, slopes[0] / spacing, heading_px)
    assert rows.offset_px(1, v[:, 1]) == pytest.approx(u[:, 1])
    sight = CAMERA.sight(rows, 1.0)
    assert sight.heading_rad == pytest.approx(heading_rad, abs=1e-9)
    assert sight.lateral_offset_m == pytest.approx(lateral_m, abs=1e-9)
    assert astuple(CAMERA.rows(heading_rad, lateral_m, rows)) == pytest.approx(astuple(rows))


def test_excess_green_does_not_depend_on_exposure() -> None:
    picture = np.full((4, 8, 3), (40, 80, 20), np.uint8)
    assert excess_green(picture, 4) == pytest.approx(np.full((2, 4), 100 / 140), abs=1e-6)
    assert excess_green(2 * picture, 8) == pytest.approx(np.full((4, 8), 100 / 140), abs=1e-6)
    assert not excess_green(0 * picture, 8).any()


@pytest.mark.parametrize("height_px", [725, 1305, 1421])
def test_a_picture_and_its_camera_shrink_alike(height_px: int) -> None:
    """Their heights shrunk to 160 pixels of width lie halfway between two whole numbers."""
    index = excess_green(np.full((height_px, 1856, 3), (20, 90, 10), np.uint8), 160)
    assert index.dtype == np.float32
    assert index.shape == (Camera(1856, height_px, 900.0, 1.0).shrunk(160).height_px, 160)


@pytest.mark.parametrize("lateral_m", [-0.08, 0.0, 0.05])
@pytest.mark.parametrize("heading_rad, pitch_rad", [(0.0, 0.0), (0.12, -0.05), (-0.12, 0.08)])
def test_drawn_rows_are_found_where_they_are(
    lateral_m: float, heading_rad: float, pitch_rad: float
) -> None:
    sight = CLASSICAL.look(picture_of(CAMERA, lateral_m, heading_rad, pitch_rad))
    assert sight.heading_rad == pytest.approx(heading_rad, abs=0.02)
    assert sight.lateral_offset_m == pytest.approx(lateral_m, abs=0.03)
    assert sight.confidence > P.min_confidence


@pytest.mark.parametrize("rgb", [(0, 0, 0), (110, 80, 60), (60, 130, 40), (255, 255, 255)])
def test_a_picture_of_one_colour_shows_no_lane(rgb: tuple) -> None:
    assert CLASSICAL.look(np.full((240, 320, 3), rgb, np.uint8)).confidence < P.end_confidence


def test_a_lane_that_jumps_is_not_believed_until_the_old_one_is_lost_for_long() -> None:
    follower = VisionFollower(P)
    here, there = picture_of(CAMERA, -0.1, 0.0), picture_of(CAMERA, 0.12, 0.0)
    assert follower.update(here, 0.0).is_valid
    looks = [follower.update(there, DT_S * i) for i in range(1, 20)]
    believed = [look.is_valid for look in looks].index(True)
    assert believed == pytest.approx(P.max_coast_s / DT_S, abs=1)
    assert looks[believed - 1].centre.distance_m > 0.0 > looks[believed].centre.distance_m


def test_waits_for_a_row_and_stands_after_a_long_gap() -> None:
    follower = VisionFollower(P)
    bare, rows = np.zeros((240, 320, 3), np.uint8), picture_of(CAMERA, 0.0, 0.0)
    for i in range(30):
        output = follower.update(bare, DT_S * i)
    assert output.state is State.WAITING and output.speed_m_s == 0.0
    assert follower.update(rows, 1.55).speed_m_s == P.speed_m_s
    assert follower.update(bare, 1.60).speed_m_s == P.speed_m_s
    assert follower.update(bare, 1.60 + P.max_gap_s + DT_S).speed_m_s == 0.0


def test_pictures_may_change_their_size() -> None:
    """The same lane is seen in the same place in wider and higher pictures of the camera."""
    follower, sights = VisionFollower(P), []
    for size_px in ((320, 240), (640, 400), (320, 240)):
        picture = picture_of(camera_of(*size_px, P), 0.05, 0.0)
        sights.append(follower.update(picture, DT_S * len(sights)).sight)
        assert sights[-1].lateral_offset_m == pytest.approx(0.05, abs=0.03)
        assert sights[-1].heading_rad == pytest.approx(0.0, abs=0.02)
    assert sights[2] == sights[0] != sights[1]


@pytest.mark.parametrize("size_px", [(1, 160), (15, 15), (16, 65), (65, 16), (1000, 3)])
def test_a_picture_too_small_or_narrow_is_refused_and_changes_nothing(size_px: tuple) -> None:
    """A picture of 1 x 160 pixels, shrunk to a width of 160, would take gigabytes."""
    follower, others = VisionFollower(P), VisionFollower(P)
    picture = picture_of(CAMERA, 0.05, 0.0)
    follower.update(picture, 0.0)
    with pytest.raises(GeneratorError, match=f"found a picture of {size_px[0]} x {size_px[1]} p"):
        follower.update(np.zeros((*size_px[::-1], 3), np.uint8), DT_S)
    others.update(picture, 0.0)
    assert follower.update(picture, 2 * DT_S) == others.update(picture, 2 * DT_S)


@pytest.mark.parametrize(
    "picture, found",
    [
        (np.zeros((96, 128), np.uint8), r"uint8\[96, 128\]"),
        (np.zeros((96, 128, 4), np.uint8), r"uint8\[96, 128, 4\]"),
        (np.zeros((96, 128, 3)), r"float64\[96, 128, 3\]"),
    ],
)
def test_a_picture_of_another_kind_is_refused(picture: np.ndarray, found: str) -> None:
    with pytest.raises(GeneratorError, match=f"found a picture {found}, expected uint8"):
        VisionFollower(P).update(picture, 0.0)


def test_what_is_seen_is_drawn_where_it_is() -> None:
    picture = picture_of(CAMERA, 0.05, 0.1)
    output = VisionFollower(P).update(picture, 0.0)
    shown = drawn(picture, output, P)
    assert shown.shape == (480, 640, 3)
    rows = output.sight.rows.scaled(2.0)
    for row, colour in ((0.0, VALID), (0.5, CENTRE), (1.0, VALID)):
        u_px = 320.0 + rows.offset_px(row, np.float64(350.0))
        assert (shown[350, round(u_px)] == colour).all()


def drive(lateral_m: float, heading_rad: float, length_m: float = 3.0) -> np.ndarray:
    """Drives a robot without slip down rows that end at the length; returns x, lateral, heading at each picture."""
    follower, track = VisionFollower(P), []
    x, y, yaw = 0.0, lateral_m, heading_rad
    for i in range(200):
        camera_x = x + P.camera_ahead_m * math.cos(yaw)
        camera_y = y + P.camera_ahead_m * math.sin(yaw)
        picture = picture_of(CAMERA, camera_y, yaw, end_m=length_m - camera_x)
        output = follower.update(picture, 2 * DT_S * i)
        track.append([x, y, yaw])
        if output.state is State.FINISHED:
            break
        yaw += output.turn_rad_s * 2 * DT_S
        x += output.speed_m_s * 2 * DT_S * math.cos(yaw)
        y += output.speed_m_s * 2 * DT_S * math.sin(yaw)
    assert output.state is State.FINISHED
    return np.array(track)


def test_drives_down_a_lane_and_stops_behind_it() -> None:
    track = drive(0.1, -0.1)
    settled = track[(track[:, 0] > 1.5) & (track[:, 0] < 2.5)]
    assert np.abs(settled[:, 1]).max() < 0.03 and np.abs(settled[:, 2]).max() < 0.05
    assert 2.5 < track[-1, 0] < 3.8
