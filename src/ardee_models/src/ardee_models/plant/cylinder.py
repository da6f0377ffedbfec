# SPDX-License-Identifier: MIT
"""The collision cylinder of a plant, fitted to vertices of its stalk."""

from dataclasses import dataclass

import numpy as np

_ROUNDS = 12  # rounds of the search for a stalk among leaves
_OUTLIER = 2.0  # radii from the axis beyond which a vertex belongs to a leaf
_FEWEST = 8  # vertices that a cylinder is fitted to at least
_FOOT = 0.05  # part of the plant's height that is its foot
_GROWTH, _THICKEST = (
    1.25,
    8.0,
)  # steps by which the guess of the radius grows, up to this many guesses
_SKIN = (0.4, 1.7)  # radii between which a vertex lies on the stalk's skin, however it tapers


@dataclass(frozen=True)
class Cylinder:
    """Centre, unit axis (upwards), radius and length in metres."""

    centre: np.ndarray
    axis: np.ndarray
    radius_m: float
    length_m: float

    def roll_pitch(self) -> tuple:
        """Roll and pitch in radians that turn the z axis into this axis (yaw 0)."""
        x, y, z = self.axis
        return float(np.arctan2(-y, np.hypot(x, z))), float(np.arctan2(x, z))


def _axis_line(vertices: np.ndarray) -> tuple:
    """Least-squares line x(z), y(z) through vertices: mean point and unit direction."""
    mean = vertices.mean(axis=0)
    z = vertices[:, 2] - mean[2]
    spread = float(z @ z)
    slope = (z @ (vertices[:, :2] - mean[:2])) / spread if spread > 1e-12 else np.zeros(2)
    axis = np.array([slope[0], slope[1], 1.0])
    return mean, axis / np.linalg.norm(axis)


def _distance(vertices: np.ndarray, point: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """Distances of vertices from the line through `point` along `axis`."""
    offsets = vertices - point
    return np.linalg.norm(offsets - (offsets @ axis)[:, None] * axis, axis=1)


def fit_cylinder(vertices: np.ndarray) -> Cylinder:
    """Upright cylinder of a stalk's own vertices: axis by least squares, radius their mean distance from it."""
    mean, axis = _axis_line(vertices)
    along = (vertices - mean) @ axis
    radii = _distance(vertices, mean, axis)
    low, high = float(along.min()), float(along.max())
    return Cylinder(mean + 0.5 * (low + high) * axis, axis, float(radii.mean()), high - low)


def _rises(near: np.ndarray, height_m: float) -> bool:
    """Returns whether vertices can be those of a stalk: enough to fit, and not only its foot."""
    return len(near) >= _FEWEST and float(np.ptp(near[:, 2])) > _FOOT * height_m


def fit_stalk_among_leaves(vertices: np.ndarray, radius_guess_m: float) -> Cylinder:
    """Fits the stalk of a plant whose stalk and leaves are not separate parts.

    Starts at the foot, keeps the vertices near the axis, fits the cylinder, and repeats both with the radius found. A
    plant without vertices to fit gets an upright cylinder of its height and the guessed radius.
    """
    vertices = np.unique(vertices, axis=0)  # an .stl repeats a vertex for each of its triangles
    height = float(np.ptp(vertices[:, 2]))
    foot = vertices[vertices[:, 2] <= vertices[:, 2].min() + _FOOT * height]
    point, axis, radius = np.median(foot, axis=0), np.array([0.0, 0.0, 1.0]), radius_guess_m
    middle = point + (vertices[:, 2].min() + 0.5 * height - point[2]) * axis
    upright = Cylinder(middle, axis, radius_guess_m, height)
    distance = _distance(vertices, point, axis)
    # a stalk thicker than the guess has its skin outside
    while not _rises(vertices[distance < _OUTLIER * radius], height):
        radius *= _GROWTH
        if radius > _THICKEST * radius_guess_m:
            return upright
    for _ in range(_ROUNDS):
        near = distance < _OUTLIER * radius
        if not _rises(vertices[near], height):
            return upright
        point, axis = _axis_line(vertices[near])
        distance = _distance(vertices, point, axis)
        radius = max(float(np.median(distance[near])), 1e-4)
    skin = (distance > _SKIN[0] * radius) & (distance < _SKIN[1] * radius)
    return fit_cylinder(vertices[skin]) if _rises(vertices[skin], height) else upright
