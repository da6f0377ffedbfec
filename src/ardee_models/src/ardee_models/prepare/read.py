# SPDX-License-Identifier: MIT
"""Reads a mesh file as the parts of plants."""

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List, Optional, Set

import numpy as np
from PIL import Image

from ardee_common.errors import GeneratorError
from ardee_models.mesh_file import Piece, Say, read_pieces
from ardee_models.plant.plant import Mesh


@dataclass(frozen=True)
class UserPart:
    """One geometry of the file, with its texture or its colour."""

    name: str
    mesh: Mesh
    image: Optional[Image.Image]
    colour: tuple


def _appearance(visual: object) -> tuple:
    """Texture image or None, and colour 0..1."""
    material = getattr(visual, "material", None)
    image = getattr(material, "baseColorTexture", None) or getattr(material, "image", None)
    colour = getattr(material, "main_color", None)
    if colour is None:
        colour = getattr(visual, "main_color", None)
    if colour is None:
        colour = (204, 204, 204)
    return image, tuple(round(float(c) / 255.0, 4) for c in tuple(colour)[:3])


def _part(name: str, piece: Piece) -> UserPart:
    geometry, vertices = piece.geometry, piece.vertices_m()
    normals = np.asarray(geometry.vertex_normals) @ np.linalg.inv(piece.matrix[:3, :3])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(lengths > 1e-12, normals / np.maximum(lengths, 1e-12), [0.0, 0.0, 1.0])
    texcoords = getattr(geometry.visual, "uv", None)
    image, colour = _appearance(geometry.visual)
    if texcoords is None or len(texcoords) != len(vertices):
        texcoords, image = np.zeros((len(vertices), 2)), None
    mesh = Mesh(vertices, normals, np.asarray(texcoords), np.asarray(geometry.faces))
    return UserPart(name, mesh, image, colour)


def read_mesh(path: Path, up: str, scale: Optional[float], say: Say) -> List[UserPart]:
    """Reads all geometries of the file, each at its place in the scene; `up` x, y, z or auto, `scale` metres a unit."""
    parts: Dict[str, UserPart] = {}
    taken: Set[str] = set()  # in lower case, in which their visuals are named
    for piece in read_pieces(path, up, scale, say):
        plain = re.sub("[^A-Za-z0-9_-]", "_", piece.name)
        name = base = re.sub("-(geometry|mesh)$", "", plain) or "Part"
        number = len(parts)
        while name.lower() in taken:
            name, number = f"{base}_{number}", number + 1
        taken.add(name.lower())
        parts[name] = _part(name, piece)
    heights = np.concatenate([part.mesh.vertices[:, 2] for part in parts.values()])
    if not 0.005 < np.ptp(heights) < 50.0:
        raise GeneratorError(
            f"{path}: found a height of {np.ptp(heights):g} m, expected 0.005 to 50 m;"
            " give --mesh-scale (metres a unit) or --mesh-up"
        )
    return list(parts.values())
