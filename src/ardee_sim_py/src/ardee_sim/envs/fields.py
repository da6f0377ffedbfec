# SPDX-License-Identifier: MIT
"""Fields of environments: a scenario of ardee_world, sown anew from a seed, or a world that stays as it is."""

import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Optional

from ardee_sim import packages
from ardee_sim.envs.randomise import Numbers, plan_values, with_scene
from ardee_sim.errors import ArdeeError
from ardee_sim.world import PathLike, World

from ardee_common.errors import GeneratorError
from ardee_world.trial import Trial, prepare, scenario_paths


@dataclass(frozen=True)
class SownField:
    """A world, and the truth of the field in it."""

    world: World
    trial: Trial


class FieldSource:
    """Makes the fields of an environment, in a temporary folder.

    scenario : name in config/scenarios.yaml of ardee_world
    world : path of a world of yours instead, with its .start.yaml beside it; it is never sown anew
    """

    def __init__(self, scenario: Optional[str], world: Optional[PathLike]) -> None:
        if (scenario is None) == (world is None):
            raise ArdeeError(f"found {scenario=} and {world=}, expected one of them")
        self._folder = tempfile.TemporaryDirectory(prefix="ardee_env_")
        self._plan: Optional[Path] = None
        if world is not None:
            self._world = Path(world).resolve()
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

    def load(self, seed: int, drawn: Numbers) -> SownField:
        """Returns the field of a seed, with the drawn numbers in its plan, light and ground."""
        models = [Path(name) for name in packages.model_folders()]
        try:
            trial = prepare(
                self._world, self._plan, seed, self.folder / "models", plan_values(drawn), models
            )
            trial = with_scene(trial, drawn, self.folder, models)
        except GeneratorError as error:
            raise ArdeeError(str(error)) from error
        return SownField(World.from_file(trial.world, model_paths=trial.models), trial)

    def close(self) -> None:
        """Deletes the folder."""
        self._folder.cleanup()
