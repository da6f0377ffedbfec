# SPDX-License-Identifier: MIT
"""Tests the services of the running simulator, on level ground, with answers known by hand."""
import copy
import math
import pathlib
from typing import Any, Iterator

import probes
import pytest
from gazebo_calls import call, delete, empty, pose, push, spawn, state, step
from geometry_msgs.msg import Quaternion, Twist, Vector3

from ardee_common.ros_graph import RosGraph
from gazebo_msgs.msg import ModelState

DATA = pathlib.Path(__file__).parent / "data"
BALL = (DATA / "ball.sdf").read_text()
POST = (DATA / "lidar_post.urdf").read_text()
BALL_RADIUS_M, BALL_MASS_KG, STEP_S = 0.1, 2.0, 0.005


@pytest.fixture(scope="module")
def world(shared_graph: RosGraph) -> Iterator[RosGraph]:
    """Yields the simulator alone, on level ground with a wall."""
    shared_graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(DATA / "plane.world"))
    shared_graph.call(probes.clock_at_least, 0.1)
    yield shared_graph


@pytest.fixture(autouse=True)
def as_before(world: RosGraph) -> Iterator[None]:
    """Leaves a running world with its original content after each test."""
    yield
    names = properties(world).model_names
    ours = [delete(name) for name in names if name not in ("ground", "wall")]
    world.call(probes.call_services, [*ours, empty("unpause_physics")])


def properties(graph: RosGraph) -> Any:
    return call(graph, ("/gazebo/get_world_properties", "gazebo_msgs/GetWorldProperties", {}))[0]


def test_world_properties(world: RosGraph) -> None:
    found = properties(world)
    assert found.success
    assert sorted(found.model_names) == ["ground", "wall"]
    assert found.sim_time > 0


def test_pause_holds_the_clock_and_unpause_lets_it_go(world: RosGraph) -> None:
    call(world, empty("pause_physics"))
    assert world.call(probes.clock_stands_still)
    before = properties(world).sim_time
    assert properties(world).sim_time == before
    call(world, empty("unpause_physics"))
    assert world.call(probes.clock_at_least, before + 0.1)


def test_steps_of_a_paused_world_are_counted_exactly(world: RosGraph) -> None:
    paused = call(world, empty("pause_physics"), step(0))[1]
    after = call(world, step(7))[0]
    assert after.success, after.status_message
    assert (after.sim_time - paused.sim_time).to_nsec() == 7 * int(STEP_S * 1e9)


def test_a_running_world_cannot_be_stepped(world: RosGraph) -> None:
    answer = call(world, step(1))[0]
    assert not answer.success
    assert "pause" in answer.status_message


def test_free_fall(world: RosGraph) -> None:
    """Checks that after n semi-implicit steps of h a body has fallen g h^2 n (n + 1) / 2."""
    steps, height_m = 40, 5.0
    answers = call(
        world,
        empty("pause_physics"),
        spawn("ball", BALL, pose(z=height_m)),
        step(steps),
        state("ball"),
    )
    assert answers[1].success, answers[1].status_message
    fallen = 9.81 * STEP_S**2 * steps * (steps + 1) / 2
    assert answers[3].success
    assert answers[3].pose.position.z == pytest.approx(height_m - fallen, abs=1e-9)
    assert answers[3].twist.linear.z == pytest.approx(-9.81 * STEP_S * steps, abs=1e-9)


def test_a_lidar_on_a_urdf_robot_sees_the_wall(world: RosGraph) -> None:
    answer = call(
        world, spawn("post", POST, pose(x=1.0, z=0.2), "urdf", robot_namespace="post_ns")
    )[0]
    assert answer.success, answer.status_message
    scan = world.call(probes.collect, "/post_ns/scan", "sensor_msgs/LaserScan", 2)[-1]
    assert scan.ranges[1] == pytest.approx(3.0, abs=2e-3)  # from x = 1 to the face at x = 4
    assert scan.ranges[0] == pytest.approx(3.0 / math.cos(0.5), abs=4e-3)


