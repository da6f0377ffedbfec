# SPDX-License-Identifier: MIT
"""The robots as the tests see them."""
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
    """What the sources say of a TerraSentia; each test runs for every one."""
    return request.param


@pytest.fixture(scope="session")
def robot(generation: Generation) -> Robot:
    """That TerraSentia without a namespace."""
    return Robot(expand(PACKAGE / "robots" / generation.file))
