# SPDX-License-Identifier: MIT
"""Plan of a campaign: combinations, replicates, and for each run an identity and a seed that follow from its inputs."""
import contextlib
import hashlib
import itertools
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Tuple

import numpy as np
from ardee_sim.identity import engine_digest, engine_version

from ardee_campaigns import controllers, measures, robot, tables, worlds
from ardee_campaigns.campaign_file import Campaign, CampaignKeys, FactorKeys, Value
from ardee_common.config import Mapping as Placed
from ardee_common.config import read_yaml_lines
from ardee_common.digests import Digests
from ardee_common.errors import GeneratorError

_DIGITS = 16  # of a run_id


@dataclass(frozen=True)
class Cell:
    """A combination: names of a world, a robot and a controller, and the factors' values in the file's order."""

    world: str
    robot: str
    controller: str
    factors: Tuple[Tuple[str, Value], ...]


@dataclass(frozen=True)
class Job:
    """All inputs of one run, for a worker: small values, and files by path."""

    run_id: str
    cell: Cell
    replicate: int
    seed: int
    campaign: Campaign
    files: worlds.WorldFiles
    urdf: Path

    @property
    def field_seed(self) -> int:
        """Returns the seed of the field, of which the generator takes 31 bits."""
        return self.seed if self.campaign.keys.first_seed is not None else self.seed >> 33


def seed_of(keys: CampaignKeys, world: str, replicate: int) -> int:
    """Returns the seed of a run: the same for all robots, controllers and factors, so that runs can be paired."""
    if keys.first_seed is not None:
        return keys.first_seed + replicate
    return int.from_bytes(_digest([keys.seed, world, replicate])[:8], "big")


def _digest(value: Any) -> bytes:
    return hashlib.sha256(json.dumps(value, sort_keys=True).encode()).digest()


def cells(campaign: Campaign) -> List[Cell]:
    """Returns all combinations, in the order of the file."""
    names = (campaign.worlds, campaign.robots, campaign.controllers)
    points = list(_points(campaign))
    return [Cell(*key, point) for key in itertools.product(*names) for point in points]


def _points(campaign: Campaign) -> Iterator[Tuple[Tuple[str, Value], ...]]:
    factors, plan = campaign.factors, campaign.keys.plan
    if plan.points is None:
        values = (factor.values or () for factor in factors.values())
        for chosen in itertools.product(*values):
            yield tuple(zip(factors, chosen))
        return
    rng = np.random.default_rng(np.random.SeedSequence(campaign.keys.seed, spawn_key=(1,)))
    columns = [_stratified(factor, plan.points, rng) for factor in factors.values()]
    points = (tuple(zip(factors, chosen)) for chosen in zip(*columns))
    yield from dict.fromkeys(points)  # listed values may give one twice


def _stratified(factor: FactorKeys, count: int, rng: np.random.Generator) -> List[Value]:
    """Returns values of a factor, one from each of `count` equal parts of its range, in random order."""
    at = (rng.permutation(count) + rng.random(count)) / count
    if factor.values is not None:
        return [factor.values[int(place * len(factor.values))] for place in at]
    return [float(factor.low + (factor.high - factor.low) * place) for place in at]


def factors_of(campaign: Campaign, cell: Cell, kind: str) -> Dict[str, Value]:
    """Returns the values of the factors of a controller, field or robot."""
    return {name: value for name, value in cell.factors if campaign.factors[name].of == kind}


def params_of(campaign: Campaign, cell: Cell) -> Dict[str, Any]:
    """Returns a controller's parameters: its own, over them the world's, over them the factors."""
    world = (campaign.worlds[cell.world].params or {}).get(cell.controller) or {}
    own = campaign.controllers[cell.controller].params or {}
    return {**own, **world, **factors_of(campaign, cell, "controller")}


