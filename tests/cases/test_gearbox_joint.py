# SPDX-License-Identifier: MIT
"""A gearbox of -2 between wheels of 0.1 kg m^2: 1 N m on the first for 0.5 s turns 0.5 kg m^2, to 1 and 2 rad/s."""
import pathlib

import pytest
from gazebo_calls import call, empty, pose, simulate, spawn, step

from ardee_common.ros_graph import RosGraph

GEARED = (pathlib.Path(__file__).parent / "gearbox-joint/geared.sdf").read_text()
STEP_S = 0.001


def test_gearbox_joint(graph: RosGraph) -> None:
    import rospy

    simulate(graph)

    def get(joint: str) -> tuple:
        fields = {"joint_name": f"geared::{joint}"}
        return "/gazebo/get_joint_properties", "gazebo_msgs/GetJointProperties", fields

    push = {"joint_name": "geared::ja", "effort": 1.0, "duration": rospy.Duration.from_sec(0.5)}
    answers = call(
        graph,
        empty("pause_physics"),
        spawn("geared", GEARED, pose()),
        ("/gazebo/apply_joint_effort", "gazebo_msgs/ApplyJointEffort", push),
        step(round(0.6 / STEP_S)),
        get("ja"),
        get("jb"),
    )
    assert answers[1].success, answers[1].status_message
    first, second = answers[4], answers[5]
    assert first.rate == pytest.approx([1.0], rel=0.03)
    assert second.rate == pytest.approx([2.0], rel=0.03)
    assert second.position[0] == pytest.approx(2.0 * first.position[0], abs=1e-3)
