# SPDX-License-Identifier: MIT
"""Tests scripts/build on a workspace with a user's own package in it."""
import os
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]
FILES = {
    "package.xml": """<package format="2">
  <name>mower</name><version>1.0.0</version><description>Mows.</description>
  <maintainer email="a@b.org">A</maintainer><license>MIT</license>
  <buildtool_depend>catkin</buildtool_depend>
</package>""",
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.10)
project(mower LANGUAGES CXX)
find_package(catkin REQUIRED)
catkin_package()
add_compile_options(-Wall)
add_library(mower mower.cpp)""",
    "mower.cpp": "int mow() {\n  int unused;\n  return 1;\n}\n",
}


def test_a_warning_in_a_users_own_package_is_no_error(tmp_path: pathlib.Path) -> None:
    shutil.copytree(ROOT / "scripts", tmp_path / "scripts")
    package = tmp_path / "src" / "mower"
    package.mkdir(parents=True)
    for name, text in FILES.items():
        (package / name).write_text(text)
    env = {name: os.environ[name] for name in ("HOME", "PATH")}
    command = [tmp_path / "scripts" / "build", "-j1"]
    done = subprocess.run(
        command, env=env, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    assert done.returncode == 0, done.stdout
    assert "[-Wunused-variable]" in done.stdout
