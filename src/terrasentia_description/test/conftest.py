# SPDX-License-Identifier: MIT
"""Fixtures of the robots under test."""
import pathlib
import sys

import pytest

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PACKAGE.parent / "ardee_sensors/test"))
sys.path.insert(0, str(PACKAGE / "test"))

from generations import GENERATIONS, Generation  # noqa: E402
from robot_urdf import Robot  # noqa: E402
from xacro_runner import expand  # noqa: E402


@pytest.fixture(scope="session", params=GENERATIONS, ids=lambda generation: generation.name)
def generation(request: pytest.FixtureRequest) -> Generation:
    """Returns expected numbers of a TerraSentia; each test runs for every generation."""
    return request.param


@pytest.fixture(scope="session")
def robot(generation: Generation) -> Robot:
    """Returns the URDF of the TerraSentia of `generation`, without a namespace."""
    return Robot(expand(PACKAGE / "robots" / generation.file))
