# SPDX-License-Identifier: MIT
"""Tests the installed C++ library as a user's program links it: the examples, built out of tree."""
import pathlib
import re
import subprocess
from typing import List

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[1]
EXAMPLES = ROOT / "src" / "ardee_sim_cpp" / "examples"
SLOPE_RAD = 0.2  # the slope in custom_sensor/main.cpp


def run(*command: object) -> str:
    """Runs a command and returns its output; fails with that output if the command fails."""
    done = subprocess.run(
        [str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    assert done.returncode == 0, done.stdout
    return done.stdout


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """Returns the folder with the examples' programs."""
    folder = tmp_path_factory.mktemp("library")
    run("cmake", "--install", ROOT / "build" / "ardee_sim_cpp", "--prefix", folder / "installed")
    prefix = f"-DCMAKE_PREFIX_PATH={folder / 'installed'}"
    run("cmake", "-S", EXAMPLES, "-B", folder / "build", prefix)
    run("cmake", "--build", folder / "build")
    return folder / "build"


def numbers(line: str) -> List[float]:
    return [float(found) for found in re.findall(r"-?\d+\.?\d*(?:e-?\d+)?", line)]


def test_a_sensor_of_ones_own_measures(built: pathlib.Path) -> None:
    roll_rad, pitch_rad = numbers(run(built / "custom_sensor"))
    assert abs(roll_rad) < 0.01
    assert abs(pitch_rad - SLOPE_RAD) < 0.01


def test_the_smallest_program_drives(built: pathlib.Path, tmp_path: pathlib.Path) -> None:
    assert len((EXAMPLES / "minimal.cpp").read_text().splitlines()) <= 40
    robots = ROOT / "src" / "terrasentia_description" / "robots"
    robot = tmp_path / "robot.urdf"
    robot.write_text(run("rosrun", "xacro", "xacro", robots / "tsv1_default.urdf.xacro"))
    world = ROOT / "src" / "ardee_world" / "worlds" / "empty.world"
    lines = run(built / "minimal", world, robot).splitlines()
    assert len(lines) == 10
    assert 4.5 < numbers(lines[-1])[1] < 5.05
