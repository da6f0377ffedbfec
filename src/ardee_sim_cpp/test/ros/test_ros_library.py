# SPDX-License-Identifier: MIT
"""Runs the unit tests of ros/ from the workspace's build: they need ROS's library, but no ROS master."""
import pathlib
import re
import subprocess


def test_ros_library() -> None:
    find = ["catkin_find", "--first-only", "--libexec", "ardee_sim_cpp", "ros_library_test"]
    program = subprocess.run(find, capture_output=True, text=True).stdout.strip()
    assert program, "found no ros_library_test, expected one in the workspace"
    run = subprocess.run([program], capture_output=True, text=True)
    assert run.returncode == 0, run.stdout + run.stderr
    passed = re.search(r"^\[  PASSED  \] (\d+) tests", run.stdout, re.MULTILINE)
    sources = pathlib.Path(__file__).parent.glob("test_*.cpp")
    written = sum(len(re.findall(r"^TEST\(", file.read_text(), re.MULTILINE)) for file in sources)
    assert passed and int(passed[1]) == written, "a test that is written is not in the program"
