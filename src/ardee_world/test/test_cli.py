# SPDX-License-Identifier: MIT
"""Tests the generators as a person without ROS runs them: a crop, a terrain, a field of both, and a world."""

import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

SOURCES = Path(__file__).resolve().parents[2]
GEOFENCE = SOURCES / "ardee_geofence/default_gps_behavior.geofence"
# Python imports this at its start; ROS's modules are then not to be found.
NO_ROS = """import sys
class NoRos:
    def find_spec(self, name, path=None, target=None):
        if name.startswith(("ros", "catkin", "tf2")) or name.endswith(("_msgs", "_srvs")):
            raise ModuleNotFoundError(f"no module {name}", name=name)
sys.meta_path.insert(0, NoRos())
"""


@pytest.fixture
def cli(tmp_path):
    """Returns a function that runs a command in an empty folder, without ROS, and returns what it did."""
    (tmp_path / "sitecustomize.py").write_text(NO_ROS)
    packages = [SOURCES / name / "src" for name in ("ardee_common", "ardee_models", "ardee_world")]
    path = os.pathsep.join(map(str, [tmp_path, *packages]))
    env = {"HOME": str(tmp_path), "PATH": "/usr/bin:/bin", "PYTHONPATH": path}

    def run(*words: object) -> subprocess.CompletedProcess:
        command = [sys.executable, "-m", "ardee_world.cli", *map(str, words)]
        return subprocess.run(command, env=env, cwd=tmp_path, capture_output=True, text=True)

    return run


def test_a_world_is_made_without_ros(cli, tmp_path):
    field = ["--models", "my_corn", "--model-path", "models", "--terrain", "my_ground"]
    field += [
        "--rows-per-plot",
        2,
        "--stalks-per-row",
        3,
        "--emergence-min",
        1,
        "--emergence-max",
        1,
    ]
    for words in (
        ["generate_crop", "--stage", "V3", "--name", "my_corn", "--output", "models"],
        ["generate_terrain", "--samples", 33, "--name", "my_ground", "--output", "models"],
        ["generate_field", *field, "--name", "my_field", "--output", "models"],
        ["assemble_world", "models/my_field", "models/my_ground", GEOFENCE]
        + ["--model-path", "models", "--output", "world"],
    ):
        done = cli(*words)
        assert done.returncode == 0, done.stderr
    world = tmp_path / done.stdout.strip()
    assert ElementTree.parse(world).find("world/include/uri") is not None
    assert len((tmp_path / "models/my_field/truth.csv").read_text().splitlines()) == 1 + 2 * 3


def test_bad_words_are_refused_in_one_line_that_names_what_is_there(cli):
    for words, message in (
        (["generate_feild"], "ardee_world.cli: unknown command 'generate_feild'"),
        ([], "the following arguments are required: COMMAND"),
        (["generate_field", "--nmae", "x"], "generate_field: unknown argument '--nmae'"),
    ):
        done = cli(*words)
        assert done.returncode == 2 and message in done.stderr and done.stderr.count("\n") == 1


def test_without_ros_there_is_no_rospkg(cli, tmp_path):
    env = {"PYTHONPATH": str(tmp_path), "PATH": "/usr/bin:/bin"}
    done = subprocess.run([sys.executable, "-c", "import rospkg"], env=env, capture_output=True)
    assert b"no module rospkg" in done.stderr
