# SPDX-License-Identifier: MIT
"""Sets the plants of a generated field on another ground: the z of every plant becomes the ground's height."""

import re
from pathlib import Path
from typing import List, Optional, Tuple

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_models.terrain.height_map import Ground
from ardee_world.field_layout import to_world
from ardee_world.writers.instances import HEADER
from ardee_world.writers.sdf import EXTENSION_NAMESPACE

WorldPose = Tuple[float, float, float]
_TABLE = re.compile(r"<ardee:instances>\s*([A-Za-z0-9_][A-Za-z0-9_.-]*)\s*</ardee:instances>")
OWN_POSE = re.compile(r"<pose>([^<]*)</pose>")
_POSE = re.compile(r"(<include>.*?<pose>)([^<]*)(</pose>)", re.DOTALL)


def is_generated(model: str) -> bool:
    """Tells whether the field generator wrote the model; only its plants are known to stand on the ground."""
    return EXTENSION_NAMESPACE in model[:400]


def own_pose(model: str) -> WorldPose:
    """Returns x [m], y [m], yaw [rad] of the <pose> that a generated field's model.sdf has."""
    found = OWN_POSE.search(model.split("<include>", 1)[0])
    if not found:
        return 0.0, 0.0, 0.0
    try:
        x, y, *upright, yaw = (float(value) for value in found.group(1).split())
    except ValueError:
        upright = []
    if upright != [0.0, 0.0, 0.0] or not np.isfinite([x, y, yaw]).all():
        raise GeneratorError(f"field: found <pose>{found.group(1)}</pose>, expected X Y 0 0 0 YAW")
    return x, y, yaw


def _heights(xy: np.ndarray, ground: Ground, pose: WorldPose) -> List[float]:
    """Returns heights [m] of the ground below places of a field that stands at `pose`."""
    world = to_world(xy, pose)
    return ground.height_at(world[:, 0], world[:, 1]).tolist()


def seat(model: str, ground: Ground) -> str:
    """Returns the text of model.sdf with its includes on the ground, for a world that keeps the field's own pose."""
    poses = [match.group(2).split() for match in _POSE.finditer(model)]
    if not poses:
        return model
    try:
        xy = np.array([pose[:2] for pose in poses], dtype=float)
    except ValueError as error:
        raise GeneratorError(f"field: found a pose that is not six numbers: {error}") from error
    heights = iter(_heights(xy, ground, own_pose(model)))

    def placed(match: "re.Match") -> str:
        x, y, _, *turn = match.group(2).split()
        return f"{match.group(1)}{x} {y} {next(heights) + 0.0:.4f} {' '.join(turn)}{match.group(3)}"

    return _POSE.sub(placed, model)


def table_name(model: str) -> Optional[str]:
    """Returns the name of the table of plants beside a model.sdf, if it has one."""
    found = _TABLE.search(model)
    return found.group(1) if found else None


def read_table(path: Path) -> str:
    """Reads the text of a table of plants."""
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        raise GeneratorError(f"{path}: cannot be read: {error}") from error
    if not text.startswith(HEADER):
        found = text[:80].split("\n")[0]
        raise GeneratorError(f"{path}:1: found {found!r}, expected the header {HEADER.strip()!r}")
    return text


def seat_table(text: str, path: Path, ground: Ground, pose: WorldPose) -> str:
    """Returns the table of a field at `pose` with its plants on the ground; messages name `path`."""
    rows = [line.split(",") for line in text.splitlines()[1:]]
    xy = np.empty((len(rows), 2))
    for number, row in enumerate(rows):
        try:
            if len(row) != HEADER.count(",") + 1:
                raise ValueError(f"{len(row)} columns")
            xy[number] = float(row[2]), float(row[3])
        except ValueError as error:
            raise GeneratorError(
                f"{path}:{number + 2}: found {','.join(row)[:80]!r}, expected {HEADER.strip()}: {error}"
            ) from error
    for row, height in zip(rows, _heights(xy, ground, pose)):
        row[4] = f"{height + 0.0:.4f}"
    return HEADER + "".join(",".join(row) + "\n" for row in rows)
