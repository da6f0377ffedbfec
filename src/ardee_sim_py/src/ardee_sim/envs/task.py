# SPDX-License-Identifier: MIT
"""The interface between an environment and its task, and what all tasks share."""

import math
from dataclasses import dataclass, field
from typing import Any, Dict, FrozenSet, Protocol, Tuple, Type

import numpy as np
from ardee_sim.envs.fields import SownField
from ardee_sim.errors import ArdeeError
from ardee_sim.readings import Reading
from ardee_sim.simulation import Simulation
from ardee_sim.state import State
from gymnasium import spaces

from ardee_world.row_truth import Deviation, Lane, Pose


@dataclass(frozen=True)
class Scene:
    """A robot in a field during an episode."""

    sim: Simulation
    robot: str
    sown: SownField
    plants: FrozenSet[str] = field(repr=False)

    def state(self) -> State:
        """Returns the robot's true state."""
        return self.sim.state(self.robot)

    def pose(self) -> Pose:
        """Returns the robot's true pose on the ground plan."""
        state = self.state()
        return Pose(float(state.xyz_m[0]), float(state.xyz_m[1]), state.yaw_rad)

    def reading(self, topic: str) -> Any:
        """Returns the last reading of a topic of the task; its class is that of the topic."""
        reading = self.sim.latest(topic)
        if reading is None:
            raise ArdeeError(f"{topic}: found no reading in a control period, expected one")
        return reading

    def check_kinds(self, **arguments: Tuple[str, Type[Reading]]) -> None:
        """Raises ArdeeError unless the topic of each argument of the task has readings of its class."""
        for name, (topic, kind) in arguments.items():
            found = type(self.reading(topic)).__name__
            if found != kind.__name__:
                raise ArdeeError(
                    f"{name}: found '{topic}' of {found}, expected a topic of {kind.__name__}"
                )

    def touches_plant(self) -> bool:
        """Returns whether the robot has touched a plant since the last call."""
        for names in self.sim.touched():
            mine = [name.startswith(f"{self.robot}::") for name in names]
            others = (name for name, is_mine in zip(names, mine) if not is_mine)
            if any(mine) and any(_model(name) in self.plants for name in others):
                return True
        return False


def _model(collision: str) -> str:
    return collision.rsplit("::", 2)[0]


class Task(Protocol):
    """What an environment asks of its task."""

    @property
    def topics(self) -> Tuple[str, ...]:
        """Topics that are demanded for the end of each control period."""

    def start(self, sown: SownField, rng: np.random.Generator) -> Pose:
        """Returns where the robot starts, drawn from `rng`."""

    def begin(self, scene: Scene) -> None:
        """Starts an episode: the robot stands at its start."""

    def space(self, scene: Scene) -> spaces.Space:
        """Returns the space of observations; the robot has readings of all topics."""

    def observe(self, scene: Scene) -> Any:
        """Returns the observation at the end of a control period."""

    def reward(self, scene: Scene) -> Dict[str, float]:
        """Returns the terms of the reward of a control period by name; called before end()."""

    def end(self, scene: Scene) -> Tuple[str, float]:
        """Returns the reason for which the episode ends, or "", and the reward for that."""


def near_lane(
    lane: Lane, along_m: float, rng: np.random.Generator, sd: Tuple[float, float]
) -> Pose:
    """Returns a pose on a lane's centre line, displaced to the side and turned with standard deviations [m, rad]."""
    on = lane.centre.at(along_m)
    aside, turn = rng.standard_normal(2) * sd
    x, y = on.x_m - math.sin(on.yaw_rad) * aside, on.y_m + math.cos(on.yaw_rad) * aside
    return Pose(float(x), float(y), float(on.yaw_rad + turn))


def has_left(here: Deviation) -> bool:
    """Returns whether the robot's middle is beyond a row, or the robot is turned against the lane."""
    return min(here.left_m, here.right_m) < 0.0 or abs(here.heading_rad) > math.pi / 2
