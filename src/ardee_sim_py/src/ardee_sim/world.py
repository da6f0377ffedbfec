# SPDX-License-Identifier: MIT
"""A world as data: fields, terrain, light."""

import csv
import os
from collections.abc import Sequence as SequenceABC
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple, TypedDict, Union

import numpy as np
from ardee_sim import _core, checks, packages
from ardee_sim.errors import ArdeeError

from ardee_common.errors import GeneratorError

PathLike = Union[str, "os.PathLike[str]"]
_MOST_MODELS = 16  # that stay loaded
_SPECIES = {1: "corn", 2: "sorghum", 3: "tobacco"}
_NUMBERS = ("id", "plot", "row", "place")  # columns of truth.csv


def read_text(file: PathLike) -> str:
    """Returns a file's text. Raises ArdeeError if it cannot be read."""
    try:
        return Path(file).read_text()
    except (OSError, UnicodeDecodeError) as error:
        raise ArdeeError(f"{file}: {error}, expected a text file") from None


class StartPose(TypedDict):
    """Pose at which a robot starts, as arguments of Simulation.spawn()."""

    xyz_m: Tuple[float, float, float]
    rpy_rad: Tuple[float, float, float]


@dataclass(frozen=True)
class Plant:
    """A crop plant, as the world has it; plot, row, place, stage and height are those of its field's truth.csv.

    `instance` is its number in instance pictures. A plant of a field without truth.csv has None there, and no height.
    """

    name: str
    species: str
    xyz_m: np.ndarray
    quat_xyzw: np.ndarray
    scale: float
    instance: int
    id: Optional[int] = None
    plot: Optional[int] = None
    row: Optional[int] = None
    place: Optional[int] = None
    stage: Optional[str] = None
    height_m: Optional[float] = None


@dataclass(frozen=True)
class Placement:
    """A static model of the world, such as corn-field::plant_7; label and instance are its numbers in pictures.

    `visuals` names the parts of it, such as stem and tassel, by their numbers in pictures of visuals.
    """

    name: str
    label: int
    instance: int
    visuals: Dict[int, str]


def _truth_beside(file: str) -> Dict[int, Dict[str, Any]]:
    """Returns what truth.csv beside a field's file says of its plants, by id."""
    path = Path(file).parent / "truth.csv"
    if not path.is_file():
        return {}
    found = {}
    with path.open(newline="", encoding="utf-8-sig") as text:
        lines = csv.DictReader(text)
        try:
            for row in lines:
                known: Dict[str, Any] = {key: int(row[key]) for key in _NUMBERS}
                known.update(stage=row["stage"], height_m=float(row["height_m"]))
                found[known["id"]] = known
        except (KeyError, ValueError, TypeError, csv.Error) as error:
            line = f"{path}:{max(lines.line_num, 1)}"
            expected = f"whole numbers in {', '.join(_NUMBERS)}, a stage, a height_m"
            raise ArdeeError(f"{line}: found {error}, expected {expected}") from None
    return found


def _plant(placement: Tuple[Any, ...], truth: Dict[int, Dict[str, Any]]) -> Plant:
    name, _, xyz_m, quat_xyzw, scale, label, instance, _ = placement
    number = name.rpartition("plant_")[2]
    known = truth.get(int(number), {}) if number.isdigit() else {}
    return Plant(name, _SPECIES[label], xyz_m, quat_xyzw, scale, instance, **known)


class World:
    """A world, read and checked whole; it never changes, and any number of simulations share it.

    Relative files and model:// are searched for in `model_paths` first, then in GAZEBO_MODEL_PATH,
    GAZEBO_RESOURCE_PATH, ROS_PACKAGE_PATH and the data that comes with this module.
    """

    def __init__(self, core: "_core.World") -> None:
        self._core = core
        self._models: Dict[Tuple[str, str], "_core.Model"] = {}
        self._plants: Optional[List[Plant]] = None

    def load_model(self, text: str, file: str) -> "_core.Model":
        """Returns a model for Simulation.spawn(); the last ones stay, for a robot that is spawned again and again."""
        key = text, file
        if key not in self._models:
            if len(self._models) >= _MOST_MODELS:
                self._models.pop(next(iter(self._models)))
            self._models[key] = self._core.load_model(text, file)
        return self._models[key]

    @classmethod
    def from_file(cls, path: PathLike, *, model_paths: Sequence[PathLike] = ()) -> "World":
        """Returns the world of an SDF file, by its path or the name of a shipped world such as corn.world.

        Raises ArdeeError with file, line and element if the file, or one that it refers to, cannot be read.
        """
        name = checks.path(path, "path")
        if os.path.isdir(name):
            raise ArdeeError(f"{name}: found a folder, expected a world's file")
        return cls(_core.World.from_file(name, *cls._folders(model_paths)))

    @classmethod
    def from_string(
        cls, sdf: str, *, base_dir: PathLike = ".", model_paths: Sequence[PathLike] = ()
    ) -> "World":
        """Returns the world of an SDF text; relative files are searched for in `base_dir`."""
        path = os.path.join(checks.path(base_dir, "base_dir"), "world")
        text = checks.text(sdf, "sdf")
        return cls(_core.World.from_string(text, path, *cls._folders(model_paths)))

    @staticmethod
    def _folders(model_paths: Sequence[PathLike]) -> Tuple[List[str], List[str], List[str]]:
        if isinstance(model_paths, str) or not isinstance(model_paths, SequenceABC):
            raise TypeError(
                f"{checks.found(model_paths, 'model_paths')}, expected a list of folders"
            )
        models = [os.path.abspath(checks.path(path, "model_paths")) for path in model_paths]
        for path in models:
            if not os.path.isdir(path):
                raise ArdeeError(f"model_paths: found {path!r}, expected a folder")
        models += packages.model_folders()
        return models, packages.media_folders(), packages.package_folders()

    @property
    def name(self) -> str:
        """Name in the file's <world> element."""
        return self._core.name()

    @property
    def path(self) -> str:
        """File of the world; of a text, a name for messages."""
        return self._core.path()

    @property
    def start(self) -> StartPose:
        """Pose at which a robot starts, as Simulation.spawn() takes it; from NAME.start.yaml beside the world.

        That of a world without such a file is the launch files' own: in the origin, at yaw -3.14.
        Raises ArdeeError if the file is not one of x_m, y_m, z_m, yaw_rad.
        """
        from ardee_world.start import read_start  # half a second, for those alone who ask

        try:
            start = read_start(Path(self.path).with_suffix(".start.yaml"))
        except GeneratorError as error:
            raise ArdeeError(str(error)) from None
        return {"xyz_m": (start.x_m, start.y_m, start.z_m), "rpy_rad": (0.0, 0.0, start.yaw_rad)}

    def placements(self) -> List[Placement]:
        """Returns all static models, in the order of their instance numbers."""
        return [Placement(made[0], *made[5:]) for made in self._core.placements()]

    def plants(self) -> List[Plant]:
        """Returns all crop plants, in the order of their instance numbers; truth.csv is read at the first call.

        Raises ArdeeError with file and line if it is no truth.csv.
        """
        if self._plants is None:
            truths: Dict[str, Dict[int, Dict[str, Any]]] = {}
            found = []
            for placement in self._core.placements():
                file, label = placement[1], placement[5]
                if label in _SPECIES:
                    if file not in truths:
                        truths[file] = _truth_beside(file)
                    found.append(_plant(placement, truths[file]))
            self._plants = found
        return list(self._plants)
