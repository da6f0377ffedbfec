# SPDX-License-Identifier: MIT
"""Domain randomisation: the names of what may be drawn for an episode, and what scene numbers change."""

import contextlib
import math
import re
import shutil
from dataclasses import replace
from numbers import Real
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple
from xml.etree import ElementTree

import numpy as np
from ardee_sim import checks
from ardee_sim.envs.arguments import mapping
from ardee_sim.errors import ArdeeError

from ardee_common.errors import known_names
from ardee_models.lookup import find_model, search_path
from ardee_world.request import all_fields
from ardee_world.trial import Trial, field_and_terrain

Ranges = Mapping[str, Tuple[float, float]]
Numbers = Mapping[str, float]

# Numbers of the scene, with their bounds; all others are numbers of a field's plan.
SCENE = {
    "noise_scale": (0.0, 100.0),  # factor of standard deviations and drifts of the robot's sensors
    "sun_azimuth_rad": (-2 * math.pi, 2 * math.pi),  # where the light comes from, from x to y
    "sun_elevation_rad": (0.01, math.pi / 2),
    "sun_intensity": (0.0, 10.0),  # factor of the sun's colour
    "ambient": (0.0, 1.0),  # grey level of the light from everywhere
    "ground_friction": (0.0, 10.0),  # Coulomb's coefficient; the lesser one of two surfaces acts
}
# Leaves of a sown field's plants, rounded: with a visible collar (corn, sorghum), or all visible ones (tobacco).
STAGE = "stage"
_FILES = ("uri", "diffuse", "normal", "filename")  # of a world, which may be relative to it
_NOISE = re.compile(
    r"(<(?:stddev|bias_stddev|dynamic_bias_stddev|noiseGrowth|\w*[gG]aussianNoise|\w*[dD]rift)>)([^<]+)(?=</)"
)


def plan_names() -> Sequence[str]:
    """Returns the names of a sown field's numbers: those of its plan, where `emergence` sets both bounds, and STAGE."""
    numbers = {
        name
        for name, (_, option) in all_fields().items()
        if option.type in (int, float, Optional[float])
    }
    return sorted(numbers - {"seed", "emergence_min", "emergence_max"} | {"emergence", STAGE})


def check_ranges(ranges: Ranges, is_sown: bool, argument: str = "randomise") -> None:
    """Raises ArdeeError unless each name is one of SCENE or of a sown field's plan, and each range is one."""
    known = [*SCENE, *plan_names()]
    for name, given in mapping(ranges, argument).items():
        if name not in known:
            raise ArdeeError(f"{argument}: found '{name}', {known_names(str(name), known)}")
        if name not in SCENE and not is_sown:
            raise ArdeeError(f"{argument}: found '{name}' for a field that is not sown anew")
        least, greatest = SCENE.get(name, (-math.inf, math.inf))
        if not _is_range(given) or not least <= given[0] <= given[1] <= greatest:
            bounds = f" within {least:g} and {greatest:g}" if name in SCENE else ""
            raise ArdeeError(
                f"{argument}: {checks.found(given, name)}, expected least and greatest value{bounds}"
            )


def _is_range(given: Any) -> bool:
    ends = given.tolist() if isinstance(given, np.ndarray) else given
    is_pair = isinstance(ends, (list, tuple)) and len(ends) == 2
    return is_pair and all(isinstance(end, Real) and math.isfinite(end) for end in ends)


def plan_values(drawn: Numbers) -> Dict[str, object]:
    """Returns options of a field's plan from drawn numbers; whole ones where the plan counts."""
    values: Dict[str, object] = {}
    for name, value in drawn.items():
        if name == "emergence":
            values.update(emergence_min=value, emergence_max=value)
        elif name not in (*SCENE, STAGE):
            is_count = all_fields()[name][1].type is int
            values[name] = round(value) if is_count else value
    return values


