# SPDX-License-Identifier: MIT
"""Runs waiting_callbacks_test.cpp, as the workspace's build has made it: it needs ROS's library, but no ROS master."""
import subprocess


def test_waiting_callbacks() -> None:
    find = ["catkin_find", "--first-only", "--libexec", "ardee_sim_cpp", "waiting_callbacks_test"]
    program = subprocess.run(find, capture_output=True, text=True).stdout.strip()
    assert program, "found no waiting_callbacks_test, expected one in the workspace"
    run = subprocess.run([program], capture_output=True, text=True)
    assert run.returncode == 0 and "[  PASSED  ] 3 tests." in run.stdout, run.stdout + run.stderr
