# SPDX-License-Identifier: MIT
"""A launch file publishes the map's place by static_transform_publisher: the map alone is the parent of odom, and the
robot is at (3, 1) in the map.
"""
from pathlib import Path

import probes
import pytest

from ardee_common.ros_graph import RosGraph

FILE = Path(__file__).with_name("tf-static-map-odom") / "test.launch"


def test_the_map_is_the_only_parent_of_odom(graph: RosGraph) -> None:
    graph.spawn("roslaunch", str(FILE))
    for _ in range(3):
        at = graph.call(probes.transform, "map", "base_footprint").transform.translation
        assert (at.x, at.y) == pytest.approx((3.0, 1.0), abs=0.01)
    assert graph.call(probes.parents_in_tf, "odom", 1.5) == {"map"}
