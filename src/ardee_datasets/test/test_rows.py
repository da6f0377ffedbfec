# SPDX-License-Identifier: MIT
"""Rows and feet in the picture of a camera whose projection is known in closed form."""

import math

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from ardee_datasets.motion import Motion
from ardee_datasets.rows import (
    Row,
    foot_keypoint,
    nearest_direction,
    on_ground,
    project,
    vanishing_point,
)
from ardee_datasets.scenery import CameraPose
from ardee_models.terrain.ground import LevelGround

SIZE = (200, 100)
FOCAL_PX, HEIGHT_M = 100.0, 0.5
K = np.array([[FOCAL_PX, 0, 99.5], [0, FOCAL_PX, 49.5], [0, 0, 1]])


def camera(yaw_deg: float) -> np.ndarray:
    """X_WC of a level camera above the origin."""
    turned = Rotation.from_euler("Z", yaw_deg, degrees=True)
    return CameraPose(np.array([0.0, 0.0, HEIGHT_M]), turned).matrix()


def row(points: list) -> Row:
    return Row(0, 3, on_ground(np.array(points, dtype=float), LevelGround()))


def test_a_row_ahead_is_clipped_where_it_leaves_the_picture() -> None:
    """A row 0.4 m to the left, from behind the camera to 10 m ahead: u = c - f 0.4 / x, v = c + f h / x."""
    (piece,) = row([[-5, 0.4], [10, 0.4]]).in_picture(K, camera(0.0), SIZE)
    line = np.array(piece["line_px"])
    nearest_m = FOCAL_PX * HEIGHT_M / (99 - 49.5)  # in the lowest row of pixels
    ends = [[99.5 - FOCAL_PX * 0.4 / x, 49.5 + FOCAL_PX * HEIGHT_M / x] for x in (nearest_m, 10)]
    assert np.allclose([line[0], line[-1]], ends, atol=0.006)
    assert np.allclose(line[:, 0], 99.5 - (line[:, 1] - 49.5) * 0.4 / HEIGHT_M, atol=0.02)
    assert (piece["plot"], piece["row"]) == (0, 3)


def test_a_row_that_leaves_the_view_and_comes_back_has_two_pieces() -> None:
    bent = row([[2, 1], [2, 9], [4, 9], [4, -1]])
    pieces = bent.in_picture(K, camera(0.0), SIZE)
    assert [len(piece["line_px"]) > 1 for piece in pieces] == [True, True]
    assert row([[-9, 1], [-1, 1]]).in_picture(K, camera(0.0), SIZE) == []


@pytest.mark.parametrize("yaw_deg", [0.0, 20.0, -150.0])
def test_the_vanishing_point_of_the_nearest_row(yaw_deg: float) -> None:
    rows = [row([[0, 0.4], [10, 0.4]]), row([[-3, -5], [-3, 5]])]
    direction = nearest_direction(rows, (1.0, 0.0))
    found = vanishing_point(direction, K, camera(yaw_deg))
    assert np.allclose(found, [99.5 + FOCAL_PX * math.tan(math.radians(yaw_deg)), 49.5])


def test_lines_across_the_view_have_no_vanishing_point() -> None:
    assert vanishing_point([0, 1, 0], K, camera(0.0)) is None


def test_a_foot_is_visible_only_where_its_own_stalk_shows() -> None:
    """A foot 2 m ahead and 0.4 m to the right: u = 99.5 + 20, v = 49.5 + 25, rounded to an even pixel."""
    foot = np.array([2.0, -0.4, 0.0])
    pixel, depth = project(foot[None], K, camera(0.0))
    assert np.allclose(pixel, [[119.5, 74.5]]) and depth == pytest.approx(2.0)
    mask, depth_m = np.zeros((100, 200), dtype=bool), np.full((100, 200), 1.99)

    def found() -> list:
        return foot_keypoint(foot, K, camera(0.0), mask, depth_m)

    assert found() == [119.5, 74.5, 1]
    mask[74, 120] = True
    assert found() == [119.5, 74.5, 2]
    depth_m[74, 120] = 1.5  # a leaf of the same plant
    assert found() == [119.5, 74.5, 1]
    assert foot_keypoint(-foot, K, camera(0.0), mask, depth_m) == [0, 0, 0]
    assert foot_keypoint(foot * 0.5, K, camera(0.0), mask, depth_m) == [0, 0, 0]


@pytest.mark.parametrize("fast", [1.0, 4.0])
def test_points_appear_where_a_rolling_shutter_sees_them(fast: float) -> None:
    """Each apparent point projects to the pixel of the true one at its row's time; the middle row's are the true."""
    motion = Motion(np.array([0.6, 0.9, 0.0]) * fast, np.array([0.1, -0.3, 0.4]), 0.02, 0.08)
    X_WC, points = camera(10.0), np.random.default_rng(1).uniform((1, -1, 0), (4, 1, 1), (50, 3))
    pixels, _ = project(motion.apparent(points, K, X_WC, SIZE), K, X_WC)
    body = CameraPose(np.array([0.0, 0.0, HEIGHT_M]), Rotation.from_euler("Z", 10.0, degrees=True))
    away_px = []
    for point, (u, v) in zip(points, pixels):
        if not (0 < u < SIZE[0] and 0 < v < SIZE[1]):
            continue
        time_s = 0.08 * (v / SIZE[1] - 0.5)
        turned = Rotation.from_rotvec(time_s * motion.w_rad_s) * body.rotation
        then = CameraPose(body.xyz_m + time_s * motion.v_m_s, turned).matrix()
        assert np.allclose(project(point[None], K, then)[0], (u, v), atol=1e-3)
        away_px.append(np.hypot(*(project(point[None], K, X_WC)[0][0] - (u, v))))
    assert len(away_px) > 20 and max(away_px) > 1.0
    begun_m, begun = motion.begin(body.xyz_m, body.rotation)
    assert np.allclose(begun_m, (-0.03 * fast, -0.045 * fast, HEIGHT_M))
    assert np.allclose(
        (begun.inv() * body.rotation).magnitude(), 0.05 * np.linalg.norm(motion.w_rad_s)
    )


def test_at_rest_points_are_where_they_are() -> None:
    motion = Motion(np.zeros(3), np.zeros(3), 0.1, 0.1)
    body = Rotation.from_euler("Z", 10.0, degrees=True)
    assert motion.begin(np.ones(3), body)[1] is body
    points = np.random.default_rng(1).normal(size=(50, 3))
    assert np.allclose(motion.apparent(points, K, camera(0.0), SIZE), points, atol=1e-15)
