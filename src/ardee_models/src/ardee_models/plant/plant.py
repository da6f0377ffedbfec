# SPDX-License-Identifier: MIT
"""A generated plant as plain data: organs of triangles, and the figures that describe it."""

from dataclasses import dataclass
from typing import Tuple

import numpy as np


@dataclass(frozen=True)
class Mesh:
    """Triangles with per-vertex normals and texture coordinates; metres, z up, v = 0 at the image's lower edge."""

    vertices: np.ndarray
    normals: np.ndarray
    texcoords: np.ndarray
    triangles: np.ndarray

    def triangle_areas_m2(self) -> np.ndarray:
        """Area of each triangle, one side."""
        a, b, c = (self.vertices[self.triangles[:, i]] for i in range(3))
        return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2

    def triangle_centres(self) -> np.ndarray:
        """Mean of each triangle's corners, (n, 3)."""
        return self.vertices[self.triangles].mean(axis=1)

    def area_m2(self) -> float:
        """Sum of the triangles' areas, one side."""
        return float(self.triangle_areas_m2().sum())


@dataclass(frozen=True)
class Organ:
    """A named part of the plant: one submesh of the model, one material, one texture."""

    name: str
    visual: str
    texture: str
    mesh: Mesh


@dataclass(frozen=True)
class Plant:
    """Organs of one plant at one level of detail."""

    species: str
    stage: str
    label: int
    organs: Tuple[Organ, ...]

    def organ(self, name: str) -> Organ:
        """The organ of that name."""
        return next(organ for organ in self.organs if organ.name == name)

    def vertices(self) -> np.ndarray:
        """All vertices."""
        return np.concatenate([organ.mesh.vertices for organ in self.organs])

    def triangle_count(self) -> int:
        """Triangles in all organs."""
        return int(sum(len(organ.mesh.triangles) for organ in self.organs))

    def blades(self) -> Tuple[Mesh, ...]:
        """Meshes of all blades."""
        return tuple(organ.mesh for organ in self.organs if organ.name.startswith("Leaves"))

    def leaf_area_m2(self) -> float:
        """Area of one side of all blades."""
        return sum(mesh.area_m2() for mesh in self.blades())
