# SPDX-License-Identifier: MIT
"""The services of the controller manager of a robot with libgazebo_ros_control.so, and the topics of its controllers,
which come and go with them."""
import pathlib
from typing import Any, Dict, Iterator, List, Tuple

import probes
import pytest
from gazebo_calls import Call, call, delete, empty, pose, simulate, spawn, step

from ardee_common.ros_graph import RosGraph

ROBOT = (
    pathlib.Path(__file__).parent / "cases" / "ros-control-diff-drive" / "wheels.urdf"
).read_text()
BEST_EFFORT, STRICT = 1, 2
PARAMETERS = """
joints: {type: joint_state_controller/JointStateController, publish_rate: 50}
base: &base
  type: diff_drive_controller/DiffDriveController
  left_wheel: left
  right_wheel: right
  wheel_separation: 0.4
  wheel_radius: 0.1
  pose_covariance_diagonal: [0.001, 0.001, 0.001, 0.001, 0.001, 0.03]
  twist_covariance_diagonal: [0.001, 0.001, 0.001, 0.001, 0.001, 0.03]
left_alone: {type: velocity_controllers/JointVelocityController, joint: left}
integers: {<<: *base, pose_covariance_diagonal: [0, 0, 0, 0, 0, 0]}
taken: {<<: *base}
strange: {type: nobodys/Controller}
"""
IMU = """<gazebo><plugin name="imu" filename="libgazebo_ros_imu.so"><bodyName>base_link</bodyName>
<topicName>/taken/odom</topicName></plugin></gazebo></robot>"""


def manage(service: str, kind: str, **fields: Any) -> Call:
    return f"/controller_manager/{service}", f"controller_manager_msgs/{kind}", fields


def load(name: str) -> Call:
    return manage("load_controller", "LoadController", name=name)


def unload(name: str) -> Call:
    return manage("unload_controller", "UnloadController", name=name)


def switch(start: List[str], stop: List[str], strictness: int = STRICT) -> Call:
    return manage(
        "switch_controller",
        "SwitchController",
        start_controllers=start,
        stop_controllers=stop,
        strictness=strictness,
    )


def oks(graph: RosGraph, *calls: Call) -> List[bool]:
    return [answer.ok for answer in call(graph, *calls)]


def states(graph: RosGraph) -> Dict[str, str]:
    answer = call(graph, manage("list_controllers", "ListControllers"))[0]
    return {each.name: each.state for each in answer.controller}


def topics(graph: RosGraph) -> Tuple[List[str], List[str]]:
    return graph.call(probes.topics_of, "/gazebo")


@pytest.fixture(scope="module")
def world(shared_graph: RosGraph) -> Iterator[RosGraph]:
    """Yields the simulator with the robot, paused, and parameters of controllers."""
    file = shared_graph.folder / "control.yaml"
    file.write_text(PARAMETERS)
    shared_graph.run("rosparam", "load", str(file))
    simulate(shared_graph)
    robot = ROBOT.replace("</robot>", IMU)
    answer = call(shared_graph, empty("pause_physics"), spawn("wheels", robot, pose(), "urdf"))[1]
    assert answer.success, answer.status_message
    yield shared_graph


@pytest.fixture(autouse=True)
def as_before(world: RosGraph) -> Iterator[None]:
    """Leaves a manager without controllers after each test."""
    yield
    assert oks(
        world, manage("reload_controller_libraries", "ReloadControllerLibraries", force_kill=True)
    ) == [True]


def test_types_are_listed(world: RosGraph) -> None:
    answer = call(world, manage("list_controller_types", "ListControllerTypes"))[0]
    assert "diff_drive_controller/DiffDriveController" in answer.types
    assert answer.types == sorted(answer.types)
    assert set(answer.base_classes) == {"controller_interface::ControllerBase"}
    assert len(answer.base_classes) == len(answer.types)


def test_topics_come_and_go_with_a_controller(world: RosGraph) -> None:
    assert oks(world, load("base")) == [True]
    published, heard = topics(world)
    assert "/base/odom" in published and "/base/cmd_vel" in heard
    assert "/base/set_parameters" in world.call(probes.services_of, "/gazebo")
    assert states(world) == {"base": "initialized"}
    assert oks(world, unload("base")) == [True]
    published, heard = topics(world)
    assert "/base/odom" not in published and "/base/cmd_vel" not in heard
    assert "/base/set_parameters" not in world.call(probes.services_of, "/gazebo")


