# SPDX-License-Identifier: MIT
"""A small robot on two wheels and a sliding foot, each 1 mm soft (minDepth), in a world whose contact_surface_layer is
10 mm: the depth of a body takes the place of the world's layer, so that its hull stays off the ground, and it drives
at the 0.2 m/s that it is told and turns."""
import pathlib

import probes
import pytest
from gazebo_calls import call, pose, spawn, state, step

from ardee_common.ros_graph import RosGraph

CASE = pathlib.Path(__file__).parent / "contact-layer-diff-drive"


def test_the_wheels_sink_by_their_own_depth_and_drive(graph: RosGraph) -> None:
    graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(CASE / "lab.world"), "-u")
    runner = spawn("runner", (CASE / "runner.urdf").read_text(), pose(), "urdf")
    spawned, stepped, found = call(graph, runner, step(3000), state("runner"))
    assert spawned.success, spawned.status_message
    assert stepped.success
    assert -0.0015 < found.pose.position.z < 0.0005
    assert abs(found.pose.orientation.y) < 0.01  # half the pitch
    graph.call(probes.call_service, "/gazebo/unpause_physics", "std_srvs/Empty", {})
    _, last = graph.call(probes.drive, "/cmd_vel", "/odom", 0.2, 0.0, 3.0)
    assert last.twist.twist.linear.x == pytest.approx(0.2, abs=0.01)
    _, last = graph.call(probes.drive, "/cmd_vel", "/odom", 0.0, 0.8, 2.0)
    assert last.twist.twist.angular.z == pytest.approx(0.8, abs=0.05)