def test_topics_come_with_a_robot_and_go_with_it(world: RosGraph) -> None:
    call(world, spawn("post", POST, pose(z=0.2), "urdf", robot_namespace="here"))
    world.call(probes.wait_for_topics, ["/here/scan"], [])
    answer = call(world, delete("post"))[0]
    assert answer.success, answer.status_message
    world.call(probes.wait_for_topics, ["/clock"], ["/here/scan"])
    assert "post" not in properties(world).model_names


def test_the_warnings_of_a_spawn_reach_its_caller(world: RosGraph) -> None:
    odd = BALL.replace("<mass>", "<frobnication>7</frobnication><mass>")
    clean, warned = call(world, spawn("a", BALL, pose(z=1)), spawn("b", odd, pose(z=2)))
    assert clean.success and warned.success
    assert clean.status_message == "SpawnModel: Successfully spawned entity"
    first, *warnings = warned.status_message.splitlines()
    assert first == clean.status_message
    assert any("frobnication" in line for line in warnings)


def test_performance_is_told_while_somebody_listens(world: RosGraph) -> None:
    call(world, spawn("post", POST, pose(z=0.2), "urdf", robot_namespace="fast"))
    told = world.call(probes.performance_of, "/fast/scan", "sensor_msgs/LaserScan")
    assert told.real_time_factor > 0
    sensor = told.sensors[0]
    assert sensor.name == "post::lidar::lidar_sensor"
    assert sensor.sim_update_rate == pytest.approx(20.0, rel=1e-6)
    assert sensor.real_update_rate > 0
    assert sensor.fps == -1


def test_a_name_is_taken_once(world: RosGraph) -> None:
    first, second = call(world, spawn("a", BALL, pose(z=1)), spawn("a", BALL, pose(y=3, z=1)))
    assert first.success
    assert not second.success
    assert "already exists" in second.status_message
    assert properties(world).model_names.count("a") == 1


BROKEN = {
    "not closed": ("<sdf version='1.5'><model name='m'><link name='l'>", "sdf"),
    "no XML": ("", "urdf"),
    "another language": ("<html/>", "sdf"),
    "no link": ("<robot name='m'/>", "urdf"),
    "negative mass": (BALL.replace("<mass>2.0", "<mass>-2.0"), "sdf"),
    "not a number": (BALL.replace("<mass>2.0", "<mass>nan"), "sdf"),
    "no such mesh": (
        BALL.replace(
            "<sphere><radius>0.1</radius></sphere>", "<mesh><uri>file:///no.dae</uri></mesh>"
        ),
        "sdf",
    ),
    "joint without link": (
        POST.replace('<child link="lidar" />', '<child link="nothing" />'),
        "urdf",
    ),
}


@pytest.mark.parametrize("what", BROKEN)
def test_a_broken_model_leaves_nothing_and_says_why(world: RosGraph, what: str) -> None:
    xml, kind = BROKEN[what]
    before = world.call(probes.topics)
    answer = call(world, spawn("broken", xml, pose(z=1), kind))[0]
    assert not answer.success
    assert len(answer.status_message) > 10
    assert "broken" not in properties(world).model_names
    assert world.call(probes.topics) == before


def test_an_unknown_reference_frame_is_refused(world: RosGraph) -> None:
    answer = call(world, spawn("ball", BALL, pose(), reference_frame="nowhere"))[0]
    assert not answer.success
    assert "nowhere" in answer.status_message or "reference_frame" in answer.status_message


def test_deleting_what_is_not_there_is_refused(world: RosGraph) -> None:
    answer = call(world, delete("ghost"))[0]
    assert not answer.success
    assert "ghost" in answer.status_message


def test_states_are_set_and_read_in_any_frame(world: RosGraph) -> None:
    post_at = pose(x=1, y=2, z=0.2, yaw=math.pi / 2)
    wanted = ModelState("ball", pose(x=1.0), Twist(Vector3(0.5, 0, 0), Vector3()), "post")
    answers = call(
        world,
        empty("pause_physics"),
        spawn("post", POST, post_at, "urdf"),
        spawn("ball", BALL, pose(z=3)),
        ("/gazebo/set_model_state", "gazebo_msgs/SetModelState", {"model_state": wanted}),
        state("ball"),
        state("ball", "post"),
    )
    assert answers[3].success, answers[3].status_message
    in_world, in_post = answers[4:]
    position = in_world.pose.position  # 1 m ahead of a post that looks along +y
    assert (position.x, position.y, position.z) == pytest.approx((1, 3, 0.2), abs=1e-9)
    speed = in_world.twist.linear
    assert (speed.x, speed.y, speed.z) == pytest.approx((0, 0.5, 0), abs=1e-9)
    assert in_post.pose.position.x == pytest.approx(1.0, abs=1e-9)
    assert in_post.twist.linear.x == pytest.approx(0.5, abs=1e-9)
    assert in_post.header.frame_id == "post"


