# SPDX-License-Identifier: MIT
"""Shapes of weeds, stones and litter, as triangles (n, 3, 3) in metres. Sizes are estimates of common specimens."""

from typing import List

import numpy as np
from scipy.spatial import ConvexHull

_BLADE_STEPS = 6
_GOLDEN_RAD = np.radians(137.5)  # spiral phyllotaxy


def _grid(points: np.ndarray) -> np.ndarray:
    """Two triangles a cell of a grid of points (rows, columns, 3)."""
    a, b, c, d = points[:-1, :-1], points[:-1, 1:], points[1:, 1:], points[1:, :-1]
    cells = np.stack((np.stack((a, b, c), -2), np.stack((a, c, d), -2)), -3)
    return cells.reshape(-1, 3, 3)


def both_sides(triangles: np.ndarray) -> np.ndarray:
    """Adds the back of a sheet, which makes it visible from below too: STL has no two-sided material."""
    return np.concatenate((triangles, triangles[:, ::-1]))


def blade(
    length_m: float,
    width_m: float,
    azimuth_rad: float,
    rise_rad: float,
    bend_rad: float,
    foot_m: tuple,
) -> np.ndarray:
    """A leaf: starts at `foot_m`, rises at an angle, bends over evenly; pointed at both ends, folded at its midrib."""
    t = np.linspace(0.0, 1.0, _BLADE_STEPS + 1)
    angle = rise_rad - bend_rad * t
    step = length_m / _BLADE_STEPS
    out = np.concatenate(([0.0], np.cumsum(np.cos(angle[:-1]) * step)))
    up = np.concatenate(([0.0], np.cumsum(np.sin(angle[:-1]) * step)))
    half = 0.5 * width_m * np.sin(np.pi * t**0.8) ** 0.8 + 1e-4
    across = np.stack((-half, np.zeros_like(half), half), axis=1)
    fold = 0.25 * np.abs(across)
    c, s = np.cos(azimuth_rad), np.sin(azimuth_rad)
    x = c * out[:, None] - s * across
    y = s * out[:, None] + c * across
    return _grid(np.stack((x, y, up[:, None] + fold), axis=-1) + np.array(foot_m))


def tube(start_m: tuple, end_m: tuple, radii_m: tuple, sides: int = 7) -> np.ndarray:
    """An open cone between two points."""
    start, end = np.array(start_m), np.array(end_m)
    axis = (end - start) / np.linalg.norm(end - start)
    helper = np.array([1.0, 0.0, 0.0]) if abs(axis[2]) > 0.9 else np.array([0.0, 0.0, 1.0])
    u = np.cross(axis, helper)
    u /= np.linalg.norm(u)
    angles = np.linspace(0.0, 2.0 * np.pi, sides + 1)
    ring = np.cos(angles)[:, None] * u + np.sin(angles)[:, None] * np.cross(axis, u)
    return _grid(np.stack((start + radii_m[0] * ring, end + radii_m[1] * ring)))


def rosette(rng: np.random.Generator) -> np.ndarray:
    """Leaves close to the ground, as of dandelion."""
    leaves = [
        blade(
            rng.uniform(0.09, 0.15),
            rng.uniform(0.03, 0.045),
            k * _GOLDEN_RAD,
            np.radians(rng.uniform(20, 45)),
            np.radians(rng.uniform(25, 50)),
            (0.0, 0.0, 0.004),
        )
        for k in range(10)
    ]
    return both_sides(np.concatenate(leaves))


def broadleaf(rng: np.random.Generator) -> np.ndarray:
    """An upright weed with broad leaves, as of pigweed."""
    height = 0.34
    parts = [both_sides(tube((0, 0, 0), (0, 0, height), (0.005, 0.002)))]
    for k in range(12):
        share = (k + 1.5) / 13.0
        size = 0.11 * (1.0 - 0.55 * share) * rng.uniform(0.85, 1.15)
        rise, bend = np.radians(rng.uniform(25, 50)), np.radians(rng.uniform(30, 70))
        parts.append(
            both_sides(blade(size, 0.5 * size, k * _GOLDEN_RAD, rise, bend, (0, 0, share * height)))
        )
    return np.concatenate(parts)


def grass_tuft(rng: np.random.Generator) -> np.ndarray:
    """A tuft of narrow blades, as of foxtail."""
    blades = [
        blade(
            rng.uniform(0.2, 0.38),
            rng.uniform(0.006, 0.01),
            rng.uniform(-np.pi, np.pi),
            np.radians(rng.uniform(55, 88)),
            np.radians(rng.uniform(20, 90)),
            (*rng.uniform(-0.015, 0.015, 2), 0.0),
        )
        for _ in range(22)
    ]
    return both_sides(np.concatenate(blades))


def _hull(points: np.ndarray) -> np.ndarray:
    """Triangles of the convex hull, seen from outside."""
    hull = ConvexHull(points)
    triangles = points[hull.simplices]
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    inward = np.einsum("ij,ij->i", normal, hull.equations[:, :3]) < 0.0
    triangles[inward] = triangles[inward][:, ::-1]
    return triangles


def stone(rng: np.random.Generator, size_m: tuple, corners: int) -> np.ndarray:
    """A convex stone, a third of it in the ground; few corners make it sharp."""
    points = rng.standard_normal((corners, 3))
    points /= np.linalg.norm(points, axis=1)[:, None]
    points *= rng.uniform(0.88, 1.0, corners)[:, None] * 0.5 * np.array(size_m)
    points[:, 2] += size_m[2] / 6.0
    return _hull(points)


def dead_leaf(rng: np.random.Generator) -> np.ndarray:
    """A dry corn leaf on the ground, arched a little off it."""
    arch = blade(0.36, 0.05, 0.0, np.radians(22), np.radians(48), (-0.18, 0.0, 0.004))
    arch[..., 2] = np.maximum(arch[..., 2], 0.003)
    arch[..., 1] += 0.03 * np.sin(6.0 * arch[..., 0] + rng.uniform(0, np.pi))
    return both_sides(arch)


def dead_stalk(rng: np.random.Generator) -> np.ndarray:
    """A broken stalk lying on the ground."""
    bend = rng.uniform(0.01, 0.03)
    middle = (0.02, bend, 0.013)
    parts: List[np.ndarray] = [tube((-0.22, 0.0, 0.012), middle, (0.012, 0.011))]
    parts.append(tube(middle, (0.2, 0.0, 0.011), (0.011, 0.009)))
    return both_sides(np.concatenate(parts))
