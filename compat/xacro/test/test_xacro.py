# SPDX-License-Identifier: MIT
"""The xacro stand-in: ROS 1's substitutions, where its module comes from, what it says when that is missing."""
import os
import pathlib
import shutil
import subprocess
import sys

import pytest

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
HEAD = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">'


def run(script: pathlib.Path, *arguments: str, **environment: str) -> subprocess.CompletedProcess:
    """Run a script of the package."""
    variables = dict(os.environ, ROS_PACKAGE_PATH=str(PACKAGE), **environment)
    command = ["/usr/bin/python3", str(script), *arguments]
    return subprocess.run(command, env=variables, capture_output=True, text=True)


def write(folder: pathlib.Path, body: str) -> str:
    """Path of a xacro file with this body."""
    file = folder / "robot.xacro"
    file.write_text(f"{HEAD}{body}</robot>")
    return str(file)


@pytest.mark.parametrize("script", ["xacro", "xacro.py"])
def test_substitutions_are_those_of_roslaunch(tmp_path: pathlib.Path, script: str):
    body = (
        '<xacro:arg name="side" default="left"/>'
        '<link name="$(arg side)|$(find xacro)|$(env ARM)|$(optenv NO_ARM none)|$(eval 2*3)"/>'
    )
    done = run(PACKAGE / "scripts" / script, write(tmp_path, body), "side:=right", ARM="x86")
    assert done.returncode == 0, done.stderr
    assert f'name="right|{PACKAGE}|x86|none|6"' in done.stdout


def test_an_argument_without_a_value_keeps_its_default_as_in_ros_1(tmp_path: pathlib.Path):
    body = '<xacro:arg name="ns" default="a"/><link name="[$(arg ns)]"/>'
    done = run(PACKAGE / "scripts/xacro", write(tmp_path, body), "ns:=")
    assert 'name="[a]"' in done.stdout, done.stderr


@pytest.mark.parametrize(
    "body, message",
    [
        ('<link name="$(find no_such_package)"/>', "no_such_package"),
        ('<link name="$(arg missing)"/>', "missing"),
        ('<link name="${missing}"/>', "missing"),
        ("<xacro:no_such_macro/>", "no_such_macro"),
    ],
)
def test_what_is_unknown_is_an_error_with_its_name(tmp_path: pathlib.Path, body: str, message: str):
    done = run(PACKAGE / "scripts/xacro", write(tmp_path, body))
    assert done.returncode != 0 and message in done.stderr and not done.stdout


def test_min_and_max_are_good_names_for_arguments(tmp_path: pathlib.Path):
    body = (
        '<xacro:macro name="m" params="min max"><link name="${min}..${max}"/></xacro:macro>'
        '<xacro:m min="1" max="2"/><link name="${max(3, 4)}"/>'
    )
    done = run(PACKAGE / "scripts/xacro", write(tmp_path, body))
    assert 'name="1..2"' in done.stdout and 'name="4"' in done.stdout
    assert done.stderr == ""


def test_a_xacro_module_on_the_python_path_wins(tmp_path: pathlib.Path):
    (tmp_path / "xacro.py").write_text("def main():\n    print('the real one')\n")
    done = run(PACKAGE / "scripts/xacro", PYTHONPATH=str(tmp_path))
    assert done.stdout == "the real one\n", done.stderr


@pytest.mark.parametrize("through", ["environment", "place"])
def test_without_the_module_it_says_where_it_looked(tmp_path: pathlib.Path, through: str):
    script, nowhere = PACKAGE / "scripts/xacro", tmp_path / "nowhere"
    environment = {"ARDEE_PYDEPS": str(nowhere)}
    if through == "place":
        target = tmp_path / "compat/xacro/scripts/xacro"
        target.parent.mkdir(parents=True)
        shutil.copy(script, target)
        script, nowhere, environment = target, tmp_path / "pydeps", {"ARDEE_PYDEPS": ""}
    # -S: no site packages, so that a xacro installed for the whole machine does not help
    variables = dict(os.environ, PYTHONPATH="", **environment)
    command = [sys.executable, "-S", str(script)]
    done = subprocess.run(command, env=variables, capture_output=True, text=True)
    assert done.returncode != 0
    assert f"looked in {nowhere}" in done.stderr and "xacro==2.1.1" in done.stderr