def with_noise(robot: str, scale: float) -> str:
    """Returns a robot's description whose sensors have `scale` times the standard deviations and drifts."""

    def scaled(found: "re.Match[str]") -> str:
        try:
            numbers = [float(value) for value in found[2].replace(",", " ").split()]
        except ValueError:  # in a comment, or for the simulator to refuse
            return found[0]
        return found[1] + " ".join(str(value * scale) for value in numbers)

    return robot if scale == 1.0 else _NOISE.sub(scaled, robot)


def with_scene(trial: Trial, drawn: Numbers, folder: Path, models: Sequence[Path]) -> Trial:
    """Returns the trial with another sun and another ground, in files of `folder`, as drawn numbers say."""
    if "ground_friction" in drawn:
        ground = _ground(trial, drawn["ground_friction"], folder / "ground", models)
        trial = replace(trial, models=[ground, *trial.models])
    if not {"sun_azimuth_rad", "sun_elevation_rad", "sun_intensity", "ambient"} & set(drawn):
        return trial
    tree = ElementTree.parse(trial.world)
    _change_light(tree, drawn, trial.world)
    for node in tree.iter():
        file = trial.world.parent / (node.text or "").strip()
        if node.tag in _FILES and file.is_file():
            node.text = str(file)
    world = folder / "drawn.world"
    tree.write(world)
    shutil.copyfile(trial.world.with_suffix(".start.yaml"), world.with_suffix(".start.yaml"))
    return replace(trial, world=world)


def _numbers(node: ElementTree.Element, counts: Sequence[int], file: Path) -> List[float]:
    """Returns the numbers of an element, as many as one of the counts."""
    with contextlib.suppress(ValueError):
        numbers = [float(value) for value in (node.text or "").split()]
        if len(numbers) in counts:
            return numbers
    expected = " or ".join(map(str, counts))
    raise ArdeeError(f"{file}: <{node.tag}>: found {node.text!r}, expected {expected} numbers")


def _change_light(tree: ElementTree.ElementTree, drawn: Numbers, file: Path) -> None:
    sun, scene = tree.find("world/light[@type='directional']"), tree.find("world/scene")
    if sun is None or scene is None:
        raise ArdeeError(f"{file}: found no directional <light> or no <scene>, expected both")
    direction = _child(sun, "direction", "0 0 -1")
    x, y, z = _numbers(direction, (3,), file)
    azimuth = drawn.get("sun_azimuth_rad", math.atan2(-y, -x))
    elevation = drawn.get("sun_elevation_rad", math.atan2(-z, math.hypot(x, y)))
    flat = -math.cos(elevation)
    direction.text = f"{flat * math.cos(azimuth)} {flat * math.sin(azimuth)} {-math.sin(elevation)}"
    colour = _child(sun, "diffuse", "1 1 1 1")
    red, green, blue, *alpha = _numbers(colour, (3, 4), file)
    bright = drawn.get("sun_intensity", 1.0)
    colour.text = " ".join(map(str, (bright * red, bright * green, bright * blue, *alpha)))
    if "ambient" in drawn:
        _child(scene, "ambient", "").text = " ".join([str(drawn["ambient"])] * 3 + ["1"])


def _ground(trial: Trial, friction: float, folder: Path, models: Sequence[Path]) -> Path:
    """Returns the folder of a copy of the terrain's model that has another friction."""
    folders = search_path([*trial.models, *models])
    terrain = field_and_terrain(trial.world, folders)[1]
    source, copy = find_model(terrain, folders), folder / terrain
    if not copy.is_dir():
        copy.mkdir(parents=True)
        for entry in source.iterdir():
            if entry.name != "model.sdf":
                (copy / entry.name).symlink_to(entry.resolve())
    tree = ElementTree.parse(source / "model.sdf")
    for collision in tree.iter("collision"):
        node = collision
        for name in ("surface", "friction", "ode"):
            node = _child(node, name, "")
        for name in ("mu", "mu2"):
            _child(node, name, "").text = str(friction)
    tree.write(copy / "model.sdf")
    return folder


def _child(parent: ElementTree.Element, name: str, text: str) -> ElementTree.Element:
    """Returns the child of that name, made with `text` if there is none."""
    found = parent.find(name)
    if found is None:
        found = ElementTree.SubElement(parent, name)
        found.text = text
    return found
