# SPDX-License-Identifier: MIT
"""Triangle shapes for the meshes of robots and sensors, and their binary STL files.

A shape is an array of shape (n, 3, 3): n triangles of three corners in metres, counter-clockwise seen
from outside.
"""
import pathlib

import numpy as np

DECIMALS = (
    6  # coordinates are whole micrometres, so that a file's bytes do not depend on the C library
)
STL_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def _fan(ring: np.ndarray) -> np.ndarray:
    """Triangles that fill a convex ring (k, 3), facing the side from which it runs counter-clockwise."""
    count = len(ring)
    first = np.broadcast_to(ring[0], (count - 2, 3))
    return np.stack([first, ring[1:-1], ring[2:]], axis=1)


def loft(rings: list, closed: bool = False) -> np.ndarray:
    """Skin over rings (k, 3) of equal length, each counter-clockwise seen from the last one.

    If `closed`, the last ring joins the first (a torus); else both ends are filled as convex faces.
    """
    pairs = list(zip(rings[:-1], rings[1:])) + ([(rings[-1], rings[0])] if closed else [])
    parts = []
    for low, high in pairs:
        low_next, high_next = np.roll(low, -1, axis=0), np.roll(high, -1, axis=0)
        parts.append(np.stack([low, low_next, high_next], axis=1))
        parts.append(np.stack([low, high_next, high], axis=1))
    if not closed:
        parts += [_fan(rings[0][::-1]), _fan(rings[-1])]
    return np.concatenate(parts)


def at_height(outline: np.ndarray, z: float) -> np.ndarray:
    """The outline (k, 2) as a ring (k, 3) in the plane z."""
    return np.column_stack([outline, np.full(len(outline), z)])


def circle(radius: float, segments: int, center: tuple = (0.0, 0.0)) -> np.ndarray:
    """Outline (segments, 2) of a circle."""
    angle = 2 * np.pi * np.arange(segments) / segments
    return np.column_stack([np.cos(angle), np.sin(angle)]) * radius + center


def rectangle(size_x: float, size_y: float, corner: float, steps: int = 4) -> np.ndarray:
    """Outline of a rectangle about the origin with round corners of radius `corner`."""
    angle = np.linspace(0, np.pi / 2, steps + 1)
    arc = corner * np.column_stack([np.cos(angle), np.sin(angle)])
    middle = np.array([size_x / 2 - corner, size_y / 2 - corner])
    quarter = middle + arc
    mirrored = (quarter * (-1, 1))[::-1]
    return np.concatenate([quarter, mirrored, -quarter, -mirrored])


def capsule(end: tuple, radius_start: float, radius_end: float, steps: int = 12) -> np.ndarray:
    """Outline around a circle at the origin and one at `end`, joined by their common tangents."""
    end_point = np.asarray(end, dtype=float)
    length = np.hypot(*end_point)
    heading = np.arctan2(end_point[1], end_point[0])
    tangent = np.arccos((radius_start - radius_end) / length)
    far = heading + np.linspace(-tangent, tangent, steps + 1)
    near = heading + np.linspace(tangent, 2 * np.pi - tangent, steps + 1)
    return np.concatenate(
        [
            end_point + radius_end * np.column_stack([np.cos(far), np.sin(far)]),
            radius_start * np.column_stack([np.cos(near), np.sin(near)]),
        ]
    )


def box(
    size: tuple, center: tuple = (0.0, 0.0, 0.0), corner: float = 0.0, edge: float = 0.0
) -> np.ndarray:
    """Box with round vertical corners of radius `corner` and a chamfer `edge` along top and bottom."""
    steps = 4 if corner > 0 else 0
    half = size[2] / 2
    full = rectangle(size[0], size[1], corner, steps)
    if edge == 0:
        return loft([at_height(full, -half), at_height(full, half)]) + center
    inset = rectangle(size[0] - 2 * edge, size[1] - 2 * edge, max(corner - edge, 0.0), steps)
    levels = [(inset, -half), (full, edge - half), (full, half - edge), (inset, half)]
    return loft([at_height(outline, z) for outline, z in levels]) + center


def lathe(profile: list, segments: int, closed: bool = False) -> np.ndarray:
    """Turned part about z: profile of (radius, z) with rising z, or closed and running counter-clockwise."""
    return loft([at_height(circle(r, segments), z) for r, z in profile], closed)


def turn(triangles: np.ndarray, axis: int, angle_rad: float) -> np.ndarray:
    """The shape turned about a coordinate axis (0 x, 1 y, 2 z), right-handed."""
    c, s = np.cos(angle_rad), np.sin(angle_rad)
    rotation = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    rotation[i, i], rotation[i, j], rotation[j, i], rotation[j, j] = c, -s, s, c
    return triangles @ rotation.T


def mirror_x(triangles: np.ndarray) -> np.ndarray:
    """The mirror image in the plane x = 0, its faces still outwards."""
    return (triangles * (-1.0, 1.0, 1.0))[:, ::-1]


def stl_bytes(triangles: np.ndarray) -> bytes:
    """Binary STL of the shape; triangles that vanish when rounded are left out."""
    corners = np.round(triangles, DECIMALS) + 0.0
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    length = np.linalg.norm(normal, axis=1)
    keep = length > 0
    records = np.zeros(int(keep.sum()), STL_RECORD)
    records["normal"] = np.round(normal[keep] / length[keep, None], DECIMALS) + 0.0
    records["corners"] = corners[keep]
    header = b"ARDEE mesh, metres".ljust(80, b" ")
    return header + np.uint32(len(records)).tobytes() + records.tobytes()


def write_all(meshes: dict, folder: pathlib.Path) -> None:
    """Writes each shape of {file name: triangles} into the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, triangles in meshes.items():
        (folder / name).write_bytes(stl_bytes(triangles))
