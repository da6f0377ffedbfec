# SPDX-License-Identifier: MIT
"""Crop rows and plants' feet in the picture of a pinhole camera: lines, vanishing point, keypoints."""

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np

from ardee_models.terrain.height_map import Ground
from ardee_world.row_truth import Polyline, distinct

Size = Tuple[int, int]  # width, height of a picture in pixels
_STEP_M = 0.1  # between the places where a row's line takes the height of the ground
_NEAR_M = 0.02  # nearer than this to the camera's plane, nothing is projected
_APART_PX = 2.0  # between the points of a line in a picture
_FOOT_DEPTH_M = 0.05  # between a foot and the surface of its own stalk before it


@dataclass(frozen=True)
class Row:
    """A crop row of the truth, as a line [n, 3] on the ground in the world."""

    plot: int
    row: int
    line_m: np.ndarray

    def in_picture(self, K: np.ndarray, X_WC: np.ndarray, size: Size) -> List[Dict[str, Any]]:
        """Returns its pieces in a picture, with their points rounded to 0.01 pixels; plants and hills hide none."""
        return [
            {"plot": self.plot, "row": self.row, "line_px": np.round(piece, 2).tolist()}
            for piece in clipped(self.line_m, K, X_WC, size)
        ]


def read_rows(truth: Path, ground: Ground) -> List[Row]:
    """Returns the rows of a field's truth.json that have a direction."""
    made = []
    for row in json.loads(truth.read_text())["rows"]:
        line = distinct(np.array(row["world_line_m"], dtype=float))
        if len(line) > 1:
            made.append(Row(row["plot"], row["row"], on_ground(line, ground)))
    return made


def on_ground(row_m: np.ndarray, ground: Ground) -> np.ndarray:
    """Returns a row [n, 2] as a line [m, 3] on the ground."""
    line = Polyline(row_m)
    along = np.linspace(0.0, line.length_m, int(np.ceil(line.length_m / _STEP_M)) + 1)
    x, y = np.array([line.at(distance)[:2] for distance in along]).T
    return np.column_stack((x, y, ground.height_at(x, y)))


def project(points_m: np.ndarray, K: np.ndarray, X_WC: np.ndarray) -> Tuple[np.ndarray, np.ndarray]:
    """Returns pixels [n, 2] of points [n, 3] in the world, and their depths [n]; pixels hold where depth > 0."""
    homogeneous = _homogeneous(points_m, K, X_WC)
    depth = homogeneous[:, 2]
    return homogeneous[:, :2] / np.where(depth == 0.0, np.nan, depth)[:, None], depth


def _homogeneous(points_m: np.ndarray, K: np.ndarray, X_WC: np.ndarray) -> np.ndarray:
    return (points_m - X_WC[:3, 3]) @ X_WC[:3, :3] @ K.T


def clipped(line_m: np.ndarray, K: np.ndarray, X_WC: np.ndarray, size: Size) -> List[np.ndarray]:
    """Returns the pieces [n, 2] of a line [m, 3] between the picture's outermost pixel centres, 0 to size - 1."""
    width, height = size
    points = _homogeneous(line_m, K, X_WC)
    u, v, depth = points.T
    # distances to the five sides of the view, which are positive inside of it
    sides = [u, (width - 1) * depth - u, v, (height - 1) * depth - v]
    inside = np.stack((*sides, depth - _NEAR_M))
    a, b = inside[:, :-1], inside[:, 1:]
    crossing = a / np.where(a == b, 1.0, a - b)
    enter = np.where((a < 0) & (b >= 0), crossing, 0.0).max(axis=0)
    leave = np.where((a >= 0) & (b < 0), crossing, 1.0).min(axis=0)
    is_seen = (enter < leave) & ~((a < 0) & (b < 0)).any(axis=0)
    pieces: List[List[np.ndarray]] = []
    for i in np.flatnonzero(is_seen):
        step = points[i + 1] - points[i]
        if enter[i] > 0 or i == 0 or not is_seen[i - 1]:
            pieces.append([points[i] + enter[i] * step])
        pieces[-1].append(points[i] + leave[i] * step)
    return [_thinned(np.array([p[:2] / p[2] for p in piece])) for piece in pieces]


def _thinned(line_px: np.ndarray) -> np.ndarray:
    """Returns a line without the points that lie close to the one before; its ends stay."""
    kept = [line_px[0]]
    kept += [p for p in line_px[1:-1] if np.hypot(*(p - kept[-1])) >= _APART_PX]
    return np.array([*kept, line_px[-1]])


def vanishing_point(
    direction: Sequence[float], K: np.ndarray, X_WC: np.ndarray
) -> Optional[np.ndarray]:
    """Returns the pixel where lines of a direction [3] or its opposite meet ahead; None if they cross the view."""
    u, v, depth = K @ X_WC[:3, :3].T @ np.asarray(direction, dtype=float)
    return None if abs(depth) < 1e-6 else np.array([u / depth, v / depth])


def nearest_direction(rows: Sequence[Row], xy_m: Sequence[float]) -> np.ndarray:
    """Returns the direction [3], level, of the nearest row where it is nearest to a place."""
    seen = [Polyline(row.line_m[:, :2]).project(xy_m[0], xy_m[1]) for row in rows]
    angle = min(seen, key=lambda one: abs(one.left_m)).direction_rad
    return np.array([np.cos(angle), np.sin(angle), 0.0])


def foot_keypoint(
    foot_m: np.ndarray,
    K: np.ndarray,
    X_WC: np.ndarray,
    mask: np.ndarray,
    depth_m: np.ndarray,
) -> List[Any]:
    """Returns [u, v, visibility] of a plant's foot as COCO has it: 2 visible, 1 hidden, 0 0 0 outside of the picture.

    A visible foot shows its own stalk: `mask` is that of the plant, and another part of it does not hide the foot.
    """
    pixels, depth = project(foot_m[None], K, X_WC)
    if depth[0] < _NEAR_M:
        return [0, 0, 0]
    u, v = (float(value) for value in np.round(pixels[0], 2))
    column, row = round(u), round(v)
    height, width = mask.shape
    if not (0 <= column < width and 0 <= row < height):
        return [0, 0, 0]
    is_shown = mask[row, column] and abs(depth_m[row, column] - depth[0]) < _FOOT_DEPTH_M
    return [u, v, 2 if is_shown else 1]
