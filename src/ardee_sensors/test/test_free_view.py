# SPDX-License-Identifier: MIT
"""Tests that no lidar sees itself, and that no camera has its own body before the lens."""
import numpy as np
import pytest
from device_numbers import PACKAGE, devices, load
from xacro_runner import read_stl

LIDARS = [device for device in devices() if load(device)["kind"].startswith("lidar")]
BOXES = [device for device in devices() if load(device)["kind"] in ("rgbd", "stereo")] + [
    "ueye_cp_gige"
]


def rays(numbers: dict) -> np.ndarray:
    """Returns unit directions (n, 3) that fill the field of view, its edges included."""
    azimuth = np.linspace(numbers["min_angle_rad"], numbers["max_angle_rad"], 181)
    edges = [numbers.get("vertical_min_angle_rad", 0), numbers.get("vertical_max_angle_rad", 0)]
    a, e = (grid.ravel() for grid in np.meshgrid(azimuth, np.linspace(*edges, 9)))
    return np.column_stack([np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e)])


def hits(triangles: np.ndarray, directions: np.ndarray) -> int:
    """Returns the number of (ray, triangle) pairs that meet, for rays from the origin (Moeller and Trumbore 1997)."""
    corner, one, two = (
        triangles[:, 0],
        triangles[:, 1] - triangles[:, 0],
        triangles[:, 2] - triangles[:, 0],
    )
    p = np.cross(directions[:, None], two[None])
    det = (p * one).sum(-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        u = -(p * corner).sum(-1) / det
        q = np.cross(-corner, one)
        v = (directions[:, None] * q).sum(-1) / det
        t = (two * q).sum(-1) / det
        return int(((u >= 0) & (v >= 0) & (u + v <= 1) & (t > 0)).sum())


def mesh_in_the_sensor_frame(device: str) -> np.ndarray:
    numbers = load(device)
    lift = numbers.get("scan_height_m", numbers.get("frame_z_m"))
    return read_stl(PACKAGE / f"meshes/{device}.stl") - (numbers.get("turret_x_m", 0), 0, lift)


@pytest.mark.parametrize("device", LIDARS)
def test_a_lidar_does_not_see_itself(device: str):
    triangles = mesh_in_the_sensor_frame(device)
    assert hits(triangles, rays(load(device))) == 0
    assert hits(triangles, np.array([[0.01, 0.02, -1.0]])) > 0  # the device has a body below


@pytest.mark.parametrize("device", BOXES)
def test_a_lens_is_in_front(device: str):
    """The frame is the middle of the front, so that the whole body is behind it."""
    corners = read_stl(PACKAGE / f"meshes/{device}.stl").reshape(-1, 3)
    assert corners[:, 0].max() == pytest.approx(load(device)["size_x_m"] / 2, abs=1e-6)