def test_a_model_within_a_model_has_a_state_of_its_own(world: RosGraph) -> None:
    ball = BALL[BALL.index("<model") : BALL.index("</sdf>")]
    inside = "<model name='tray'><pose>1 0 0 0 0 0</pose><link name='plate'/></model>"
    carrier = f"<sdf version='1.9'>{ball.replace('</model>', inside + '</model>')}</sdf>"
    wanted = ModelState("ball::tray", pose(x=4, z=3), Twist(), "")
    answers = call(
        world,
        empty("pause_physics"),
        spawn("ball", carrier, pose(z=3)),
        state("ball::tray"),
        ("/gazebo/set_model_state", "gazebo_msgs/SetModelState", {"model_state": wanted}),
        state("ball"),
        ("/gazebo/get_model_properties", "gazebo_msgs/GetModelProperties", {"model_name": "ball"}),
    )
    assert answers[2].pose.position.x == pytest.approx(1.0, abs=1e-9)
    assert answers[3].success, answers[3].status_message
    assert answers[4].pose.position.x == pytest.approx(3.0, abs=1e-9)
    assert answers[5].child_model_names == ["tray"]


def test_the_state_of_an_unknown_model_is_refused(world: RosGraph) -> None:
    missing = ModelState("ghost", pose(), Twist(), "")
    set_answer, get_answer = call(
        world,
        ("/gazebo/set_model_state", "gazebo_msgs/SetModelState", {"model_state": missing}),
        state("ghost"),
    )
    for answer in (set_answer, get_answer):
        assert not answer.success
        assert "ghost" in answer.status_message


def test_a_state_that_is_not_a_number_is_refused(world: RosGraph) -> None:
    bad = ModelState("ball", pose(x=math.nan), Twist(), "")
    answers = call(
        world,
        spawn("ball", BALL, pose(z=1)),
        ("/gazebo/set_model_state", "gazebo_msgs/SetModelState", {"model_state": bad}),
        state("ball"),
    )
    assert not answers[1].success
    assert math.isfinite(answers[2].pose.position.x)


def test_a_quaternion_of_any_length_is_a_rotation(world: RosGraph) -> None:
    wanted = pose(z=5.0)
    wanted.orientation = Quaternion(0, 0, 1e200, 1e200)
    fields = {"model_state": ModelState("ball", wanted, Twist(), "")}
    answers = call(
        world,
        empty("pause_physics"),
        spawn("ball", BALL, pose(z=5.0)),
        ("/gazebo/set_model_state", "gazebo_msgs/SetModelState", fields),
        state("ball"),
    )
    assert answers[2].success, answers[2].status_message
    turned = answers[3].pose.orientation
    assert (turned.z, turned.w) == pytest.approx((math.sqrt(0.5), math.sqrt(0.5)), abs=1e-9)


def test_gravity_is_set_and_read(world: RosGraph) -> None:
    get = ("/gazebo/get_physics_properties", "gazebo_msgs/GetPhysicsProperties", {})
    old = call(world, empty("pause_physics"), get)[1]
    assert old.success
    assert old.pause
    assert old.time_step == pytest.approx(STEP_S)
    assert old.gravity.z == pytest.approx(-9.81)
    fields = {
        "time_step": old.time_step,
        "max_update_rate": old.max_update_rate,
        "gravity": Vector3(0, 0, -1.62),
        "ode_config": old.ode_config,
    }
    back = dict(fields, gravity=old.gravity)
    service = ("/gazebo/set_physics_properties", "gazebo_msgs/SetPhysicsProperties")
    moon = call(
        world,
        (*service, fields),
        get,
        spawn("ball", BALL, pose(z=2)),
        step(10),
        state("ball"),
        (*service, back),
    )
    assert moon[0].success
    assert moon[1].gravity.z == pytest.approx(-1.62)
    assert moon[4].twist.linear.z == pytest.approx(-1.62 * 10 * STEP_S, abs=1e-9)


