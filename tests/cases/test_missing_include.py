# SPDX-License-Identifier: MIT
"""A world whose middle one of three models is not on this machine: gzserver leaves it out with one error that names the
model and its line, partly.world:5; `behind` stands at (5, 0, 0.5)."""
from pathlib import Path

import probes
import pytest

from ardee_common.ros_graph import RosGraph

WORLD = Path(__file__).with_name("missing-include") / "partly.world"


def test_the_rest_of_the_world_loads(graph: RosGraph) -> None:
    server = graph.spawn("rosrun", "gazebo_ros", "gzserver", str(WORLD))
    properties, behind = graph.call(
        probes.call_services,
        [
            ("/gazebo/get_world_properties", "gazebo_msgs/GetWorldProperties", {}),
            ("/gazebo/get_model_state", "gazebo_msgs/GetModelState", {"model_name": "behind"}),
        ],
    )
    assert properties.model_names == ["before", "behind"]
    at = behind.pose.position
    assert (at.x, at.y, at.z) == pytest.approx((5.0, 0.0, 0.5))
    errors = [line for line in server.output().splitlines() if "ERROR" in line]
    assert len(errors) == 1, server.output()
    assert "partly.world:5: <uri>: found 'model://no_such_tree'" in errors[0]
