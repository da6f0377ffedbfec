# SPDX-License-Identifier: MIT
"""Tests that a service that answers success = false changes nothing: with invalid numbers and unknown names."""
import math
import pathlib
from typing import Any, Dict, Iterator, List, Tuple

import pytest
from gazebo_calls import Call, call, empty, pose, simulate, spawn, state, step
from geometry_msgs.msg import Point, Pose, Twist, Vector3, Wrench
from std_msgs.msg import ColorRGBA

from ardee_common.ros_graph import RosGraph
from gazebo_msgs.msg import LinkState, ModelState, ODEJointProperties, ODEPhysics

WORLD = """<sdf version="1.6"><world name="w">
  <light name="sun" type="directional"><diffuse>0.8 0.7 0.6 1</diffuse></light>
</world></sdf>"""
ARM = """<sdf version="1.6"><model name="arm">
  <link name="foot"><inertial><mass>10</mass></inertial></link>
  <link name="upper"><pose>0 0 1 0 0 0</pose></link>
  <link name="lower"><pose>1 0 1 0 0 0</pose></link>
  <joint name="shoulder" type="revolute"><parent>foot</parent><child>upper</child><axis><xyz>0 0 1</xyz></axis></joint>
  <joint name="elbow" type="revolute"><parent>upper</parent><child>lower</child><axis><xyz>0 0 1</xyz></axis></joint>
  <link name="hand"><pose>2 0 1 0 0 0</pose></link>
  <joint name="wrist" type="ball"><parent>lower</parent><child>hand</child></joint>
  <joint name="weld" type="fixed"><parent>world</parent><child>foot</child></joint>
</model></sdf>"""
RING = (pathlib.Path(__file__).parent / "data/ring.sdf").read_text()
NAN, INF = math.nan, math.inf
Request = Dict[str, Any]


@pytest.fixture(scope="module")
def world(shared_graph: RosGraph) -> Iterator[RosGraph]:
    """Yields a paused world with an arm on the ground, a light, and four bars that hinges nearly close to a ring."""
    simulate(shared_graph, WORLD)
    answers = call(
        shared_graph,
        empty("pause_physics"),
        spawn("arm", ARM, pose()),
        spawn("ring", RING, pose(y=5)),
    )
    assert all(answer.success for answer in answers[1:])
    yield shared_graph


def request(service: str, fields: Request) -> Call:
    kind = "".join(word.capitalize() for word in service.split("_"))
    return f"/gazebo/{service}", f"gazebo_msgs/{kind}", fields


def get(service: str, **fields: Any) -> Call:
    return request(f"get_{service}", fields)


EVERYTHING = [
    state("arm"),
    get("link_state", link_name="arm::upper"),
    get("link_state", link_name="arm::lower"),
    get("link_state", link_name="ring::a"),
    get("link_state", link_name="ring::b"),
    get("link_properties", link_name="arm::upper"),
    get("link_properties", link_name="arm::lower"),
    get("joint_properties", joint_name="arm::shoulder"),
    get("joint_properties", joint_name="arm::elbow"),
    get("physics_properties"),
    get("light_properties", light_name="sun"),
    get("world_properties"),
]


def place(x: float = 0, **rest: float) -> Pose:
    return pose(x, **rest)


def model_state(**changed: Any) -> Request:
    fields = dict(model_name="arm", pose=place(x=5), twist=Twist(Vector3(1, 0, 0), Vector3()))
    return {"model_state": ModelState(**{**fields, **changed})}


def link_state(**changed: Any) -> Request:
    fields = dict(link_name="arm::lower", pose=place(x=5), twist=Twist(Vector3(1, 0, 0), Vector3()))
    return {"link_state": LinkState(**{**fields, **changed})}


def joints(names: List[str], positions: List[float], model: str = "arm") -> Request:
    return {"model_name": model, "joint_names": names, "joint_positions": positions}


def link_properties(**changed: Any) -> Request:
    fields = dict(link_name="arm::upper", com=pose(z=0.1), gravity_mode=False, mass=3.0)
    fields.update(ixx=0.2, iyy=0.2, izz=0.2)
    return {**fields, **changed}


def joint_properties(name: str = "arm::elbow", **lists: List[float]) -> Request:
    config = ODEJointProperties(**{"damping": [0.7], **lists})
    return {"joint_name": name, "ode_joint_config": config}


def physics_properties(ode: Tuple[str, Any] = ("erp", 0.3), **changed: Any) -> Request:
    fields = dict(time_step=0.002, max_update_rate=100.0, gravity=Vector3(0, 0, -1))
    config = ODEPhysics(erp=0.2, contact_max_correcting_vel=10.0, contact_surface_layer=0.001)
    setattr(config, *ode)
    return {**fields, "ode_config": config, **changed}


def light_properties(**changed: Any) -> Request:
    fields = dict(light_name="sun", diffuse=ColorRGBA(1, 0, 0, 1), attenuation_constant=0.5)
    return {**fields, **changed}


def wrench(body: str = "arm::lower", frame: str = "", **parts: Vector3) -> Request:
    return {"body_name": body, "reference_frame": frame, "wrench": Wrench(**parts)}


