# SPDX-License-Identifier: MIT
"""The robot as the tests see it."""
import pathlib
import sys

import pytest

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PACKAGE.parent / "ardee_sensors/test"))
sys.path.insert(0, str(PACKAGE / "test"))

from robot_urdf import Robot  # noqa: E402
from xacro_runner import expand  # noqa: E402


@pytest.fixture(scope="session")
def robot() -> Robot:
    """TerraSentia v1 without a namespace."""
    return Robot(expand(PACKAGE / "robots/tsv1_default.urdf.xacro"))
