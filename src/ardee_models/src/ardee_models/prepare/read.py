# SPDX-License-Identifier: MIT
"""Reads a mesh file of any format that trimesh knows, as parts in metres with z up."""

import importlib
import os
import re
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import List, Optional

import numpy as np
from PIL import Image

from ardee_common.errors import GeneratorError
from ardee_models.plant.plant import Mesh

_FORMATS = {".dae", ".obj", ".stl", ".ply", ".glb", ".gltf", ".off", ".3mf"}
_Y_UP_FORMATS = {".glb", ".gltf", ".obj"}
# columns of a rotation that brings the file's up axis to z
_TO_Z_UP = {
    "z": np.eye(3),
    "y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
    "x": np.array([[0.0, -1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]]),
}


@dataclass(frozen=True)
class UserPart:
    """One geometry of the file, with its texture or its colour."""

    name: str
    mesh: Mesh
    image: Optional[Image.Image]
    colour: tuple


def load_trimesh() -> ModuleType:
    """Imports trimesh from the system, else from $ARDEE_PYDEPS or <workspace>/pydeps, where scripts/setup puts it."""
    folder = os.environ.get("ARDEE_PYDEPS") or str(Path(__file__).resolve().parents[5] / "pydeps")
    if folder not in sys.path:
        sys.path.append(folder)
    try:
        return importlib.import_module("trimesh")
    except ImportError as error:
        raise GeneratorError(
            f"{error}; looked in {folder}; expected: pip install --no-deps --target {folder} trimesh"
        ) from error


def _collada_asset(path: Path) -> tuple:
    """Up axis and metres a unit of a COLLADA file."""
    try:
        root = ElementTree.parse(path).getroot()
        space = root.tag[: root.tag.index("}") + 1] if "}" in root.tag else ""
        axis = root.findtext(f"{space}asset/{space}up_axis", "Y_UP").strip()[0].lower()
        unit = root.find(f"{space}asset/{space}unit")
        return axis, float(unit.get("meter", 1.0)) if unit is not None else 1.0
    except (ElementTree.ParseError, OSError, ValueError, IndexError) as error:
        raise GeneratorError(f"{path}: not a readable COLLADA file: {error}") from error


def _orientation(path: Path, up: str, scale: Optional[float]) -> tuple:
    axis, unit = "y" if path.suffix.lower() in _Y_UP_FORMATS else "z", 1.0
    if path.suffix.lower() == ".dae":
        axis, unit = _collada_asset(path)
    axis = axis if up == "auto" else up
    if axis not in _TO_Z_UP:
        raise GeneratorError(f"{path}: found up axis {axis!r}, expected x, y or z")
    return _TO_Z_UP[axis], unit if scale is None else scale


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


def _part(name: str, geometry: object, matrix: np.ndarray) -> UserPart:
    vertices = np.asarray(geometry.vertices) @ matrix[:3, :3].T + matrix[:3, 3]
    normals = np.asarray(geometry.vertex_normals) @ np.linalg.inv(matrix[:3, :3])
    lengths = np.linalg.norm(normals, axis=1, keepdims=True)
    normals = np.where(lengths > 1e-12, normals / np.maximum(lengths, 1e-12), [0.0, 0.0, 1.0])
    texcoords = getattr(geometry.visual, "uv", None)
    image, colour = _appearance(geometry.visual)
    if texcoords is None or len(texcoords) != len(vertices):
        texcoords, image = np.zeros((len(vertices), 2)), None
    return UserPart(
        name,
        Mesh(vertices, normals, np.asarray(texcoords), np.asarray(geometry.faces)),
        image,
        colour,
    )


def _check(path: Path, parts: List[UserPart]) -> None:
    if not parts:
        raise GeneratorError(f"{path}: found no triangles")
    for part in parts:
        if not np.isfinite(part.mesh.vertices).all():
            raise GeneratorError(f"{path}: {part.name}: found a vertex that is not finite")
    heights = np.concatenate([part.mesh.vertices[:, 2] for part in parts])
    if not 0.005 < np.ptp(heights) < 50.0:
        raise GeneratorError(
            f"{path}: found a height of {np.ptp(heights):g} m, expected 0.005 to 50 m;"
            " give --scale (metres a unit) or --up"
        )


def read_mesh(path: Path, up: str = "auto", scale: Optional[float] = None) -> List[UserPart]:
    """Reads all geometries of the file, each at its place in the scene; `up` x, y, z or auto, `scale` metres a unit."""
    if path.suffix.lower() not in _FORMATS:
        raise GeneratorError(f"{path}: expected a file of {' '.join(sorted(_FORMATS))}")
    if not path.is_file():
        raise GeneratorError(f"{path}: no such file")
    rotation, unit = _orientation(path, up, scale)
    turn = np.eye(4)
    turn[:3, :3] = unit * rotation
    trimesh = load_trimesh()
    try:
        scene = trimesh.load(str(path), force="scene", process=False)
        parts, names = [], set()
        for node in scene.graph.nodes_geometry:
            matrix, key = scene.graph[node]
            geometry = scene.geometry[key]
            if len(getattr(geometry, "faces", ())) == 0:
                continue
            name = base = (
                re.sub("-(geometry|mesh)$", "", re.sub("[^A-Za-z0-9_-]", "_", key)) or "Part"
            )
            while name in names:
                name = f"{base}_{len(names)}"
            names.add(name)
            parts.append(_part(name, geometry, turn @ matrix))
    except GeneratorError:
        raise
    except Exception as error:  # a hostile file may break a reader anywhere
        # trimesh treats a file that is no binary STL as text, and lets another module guess its encoding
        text = "neither binary nor text" if isinstance(error, ImportError) else error
        raise GeneratorError(f"{path}: cannot be read: {type(error).__name__}: {text}") from error
    _check(path, parts)
    return parts
