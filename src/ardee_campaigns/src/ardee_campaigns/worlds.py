# SPDX-License-Identifier: MIT
"""Worlds of a campaign: their files, and a field sown in one for a run."""
import contextlib
import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence
from xml.etree import ElementTree

from ardee_sim import packages
from ardee_sim.packages import find_package

from ardee_campaigns.campaign_file import WorldKeys
from ardee_common.errors import GeneratorError, known_names
from ardee_models.lookup import find_model, search_path
from ardee_world import trial
from ardee_world.clutter import KINDS, has_items
from ardee_world.field_config import FieldConfig
from ardee_world.generate_field import make_configured
from ardee_world.request import (
    all_fields,
    checked_values,
    configure,
    placed_values,
    read_paths,
    with_changes,
    yaml_values,
)
from ardee_world.trial import Trial

_OF_A_RUN = ("name", "output", "seed")  # options of a recipe that each run has of its own
_STEP_S = 0.005
_USUAL_STEP_S = 0.001  # of a world that gives none
_WORLD = """<?xml version="1.0"?>
<sdf version="1.5">
  <world name="default">
    <light name="sun" type="directional">
      <pose>0 0 10 0 0 0</pose>
      <direction>-0.3 0.4 -1.0</direction>
    </light>
    <physics type="ode">
      <max_step_size>{step_s}</max_step_size>
      <gravity>0 0 -9.8</gravity>
    </physics>
    <include><uri>model://{terrain}</uri></include>
    <include>
      <uri>model://{name}</uri>
      <pose>{x_m} {y_m} 0 0 0 {yaw_rad}</pose>
    </include>
  </world>
</sdf>
"""


@dataclass(frozen=True)
class WorldFiles:
    """Files of a world: the world itself and the recipe of its field; one of them may be missing."""

    world: Optional[Path]
    plan: Optional[Path]

    def content(self) -> bytes:
        """Returns the bytes of the files, and of the world's start pose."""
        start = self.world.with_suffix(".start.yaml") if self.world else None
        files = (self.world, start if start and start.is_file() else None, self.plan)
        return b"\0".join(file.read_bytes() for file in files if file)

    def step_s(self) -> float:
        """Returns the time of a physics step."""
        if not self.world:
            return _STEP_S
        try:
            text = ElementTree.parse(self.world).findtext("world/physics/max_step_size", "")
        except ElementTree.ParseError as error:
            raise GeneratorError(f"{self.world}: not valid XML: {error}") from None
        return float(text) if text.strip() else _USUAL_STEP_S


def _found(name: str, folder: Path, shipped: Path, what: str) -> Path:
    for file in (folder / Path(name).expanduser(), shipped / name):
        if file.is_file():
            return file.resolve()
    known = [file.name for file in shipped.glob(f"*{Path(name).suffix}")]
    raise GeneratorError(f"{what}: found {name!r}, no such file, and {known_names(name, known)}")


def find_files(keys: WorldKeys, folder: Path) -> WorldFiles:
    """Returns the files of a world; relative ones lie in `folder`, or are shipped."""
    share = find_package("ardee_world")
    if keys.scenario:
        return WorldFiles(*trial.scenario_paths(share, keys.scenario))
    world = keys.world and _found(keys.world, folder, share / "worlds", "world")
    plan = keys.field and _found(keys.field, folder, share / "fields", "field")
    return WorldFiles(world or None, plan or None)


def check_options(
    keys: WorldKeys, files: WorldFiles, factors: Mapping[str, Any], folder: Path
) -> None:
    """Raises GeneratorError for an option that no recipe has, one that the recipe refuses, or a file that is not there.

    Relative paths lie in `folder`.
    """
    known = sorted(set(all_fields()) - set(_OF_A_RUN))
    options = {**(keys.options or {}), **factors}
    for name in options:
        if name in _OF_A_RUN:
            raise GeneratorError(f"options: found {name!r}, which each run has of its own")
        if name not in known:
            raise GeneratorError(f"options: found {name!r}, {known_names(name, known)}")
    if files.plan:
        values = placed_values(checked_values(options), folder)
        for name in values:
            for path in read_paths({name: values[name]}):
                if not path.exists():
                    raise GeneratorError(f"options: {name}: found {str(path)!r}, no such file")
        configure({**with_changes(yaml_values(files.plan), values), "name": files.plan.stem})
    elif options:
        found = f"options: found {', '.join(options)}"
        raise GeneratorError(f"{found} for a world without field recipe, expected a recipe")


def _options(keys: WorldKeys, factors: Mapping[str, Any], folder: Path) -> Dict[str, Any]:
    made = {**(keys.options or {}), **factors}
    made = {name: tuple(v) if isinstance(v, list) else v for name, v in made.items()}
    return placed_values(made, folder)


def parts(
    keys: WorldKeys, files: WorldFiles, factors: Mapping[str, Any], folder: Path
) -> List[Path]:
    """Returns what a world is made of beside its own files: files that its recipe names, and folders of models.

    Relative paths lie in `folder`. A model that is not there, or that the recipe is of, is left out.
    """
    names = trial.included_names(files.world) if files.world else []
    found: List[Path] = []
    own: Sequence[Path] = ()
    if files.plan:
        names = [name for name in names if name != files.plan.stem]
        values = with_changes(yaml_values(files.plan), _options(keys, factors, folder))
        sources, config = configure({**values, "name": files.plan.stem})
        names += [*sources.models, *([sources.terrain] if sources.terrain else [])]
        for kind in KINDS:
            if has_items(kind, config.clutter):
                names += getattr(config.clutter, f"{kind}_models")
        own = [Path(name) for name in values.pop("model_path", ())]
        found = read_paths(values)
    folders = search_path([*own, *map(Path, packages.model_folders())])
    for name in dict.fromkeys(names):
        with contextlib.suppress(GeneratorError):
            found.append(find_model(name, folders))
    return found


def sow(
    keys: WorldKeys,
    files: WorldFiles,
    factors: Mapping[str, Any],
    seed: int,
    folder: Path,
    beside: Path,
) -> Trial:
    """Returns the world of a run; its field is sown in a folder of models.

    factors : options of the recipe; relative paths in them and in the world's options lie in the folder `beside`
    """
    options = _options(keys, factors, beside)
    shipped = [Path(name) for name in packages.model_folders()]
    if files.world:
        return trial.prepare(files.world, files.plan, seed, folder, options, shipped)
    assert files.plan is not None
    values = with_changes(yaml_values(files.plan), options)
    name = files.plan.stem
    values["model_path"] = (*values.get("model_path", ()), *map(str, shipped))
    values.update(name=name, output=str(folder), seed=seed)
    folder.mkdir(parents=True, exist_ok=True)
    make_configured(values, has_map=False)
    world = folder / name / f"{name}.world"
    x_m, y_m, yaw_rad = values.get("world_pose", FieldConfig().world_pose)
    terrain = values.get("terrain") or "ground_plane"
    place = {"x_m": x_m, "y_m": y_m, "yaw_rad": yaw_rad}
    world.write_text(_WORLD.format(step_s=_STEP_S, terrain=terrain, name=name, **place))
    made = trial.prepare(world, None, seed, folder, more_models=[folder, *shipped])
    return dataclasses.replace(made, models=[folder])
