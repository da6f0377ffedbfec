# SPDX-License-Identifier: MIT
"""Parts of a run in a world: a freshly sown field, its truth, a start pose, the ground."""

import contextlib
import math
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType
from typing import Dict, List, Mapping, Optional, Sequence, Tuple
from xml.etree import ElementTree

import numpy as np

from ardee_common.config import build, read_yaml_lines
from ardee_common.errors import GeneratorError, known_names
from ardee_models.lookup import find_model, search_path
from ardee_models.terrain.ground import ground_model, is_ground
from ardee_models.terrain.height_map import Ground
from ardee_world.generate_field import make_configured
from ardee_world.request import with_changes, yaml_values
from ardee_world.row_truth import Field, Pose, read_field
from ardee_world.seating import own_pose
from ardee_world.start import STAND_M, Start

HALF_TRACK_M = 0.24  # the wheels stand within this of the robot's middle
_PLACE_TOLERANCE = 1e-3  # m and rad
# "relatively near the center" (thesis 5.2.1): how a person sets a robot down (estimate)
START_SD_M, START_SD_RAD = 0.03, 0.05


def standing_m(ground: Ground, pose: Pose) -> float:
    """Returns the height of base_footprint at a place: the highest wheel determines it."""
    around = np.array([-HALF_TRACK_M, 0.0, HALF_TRACK_M])
    x, y = pose.x_m + around[:, None], pose.y_m + around[None, :]
    return float(np.max(ground.height_at(x, y))) + STAND_M


@dataclass(frozen=True)
class Trial:
    """One run of a scenario, ready to be driven."""

    world: Path
    models: List[Path]  # folders before GAZEBO_MODEL_PATH
    field: Field
    start: Pose
    ground: Ground

    def height_m(self, pose: Pose) -> float:
        """Returns the height of base_footprint at a place: the highest wheel determines it."""
        return standing_m(self.ground, pose)


def included_names(world: Path) -> List[str]:
    """Returns the names of the models that a world includes."""
    try:
        uris = [node.text or "" for node in ElementTree.parse(world).iterfind("world/include/uri")]
    except ElementTree.ParseError as error:
        raise GeneratorError(f"{world}: not valid XML: {error}") from error
    return [uri.strip()[len("model://") :] for uri in uris if uri.strip().startswith("model://")]


def _included_models(world: Path, folders: List[Path]) -> Dict[str, Path]:
    """Returns the folders of the models that a world includes, by name; a light of Gazebo's database has none."""
    found = {}
    for name in included_names(world):
        with contextlib.suppress(GeneratorError):
            found[name] = find_model(name, folders)
    return found


def field_and_terrain(world: Path, folders: List[Path]) -> Tuple[Path, str]:
    """Returns the folder of the field that a world includes, and the name of the terrain."""
    models = _included_models(world, folders)
    fields = [name for name, model in models.items() if (model / "truth.json").is_file()]
    terrains = [name for name in models if name not in fields and is_ground(models[name])]
    for what, names in (("fields with truth.json", fields), ("terrains", terrains)):
        if len(names) != 1:
            which = f" ({', '.join(names)})" if names else ""
            raise GeneratorError(f"{world}: found {len(names)} {what}{which}, expected one include")
    return models[fields[0]], terrains[0]


def _check_places(world: Path, field: Path, terrain: str) -> None:
    """Raises GeneratorError if an include has moved the field or the terrain from where the truth has them."""
    planned = {field.name: own_pose((field / "model.sdf").read_text()), terrain: (0.0, 0.0, 0.0)}
    for include in ElementTree.parse(world).iterfind("world/include"):
        name = (include.findtext("uri") or "").strip()[len("model://") :]
        pose = include.findtext("pose")
        if name not in planned or pose is None:
            continue
        x, y, yaw = planned[name]
        try:
            off = np.array(pose.split(), dtype=float) - (x, y, 0.0, 0.0, 0.0, yaw)
            off[5] = math.remainder(off[5], math.tau)
        except ValueError:
            off = np.array([np.inf])
        if not (np.abs(off) < _PLACE_TOLERANCE).all():
            expected = f"expected {x:g} {y:g} 0 0 0 {yaw:g}, for which its truth was written"
            raise GeneratorError(f"{world}: found {name} included at {pose.strip()}, {expected}")


def _sow(
    plan: Path, seed: int, folder: Path, changes: Mapping[str, object], models: Sequence[Path]
) -> None:
    values = with_changes(yaml_values(plan), dict(changes))
    values["model_path"] = (*values.get("model_path", ()), *map(str, models))
    values.update(name=plan.stem, output=str(folder), seed=seed)
    make_configured(values, has_map=False)


def start_near(start: Start, seed: int) -> Pose:
    """Returns the start pose with a person's inaccuracy, drawn from the seed."""
    rng = np.random.default_rng(np.random.SeedSequence(seed, spawn_key=(5,)))
    aside, turn = rng.standard_normal(2) * (START_SD_M, START_SD_RAD)
    x = start.x_m - np.sin(start.yaw_rad) * aside
    y = start.y_m + np.cos(start.yaw_rad) * aside
    return Pose(float(x), float(y), float(start.yaw_rad + turn))


def scenario_paths(share: Path, name: str) -> Tuple[Path, Optional[Path]]:
    """Returns world and plan, if any, of a scenario of config/scenarios.yaml; `share` is ardee_world's folder."""
    scenarios = read_yaml_lines(share / "config" / "scenarios.yaml")
    if name not in scenarios:
        raise GeneratorError(f"scenario: found {name!r}, {known_names(name, scenarios)}")
    world, plan = scenarios[name]["world"], scenarios[name]["plan"]
    return share / "worlds" / world, share / "fields" / plan if plan else None


def prepare(
    world: Path,
    plan: Optional[Path],
    seed: int,
    folder: Path,
    changes: Mapping[str, object] = MappingProxyType({}),
    more_models: Sequence[Path] = (),
) -> Trial:
    """Sows the field of a plan, if given, in a folder of models; finds truth, start and ground of the world.

    `changes` replace options of the plan; `more_models` are folders of models besides those of GAZEBO_MODEL_PATH.
    """
    if not world.is_file():
        raise GeneratorError(f"{world}: no such world")
    if plan:
        folder.mkdir(parents=True, exist_ok=True)
        _sow(plan, seed, folder, changes, more_models)
    models = [folder] if plan else []
    folders = search_path([*models, *more_models])
    field, terrain = field_and_terrain(world, folders)
    _check_places(world, field, terrain)
    truth = read_field(field / "truth.json")
    start = build(Start, read_yaml_lines(world.with_suffix(".start.yaml")))
    return Trial(world, models, truth, start_near(start, seed), ground_model(terrain, folders))
