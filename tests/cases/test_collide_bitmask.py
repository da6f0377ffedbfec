# SPDX-License-Identifier: MIT
"""Bodies touch only where the bitwise AND of their collide_bitmask is not zero: of two balls above a shelf of mask 1,
that of mask 1 comes to lie on it, and that of mask 2 falls through it to the floor, whose mask is 0xFFFF."""
import pathlib

import probes
import pytest

from ardee_common.ros_graph import RosGraph

WORLD = pathlib.Path(__file__).parent / "collide-bitmask" / "shelf.world"


def test_a_ball_meets_the_shelf_whose_mask_it_shares(graph: RosGraph) -> None:
    graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD), "-u")
    calls = [("/ardee/step", "ardee_msgs/Step", {"steps": 2000})]
    for name in ("one", "two"):
        calls.append(("/gazebo/get_model_state", "gazebo_msgs/GetModelState", {"model_name": name}))
    stepped, one, two = graph.call(probes.call_services, calls)
    assert stepped.success
    assert one.pose.position.z == pytest.approx(0.70, abs=0.02)
    assert two.pose.position.z == pytest.approx(0.10, abs=0.02)
