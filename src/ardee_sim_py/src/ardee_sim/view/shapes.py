# SPDX-License-Identifier: MIT
"""Triangles of a model's visible shapes, in the frame of its link."""

from dataclasses import dataclass
from typing import Any, Dict, Iterable, List, Optional, Tuple

import numpy as np

_ROUND = 24  # sides of a cylinder, meridians of a sphere
_MOST_CELLS = 160  # of a ground, each way
_GRAY = {
    "rgba": np.array([0.7, 0.7, 0.7, 1.0]),
    "emissive": np.zeros(3),
    "texture": "",
    "two_sided": False,
    "alpha_rejection": -1.0,
}
_SOIL = np.array([0.45, 0.36, 0.27, 1.0])


@dataclass(frozen=True)
class Piece:
    """Triangles of one material.

    vertices_m : float32[n, 3]
    triangles : uint32[m, 3], counter-clockwise from outside
    material : dict with rgba, emissive, texture (path or empty), two_sided, alpha_rejection (below 0: none)
    texcoords : float32[n, 2], v upwards from the image's lower edge; empty without a texture
    normals : float32[n, 3]; None: flat triangles
    """

    vertices_m: np.ndarray
    triangles: np.ndarray
    material: Dict[str, Any]
    texcoords: np.ndarray
    normals: Optional[np.ndarray] = None


def rotation(quat_xyzw: np.ndarray) -> np.ndarray:
    """Returns the rotation matrix [3, 3] of a unit quaternion."""
    x, y, z, w = quat_xyzw
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def moved(piece: Piece, xyz_m: np.ndarray, quat_xyzw: np.ndarray) -> Piece:
    """Returns a piece in a frame in which its own has this pose."""
    turn = rotation(quat_xyzw)
    normals = None if piece.normals is None else (piece.normals @ turn.T).astype(np.float32)
    vertices_m = (piece.vertices_m @ turn.T + xyz_m).astype(np.float32)
    return Piece(vertices_m, piece.triangles, piece.material, piece.texcoords, normals)


def pieces_of(shapes: Iterable[Dict[str, Any]]) -> List[Piece]:
    """Returns the pieces of a link's shapes, grounds left out."""
    return [
        moved(_piece(shape), shape["xyz_m"], shape["quat_xyzw"])
        for shape in shapes
        if shape["kind"] != "heightmap"
    ]


def _piece(shape: Dict[str, Any]) -> Piece:
    material = shape["material"]
    if shape["kind"] == "mesh":
        vertices_m, texcoords = shape["vertices_m"], shape["texcoords"]
        if len(texcoords) != len(vertices_m):
            material, texcoords = {**material, "texture": ""}, texcoords[:0]
        return Piece(vertices_m, shape["triangles"], material, texcoords)
    vertices_m, triangles = _SOLIDS[shape["kind"]](shape)
    material = {**material, "texture": ""}  # solids have no texture coordinates
    return Piece(
        np.asarray(vertices_m, np.float32),
        np.asarray(triangles, np.uint32),
        material,
        np.zeros((0, 2), np.float32),
    )


_Solid = Tuple[np.ndarray, np.ndarray]


def _box(shape: Dict[str, Any]) -> _Solid:
    corners = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) / 2
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return corners * shape["size_m"], np.array(
        [corner for a, b, c, d in quads for corner in ((a, b, c), (a, c, d))]
    )


def _lathe(radii: np.ndarray, heights: np.ndarray) -> _Solid:
    """Returns the surface that a polyline makes about the z axis, from below."""
    angles = np.arange(_ROUND) * 2 * np.pi / _ROUND
    ring = np.stack([np.cos(angles), np.sin(angles), np.zeros(_ROUND)], axis=1)
    vertices = np.concatenate([ring * r + [0, 0, h] for r, h in zip(radii, heights)])
    here, there = np.arange(_ROUND), (np.arange(_ROUND) + 1) % _ROUND
    faces = []
    for low in range(0, (len(radii) - 1) * _ROUND, _ROUND):
        high = low + _ROUND
        faces.append(np.stack([low + here, low + there, high + there], axis=1))
        faces.append(np.stack([low + here, high + there, high + here], axis=1))
    return vertices, np.concatenate(faces)


