# SPDX-License-Identifier: MIT
"""A picture of a textured mesh without a graphics card: points over its triangles, of which the nearest is seen."""

from dataclasses import dataclass
from pathlib import Path
from typing import List, Tuple

import numpy as np

from ardee_models.prepare.read import read_mesh

_SAMPLES_PER_PIXEL = 2.2  # mean number of points on a pixel of a triangle seen from the front
# steps of a sequence that fills the unit square evenly: 1/g and 1/g^2 with g^3 = g + 1
_EVEN = (0.7548776662466927, 0.5698402909980532)
_LIGHT = np.array([0.35, -0.60, 0.72])
_AMBIENT = 0.50
_MOST_POINTS = 3_000_000  # limit for one picture


@dataclass(frozen=True)
class Part:
    """Corners (n, 3, 3), texture coordinates (n, 3, 2) and image of one submesh."""

    name: str
    corners: np.ndarray
    texcoords: np.ndarray
    texture: np.ndarray


def read_dae(dae: Path) -> List[Part]:
    """Triangles and textures of a mesh file."""
    parts = []
    for part in read_mesh(dae, "auto", None, lambda text: None):
        corners = part.mesh.vertices[part.mesh.triangles]
        texture = np.full((1, 1, 3), 255.0 * np.array(part.colour))
        if part.image is not None:
            texture = np.asarray(part.image.convert("RGB"), dtype=float)
        parts.append(Part(part.name, corners, part.mesh.texcoords[part.mesh.triangles], texture))
    return parts


def _sample(part: Part, per_m2: float) -> tuple:
    """Samples points, colours and unit normals evenly over the part's area."""
    a, b, c = (part.corners[:, k] for k in range(3))
    cross = np.cross(b - a, c - a)
    twice = np.linalg.norm(cross, axis=1)
    count = np.ceil(0.5 * twice * per_m2).astype(int)
    index = np.repeat(np.arange(len(count)), count)
    k = np.arange(len(index))
    s, t = (k * _EVEN[0]) % 1.0, (k * _EVEN[1]) % 1.0
    over = s + t > 1.0
    s, t = np.where(over, 1.0 - s, s), np.where(over, 1.0 - t, t)
    weights = np.stack((1.0 - s - t, s, t), axis=-1)[..., None]
    points = np.sum(part.corners[index] * weights, axis=1)
    uv = np.sum(part.texcoords[index] * weights, axis=1)
    rows, columns, _ = part.texture.shape
    x = np.clip(uv[:, 0] * columns, 0, columns - 1).astype(int)
    y = np.clip((1.0 - uv[:, 1]) * rows, 0, rows - 1).astype(int)
    return points, part.texture[y, x], (cross / np.maximum(twice, 1e-12)[:, None])[index]


def draw(
    parts: List[Part],
    size_px: Tuple[int, int],
    pixels_per_m: float,
    azimuth_rad: float,
    elevation_rad: float,
    background: Tuple[int, int, int],
) -> np.ndarray:
    """Draws parts in parallel projection; RGB uint8 (height, width, 3).

    The plant's foot is in the middle, near the lower edge or so far above it that low tips show.
    """
    width, height = size_px
    area = sum(
        0.5
        * np.linalg.norm(
            np.cross(p.corners[:, 1] - p.corners[:, 0], p.corners[:, 2] - p.corners[:, 0]), axis=1
        ).sum()
        for p in parts
    )
    per_m2 = min(_SAMPLES_PER_PIXEL * pixels_per_m**2, _MOST_POINTS / max(area, 1e-9))
    samples = [_sample(part, per_m2) for part in parts]
    points, colours, normals = (np.concatenate([s[k] for s in samples]) for k in range(3))
    toward = np.array([np.cos(azimuth_rad), np.sin(azimuth_rad), 0.0])
    right = np.array([-np.sin(azimuth_rad), np.cos(azimuth_rad), 0.0])
    eye = np.cos(elevation_rad) * toward + np.array([0.0, 0.0, np.sin(elevation_rad)])
    up = np.cross(eye, right)
    light = _LIGHT[0] * right - _LIGHT[1] * toward + np.array([0.0, 0.0, _LIGHT[2]])
    # a leaf is lit from either side; what faces up is a little brighter
    shade = _AMBIENT + (1.0 - _AMBIENT) * np.abs(normals @ light) / np.linalg.norm(light)
    x = (points @ right * pixels_per_m + width / 2).astype(int)
    above = points @ up * pixels_per_m
    foot = min(0.965 * height, 0.985 * height + above.min())
    y = (foot - above).astype(int)
    inside = (x >= 0) & (x < width) & (y >= 0) & (y < height)
    order = np.argsort(points[inside] @ eye, kind="stable")  # far to near: the last one stays
    picture = np.empty((height, width, 3), dtype=np.uint8)
    picture[:] = background
    lit = np.clip(colours[inside] * shade[inside, None] * 1.12, 0, 255).astype(np.uint8)
    picture[y[inside][order], x[inside][order]] = lit[order]
    return picture
