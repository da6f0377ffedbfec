# SPDX-License-Identifier: MIT
"""A part with an inertia that no body has is screwed to another: the sum of both moves, with one warning that names the
link."""
import pathlib

import probes
import pytest
from ros_graph import RosGraph

CASES = pathlib.Path(__file__).parent
WORLD = CASES.parent / "data" / "plane.world"


def test_the_robot_stands_with_one_warning(graph: RosGraph) -> None:
    from geometry_msgs.msg import Point, Pose

    server = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD), "-u")
    lid = {
        "model_name": "lid_robot",
        "model_xml": (CASES / "inertia-not-positive" / "lid.urdf").read_text(),
        "initial_pose": Pose(position=Point(z=0.2)),
    }
    spawned, stepped, state = graph.call(
        probes.call_services,
        [
            ("/gazebo/spawn_urdf_model", "gazebo_msgs/SpawnModel", lid),
            ("/ardee/step", "ardee_msgs/Step", {"steps": 400}),
            ("/gazebo/get_model_state", "gazebo_msgs/GetModelState", {"model_name": "lid_robot"}),
        ],
    )
    assert spawned.success, spawned.status_message
    assert stepped.success
    assert state.pose.position.z == pytest.approx(0.05, abs=0.002)
    warnings = [line for line in server.output().splitlines() if "WARN" in line]
    assert sum("link 'lid'" in line and "which no body has" in line for line in warnings) == 1
