# SPDX-License-Identifier: MIT
"""Fields of environments: a scenario of ardee_world, sown anew from a seed, or a world that stays as it is."""

import tempfile
from dataclasses import dataclass
from itertools import combinations_with_replacement, product
from pathlib import Path
from typing import Any, Dict, Iterator, List, Optional, Sequence, Tuple

from ardee_sim import checks, packages
from ardee_sim.envs.arguments import refusals
from ardee_sim.envs.randomise import SCENE, STAGE, Numbers, Ranges, plan_values, with_scene
from ardee_sim.errors import ArdeeError
from ardee_sim.world import PathLike, World

from ardee_common.errors import GeneratorError
from ardee_models.lookup import crop_model, search_path
from ardee_models.plant.crops import make_crop
from ardee_models.plant.species import load_params, load_species
from ardee_world.request import configure, with_changes, yaml_values
from ardee_world.trial import Trial, prepare, scenario_paths


@dataclass(frozen=True)
class SownField:
    """A world, and the truth of the field in it."""

    world: World
    trial: Trial


class FieldSource:
    """Makes the fields of an environment, in a temporary folder.

    scenario : name in config/scenarios.yaml of ardee_world
    world : path of a world of yours instead, with its .start.yaml beside it, or a shipped one's name; never resown
    """

    def __init__(self, scenario: Optional[str], world: Optional[PathLike]) -> None:
        if (scenario is None) == (world is None):
            raise ArdeeError(f"found {scenario=} and {world=}, expected one of them")
        self._folder = tempfile.TemporaryDirectory(prefix="ardee_env_")
        self._plan: Optional[Path] = None
        if world is not None:
            with refusals():
                name = checks.path(world, "world")
            found = name if Path(name).is_file() else World.from_file(name).path
            self._world = Path(found).resolve()
            return
        try:
            share = packages.find_package("ardee_world")
            self._world, self._plan = scenario_paths(share, str(scenario))
        except GeneratorError as error:
            raise ArdeeError(str(error)) from error

    @property
    def is_sown(self) -> bool:
        """Whether a seed changes the field."""
        return self._plan is not None

    @property
    def folder(self) -> Path:
        """A folder of the environment's own, until close()."""
        return Path(self._folder.name)

    def _stages(self, leaves: float) -> Iterator[Tuple[str, str]]:
        """Yields species and stage of each plant of the plan's pool if it had that many leaves."""
        models = search_path([Path(name) for name in packages.model_folders()])
        for name in yaml_values(self._plan)["models"] if self._plan else ():
            species = crop_model(name, models).species
            yield species, f"{load_species(species)[0].counters[0]}{round(leaves)}"

    def check_stages(self, leaves: Sequence[float]) -> None:
        """Raises ArdeeError unless the field's species have these numbers of leaves at some stage."""
        try:
            for number in leaves:
                for species, stage in self._stages(number):
                    load_params(species, stage)
        except GeneratorError as error:
            raise ArdeeError(f"randomise: {STAGE}: {error}") from error

    def check_plan(self, ranges: Ranges) -> None:
        """Raises ArdeeError unless the field's plan can have the ends of each range, and of each two ranges."""
        ranges = {name: ends for name, ends in ranges.items() if name not in (*SCENE, STAGE)}
        if self._plan is None or not ranges:
            return
        plan: Dict[str, Any] = {**yaml_values(self._plan), "name": self._plan.stem}
        middle = {name: (low + high) / 2 for name, (low, high) in ranges.items()}
        try:
            for one, other in combinations_with_replacement(ranges, 2):
                for ends in product(ranges[one], ranges[other]):
                    drawn = {**middle, **dict(zip((one, other), ends))}
                    configure(with_changes(plan, plan_values(drawn)))
        except GeneratorError as error:
            raise ArdeeError(f"randomise: {error}") from error

    def _grow(self, leaves: float) -> Tuple[str, ...]:
        """Returns the names of a pool of plants with that many leaves, and makes those that are not there."""
        names: List[str] = []
        for seed, (species, stage) in enumerate(self._stages(leaves), 1):
            names.append(f"{species}_{stage}_{seed}")
            if not (self.folder / "models" / names[-1]).is_dir():
                make_crop(species, stage, seed, names[-1], self.folder / "models")
        return tuple(names)

    def load(self, seed: int, drawn: Numbers) -> SownField:
        """Returns the field of a seed, with the drawn numbers in its plan, light and ground."""
        own = self.folder / "models"
        models = [own, *(Path(name) for name in packages.model_folders())]
        values = plan_values(drawn)
        try:
            if STAGE in drawn:
                values["models"] = self._grow(drawn[STAGE])
            trial = prepare(self._world, self._plan, seed, own, values, models)
            trial = with_scene(trial, drawn, self.folder, models)
        except GeneratorError as error:
            raise ArdeeError(str(error)) from error
        return SownField(World.from_file(trial.world, model_paths=trial.models), trial)

    def close(self) -> None:
        """Deletes the folder."""
        self._folder.cleanup()
