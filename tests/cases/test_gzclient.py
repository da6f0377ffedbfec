# SPDX-License-Identifier: MIT
"""Starts launch files with Gazebo's window on a machine without a display: the world runs, gzclient reports in one line
that there is none, and there is no error.
"""
from pathlib import Path

import probes
import pytest

from ardee_common.ros_graph import RosGraph, wait_until

FOLDER = Path(__file__).with_name("gzclient")


@pytest.mark.parametrize("file", ["client.launch", "gui.launch"])
def test_the_world_runs_without_a_window(graph: RosGraph, file: str) -> None:
    launch = graph.spawn("roslaunch", str(FOLDER / file))
    assert graph.call(probes.clock_at_least, 0.2) >= 0.2
    wait_until(lambda: "has finished cleanly" in launch.output(), "the end of gzclient")
    assert launch.output().count("gzclient: there is no display") == 1
    assert "ERROR" not in launch.output() and "cannot" not in launch.output()
    assert launch.exit_code() is None
