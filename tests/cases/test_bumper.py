# SPDX-License-Identifier: MIT
"""A mower of 8.2 kg with friction 0.2 that is pushed with 40 N against a box: its bumper feels the push less what
friction takes, (40 -+ 16) N, in messages at 50 Hz, and nothing before."""
import pathlib

import probes
import pytest
from gazebo_calls import call, pose, push, simulate, spawn
from geometry_msgs.msg import Vector3

from ardee_common.ros_graph import RosGraph

MOWER = (pathlib.Path(__file__).parent / "bumper/mower.urdf").read_text()
WORLD = """<sdf version="1.6"><world name="w">
  <model name="ground"><static>true</static><link name="l"><collision name="c"><geometry>
    <plane><normal>0 0 1</normal></plane></geometry></collision></link></model>
  <model name="box"><static>true</static><pose>1 0 0.5 0 0 0</pose><link name="l"><collision name="c"><geometry>
    <box><size>1 2 1</size></box></geometry></collision></link></model>
</world></sdf>"""
STEPS_A_MESSAGE = 20  # 50 Hz, steps of 1 ms


@pytest.mark.parametrize(
    "collision", ["deck_fixed_joint_lump__guard_collision_1", "guard_collision"]
)
def test_bumper(graph: RosGraph, collision: str) -> None:
    simulate(graph, WORLD)
    mower = MOWER.replace("deck_fixed_joint_lump__guard_collision_1", collision)
    assert call(graph, spawn("mower", mower, pose(z=0.1), "urdf"))[0].success
    free = graph.call(probes.collect, "/bumper", "gazebo_msgs/ContactsState", 3)
    assert [message.states for message in free] == [[], [], []]
    assert free[0].header.frame_id == "guard"
    assert call(graph, push("mower::deck", Vector3(x=40), -1))[0].success
    messages = graph.call(probes.collect, "/bumper", "gazebo_msgs/ContactsState", 100)
    stamps = [message.header.stamp.to_nsec() for message in messages]
    assert {after - before for before, after in zip(stamps, stamps[1:])} == {20_000_000}
    states = messages[-1].states
    assert len(states) == STEPS_A_MESSAGE
    for state in states:
        assert state.collision1_name == "mower::guard::guard_collision"
        assert state.collision2_name == "box::l::c"
        assert "my geom:mower::guard::guard_collision" in state.info
        assert -67.2 <= state.total_wrench.force.x <= -19.2
        forces = [wrench.force.x for wrench in state.wrenches]
        assert sum(forces) == pytest.approx(state.total_wrench.force.x)
        assert [normal.x for normal in state.contact_normals] == pytest.approx([-1] * len(forces))
        assert len(state.contact_positions) == len(state.depths) == len(forces) > 0
