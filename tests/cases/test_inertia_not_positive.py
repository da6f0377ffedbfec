# SPDX-License-Identifier: MIT
"""A part with an inertia that no body has is screwed to another: the sum of both moves, with one warning that names the
link."""
import pathlib

import pytest
from gazebo_calls import call, pose, spawn, state, step

from ardee_common.ros_graph import RosGraph

CASES = pathlib.Path(__file__).parent
WORLD = CASES.parent / "data" / "plane.world"


def test_the_robot_stands_with_one_warning(graph: RosGraph) -> None:
    server = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD), "-u")
    lid = spawn("lid", (CASES / "inertia-not-positive/lid.urdf").read_text(), pose(z=0.2), "urdf")
    spawned, stepped, found = call(graph, lid, step(400), state("lid"))
    assert spawned.success, spawned.status_message
    assert stepped.success
    assert found.pose.position.z == pytest.approx(0.05, abs=0.002)
    warnings = [line for line in server.output().splitlines() if "WARN" in line]
    assert sum("link 'lid'" in line and "which no body has" in line for line in warnings) == 1
