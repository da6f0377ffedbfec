# SPDX-License-Identifier: MIT
"""Moves a generated field to another pose in the world, with its plots, its ground truth and its start pose."""

import dataclasses
import json
import re
from pathlib import Path
from typing import Any, Dict, Optional, Sequence, Tuple

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_models.terrain.height_map import Ground
from ardee_world.field_layout import DECIMALS, to_world
from ardee_world.seating import OWN_POSE, WorldPose
from ardee_world.start import Start
from ardee_world.writers.sdf import POSE
from ardee_world.writers.truth_files import degrees

Truth = Dict[str, Any]
_PLOT = re.compile(r"<plot>.*?</plot>", re.DOTALL)


def _wrapped(angle_rad: float) -> float:
    return float((angle_rad + np.pi) % (2.0 * np.pi) - np.pi)


def _moved(x_m: float, y_m: float, old: WorldPose, new: WorldPose) -> Tuple[float, float]:
    """Place in the world, after the move, of what stood at a place before it."""
    dx, dy = x_m - old[0], y_m - old[1]
    c, s = np.cos(old[2]), np.sin(old[2])
    x, y = to_world(np.array([[c * dx + s * dy, c * dy - s * dx]]), new)[0]
    return float(x), float(y)


def move_model(model: str, new: WorldPose) -> str:
    """Returns the text of model.sdf with another <pose> of its own."""
    line = POSE.format(*(repr(float(value) + 0.0) for value in new)).strip()
    return OWN_POSE.sub(line, model, count=1)


def _numbers(plot: str, tags: Sequence[str]) -> Dict[str, float]:
    """Returns the numbers of a <plot>, each of which has to be there."""
    found = {}
    for tag in tags:
        number = re.search(rf"<{tag}>\s*([^<\s]+)\s*</{tag}>", plot)
        try:
            found[tag] = float(number.group(1)) if number else float("nan")
        except ValueError:
            found[tag] = float("nan")
    if not np.isfinite(list(found.values())).all():
        raise GeneratorError(
            f"plots: found {plot[:80]!r}, expected numbers {', '.join(tags)} in each plot"
        )
    return found


def move_plots(plots: str, old: WorldPose, new: WorldPose) -> str:
    """Returns the text of plots.xacro with every plot where the field now has it."""

    def moved(match: "re.Match") -> str:
        text = match.group(0)
        found = _numbers(text, ("x", "y", "rotation"))
        found["x"], found["y"] = _moved(found["x"], found["y"], old, new)
        found["rotation"] = _wrapped(found["rotation"] + new[2] - old[2])
        for tag, value in found.items():
            text = re.sub(rf"(<{tag}>)[^<]*(</{tag}>)", rf"\g<1>{value + 0.0:.4f}\g<2>", text)
        return text

    return _PLOT.sub(moved, plots)


def seat_plots(plots: str, ground: Ground) -> str:
    """Returns the text of plots.xacro with the middle of every plot on the ground."""

    def seated(match: "re.Match") -> str:
        text = match.group(0)
        place = _numbers(text, ("x", "y"))
        z = float(ground.height_at(np.array([place["x"]]), np.array([place["y"]]))[0])
        return re.sub(r"(<z>)[^<]*(</z>)", rf"\g<1>{z + 0.0:.4f}\g<2>", text)

    return _PLOT.sub(seated, plots)


def move_start(start: Start, old: WorldPose, new: WorldPose) -> Start:
    """Returns the start pose before the moved field."""
    x, y = _moved(start.x_m, start.y_m, old, new)
    yaw = _wrapped(start.yaw_rad + new[2] - old[2])
    return dataclasses.replace(start, x_m=x, y_m=y, yaw_rad=yaw)


def read_truth(path: Path) -> Truth:
    """Reads a field's truth.json."""
    try:
        truth = json.loads(path.read_text(encoding="utf-8"))
        truth["config"]["world_pose"], truth["plants"]["x_m"], truth["clutter"], truth["rows"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise GeneratorError(f"{path}: no truth of a generated field: {error!r}") from error
    return truth


def origin_of(truth: Truth) -> Optional[Tuple[float, float]]:
    """Latitude and longitude [deg] of the world's origin that the field was planned with, if any."""
    config = truth["config"]
    origin = config.get("origin_latitude_deg"), config.get("origin_longitude_deg")
    return None if None in origin else origin


def _rounded(values: np.ndarray) -> list:
    return (np.round(values, DECIMALS) + 0.0).tolist()


def place_truth(truth: Truth, pose: WorldPose, ground: Optional[Ground]) -> None:
    """Makes the truth that of a field at `pose`, and on `ground` if given."""
    truth["config"]["world_pose"] = list(pose)
    origin = origin_of(truth)
    for columns in (truth["plants"], truth["clutter"]):
        if not columns:
            continue
        world = to_world(np.column_stack((columns["x_m"], columns["y_m"])), pose)
        columns["world_x_m"], columns["world_y_m"] = _rounded(world[:, 0]), _rounded(world[:, 1])
        if ground:
            columns["z_m"] = _rounded(ground.height_at(world[:, 0], world[:, 1]))
        if "latitude_deg" in columns and origin:
            columns.update(degrees(world, origin))
    for row in truth["rows"]:
        row["world_line_m"] = _rounded(to_world(np.array(row["line_m"], dtype=float), pose))
