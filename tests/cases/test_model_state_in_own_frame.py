# SPDX-License-Identifier: MIT
"""A model driven by set_model_state in its own frame has the requested velocity after any number of requests."""
import pathlib

import pytest
from gazebo_calls import Call, call, empty, pose, simulate, spawn, state
from geometry_msgs.msg import Twist, Vector3

from ardee_common.ros_graph import RosGraph
from gazebo_msgs.msg import ModelState

SLED = (pathlib.Path(__file__).parent / "model-state-in-own-frame/sled.urdf").read_text()
SPEED_M_S, TURN_RAD_S = 0.4, 0.1


def drive(reference: str) -> Call:
    twist = Twist(Vector3(SPEED_M_S, 0, 0), Vector3(0, 0, TURN_RAD_S))
    fields = {"model_state": ModelState("sled", pose(), twist, reference)}
    return "/gazebo/set_model_state", "gazebo_msgs/SetModelState", fields


@pytest.mark.parametrize("frames", [["sled"] * 4, ["sled::base", "sled", "sled::base", "sled"]])
def test_model_state_in_own_frame(graph: RosGraph, frames: list) -> None:
    simulate(graph)
    call(graph, empty("pause_physics"), spawn("sled", SLED, pose(z=1, yaw=1.0), "urdf"))
    for frame in frames:
        answer, found = call(graph, drive(frame), state("sled"))
        assert answer.success, answer.status_message
        turn = found.pose.orientation  # still the spawn's: cos 1 = w^2 - z^2
        forward = (turn.w**2 - turn.z**2, 2 * turn.w * turn.z)
        expected = (SPEED_M_S * forward[0], SPEED_M_S * forward[1], 0)
        speed = found.twist.linear
        assert (speed.x, speed.y, speed.z) == pytest.approx(expected, abs=1e-9)
        assert found.twist.angular.z == pytest.approx(TURN_RAD_S, abs=1e-9)
