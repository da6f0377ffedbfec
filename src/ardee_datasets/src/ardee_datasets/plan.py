# SPDX-License-Identifier: MIT
"""The plan of a data set: its scenes with their seeds, and the random streams of each."""

import hashlib
from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Optional

import numpy as np
from ardee_sim import Daylight

from ardee_datasets.light import LightKeys
from ardee_datasets.recipe import FieldKeys, Recipe


@dataclass(frozen=True)
class Scene:
    """A field of the data set, whose pictures one task takes."""

    name: str
    keys: FieldKeys
    seed: int
    light_keys: Optional[LightKeys] = None

    def light(self) -> Optional[Daylight]:
        """Returns the light over the field, if the recipe has some."""
        return self.light_keys.draw(stream(self.seed, "light")) if self.light_keys else None

    def options(self) -> Dict[str, Any]:
        """Returns the options of its field: the fixed ones, and those drawn from ranges."""
        made = dict(self.keys.options or {})
        for key, (low, high) in sorted((self.keys.ranges or {}).items()):
            rng = stream(self.seed, key)
            if isinstance(low, int) and isinstance(high, int):
                made[key] = int(rng.integers(low, high + 1))
            else:
                made[key] = round(float(rng.uniform(low, high)), 6)
        return made


@dataclass(frozen=True)
class Shot:
    """A picture to be taken; its id is unique in the data set."""

    id: str
    camera: str
    seed: int
    robot: str = ""  # which carries the camera; empty: none
    place: int = 0  # of the robot's places along its lane


def child_seed(seed: int, *names: object) -> int:
    """Returns the seed of a named stream below another seed."""
    text = "/".join(map(str, (seed, *names)))
    return int.from_bytes(hashlib.sha256(text.encode()).digest()[:4], "little")


def stream(seed: int, *names: object) -> np.random.Generator:
    """Returns the random stream of this name."""
    return np.random.default_rng(child_seed(seed, *names))


def scenes(recipe: Recipe) -> List[Scene]:
    """Returns all scenes, in the order of their names."""
    made = []
    for name, keys in sorted(recipe.fields.items()):
        for number in range(keys.fields):
            scene = f"{name}_{number:04d}"
            seed = child_seed(recipe.seed, "field", scene)
            made.append(Scene(scene, keys, seed, recipe.light))
    return made


def shots(recipe: Recipe, scene: Scene) -> Iterator[Shot]:
    """Yields the pictures of a scene, in the order of their ids."""
    wanted = scene.keys.cameras or (*(recipe.cameras or ()), *(recipe.robots or ()))
    places = range(scene.keys.frames)
    views = [
        (name, "", k) for name in sorted(recipe.cameras or ()) if name in wanted for k in places
    ]
    for robot, read in sorted((recipe.robots or {}).items()):
        if robot in wanted:
            views += [(camera, robot, k) for k in places for camera in read.cameras]
    for frame, (camera, robot, k) in enumerate(views):
        seed = child_seed(scene.seed, "shot", frame)
        yield Shot(f"{scene.name}_{frame:06d}", camera, seed, robot, k)
