# SPDX-License-Identifier: MIT
"""The recipe of a data set: which fields, seen by which cameras, how often."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable, Dict, Iterable, Optional, Tuple

import yaml
from ardee_sim.packages import find_package

from ardee_common.config import Mapping, build, read_yaml_lines
from ardee_common.errors import GeneratorError, known_names
from ardee_common.options import option
from ardee_datasets.camera import CameraKeys
from ardee_datasets.categories import CATEGORIES, OWN_LABELS
from ardee_datasets.field_options import FIELD, check_field, checked_options, drawn_options
from ardee_datasets.light import LightKeys
from ardee_datasets.ranges import check_ranges
from ardee_datasets.robots import Robot, RobotKeys, check_cameras, read_robot
from ardee_datasets.seeds import field_seed, scene_name

SPLITS = ("train", "val", "test")
_COUNT = (1, 100_000)


@dataclass(frozen=True)
class FieldKeys:
    """Fields of one kind; each is sown anew, and all its pictures belong to one split."""

    split: str = option("train", "part of the data set", choices=SPLITS)
    fields: int = option(1, "number of fields", _COUNT)
    frames: int = option(10, "number of pictures that each camera takes in a field", _COUNT)
    cameras: Tuple[str, ...] = option(
        (), "names of the cameras and robots that take pictures in them; none: all"
    )
    options: Optional[dict] = option(None, "options of generate_field, as in a field's YAML file")
    ranges: Optional[dict] = option(
        None, "options of generate_field that each field draws from [least, most]"
    )


@dataclass(frozen=True)
class LidarKeys:
    """A 3D lidar that stands upright above each camera and looks where that looks."""

    sensor: str = option(dataclasses.MISSING, "3D lidar of ardee_sensors, such as vlp16")
    above_m: float = option(0.1, "height above the camera", (0.0, 5.0))


@dataclass(frozen=True)
class Recipe:
    """A data set; the same recipe gives the same bytes."""

    fields: dict = option(dataclasses.MISSING, "kinds of fields, by name")
    cameras: Optional[dict] = option(None, "cameras, by name")
    robots: Optional[dict] = option(None, "robots that drive with their cameras, by name")
    lidars: Optional[dict] = option(None, "3D lidars, by name")
    light: Optional[dict] = option(None, "light of sun and sky; none: each field has the same noon")
    labels: Optional[dict] = option(
        None,
        f"labels of models of your own, {OWN_LABELS[0]} to {OWN_LABELS[1]}, by the name of their category",
    )
    seed: int = option(0, "root of all random numbers", (0, 2**63))
    licence: str = option("CC0-1.0", "licence of the data set, an SPDX identifier")


def _check_name(given: Mapping, name: str, what: str) -> None:
    if not name.replace("_", "").isalnum() or not name.isascii():
        raise given.error(name, f"{what} {name!r}: expected letters, digits and '_'")


def _named(cls: type, given: Mapping, what: str) -> Dict[str, Any]:
    """Returns the groups of options below names that are safe in file names."""
    made = {}
    for name, keys in given.items():
        _check_name(given, name, what)
        if not isinstance(keys, Mapping):
            raise given.error(name, f"{name}: found {keys!r}, expected a mapping of keys to values")
        check_ranges(cls, keys)
        made[name] = build(cls, keys)
    if not made:
        raise given.error("", f"{what}: found none, expected some")
    return made


def _fields(recipe: Recipe, path: Path) -> Dict[str, FieldKeys]:
    fields = {}
    for name, keys in _named(FieldKeys, recipe.fields, "fields").items():
        try:
            options, ranges = checked_options(keys.options, keys.ranges, recipe.labels)
            for number in range(keys.fields if ranges or options.get("gaps") else 1):
                seed = field_seed(recipe.seed, scene_name(name, number))
                check_field(drawn_options(options, ranges, seed), seed)
        except GeneratorError as error:
            at = recipe.fields.error(name, "")
            text = str(error)
            raise error if text.startswith(str(path)) else GeneratorError(f"{at}{name}: {text}")
        fields[name] = dataclasses.replace(keys, options=options, ranges=ranges)
    return fields


def _sensor(name: str, given: Mapping, is_fit: Callable[[dict], bool]) -> dict:
    """Returns the numbers of a shipped sensor that fits."""
    files = sorted((find_package("ardee_sensors") / "config").glob("*.yaml"))
    numbers = {file.stem: yaml.safe_load(file.read_text()) for file in files}
    known = [sensor for sensor, read in numbers.items() if is_fit(read)]
    if name not in known:
        raise given.error("sensor", f"sensor: found {name!r}, {known_names(name, known)}")
    return numbers[name]


def _with_sensor(keys: CameraKeys, given: Mapping, name: str) -> CameraKeys:
    """Returns the keys with the numbers of a shipped camera where they are not given."""
    if not keys.sensor:
        return keys
    read = _sensor(
        keys.sensor,
        given,
        lambda read: {"width_px", "height_px", "horizontal_fov_deg"} <= set(read),
    )
    changes = {
        key: read[key]
        for key in ("width_px", "height_px", "horizontal_fov_deg")
        if getattr(keys, key) is None
    }
    return dataclasses.replace(keys, **changes)


def _cameras(recipe: Recipe) -> Dict[str, CameraKeys]:
    if not recipe.cameras:
        return {}
    return {
        name: _with_sensor(keys, recipe.cameras[name], name)
        for name, keys in _named(CameraKeys, recipe.cameras, "cameras").items()
    }


def _robots(recipe: Recipe, folder: Path) -> Dict[str, Robot]:
    robots = {}
    for name, keys in (_named(RobotKeys, recipe.robots, "robots") if recipe.robots else {}).items():
        try:
            robots[name] = read_robot(keys, folder)
        except GeneratorError as error:
            assert recipe.robots
            raise recipe.robots[name].error("", str(error)) from None
    return robots


def _lidars(recipe: Recipe) -> Dict[str, LidarKeys]:
    lidars = _named(LidarKeys, recipe.lidars, "lidars") if recipe.lidars else {}
    for name, keys in lidars.items():
        assert recipe.lidars
        _sensor(keys.sensor, recipe.lidars[name], lambda read: read.get("kind") == "lidar_3d")
    return lidars


def _light(given: Mapping) -> LightKeys:
    check_ranges(LightKeys, given)
    for key in ("elevation_deg", "azimuth_deg"):
        if key in given and "times" in given:
            found = f"{key}: found it with times, which tell where the sun stands"
            raise given.error(key, f"{found}; expected one of them")
    return build(LightKeys, given)


def _labels(given: Mapping) -> Dict[str, int]:
    """Returns the recipe's own labels by name."""
    least, greatest = OWN_LABELS
    taken = {category["name"]: category["id"] for category in CATEGORIES}
    for name, label in given.items():
        _check_name(given, name, "labels")
        if not isinstance(label, int) or isinstance(label, bool) or not least <= label <= greatest:
            expected = f"expected a whole number within {least} and {greatest}"
            raise given.error(name, f"labels: {name}: found {label!r}, {expected}")
        if name in taken or label in taken.values():
            found = f"found {name}: {label}, of which one stands for another category"
            raise given.error(name, f"labels: {found}; expected a new name and a new label")
        taken[name] = label
    return dict(given)