def test_physics_takes_what_it_has_told(world: RosGraph) -> None:
    get = ("/gazebo/get_physics_properties", "gazebo_msgs/GetPhysicsProperties", {})
    service = ("/gazebo/set_physics_properties", "gazebo_msgs/SetPhysicsProperties")
    old = call(world, empty("pause_physics"), get)[1]

    def request(told: Any, **ode: float) -> Any:
        config = copy.deepcopy(told.ode_config)
        for name, value in ode.items():
            setattr(config, name, value)
        return (
            *service,
            {
                "time_step": told.time_step,
                "max_update_rate": told.max_update_rate,
                "gravity": told.gravity,
                "ode_config": config,
            },
        )

    wide = dict(sor_pgs_iters=20000, max_contacts=20000, contact_surface_layer=2.0)
    answer, told = call(world, request(old, contact_max_correcting_vel=math.inf, **wide), get)
    assert answer.success
    again, same, back = call(world, request(told), get, request(old))
    assert again.success
    assert back.success
    assert same.ode_config == told.ode_config
    assert told.ode_config.contact_max_correcting_vel == math.inf
    assert all(getattr(told.ode_config, name) == value for name, value in wide.items())


def test_a_force_accelerates_for_its_duration(world: RosGraph) -> None:
    """Pushes 2 kg with 4 N for 0.1 s: 0.2 m/s from then on."""
    answers = call(
        world,
        empty("pause_physics"),
        spawn("ball", BALL, pose(z=50)),
        push("ball::body", Vector3(0, 4, 0), 0.1),
        step(40),
        state("ball"),
    )
    assert answers[2].success, answers[2].status_message
    assert answers[4].twist.linear.y == pytest.approx(4 / BALL_MASS_KG * 0.1, abs=1e-6)


def test_a_cleared_force_acts_no_more(world: RosGraph) -> None:
    clear = ("/gazebo/clear_body_wrenches", "gazebo_msgs/BodyRequest", {"body_name": "ball::body"})
    answers = call(
        world,
        empty("pause_physics"),
        spawn("ball", BALL, pose(z=50)),
        push("ball::body", Vector3(0, 4, 0), -1.0),
        step(10),
        clear,
        step(10),
        state("ball"),
    )
    expected = 4 / BALL_MASS_KG * 10 * STEP_S
    assert answers[6].twist.linear.y == pytest.approx(expected, abs=1e-6)


def test_a_force_on_an_unknown_body_is_refused(world: RosGraph) -> None:
    answer = call(world, push("ball::nose", Vector3(1, 0, 0), 1.0))[0]
    assert not answer.success
    assert "ball" in answer.status_message


def test_reset_world_puts_models_back_and_leaves_the_clock(world: RosGraph) -> None:
    answers = call(
        world, empty("pause_physics"), spawn("ball", BALL, pose(x=1, z=3)), step(100), state("ball")
    )
    assert answers[3].pose.position.z < 2.9
    before = properties(world).sim_time
    after = call(world, empty("reset_world"), state("ball"))[1]
    position = after.pose.position
    assert (position.x, position.y, position.z) == pytest.approx((1, 0, 3), abs=1e-9)
    assert after.twist.linear.z == 0
    assert properties(world).sim_time == pytest.approx(before)


def test_reset_simulation_starts_the_clock_again_and_sensors_go_on(world: RosGraph) -> None:
    call(world, spawn("post", POST, pose(z=0.2), "urdf", robot_namespace="r"))
    world.call(probes.collect, "/r/scan", "sensor_msgs/LaserScan", 2)
    call(world, empty("pause_physics"), empty("reset_simulation"))
    assert properties(world).sim_time == 0
    call(world, empty("unpause_physics"))
    scan = world.call(probes.collect, "/r/scan", "sensor_msgs/LaserScan", 2)[-1]
    assert scan.header.stamp.to_sec() < 30.0
