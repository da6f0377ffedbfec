# SPDX-License-Identifier: MIT
"""Makes pictures of crop rows in known places, by a pinhole camera."""
import math

import numpy as np

from ardee_navigation.vision.camera import Camera

SOIL, CROP, SKY = (110, 80, 60), (60, 130, 40), (130, 170, 230)


def rotation(heading_rad: float, pitch_rad: float) -> np.ndarray:
    """Returns the matrix from the camera's optical axes (right, down, forward) to ground axes (along, left, up)."""
    turn, tilt = (math.cos(heading_rad), math.sin(heading_rad)), (
        math.cos(pitch_rad),
        math.sin(pitch_rad),
    )
    forward = (turn[0] * tilt[0], turn[1] * tilt[0], -tilt[1])
    right = (turn[1], -turn[0], 0.0)
    return np.column_stack((right, np.cross(forward, right), forward))


def picture_of(
    camera: Camera,
    lateral_m: float,
    heading_rad: float,
    pitch_rad: float = 0.0,
    width_m: float = 0.762,
    end_m: float = 30.0,
    rows: int = 4,
) -> np.ndarray:
    """Returns a picture of bands of crop, a third of the lanes' width each, by a camera in the middle lane.

    end_m : where the rows end, along them from the camera
    """
    u, v = np.meshgrid(np.arange(camera.width_px) + 0.5, np.arange(camera.height_px) + 0.5)
    rays = np.stack(
        (
            (u - camera.width_px / 2.0) / camera.focal_px,
            (v - camera.height_px / 2.0) / camera.focal_px,
            np.ones_like(u),
        )
    )
    along, left, up = np.tensordot(rotation(heading_rad, pitch_rad), rays, 1)
    with np.errstate(divide="ignore", invalid="ignore"):
        scale = camera.height_m / -up
        across = (left * scale + lateral_m) / width_m + 0.5
    row = np.round(across)
    is_crop = (np.abs(across - row) < 1.0 / 6.0) & (np.abs(row - 0.5) < rows / 2.0)
    is_crop &= along * scale < end_m
    picture = np.where((is_crop & (up < 0.0))[..., None], CROP, SOIL)
    return np.where((up >= 0.0)[..., None], SKY, picture).astype(np.uint8)
