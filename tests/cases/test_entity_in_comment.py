# SPDX-License-Identifier: MIT
"""An entity declaration that is commented out declares nothing: the world loads, and its post stands at (2, 1, 0.5)."""
import pathlib

import probes
import pytest

from ardee_common.ros_graph import RosGraph

WORLD = pathlib.Path(__file__).parent / "entity-in-comment" / "rows.world"


def test_the_world_loads(graph: RosGraph) -> None:
    graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(WORLD))
    fields = {"model_name": "post", "relative_entity_name": ""}
    state = graph.call(
        probes.call_service, "/gazebo/get_model_state", "gazebo_msgs/GetModelState", fields
    )
    assert state.success, state.status_message
    at = state.pose.position
    assert (at.x, at.y, at.z) == pytest.approx((2.0, 1.0, 0.5))
