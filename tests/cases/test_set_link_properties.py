# SPDX-License-Identifier: MIT
"""Scripts that load a robot by set_link_properties, and users who change physics by dynamic_reconfigure."""
import ast
import pathlib
from typing import Dict

import pytest
from gazebo_calls import Call, call, empty, pose, push, simulate, spawn, state, step
from geometry_msgs.msg import Vector3

from ardee_common.ros_graph import RosGraph

SLED = (pathlib.Path(__file__).parent / "set-link-properties/sled.urdf").read_text()
FALLING = SLED.replace("<gravity>false", "<gravity>true")
GET = ("/gazebo/get_link_properties", "gazebo_msgs/GetLinkProperties", {"link_name": "sled::base"})
STEPS = 1000  # of 1 ms


def set_link(**changed: object) -> Call:
    fields = dict(link_name="sled::base", com=pose(), gravity_mode=False, mass=8.0)
    fields.update(ixx=0.2, iyy=0.2, izz=0.2)
    return "/gazebo/set_link_properties", "gazebo_msgs/SetLinkProperties", {**fields, **changed}


def test_set_link_properties(graph: RosGraph) -> None:
    simulate(graph)
    answers = call(
        graph,
        empty("pause_physics"),
        spawn("sled", SLED, pose(z=1), "urdf"),
        set_link(),
        GET,
        push("sled::base", Vector3(8, 0, 0), 1.0),
        step(STEPS),
        state("sled"),
        set_link(gravity_mode=True),
        step(STEPS),
        state("sled"),
    )
    assert answers[2].success, answers[2].status_message
    assert (answers[3].mass, answers[3].gravity_mode, answers[3].ixx) == (8.0, False, 0.2)
    pushed, fallen = answers[6].twist.linear, answers[9].twist.linear
    assert (pushed.x, pushed.z) == pytest.approx((1.0, 0.0), abs=1e-6)
    assert (fallen.x, fallen.z) == pytest.approx((1.0, -9.8), abs=1e-6)


def dynparam(graph: RosGraph, *words: str) -> str:
    return graph.run("rosrun", "dynamic_reconfigure", "dynparam", *words)


def physics(graph: RosGraph) -> Dict[str, float]:
    found = ast.literal_eval(dynparam(graph, "get", "/gazebo").splitlines()[-1])
    return {name: value for name, value in found.items() if name != "groups"}


def test_physics_by_dynamic_reconfigure(graph: RosGraph) -> None:
    simulate(graph)
    call(graph, empty("pause_physics"), spawn("sled", FALLING, pose(z=50), "urdf"))
    first = physics(graph)
    numbers = "time_step max_update_rate gravity_x gravity_y gravity_z sor_pgs_iters sor_pgs_w cfm erp max_contacts"
    assert set(numbers.split()) <= set(first)
    assert first["gravity_z"] == -9.8
    dynparam(graph, "set", "/gazebo", "gravity_z", "-3.7")
    assert call(graph, step(STEPS), state("sled"))[1].twist.linear.z == pytest.approx(-3.7)
    for name, value in (("time_step", "-1"), ("gravity_z", "nan"), ("erp", "5")):
        dynparam(graph, "set", "/gazebo", name, value)
    assert physics(graph) == {**first, "gravity_z": -3.7}
    get = ("/gazebo/get_physics_properties", "gazebo_msgs/GetPhysicsProperties", {})
    old = call(graph, get)[0]
    fields = {"time_step": 0.002, "max_update_rate": 500.0, "gravity": Vector3(0, 0, -1.6)}
    fields["ode_config"] = old.ode_config
    call(graph, ("/gazebo/set_physics_properties", "gazebo_msgs/SetPhysicsProperties", fields))
    changed = {"time_step": 0.002, "max_update_rate": 500.0, "gravity_z": -1.6}
    assert physics(graph) == {**first, **changed}
