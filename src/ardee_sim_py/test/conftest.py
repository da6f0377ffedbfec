# SPDX-License-Identifier: MIT
"""A field and a robot, read once; environments."""
from typing import Any, Callable, Iterator, List

import ardee_sim
import gymnasium
import pytest
from ardee_sim.envs import FieldEnv

ON_WHEELS_M = (0.0, 0.0, 0.175)


@pytest.fixture(scope="session")
def corn() -> ardee_sim.World:
    return ardee_sim.World.from_file("corn.world")


@pytest.fixture(scope="session")
def terrasentia() -> str:
    return ardee_sim.robot("tsv1_default")


@pytest.fixture
def sim(corn: ardee_sim.World, terrasentia: str) -> Iterator[ardee_sim.Simulation]:
    """Yields a TerraSentia before the first lane of corn.world, looking along it."""
    with ardee_sim.Simulation(corn, seed=1) as made:
        made.spawn("robot", terrasentia, xyz_m=ON_WHEELS_M, rpy_rad=(0, 0, -3.14))
        yield made


@pytest.fixture
def make() -> Iterator[Callable[..., FieldEnv]]:
    """Yields a function that makes an environment without wrappers; a small picture, a kept field."""
    made: List[FieldEnv] = []

    def one(name: str = "RowFollow", **arguments: Any) -> FieldEnv:
        if "Camera" in name:
            arguments = {"width_px": 32, "height_px": 24, **arguments}
        env = gymnasium.make(f"ardee/{name}-v0", **{"seed_field": False, **arguments})
        made.append(env.unwrapped)
        return env.unwrapped

    yield one
    for env in made:
        env.close()
