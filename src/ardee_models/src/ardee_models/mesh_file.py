# SPDX-License-Identifier: MIT
"""Reads mesh files of all formats that trimesh knows, in metres and with z up: the one rule of all commands."""

import contextlib
import importlib
import io
import itertools
import logging
import os
import sys
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Callable, Iterator, List, Optional

import numpy as np

from ardee_common.errors import GeneratorError

UPS = ("auto", "x", "y", "z")
UP_RULE = "as a .dae says, y for .obj, .gltf and .glb, else z"
_FORMATS = {".dae", ".obj", ".stl", ".ply", ".glb", ".gltf", ".off", ".3mf"}
_Y_UP_FORMATS = {".glb", ".gltf", ".obj"}
_MAX_BYTES = 1 << 30
# columns of a rotation that brings the file's up axis to z
_TO_Z_UP = {
    "z": np.eye(3),
    "y": np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]]),
    "x": np.array([[0.0, -1.0, 0.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0]]),
}
Say = Callable[[str], None]


@dataclass(frozen=True)
class Piece:
    """A geometry of a mesh file: trimesh's object, and the 4x4 matrix to its place in metres with z up."""

    name: str
    geometry: object
    matrix: np.ndarray

    def vertices_m(self) -> np.ndarray:
        """Vertices (n, 3) in their place."""
        return np.asarray(self.geometry.vertices) @ self.matrix[:3, :3].T + self.matrix[:3, 3]


def load_trimesh() -> ModuleType:
    """Imports trimesh from the Python path, else from $ARDEE_PYDEPS or the workspace's pydeps/ of scripts/setup."""
    folder = os.environ.get("ARDEE_PYDEPS") or str(Path(__file__).resolve().parents[4] / "pydeps")
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


def _axis_and_unit(path: Path, up: str, scale: Optional[float]) -> tuple:
    """The axis that points up, and metres a unit."""
    axis, unit = "y" if path.suffix.lower() in _Y_UP_FORMATS else "z", 1.0
    if path.suffix.lower() == ".dae":
        axis, unit = _collada_asset(path)
    if up != "auto":
        axis = up
    if axis not in _TO_Z_UP:
        raise GeneratorError(f"{path}: found up axis {axis!r}, expected x, y or z")
    return axis, unit if scale is None else scale


def _triangulated(obj: str) -> str:
    """The text of an OBJ file with its polygons cut into triangles, for trimesh drops the textures of quads.

    Indices that count backwards, from where they stand, become those that count from the file's begin.
    """
    counts, lines = {"v": 0, "vt": 0, "vn": 0}, []

    def absolute(text: str, count: int) -> str:
        index = int(text or 1)
        index += count + 1 if index < 0 else 0
        if index < 1:
            raise ValueError(
                f"found a face of index {text}, expected 1 to {count} or -{count} to -1"
            )
        return str(index) if text else ""

    for line in obj.replace("\r\n", "\n").replace("\\\n", " ").split("\n"):
        word, *rest = line.split() or [""]
        if word in counts:
            counts[word] += 1
            line = " ".join((word, *rest))  # trimesh wants a blank where a tab may stand
        if word != "f":
            lines.append(line)
            continue
        rest = list(itertools.takewhile(lambda text: text[0] != "#", rest))
        corners = ["/".join(map(absolute, text.split("/"), counts.values())) for text in rest]
        lines += [f"f {corners[0]} {a} {b}" for a, b in zip(corners[1:], corners[2:])]
    return "\n".join(lines)


class _LeftOut(logging.Handler):
    """Tells of materials and pictures that trimesh leaves out without an error."""

    def __init__(self, path: Path, say: Say) -> None:
        super().__init__()
        self._path, self._say = path, say

    def emit(self, record: logging.LogRecord) -> None:
        """Tells of a record that is about one of them."""
        text = record.getMessage()
        if "load materials" in text or "load image" in text:
            error = record.exc_info[1] if record.exc_info else None
            self._say(f"{self._path}: warning: {text}" + (f": {error}" if error else ""))


@contextlib.contextmanager
def _telling(path: Path, say: Say) -> Iterator[None]:
    log, handler = logging.getLogger("trimesh"), _LeftOut(path, say)
    before = log.level, log.propagate
    log.addHandler(handler)
    log.setLevel(logging.DEBUG)
    log.propagate = False
    try:
        yield
    finally:
        log.removeHandler(handler)
        log.setLevel(before[0])
        log.propagate = before[1]


def _scene(path: Path) -> object:
    trimesh = load_trimesh()
    options = {"force": "scene", "process": False}
    if path.suffix.lower() != ".obj":
        return trimesh.load(str(path), **options)
    text = _triangulated(path.read_text(encoding="utf-8", errors="replace"))
    resolver = trimesh.resolvers.FilePathResolver(str(path))
    return trimesh.load(io.StringIO(text), file_type="obj", resolver=resolver, **options)


def read_pieces(path: Path, up: str, scale: Optional[float], say: Say) -> List[Piece]:
    """Reads all geometries with triangles; `up` is one of UPS, `scale` metres a unit if the file is not to say it.

    `say` is told of an axis that was turned up unasked, and of materials and pictures that are missing.
    """
    if path.suffix.lower() not in _FORMATS:
        raise GeneratorError(f"{path}: expected a file of {' '.join(sorted(_FORMATS))}")
    if not path.is_file():
        raise GeneratorError(f"{path}: cannot be read: no such file")
    if path.stat().st_size > _MAX_BYTES:
        raise GeneratorError(f"{path}: found more than {_MAX_BYTES} bytes, expected fewer")
    axis, unit = _axis_and_unit(path, up, scale)
    turn = np.eye(4)
    turn[:3, :3] = unit * _TO_Z_UP[axis]
    try:
        with _telling(path, say):
            scene, pieces = _scene(path), []
        for node in scene.graph.nodes_geometry:
            matrix, key = scene.graph[node]
            if len(getattr(scene.geometry[key], "faces", ())):
                pieces.append(Piece(key, scene.geometry[key], turn @ matrix))
    except GeneratorError:
        raise
    except Exception as error:  # a hostile file may break a reader anywhere
        # trimesh treats a file that is no binary STL as text, and lets another module guess its encoding
        text = "neither binary nor text" if isinstance(error, ImportError) else error
        raise GeneratorError(f"{path}: cannot be read: {type(error).__name__}: {text}") from error
    if not pieces:
        raise GeneratorError(f"{path}: found no triangles")
    for piece in pieces:
        shape = np.shape(piece.geometry.vertices)
        if shape[1:] != (3,):
            raise GeneratorError(
                f"{path}: {piece.name}: found vertices of {shape[-1]} numbers, expected x, y, z"
            )
        if not np.isfinite(piece.vertices_m()).all():
            raise GeneratorError(f"{path}: {piece.name}: found a vertex that is not finite")
    if up == "auto" and axis != "z":
        say(f"{path}: taken with its {axis} axis upwards ({UP_RULE}), and turned")
    return pieces
