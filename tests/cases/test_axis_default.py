# SPDX-License-Identifier: MIT
"""A joint whose <axis> has limits but no <xyz> turns about z, SDF's default: 1 N m on 0.5 kg m^2 for 0.5 s gives
1 rad/s and 0.25 rad."""
import pathlib
from typing import Any, List

import probes
import pytest

from ardee_common.ros_graph import RosGraph

CASES = pathlib.Path(__file__).parent
WORLD = CASES.parent / "data" / "plane.world"
STEP_S = 0.005


def calls(model: str) -> List[Any]:
    """Spawns the door in a world that stands, pushes its leaf for half a second, and asks for the hinge."""
    import rospy

    push = {"joint_name": "door::hinge", "effort": 1.0, "duration": rospy.Duration.from_sec(0.5)}
    door = {"model_name": "door", "model_xml": model}
    hinge = {"joint_name": "door::hinge"}
    return [
        ("/gazebo/pause_physics", "std_srvs/Empty", {}),
        ("/gazebo/spawn_sdf_model", "gazebo_msgs/SpawnModel", door),
        ("/gazebo/apply_joint_effort", "gazebo_msgs/ApplyJointEffort", push),
        ("/ardee/step", "ardee_msgs/Step", {"steps": round(0.5 / STEP_S)}),
        ("/gazebo/get_joint_properties", "gazebo_msgs/GetJointProperties", hinge),
        (
            "/gazebo/get_link_state",
            "gazebo_msgs/GetLinkState",
            {"link_name": "door::leaf", "reference_frame": ""},
        ),
    ]


def check_leaf_turns(graph: RosGraph, case: str) -> str:
    """Checks the motion of a case's door; returns what the simulator has said."""
    server = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD))
    model = (CASES / case / "door.sdf").read_text()
    _, spawned, pushed, stepped, hinge, leaf = graph.call(probes.call_services, calls(model))
    assert spawned.success, spawned.status_message
    assert pushed.success and stepped.success
    assert hinge.rate[0] == pytest.approx(1.0, abs=0.02)
    assert hinge.position[0] == pytest.approx(0.25, abs=0.01)
    assert leaf.link_state.twist.angular.z == pytest.approx(1.0, abs=0.02)
    return server.output()


def test_the_leaf_turns_about_z(graph: RosGraph) -> None:
    assert "<axis>" not in check_leaf_turns(graph, "axis-default")