REFUSED: Dict[str, List[Request]] = {
    "set_model_state": [
        model_state(model_name="ghost"),
        model_state(reference_frame="ghost"),
        model_state(pose=place(x=NAN)),
        model_state(pose=place(x=2e6)),
        model_state(twist=Twist(Vector3(INF, 0, 0), Vector3())),
        model_state(twist=Twist(Vector3(2e9, 0, 0), Vector3())),
        model_state(twist=Twist(Vector3(), Vector3(0, 2e9, 0))),
    ],
    "set_link_state": [
        link_state(link_name="arm::ghost"),
        link_state(reference_frame="ghost"),
        link_state(pose=place(y=NAN)),
        link_state(pose=place(x=-2e6)),
        link_state(twist=Twist(Vector3(), Vector3(0, 0, NAN))),
        link_state(twist=Twist(Vector3(), Vector3(0, 0, 2e9))),
    ],
    "set_model_configuration": [
        joints(["wrist"], [0.5]),
        joints(["shoulder", "elbow"], [0.5, 1e10]),
        joints(["shoulder", "elbow"], [0.5, NAN]),
        joints(["shoulder", "ghost"], [0.5, 0.5]),
        joints(["shoulder", "weld"], [0.5, 0.5]),
        joints(["shoulder"], [0.5, 0.5]),
        joints(["ab"], [0.5], model="ring"),
        joints(["shoulder"], [0.5], model="ghost"),
    ],
    "set_link_properties": [
        link_properties(link_name="arm::ghost"),
        link_properties(mass=0.0),
        link_properties(mass=-1.0),
        link_properties(mass=NAN),
        link_properties(ixx=NAN),
        link_properties(ixx=-0.2),
        link_properties(ixy=1.0),  # a principal moment below zero
        link_properties(com=place(x=INF)),
    ],
    "set_joint_properties": [
        joint_properties("arm::ghost"),
        joint_properties(damping=[-1.0]),
        joint_properties(damping=[NAN]),
        joint_properties(hiStop=[-0.5], loStop=[0.5]),
        joint_properties(hiStop=[NAN]),
        joint_properties(fmax=[-1.0], vel=[0.0]),
        joint_properties(vel=[NAN]),
        joint_properties(damping=[0.1, 0.2]),
    ],
    "set_physics_properties": [
        physics_properties(time_step=0.0),
        physics_properties(time_step=NAN),
        physics_properties(time_step=2.0),
        physics_properties(max_update_rate=-1.0),
        physics_properties(gravity=Vector3(0, NAN, 0)),
        physics_properties(gravity=Vector3(0, 0, 2e6)),
        physics_properties(("erp", 1.5)),
        physics_properties(("cfm", -1.0)),
        physics_properties(("cfm", 1e8)),
        physics_properties(("sor_pgs_w", 2.5)),
        physics_properties(("sor_pgs_iters", 100001)),
        physics_properties(("max_contacts", 1000001)),
        physics_properties(("contact_surface_layer", -1.0)),
        physics_properties(("contact_max_correcting_vel", NAN)),
        physics_properties(("sor_pgs_rms_error_tol", NAN)),
    ],
    "set_light_properties": [
        light_properties(light_name="moon"),
        light_properties(diffuse=ColorRGBA(NAN, 0, 0, 1)),
        light_properties(diffuse=ColorRGBA(2, 0, 0, 1)),
        light_properties(specular=ColorRGBA(0, -1, 0, 1)),
        light_properties(attenuation_linear=-1.0),
        light_properties(attenuation_quadratic=INF),
        light_properties(direction=Vector3(NAN, 0, 0)),
        light_properties(pose=place(x=NAN)),
        light_properties(pose=place(x=2e6)),
    ],
    "delete_light": [{"light_name": "moon"}],
    "apply_body_wrench": [
        wrench("arm::ghost"),
        wrench(frame="ghost"),
        wrench(force=Vector3(NAN, 0, 0)),
        wrench(force=Vector3(0, 2e9, 0)),
        wrench(torque=Vector3(0, 0, INF)),
        {**wrench(force=Vector3(1, 0, 0)), "reference_point": Point(NAN, 0, 0)},
        {**wrench(force=Vector3(1, 0, 0)), "reference_point": Point(2e6, 0, 0)},
    ],
    "apply_joint_effort": [
        {"joint_name": "arm::ghost", "effort": 1.0},
        {"joint_name": "arm::weld", "effort": 1.0},
        {"joint_name": "arm::wrist", "effort": 1.0},
        {"joint_name": "arm::elbow", "effort": NAN},
        {"joint_name": "arm::elbow", "effort": 2e9},
    ],
}


@pytest.mark.parametrize("service", REFUSED)
def test_what_is_refused_changes_nothing(world: RosGraph, service: str) -> None:
    requests = [request(service, fields) for fields in REFUSED[service]]
    answers = call(world, *EVERYTHING, *requests, *EVERYTHING)
    count = len(EVERYTHING)
    for sent, answer in zip(requests, answers[count:-count]):
        assert not answer.success, sent
        assert len(answer.status_message) > 10
    assert answers[:count] == answers[-count:]


@pytest.mark.parametrize("service", ["apply_body_wrench", "apply_joint_effort"])
def test_what_is_refused_does_not_act_later(world: RosGraph, service: str) -> None:
    import rospy

    forever = {"duration": rospy.Duration(-1)}
    requests = [request(service, {**fields, **forever}) for fields in REFUSED[service]]
    lower = call(world, *requests, step(5), get("link_state", link_name="arm::lower"))[-1]
    speed, turn = lower.link_state.twist.linear, lower.link_state.twist.angular
    for number in (speed.x, speed.y, speed.z, turn.x, turn.y, turn.z):
        assert number == pytest.approx(0.0, abs=1e-6)
