# SPDX-License-Identifier: MIT
"""Targets of scripts/fuzz in this package: each takes any bytes and raises an exception only for a finding."""

import tempfile
from pathlib import Path
from typing import Callable, Dict

from ardee_common.config import read_yaml_lines
from ardee_common.errors import GeneratorError
from ardee_models.prepare.read import read_mesh
from ardee_models.terrain.elevation import dem_terrain
from ardee_models.terrain.recipe import read_recipe

_FOLDER = tempfile.TemporaryDirectory(prefix="ardee_fuzz_")


def _read(reader: Callable[[Path], object], data: bytes, ending: str = "yaml") -> None:
    file = Path(_FOLDER.name) / f"input.{ending}"
    file.write_bytes(data)
    try:
        reader(file)
    except GeneratorError:
        pass


def _say(_: str) -> None:
    """Says nothing."""


def yaml_lines(data: bytes) -> None:
    """Reads YAML together with the line of each key."""
    _read(read_yaml_lines, data)


def recipe(data: bytes) -> None:
    """Reads a terrain's recipe."""
    _read(read_recipe, data)


def obj(data: bytes) -> None:
    """Reads an OBJ file as parts of plants."""
    _read(lambda path: read_mesh(path, "auto", None, _say), data, "obj")


def elevation(data: bytes) -> None:
    """Reads an ESRI ASCII grid as terrain, its holes filled."""
    _read(lambda path: dem_terrain(path, None, True, None, _say), data, "asc")


TARGETS: Dict[str, Callable[[bytes], None]] = {
    "yaml": yaml_lines,
    "recipe": recipe,
    "obj": obj,
    "elevation": elevation,
}
