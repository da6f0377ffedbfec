# SPDX-License-Identifier: MIT
"""A picture with what the row follower sees in it: rows, where they meet, the lane in use, numbers."""
import math
from typing import Tuple

import cv2
import numpy as np

from ardee_navigation.vision.follower import Output, camera_of
from ardee_navigation.vision.parameters import VisionParameters
from ardee_navigation.vision.rows import RowModel

_WIDTH_PX = 640  # at least, for the text
VALID, INVALID, CENTRE, TEXT = (26, 230, 51), (230, 128, 26), (51, 128, 255), (255, 255, 255)


def drawn(rgb: np.ndarray, output: Output, parameters: VisionParameters) -> np.ndarray:
    """Returns a picture uint8[h, w, 3], magnified if it is small, with the follower's answer to it.

    The lane's rows are green where the follower believes them and orange where not, with a ring where they meet; the
    middle of the lane in use, by which it steers, is blue.
    """
    height_px, width_px, _ = rgb.shape
    factor = max(1, math.ceil(_WIDTH_PX / width_px))
    picture = cv2.resize(rgb, None, fx=factor, fy=factor, interpolation=cv2.INTER_NEAREST)
    camera = camera_of(factor * width_px, factor * height_px, parameters)
    rows, sight = output.sight.rows.scaled(factor), output.sight
    used = camera.rows(-output.centre.angle_rad, -output.centre.distance_m, rows)
    colour = VALID if output.is_valid else INVALID
    _line(picture, used, 0.5, CENTRE)
    for row in (0.0, 1.0):
        _line(picture, rows, row, colour)
    meeting = _point(rows, 0.0, rows.horizon_px, camera.width_px)
    cv2.circle(picture, meeting, 8, colour, 2, cv2.LINE_AA)
    numbers = (
        f"{output.state.value}, confidence {sight.confidence:.2f}",
        f"heading {math.degrees(sight.heading_rad):+.1f} deg, offset {100.0 * sight.lateral_offset_m:+.1f} cm",
    )
    for i, text in enumerate(numbers):
        place = (10, 24 * (i + 1))
        for shade, thickness in (((0, 0, 0), 4), (TEXT, 1)):
            cv2.putText(
                picture, text, place, cv2.FONT_HERSHEY_SIMPLEX, 0.6, shade, thickness, cv2.LINE_AA
            )
    return picture


def _point(rows: RowModel, row: float, v_px: float, width_px: int) -> Tuple[int, int]:
    u_px = width_px / 2.0 + rows.offset_px(row, np.float64(v_px))
    return int(round(float(u_px))), int(round(v_px))


def _line(picture: np.ndarray, rows: RowModel, row: float, colour: Tuple[int, int, int]) -> None:
    """Draws a row from the horizon down to the picture's lower edge."""
    height_px, width_px, _ = picture.shape
    ends = (_point(rows, row, v_px, width_px) for v_px in (rows.horizon_px, float(height_px)))
    cv2.line(picture, *ends, colour, 2, cv2.LINE_AA)
