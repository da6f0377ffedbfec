# SPDX-License-Identifier: MIT
"""The collision cylinder of a plant, fitted to vertices of its stalk."""

from dataclasses import dataclass

import numpy as np

_ROUNDS = 12  # rounds of the search for a stalk among leaves
_OUTLIER = 2.0  # radii from the axis beyond which a vertex belongs to a leaf
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


def fit_stalk_among_leaves(vertices: np.ndarray, radius_guess_m: float) -> Cylinder:
    """Fits the stalk of a plant whose stalk and leaves are not separate parts.

    Starts at the foot, keeps the vertices near the axis, fits the cylinder, and repeats both with the radius found.
    """
    height = float(np.ptp(vertices[:, 2]))
    foot = vertices[vertices[:, 2] <= vertices[:, 2].min() + 0.05 * height]
    point, axis, radius = np.median(foot, axis=0), np.array([0.0, 0.0, 1.0]), radius_guess_m
    for _ in range(_ROUNDS):
        distance = _distance(vertices, point, axis)
        near = distance < _OUTLIER * radius
        if near.sum() < 8:
            return fit_cylinder(foot)
        point, axis = _axis_line(vertices[near])
        radius = max(float(np.median(distance[near])), 1e-4)
    distance = _distance(vertices, point, axis)
    skin = (distance > _SKIN[0] * radius) & (distance < _SKIN[1] * radius)
    return fit_cylinder(vertices[skin] if skin.sum() >= 8 else foot)