def _check_names(recipe: Recipe) -> None:
    """Raises GeneratorError for a name of two things, which samples or the simulation would mix up."""
    for key, others in (
        ("robots", {"the field": (FIELD,), "a camera": recipe.cameras, "a lidar": recipe.lidars}),
        ("lidars", {"the field": (FIELD,)}),
    ):
        given = getattr(recipe, key) or {}
        for other, names in others.items():
            for name in sorted(set(given) & set(names or ())):
                found = f"{key}: found {name!r}, the name of {other} too"
                raise given.error(name, f"{found}; expected another")


def view_name(robot: str, camera: str) -> str:
    """Returns what samples call a camera, of a robot or ("") of none."""
    return f"{robot}_{camera}" if robot else camera


def _check_views(recipe: Recipe, cameras: Iterable[str], robots: Dict[str, Robot]) -> None:
    """Raises GeneratorError for a camera of a robot with the name of another camera in samples."""
    taken = set(cameras)
    for robot, read in robots.items():
        for camera in read.cameras:
            name = view_name(robot, camera)
            if name in taken:
                found = f"robots: found another camera {name} than camera {camera} of robot {robot}"
                assert recipe.robots
                raise recipe.robots.error(robot, f"{found}; expected another name")
            taken.add(name)


def read_recipe(path: Path) -> Recipe:
    """Reads and checks a recipe. Raises GeneratorError with file and line."""
    given = read_yaml_lines(path)
    recipe = build(Recipe, given)
    _check_names(recipe)
    recipe = dataclasses.replace(recipe, labels=_labels(recipe.labels or Mapping("")))
    fields = _fields(recipe, path)
    cameras, robots = _cameras(recipe), _robots(recipe, path.parent)
    if not cameras and not robots:
        raise given.error("", "found neither cameras nor robots, expected some")
    _check_views(recipe, cameras, robots)
    for name, keys in fields.items():
        try:
            check_cameras(keys.cameras, (*cameras, *robots))
        except GeneratorError as error:
            raise recipe.fields[name].error("cameras", str(error)) from None
    lidars = _lidars(recipe)
    light = _light(recipe.light) if recipe.light is not None else None
    return dataclasses.replace(
        recipe, fields=fields, cameras=cameras, robots=robots, lidars=lidars, light=light
    )