def test_a_switch_acts_at_once_while_paused(world: RosGraph) -> None:
    assert oks(world, load("joints"), load("base"), switch(["joints", "base"], [])) == [True] * 3
    assert states(world) == {"joints": "running", "base": "running"}
    listed = call(world, manage("list_controllers", "ListControllers"))[0].controller
    claims = [(each.hardware_interface, each.resources) for each in listed[1].claimed_resources]
    assert claims == [("hardware_interface::VelocityJointInterface", ["left", "right"])]
    assert oks(world, unload("base"), switch([], ["base"]), unload("base")) == [False, True, True]
    assert states(world) == {"joints": "running"}


def test_strict_and_best_effort(world: RosGraph) -> None:
    assert oks(world, load("base"), load("left_alone"), switch(["base"], [])) == [True] * 3
    assert (
        oks(
            world,
            switch(["left_alone"], []),
            switch(["left_alone"], [], BEST_EFFORT),  # both claim the left wheel
            switch(["ghost"], []),
            switch(["base"], ["base"], BEST_EFFORT),
        )
        == [False] * 4
    )
    assert states(world) == {"base": "running", "left_alone": "initialized"}
    assert oks(world, switch(["left_alone", "ghost"], ["base"], 0)) == [True]
    assert states(world) == {"base": "stopped", "left_alone": "running"}


def test_what_cannot_be_loaded_leaves_nothing(world: RosGraph) -> None:
    before = topics(world)
    names = ["ghost", "strange", "integers", "taken", "bad name"]
    assert oks(world, *[load(name) for name in names]) == [False] * len(names)
    assert states(world) == {}
    assert topics(world) == before
    said = world.logs()
    for part in (
        "found no parameter /ghost/type",
        "/strange/type: found 'nobodys/Controller', expected one of ",
        "/integers/pose_covariance_diagonal[0]: found the integer 0, expected a number with a point",
        "topic /taken/odom is already published with another type",
        "found '/bad name' as the name of a parameter",
    ):
        assert part in said, part


def test_libraries_are_reloaded_by_force_only(world: RosGraph) -> None:
    reload = manage("reload_controller_libraries", "ReloadControllerLibraries", force_kill=False)
    assert oks(world, reload, load("joints"), reload) == [True, True, False]
    assert states(world) == {"joints": "initialized"}


def test_controllers_go_on_after_a_reset(world: RosGraph) -> None:
    assert oks(world, load("joints"), switch(["joints"], [])) == [True, True]
    call(world, step(500), empty("reset_simulation"))
    message = world.call(step_and_hear)
    assert message.header.stamp.to_sec() < 0.1
    assert message.name == ["left", "right"]


def step_and_hear() -> Any:
    """Returns the first joint states of 0.1 s."""
    import rospy
    from sensor_msgs.msg import JointState

    from ardee_common.ros_graph import wait_until
    from ardee_common.ros_node import is_connected
    from ardee_msgs.srv import Step

    rospy.init_node("listener", anonymous=True, disable_signals=True)
    heard = []  # type: List[Any]
    subscriber = rospy.Subscriber("/joint_states", JointState, heard.append)
    wait_until(lambda: is_connected(subscriber), "a publisher of /joint_states")
    rospy.ServiceProxy("/ardee/step", Step)(steps=100)
    wait_until(lambda: heard, "joint states")
    return heard[0]


def test_all_go_with_the_robot(world: RosGraph) -> None:
    other = ROBOT.replace("<robotNamespace>/<", "<robotNamespace>/other<")
    assert call(world, spawn("other", other, pose(y=5.0), "urdf"))[0].success
    assert "/other/controller_manager/list_controllers" in world.call(probes.services_of, "/gazebo")
    world.run("rosparam", "load", str(world.folder / "control.yaml"), "/other")
    name, kind, fields = load("base")
    assert oks(world, ("/other" + name, kind, fields)) == [True]
    assert "/other/base/odom" in topics(world)[0]
    assert call(world, delete("other"))[0].success
    assert not [name for name in topics(world)[0] if name.startswith("/other")]
    services = world.call(probes.services_of, "/gazebo")
    assert not [name for name in services if name.startswith("/other")]
