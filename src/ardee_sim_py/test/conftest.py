# SPDX-License-Identifier: MIT
"""A field and a robot, read once."""
from typing import Iterator

import ardee_sim
import pytest

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