def _cylinder(shape: Dict[str, Any]) -> _Solid:
    r, h = shape["radius_m"], shape["length_m"] / 2
    return _lathe(np.array([0, r, r, 0]), np.array([-h, -h, h, h]))


def _sphere(shape: Dict[str, Any]) -> _Solid:
    angles = np.linspace(-np.pi / 2, np.pi / 2, _ROUND // 2 + 1)
    return _lathe(shape["radius_m"] * np.cos(angles), shape["radius_m"] * np.sin(angles))


def _plane(shape: Dict[str, Any]) -> _Solid:
    normal = shape["normal"] / np.linalg.norm(shape["normal"])
    # turned from z to the normal along the shortest way
    quat = np.array([-normal[1], normal[0], 0.0, 1.0 + normal[2]])
    quat = quat / np.linalg.norm(quat) if np.linalg.norm(quat) > 1e-9 else np.array([1.0, 0, 0, 0])
    x, y = shape["size_m"] / 2
    corners = np.array([[-x, -y, 0], [x, -y, 0], [x, y, 0], [-x, y, 0]])
    return corners @ rotation(quat).T, np.array([[0, 1, 2], [0, 2, 3]])


_SOLIDS = {"box": _box, "cylinder": _cylinder, "sphere": _sphere, "plane": _plane}


def ground_pieces(shape: Dict[str, Any], x_m: float, y_m: float, radius_m: float) -> List[Piece]:
    """Returns a heightmap near a place, both in the link's frame: a piece for each texture that covers some of it."""
    turn = rotation(shape["quat_xyzw"])
    origin = shape["xyz_m"] + turn @ shape["position_m"]
    place = turn.T @ (np.array([x_m, y_m, 0.0]) - origin)
    heights, size = shape["heights_m"], shape["size_m"]
    axes = []
    for axis, samples in ((0, heights.shape[1]), (1, heights.shape[0])):
        cell = size[axis] / (samples - 1)
        bounds = (place[axis] + size[axis] / 2 + np.array([-radius_m, radius_m])) / cell
        low, high = np.clip([np.floor(bounds[0]), np.ceil(bounds[1])], 0, samples - 1).astype(int)
        if high == low:
            return []
        stride = -(-(high - low) // _MOST_CELLS)
        axes.append(np.append(np.arange(low, high, stride), high))
    columns, rows = axes
    z = heights[np.ix_(rows, columns)]
    x = columns / (heights.shape[1] - 1) * size[0] - size[0] / 2
    y = rows / (heights.shape[0] - 1) * size[1] - size[1] / 2
    slope_y, slope_x = np.gradient(z, y, x) if min(z.shape) > 1 else (np.zeros_like(z),) * 2
    grid_x, grid_y = np.meshgrid(x, y)
    vertices = np.stack([grid_x, grid_y, z], axis=-1).reshape(-1, 3)
    normals = np.stack([-slope_x, -slope_y, np.ones_like(z)], axis=-1).reshape(-1, 3)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    corner = np.arange(len(vertices)).reshape(z.shape)
    a, b, c, d = corner[:-1, :-1], corner[:-1, 1:], corner[1:, 1:], corner[1:, :-1]
    triangles = np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)
    layer = _layer(shape, vertices[triangles][:, :, 2].mean(axis=1))
    pieces = []
    for k in np.unique(layer):
        path, size_m = shape["textures"][k] if shape["textures"] else ("", 1.0)
        material = {**_GRAY, "texture": path, "rgba": np.ones(4) if path else _SOIL}
        if not shape["textures"] and shape["has_material"]:
            material = shape["material"]
        piece = Piece(
            vertices.astype(np.float32),
            triangles[layer == k].astype(np.uint32),
            material,
            (vertices[:, :2] / max(size_m, 1e-6)).astype(np.float32),
            normals.astype(np.float32),
        )
        pieces.append(moved(piece, origin, shape["quat_xyzw"]))
    return pieces


def _layer(shape: Dict[str, Any], heights_m: np.ndarray) -> np.ndarray:
    """Returns the number of the uppermost texture that covers at least half of each triangle."""
    layer = np.zeros(len(heights_m), int)
    for k, (least_m, fade_m) in enumerate(shape["blends"], 1):
        if k < len(shape["textures"]):
            layer[heights_m >= least_m + fade_m / 2] = k
    return layer
