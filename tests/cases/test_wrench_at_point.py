# SPDX-License-Identifier: MIT
"""A wrench at a point is a force and a torque fixed at the call: 1 N along x at 0.5 m along y of a free body of
0.01 kg m^2 gives it -50 rad/s^2 as long as it acts, however the body has turned, and 1 m/s after one second."""
import pathlib

import probes
import pytest

from ardee_common.ros_graph import RosGraph

CASES = pathlib.Path(__file__).parent
WORLD = CASES.parent / "data" / "plane.world"
STEP_S = 0.005


def test_the_point_does_not_turn_with_the_body(graph: RosGraph) -> None:
    import rospy
    from geometry_msgs.msg import Point, Pose, Vector3, Wrench

    graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD))
    puck = {
        "model_name": "puck",
        "model_xml": (CASES / "wrench-at-point" / "puck.sdf").read_text(),
        "initial_pose": Pose(position=Point(z=1)),
    }
    push = {
        "body_name": "puck::l",
        "reference_frame": "world",
        "reference_point": Point(y=0.5),
        "wrench": Wrench(force=Vector3(x=1)),
        "duration": rospy.Duration(1),
    }
    calls = [
        ("/gazebo/pause_physics", "std_srvs/Empty", {}),
        ("/gazebo/spawn_sdf_model", "gazebo_msgs/SpawnModel", puck),
        ("/gazebo/apply_body_wrench", "gazebo_msgs/ApplyBodyWrench", push),
    ]
    for _ in range(5):
        calls.append(("/ardee/step", "ardee_msgs/Step", {"steps": round(0.25 / STEP_S)}))
        calls.append(
            ("/gazebo/get_link_state", "gazebo_msgs/GetLinkState", {"link_name": "puck::l"})
        )
    answers = graph.call(probes.call_services, calls)
    assert answers[1].success and answers[2].success
    twists = [answer.link_state.twist for answer in answers[4::2]]
    spins = [twist.angular.z for twist in twists]
    assert spins == pytest.approx([-12.5, -25.0, -37.5, -50.0, -50.0], abs=0.3)
    velocity = twists[3].linear
    assert [velocity.x, velocity.y, velocity.z] == pytest.approx([1.0, 0.0, 0.0], abs=0.02)
