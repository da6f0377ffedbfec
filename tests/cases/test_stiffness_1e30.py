# SPDX-License-Identifier: MIT
"""A pad whose contact is as stiff as can be (kp 1e30, friction Inf) comes to rest at half its height, and its ground
truth, whose <updateRate> is empty, comes in each step."""
import pathlib

import probes
import pytest
from gazebo_calls import call, pose, spawn, state, step

from ardee_common.ros_graph import RosGraph

CASES = pathlib.Path(__file__).parent
WORLD = CASES.parent / "data" / "plane.world"
STEP_S = 0.005


def test_the_pad_rests_and_tells_where_it_is(graph: RosGraph) -> None:
    graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD), "-u")
    pad = spawn("pad", (CASES / "stiffness-1e30/pad.urdf").read_text(), pose(z=0.1), "urdf")
    spawned, stepped, found = call(graph, pad, step(400), state("pad"))
    assert spawned.success, spawned.status_message
    assert stepped.success
    assert found.pose.position.z == pytest.approx(0.05, abs=0.0011)
    graph.call(probes.call_service, "/gazebo/unpause_physics", "std_srvs/Empty", {})
    truth = graph.call(probes.collect, "/truth", "nav_msgs/Odometry", 5)
    stamps = [message.header.stamp.to_sec() for message in truth]
    assert [b - a for a, b in zip(stamps, stamps[1:])] == pytest.approx([STEP_S] * 4, abs=1e-6)
