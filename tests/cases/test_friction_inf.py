# SPDX-License-Identifier: MIT
"""Unlimited friction, written as Inf: a crate of 49 N that is pushed with 20 N at half its height neither slides nor
tips."""
import pathlib

import probes
import pytest

from ardee_common.ros_graph import RosGraph

WORLD = pathlib.Path(__file__).parent / "friction-inf" / "field.world"


def test_the_crate_stays_where_it_is(graph: RosGraph) -> None:
    import rospy

    graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD))
    push = {"body_name": "crate::l", "reference_frame": "world", "duration": rospy.Duration(2)}
    where = ("/gazebo/get_model_state", "gazebo_msgs/GetModelState", {"model_name": "crate"})
    _, settled, before, pushed, stepped, after = graph.call(
        probes.call_services,
        [
            ("/gazebo/pause_physics", "std_srvs/Empty", {}),
            ("/ardee/step", "ardee_msgs/Step", {"steps": 500}),
            where,
            (
                "/gazebo/apply_body_wrench",
                "gazebo_msgs/ApplyBodyWrench",
                {**push, "wrench": _along_x()},
            ),
            ("/ardee/step", "ardee_msgs/Step", {"steps": 2000}),
            where,
        ],
    )
    assert settled.success and pushed.success and stepped.success
    assert after.pose.position.x == pytest.approx(before.pose.position.x, abs=0.001)
    assert after.pose.position.z == pytest.approx(0.25, abs=0.002)
    assert abs(after.pose.orientation.y) < 0.002


def _along_x() -> object:
    from geometry_msgs.msg import Vector3, Wrench

    return Wrench(force=Vector3(x=20.0))
