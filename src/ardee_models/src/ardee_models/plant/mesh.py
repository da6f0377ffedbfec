# SPDX-License-Identifier: MIT
"""Triangle mesh building blocks: sheets, tubes, joining."""

from typing import Sequence

import numpy as np

from ardee_models.plant.plant import Mesh

_TINY = 1e-15  # m2


def grid_triangles(rows: int, columns: int) -> np.ndarray:
    """Two triangles a cell of a rows x columns grid of vertices stored row by row."""
    index = np.arange(rows * columns).reshape(rows, columns)
    a, b = index[:-1, :-1].ravel(), index[:-1, 1:].ravel()
    c, d = index[1:, 1:].ravel(), index[1:, :-1].ravel()
    return np.concatenate((np.stack((a, b, c), 1), np.stack((a, c, d), 1)))


def unit(vectors: np.ndarray) -> np.ndarray:
    """Unit vectors: each vector over its length, along the last axis."""
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def sheet(points: np.ndarray, texcoords: np.ndarray) -> Mesh:
    """Mesh over a (rows, columns, 3) grid of points, with area-weighted vertex normals."""
    rows, columns, _ = points.shape
    vertices = points.reshape(-1, 3)
    triangles = grid_triangles(rows, columns)
    a, b, c = (vertices[triangles[:, i]] for i in range(3))
    face_normals = np.cross(b - a, c - a)
    normals = np.zeros_like(vertices)
    for corner in range(3):
        np.add.at(normals, triangles[:, corner], face_normals)
    flat = np.linalg.norm(normals, axis=1) < _TINY  # all triangles there are degenerate
    normals[flat] = (0.0, 0.0, 1.0)
    return Mesh(vertices, unit(normals), texcoords.reshape(-1, 2), triangles)


def tube(centres: np.ndarray, radii: np.ndarray, side: np.ndarray, sides: int) -> Mesh:
    """Open tube round a curve that lies in the plane normal to the unit vector `side`."""
    tangents = unit(np.gradient(centres, axis=0))
    across = np.cross(tangents, side)
    angles = np.linspace(0.0, 2.0 * np.pi, sides + 1)
    directions = (
        np.cos(angles)[None, :, None] * side[None, None, :]
        + np.sin(angles)[None, :, None] * across[:, None, :]
    )
    points = centres[:, None, :] + radii[:, None, None] * directions
    along = np.concatenate(([0.0], np.cumsum(np.linalg.norm(np.diff(centres, axis=0), axis=1))))
    u, v = np.broadcast_arrays(angles[None, :] / (2.0 * np.pi), (along / along[-1])[:, None])
    texcoords = np.stack((u, v), axis=-1).reshape(-1, 2)
    triangles = grid_triangles(len(centres), sides + 1)
    rings = triangles // (sides + 1)
    # a ring of radius zero is a point: triangles with two corners in it have no area
    points_at = np.sum(radii[rings] <= 0.0, axis=1)
    triangles = triangles[points_at < 2]
    return Mesh(points.reshape(-1, 3), directions.reshape(-1, 3), texcoords, triangles)


def join(meshes: Sequence[Mesh]) -> Mesh:
    """One mesh of several, in their order."""
    offsets = np.concatenate(([0], np.cumsum([len(m.vertices) for m in meshes])[:-1]))
    return Mesh(
        np.concatenate([m.vertices for m in meshes]),
        np.concatenate([m.normals for m in meshes]),
        np.concatenate([m.texcoords for m in meshes]),
        np.concatenate([m.triangles + o for m, o in zip(meshes, offsets)]),
    )
