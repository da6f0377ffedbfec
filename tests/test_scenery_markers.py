# SPDX-License-Identifier: MIT
"""Tests what /ardee/scenery shows of a world: collision bodies if asked, within the radius asked for."""
from typing import Any, List

import probes
from visualization_msgs.msg import Marker

from ardee_common.ros_graph import RosGraph

KIND = "visualization_msgs/MarkerArray"


def markers(graph: RosGraph, *arguments: str) -> List[Any]:
    """Returns the markers of farm.world with these arguments of its launch file."""
    graph.launch("ardee_world", "custom_world.launch", "world:=farm.world", *arguments)
    graph.call(probes.clock_at_least, 0.1)
    return graph.call(probes.collect, "/ardee/scenery", KIND, 1)[0].markers


def test_collision_bodies_are_transparent_cylinders_at_the_plants(graph: RosGraph) -> None:
    found = markers(graph, "show_collisions:=true", "scenery_radius_m:=3")
    bodies = [marker for marker in found if marker.ns.endswith(" (collision)")]
    assert len(bodies) > 10 and {marker.type for marker in bodies} == {Marker.CYLINDER}
    assert all(0.0 < body.color.a < 1.0 and body.scale.x < 0.06 for body in bodies)


def test_radius_bounds_the_ground_and_no_body_shows_unless_asked(graph: RosGraph) -> None:
    found = markers(graph, "scenery_radius_m:=2")
    assert not [marker.ns for marker in found if "collision" in marker.ns]
    (ground,) = [marker for marker in found if marker.ns == "heightmap"]
    width_m = max(p.x for p in ground.points) - min(p.x for p in ground.points)
    assert 3.5 < width_m < 5.5
