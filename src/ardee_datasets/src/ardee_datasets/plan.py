# SPDX-License-Identifier: MIT
"""The plan of a data set: its scenes with their seeds, and the pictures of each."""

from dataclasses import dataclass
from typing import Any, Dict, Iterator, List, Optional, Set, Tuple

from ardee_sim import Daylight

from ardee_datasets.field_options import drawn_options
from ardee_datasets.light import LightKeys
from ardee_datasets.recipe import FieldKeys, Recipe
from ardee_datasets.seeds import child_seed, field_seed, scene_name, stream


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
        return drawn_options(self.keys.options or {}, self.keys.ranges or {}, self.seed)


@dataclass(frozen=True)
class Shot:
    """A picture to be taken; its id is unique in the data set."""

    id: str
    camera: str
    seed: int
    robot: str = ""  # which carries the camera; empty: none
    place: int = 0  # of the robot's places along its lane


def scenes(recipe: Recipe) -> List[Scene]:
    """Returns all scenes, in the order of their names."""
    made: List[Scene] = []
    seeds: Set[int] = set()
    for name, keys in sorted(recipe.fields.items()):
        for number in range(keys.fields):
            scene = scene_name(name, number)
            seed = field_seed(recipe.seed, scene)
            while seed in seeds:  # of 32 bits: no two fields of a large set are the same
                seed = field_seed(seed, scene)
            seeds.add(seed)
            made.append(Scene(scene, keys, seed, recipe.light))
    return made


def _carriers(recipe: Recipe, scene: Scene) -> List[Tuple[str, List[str]]]:
    """Returns the names of robots ("": none) that take pictures in a scene, each with those of its cameras."""
    wanted = scene.keys.cameras or (*(recipe.cameras or ()), *(recipe.robots or ()))
    alone = [("", [name]) for name in sorted(recipe.cameras or ()) if name in wanted]
    robots = sorted((recipe.robots or {}).items())
    return alone + [(name, list(robot.cameras)) for name, robot in robots if name in wanted]


def shot_count(recipe: Recipe, scene: Scene) -> int:
    """Returns the number of pictures of a scene."""
    return scene.keys.frames * sum(len(cameras) for _, cameras in _carriers(recipe, scene))


def shots(recipe: Recipe, scene: Scene) -> Iterator[Shot]:
    """Yields the pictures of a scene, in the order of their ids."""
    views = [
        (camera, robot, k)
        for robot, cameras in _carriers(recipe, scene)
        for k in range(scene.keys.frames)
        for camera in cameras
    ]
    for frame, (camera, robot, k) in enumerate(views):
        seed = child_seed(scene.seed, "shot", frame)
        yield Shot(f"{scene.name}_{frame:06d}", camera, seed, robot, k)
