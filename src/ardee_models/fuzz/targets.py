# SPDX-License-Identifier: MIT
"""Targets of scripts/fuzz in this package: each takes any bytes and raises an exception only for a finding."""

import tempfile
from pathlib import Path
from typing import Callable, Dict

from ardee_common.config import read_yaml_lines
from ardee_common.errors import GeneratorError
from ardee_models.terrain.recipe import read_recipe

_FOLDER = tempfile.TemporaryDirectory(prefix="ardee_fuzz_")
_FILE = Path(_FOLDER.name) / "input.yaml"


def _read(reader: Callable[[Path], object], data: bytes) -> None:
    _FILE.write_bytes(data)
    try:
        reader(_FILE)
    except GeneratorError:
        pass


def yaml_lines(data: bytes) -> None:
    """Reads YAML together with the line of each key."""
    _read(read_yaml_lines, data)


def recipe(data: bytes) -> None:
    """Reads a terrain's recipe."""
    _read(read_recipe, data)


TARGETS: Dict[str, Callable[[bytes], None]] = {"yaml": yaml_lines, "recipe": recipe}
