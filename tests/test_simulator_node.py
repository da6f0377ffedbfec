# SPDX-License-Identifier: MIT
"""Tests the simulator node: links, joints and wrenches by service, and the command spawn_model."""
import math
import pathlib

import probes
import pytest
from geometry_msgs.msg import Twist, Vector3
from test_services import (  # noqa: F401  (fixtures)
    BALL,
    POST,
    STEP_S,
    as_before,
    call,
    empty,
    pose,
    properties,
    push,
    spawn,
    state,
    step,
    world,
)

from ardee_common.ros_graph import RosGraph, wait_until

DATA = pathlib.Path(__file__).parent / "data"
TURNTABLE = (DATA / "turntable.sdf").read_text()
DISC_INERTIA_KG_M2 = 0.5
AXLE = ("/gazebo/get_joint_properties", "gazebo_msgs/GetJointProperties", {"joint_name": "axle"})


def configure(model: str, joint: str, position_rad: float) -> tuple:
    fields = {"model_name": model, "joint_names": [joint], "joint_positions": [position_rad]}
    return "/gazebo/set_model_configuration", "gazebo_msgs/SetModelConfiguration", fields


def test_a_link_is_moved_with_its_model(world: RosGraph) -> None:  # noqa: F811
    from gazebo_msgs.msg import LinkState

    wanted = LinkState("post::lidar", pose(x=2, z=1.3, yaw=math.pi / 2), Twist(), "")
    answers = call(
        world,
        empty("pause_physics"),
        spawn("post", POST, pose(), "urdf"),
        ("/gazebo/set_link_state", "gazebo_msgs/SetLinkState", {"link_state": wanted}),
        state("post"),
        (
            "/gazebo/get_link_state",
            "gazebo_msgs/GetLinkState",
            {"link_name": "post::lidar", "reference_frame": "post::base"},
        ),
    )
    assert answers[2].success, answers[2].status_message
    at = answers[3].pose.position  # the lidar is 0.3 m above the base
    assert (at.x, at.y, at.z) == pytest.approx((2, 0, 1.0), abs=1e-9)
    above = answers[4].link_state.pose.position
    assert (above.x, above.y, above.z) == pytest.approx((0, 0, 0.3), abs=1e-9)


def test_forces_add_up_and_their_frame_counts(world: RosGraph) -> None:  # noqa: F811
    """Pushes a ball turned by 90 degrees twice with 4 N along its x axis: 8 N along the world's y."""
    along_x = push("ball::body", Vector3(4, 0, 0), 0.1, "ball::body")
    answers = call(
        world,
        empty("pause_physics"),
        spawn("ball", BALL, pose(z=50, yaw=math.pi / 2)),
        along_x,
        along_x,
        step(40),
        state("ball"),
    )
    speed = answers[5].twist.linear
    assert (speed.x, speed.y) == pytest.approx((0, 8 / 2.0 * 0.1), abs=1e-6)


def test_an_effort_turns_a_joint_for_its_duration(world: RosGraph) -> None:  # noqa: F811
    """Applies 2 N m to 0.5 kg m^2 for 0.1 s: 0.4 rad/s from then on."""
    import rospy

    effort = {"joint_name": "axle", "effort": 2.0, "duration": rospy.Duration.from_sec(0.1)}
    answers = call(
        world,
        empty("pause_physics"),
        spawn("table", TURNTABLE, pose(z=1)),
        ("/gazebo/apply_joint_effort", "gazebo_msgs/ApplyJointEffort", effort),
        step(40),
        AXLE,
    )
    assert answers[2].success, answers[2].status_message
    assert answers[4].rate[0] == pytest.approx(2.0 * 0.1 / DISC_INERTIA_KG_M2, abs=1e-6)


def test_joints_are_set_all_or_none(world: RosGraph) -> None:  # noqa: F811
    answers = call(
        world,
        empty("pause_physics"),
        spawn("table", TURNTABLE, pose(z=1)),
        configure("table", "axle", 0.7),
        AXLE,
        configure("table", "no_such_joint", 0.1),
        configure("table", "axle", math.inf),
        AXLE,
    )
    assert answers[2].success, answers[2].status_message
    assert answers[3].position[0] == pytest.approx(0.7, abs=1e-9)
    assert not answers[4].success and "no_such_joint" in answers[4].status_message
    assert not answers[5].success
    assert answers[6].position[0] == pytest.approx(0.7, abs=1e-9)