class Planner:
    """Makes the jobs of a campaign. Its making checks all that can be checked before the first run."""

    def __init__(self, campaign: Campaign) -> None:
        self.campaign = campaign
        self.cells = cells(campaign)
        self._placed = read_yaml_lines(campaign.file)
        self._files: Dict[str, worlds.WorldFiles] = {}
        self._urdfs: Dict[str, str] = {}
        self._engine = engine_digest()
        self._digests = Digests()
        self._parts: Dict[str, str] = {}
        folder = campaign.file.parent
        try:
            measures.check(campaign.keys.measures, list(campaign.factors))
        except GeneratorError as error:
            raise self._placed.error("measures", str(error)) from None
        for name, keys in campaign.worlds.items():
            with _at(self._placed["worlds"], name):
                self._files[name] = worlds.find_files(keys, folder)
                for factors in self._field_factors(name):
                    worlds.check_options(keys, self._files[name], factors, folder)
        self._contents = {
            name: hashlib.sha256(files.content()).hexdigest() for name, files in self._files.items()
        }
        self._check_robots()
        self._sources = {
            name: controllers.source_digest(keys) for name, keys in campaign.controllers.items()
        }
        self._own_measures = {
            name: controllers.function_digest(name)
            for name in campaign.keys.measures
            if ":" in name
        }

    def _field_factors(self, world: str) -> Iterable[Dict[str, Value]]:
        """Returns the different values of the factors of a world's field."""
        made = (
            factors_of(self.campaign, cell, "field") for cell in self.cells if cell.world == world
        )
        return {json.dumps(factors): factors for factors in made}.values()

    def _probe(self, kind: str, name: str) -> Cell:
        return next(cell for cell in self.cells if getattr(cell, kind) == name)

    def _check_robots(self) -> None:
        """Spawns each robot once in an empty world, and makes each controller once for each of them."""
        for name, keys in self.campaign.robots.items():
            place = self._placed if "robots" not in self._placed else self._placed["robots"]
            with _at(place, name):
                told = robot.describe(name, keys, self.urdf(self._probe("robot", name)))
                self._check_rate(told)
            for controller, wanted in self.campaign.controllers.items():
                with _at(self._placed["controllers"], controller):
                    for cell in self.cells:
                        if (cell.robot, cell.controller) == (name, controller):
                            self._try_out(wanted, cell, told)

    def _try_out(self, keys: Any, cell: Cell, told: robot.Robot) -> None:
        params = params_of(self.campaign, cell)
        key = json.dumps([cell.robot, cell.controller, params], sort_keys=True)
        if key in self._urdfs:
            return
        self._urdfs[key] = ""
        try:
            controllers.make(keys, params, told, 0)
        except GeneratorError:
            raise
        except Exception as error:  # of any kind that a user's function raises
            why = " ".join(f"{type(error).__name__}: {error}".split())
            raise GeneratorError(f"factory {keys.factory}: {why}") from None

    def _check_rate(self, told: robot.Robot) -> None:
        for name, files in self._files.items():
            steps = told.period_s / files.step_s()
            if abs(steps - round(steps)) > 1e-6 or steps < 0.5:
                step = f"{files.step_s():g} s, those of world {name}"
                raise GeneratorError(
                    f"found a control period of {told.period_s:g} s, expected whole steps of {step}"
                )

    def urdf(self, cell: Cell) -> str:
        """Returns the URDF of a cell's robot, expanded once for each value of its arguments."""
        factors = factors_of(self.campaign, cell, "robot")
        key = json.dumps([cell.robot, factors], sort_keys=True)
        if key not in self._urdfs:
            keys = self.campaign.robots[cell.robot]
            self._urdfs[key] = robot.expand(keys, factors, self.campaign.file.parent)
        return self._urdfs[key]

    def _parts_digest(self, cell: Cell) -> str:
        """Returns a hash of the files and models of which the world of a cell is made."""
        factors = factors_of(self.campaign, cell, "field")
        key = json.dumps([cell.world, factors], sort_keys=True)
        if key not in self._parts:
            keys, files = self.campaign.worlds[cell.world], self._files[cell.world]
            parts = worlds.parts(keys, files, factors, self.campaign.file.parent)
            self._parts[key] = self._digests.of(parts)
        return self._parts[key]

    def job(self, cell: Cell, replicate: int, folder: Path) -> Job:
        """Returns a run; its robot's description is to be written in `folder`."""
        campaign, keys = self.campaign, self.campaign.keys
        seed = seed_of(keys, cell.world, replicate)
        urdf = self.urdf(cell)
        name = hashlib.sha256(urdf.encode()).hexdigest()[:_DIGITS]
        controller = campaign.controllers[cell.controller]
        world = campaign.worlds[cell.world]
        inputs = {
            "world": [self._contents[cell.world], self._parts_digest(cell)],
            "options": [world.options or {}, factors_of(campaign, cell, "field")],
            "robot": [hashlib.sha256(urdf.encode()).hexdigest(), vars(campaign.robots[cell.robot])],
            "controller": [vars(controller), self._sources[cell.controller]],
            "params": params_of(campaign, cell),
            "names": [cell.world, cell.robot, cell.controller, cell.factors],
            "seed": [seed, replicate],
            "task": [vars(keys.task), keys.limit_sim_s, keys.measures, self._own_measures],
            "engine": self._engine,
        }
        run_id = _digest(inputs).hex()[:_DIGITS]
        files = self._files[cell.world]
        return Job(run_id, cell, replicate, seed, campaign, files, folder / f"{name}.urdf")


@contextlib.contextmanager
def _at(mapping: Placed, key: str) -> Iterator[None]:
    """Puts file and line before the message of an error in the block."""
    try:
        yield
    except (GeneratorError, ValueError) as error:
        raise mapping.error(key, f"{key}: {' '.join(str(error).split())}") from None


def about(campaign: Campaign) -> Mapping[str, str]:
    """Returns the metadata of runs.parquet."""
    keys = campaign.keys
    told = {"name": keys.name, "seed": str(keys.seed), "engine": engine_version()}
    scales = [name for name, factor in campaign.factors.items() if factor.values is None]
    return {**told, tables.SCALES: " ".join(scales)} if scales else told
