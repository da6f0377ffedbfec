# SPDX-License-Identifier: MIT
"""A joint of 2 N m and 1 rad/s at most is pushed with 50 N m: 2 N m on 0.5 kg m^2 give 0.40 rad/s after 0.1 s, and an
effort in the direction of motion is nought while it is faster than its limit, so that it keeps 1.00 rad/s."""
import pathlib

import probes
import pytest

from ardee_common.ros_graph import RosGraph

CASES = pathlib.Path(__file__).parent
WORLD = CASES.parent / "data" / "plane.world"
STEP_S = 0.005


def test_the_joint_turns_no_faster_than_its_limit(graph: RosGraph) -> None:
    import rospy

    graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD))
    model = (CASES / "joint-velocity-limit" / "turret.sdf").read_text()
    push = {"joint_name": "turret::pan", "effort": 50.0, "duration": rospy.Duration(3)}
    rate = (
        "/gazebo/get_joint_properties",
        "gazebo_msgs/GetJointProperties",
        {"joint_name": "turret::pan"},
    )

    def step(duration_s: float) -> tuple:
        return ("/ardee/step", "ardee_msgs/Step", {"steps": round(duration_s / STEP_S)})

    _, spawned, pushed, _, early, _, late = graph.call(
        probes.call_services,
        [
            ("/gazebo/pause_physics", "std_srvs/Empty", {}),
            (
                "/gazebo/spawn_sdf_model",
                "gazebo_msgs/SpawnModel",
                {"model_name": "turret", "model_xml": model},
            ),
            ("/gazebo/apply_joint_effort", "gazebo_msgs/ApplyJointEffort", push),
            step(0.1),
            rate,
            step(1.9),
            rate,
        ],
    )
    assert spawned.success, spawned.status_message
    assert pushed.success
    assert early.rate[0] == pytest.approx(0.40, abs=0.02)
    assert late.rate[0] == pytest.approx(1.00, abs=0.021)