def test_a_robot_stays_away_whose_namespace_is_no_name(world: RosGraph) -> None:  # noqa: F811
    before = world.call(probes.topics)
    answer = call(world, spawn("post", POST, pose(), "urdf", robot_namespace="two words"))[0]
    assert not answer.success
    assert "two words" in answer.status_message
    assert "post" not in properties(world).model_names
    assert world.call(probes.topics) == before


def test_a_physics_step_of_zero_is_refused(world: RosGraph) -> None:  # noqa: F811
    service = "/gazebo/set_physics_properties", "gazebo_msgs/SetPhysicsProperties"
    answer = call(world, (*service, {"time_step": 0.0, "max_update_rate": 200.0}))[0]
    assert not answer.success
    assert "time_step" in answer.status_message
    assert time_step_s(world) == pytest.approx(STEP_S)


def time_step_s(graph: RosGraph) -> float:
    service = ("/gazebo/get_physics_properties", "gazebo_msgs/GetPhysicsProperties", {})
    return call(graph, service)[0].time_step


def test_spawn_model_sets_pose_and_joints(
    world: RosGraph, tmp_path: pathlib.Path
) -> None:  # noqa: F811
    call(world, empty("pause_physics"))
    file = DATA / "turntable.sdf"
    place = ["-x", "-1.5", "-y", "2e-1", "-z", "1", "-Y", "-0.5"]
    world.run(
        *["rosrun", "ardee_sim_cpp", "spawn_model", "-sdf", "-file", str(file), "-model", "table"],
        *place,
        *["-J", "axle", "0.7"],
    )
    table, axle = call(world, state("table"), AXLE)
    at = table.pose.position
    assert (at.x, at.y, at.z) == pytest.approx((-1.5, 0.2, 1.0), abs=1e-9)
    assert axle.position[0] == pytest.approx(0.7, abs=1e-9)


@pytest.mark.parametrize(
    "arguments, named",
    [
        (["-sdf", "-file", "/no/such.sdf", "-model", "a"], "/no/such.sdf"),
        (["-urdf", "-param", "no_such_param", "-model", "a"], "no_such_param"),
        (["-sdf", "-database", "no_such_model", "-model", "a"], "no_such_model"),
        (["-sdf", "-file", str(DATA / "ball.sdf"), "-model", "wall"], "already exists"),
        (["-urdf", "-file", __file__, "-model", "a"], __file__),
        (["-sdf", "-file", str(DATA / "ball.sdf"), "-model", "a", "-x", "nan"], "nan"),
    ],
)
def test_spawn_model_says_why_not(
    world: RosGraph, arguments: list, named: str
) -> None:  # noqa: F811
    command = world.spawn("rosrun", "ardee_sim_cpp", "spawn_model", *arguments)
    assert command.wait(30.0) not in (0, None)
    assert named in command.output()
    assert "Traceback" not in command.output()


def test_spawn_model_takes_its_model_away_when_stopped(world: RosGraph) -> None:  # noqa: F811
    file = str(DATA / "ball.sdf")
    command = world.spawn(
        "rosrun", "ardee_sim_cpp", "spawn_model", "-sdf", "-file", file, "-model", "bound", "-b"
    )
    wait_until(lambda: "bound" in properties(world).model_names, "the model")
    command.interrupt()
    assert command.wait(20.0) == 0, command.output()
    assert "bound" not in properties(world).model_names


def test_ctrl_c_ends_a_long_step(graph: RosGraph) -> None:
    import threading

    plane = str(DATA / "plane.world")
    executable = graph.run("catkin_find", "--first-only", "--libexec", "ardee_sim_cpp", "simulator")
    simulator = graph.spawn(executable.strip(), plane, "--paused")
    graph.call(probes.wait_for_topics, ["/clock"], [])
    answers = []
    thread = threading.Thread(target=lambda: answers.append(try_long_step(graph)))
    thread.start()
    graph.call(probes.clock_at_least, 0.1)
    simulator.interrupt()
    assert simulator.wait(10.0) == 0, simulator.output()
    thread.join()


def try_long_step(graph: RosGraph) -> None:
    """Requests more steps than the test has time for; the call ends with the simulator."""
    try:
        call(graph, step(4_000_000_000))
    except AssertionError:
        pass
