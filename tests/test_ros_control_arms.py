# SPDX-License-Identifier: MIT
"""Tests arms of three joints with a gripper: goals of their actions, and the commands of controller_manager."""
from typing import Any, Callable, Dict, Iterator, List

import pytest
from gazebo_calls import Call, call, empty, pose, simulate, spawn, step

from ardee_common.ros_graph import RosGraph, wait_until

JOINTS = ["shoulder", "elbow", "wrist"]
KINDS = ["effort", "position"]
PREEMPTED, SUCCEEDED, ABORTED = 2, 3, 4  # of actionlib_msgs/GoalStatus
GOAL_TOLERANCE_VIOLATED = -5
ACCURACY_RAD = 0.02

LINK = """<link name="{child}"><inertial><origin xyz="0.15 0 0"/><mass value="1"/>
<inertia ixx="0.001" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="{joint}" type="{type}"><parent link="{parent}"/><child link="{child}"/><origin xyz="0.3 0 0"/>
<axis xyz="{axis}"/><limit lower="{lower}" upper="{upper}" effort="100" velocity="5"/>
<dynamics damping="5"/></joint>
<transmission name="{joint}_transmission"><type>transmission_interface/SimpleTransmission</type>
<joint name="{joint}"><hardwareInterface>hardware_interface/{interface}JointInterface</hardwareInterface></joint>
<actuator name="{joint}_motor"><mechanicalReduction>1</mechanicalReduction></actuator></transmission>"""
PARAMETERS = """
joints: {{type: joint_state_controller/JointStateController, publish_rate: 50}}
wrenches: {{type: force_torque_sensor_controller/ForceTorqueSensorController, publish_rate: 50}}
arm:
  type: {kind}_controllers/JointTrajectoryController
  joints: [shoulder, elbow, wrist]
  constraints: {{goal_time: 0.5, stopped_velocity_tolerance: 0.0, shoulder: {{goal: 0.05}}, elbow: {{goal: 0.05}},
    wrist: {{goal: 0.05}}}}
  gains:  # with twice these d a straight arm is unstable: a PID acts once in 1 ms
    {{shoulder: {{p: 400.0, d: 20.0}}, elbow: {{p: 200.0, d: 10.0}}, wrist: {{p: 100.0, d: 5.0}}}}
gripper:
  type: {kind}_controllers/GripperActionController
  joint: finger
  goal_tolerance: 0.002
  stall_timeout: 0.3
  gains: {{finger: {{p: 400.0, d: 40.0}}}}
"""


def robot(kind: str) -> str:
    """Returns an arm that turns about vertical axes, unaffected by gravity; the wrist turns to 1 rad only."""
    links = ['<link name="world"/>', LINK_OF_BASE]
    parent = "base_link"
    for joint, type_, axis, lower, upper in (
        ("shoulder", "revolute", "0 0 1", -3, 3),
        ("elbow", "revolute", "0 0 1", -3, 3),
        ("wrist", "revolute", "0 0 1", -1, 1),
        ("finger", "prismatic", "1 0 0", 0, 0.05),
    ):
        child = joint + "_link"
        links.append(
            LINK.format(
                joint=joint,
                parent=parent,
                child=child,
                type=type_,
                axis=axis,
                lower=lower,
                upper=upper,
                interface=kind.capitalize(),
            )
        )
        parent = child
    plugin = f"""<gazebo><plugin name="control" filename="libgazebo_ros_control.so">
<robotNamespace>/{kind}</robotNamespace></plugin></gazebo>"""
    return f'<robot name="{kind}">{"".join(links)}{plugin}</robot>'


LINK_OF_BASE = """<link name="base_link"><inertial><mass value="5"/>
<inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="fixed" type="fixed"><parent link="world"/><child link="base_link"/></joint>"""


def manage(kind: str, service: str, type_: str, **fields: Any) -> Call:
    return f"/{kind}/controller_manager/{service}", f"controller_manager_msgs/{type_}", fields


def states(graph: RosGraph, kind: str) -> Dict[str, str]:
    listed = call(graph, manage(kind, "list_controllers", "ListControllers"))[0].controller
    return {each.name: each.state for each in listed}


@pytest.fixture(scope="module")
def arms(shared_graph: RosGraph) -> Iterator[RosGraph]:
    """Yields the simulator, paused, with both arms and their controllers, which spawners have started."""
    simulate(shared_graph)
    call(shared_graph, empty("pause_physics"))
    for i, kind in enumerate(KINDS):
        answer = call(shared_graph, spawn(kind, robot(kind), pose(y=5.0 * i), "urdf"))[0]
        assert answer.success, answer.status_message
        file = shared_graph.folder / f"{kind}.yaml"
        file.write_text(PARAMETERS.format(kind=kind))
        shared_graph.spawn(
            "rosrun", "controller_manager", "spawner", "--namespace", f"/{kind}", str(file)
        )
        wait_until(
            lambda: list(states(shared_graph, kind).values()) == ["running"] * 4,
            "running controllers",
        )
    yield shared_graph


def send(name: str, action: str, goal: Any, steps: int, cancel: bool) -> Any:
    """Returns the state and the result of a goal, cancelled after the steps if requested."""
    import actionlib
    import rospy

    import control_msgs.msg
    from ardee_msgs.srv import Step

    rospy.init_node("client", anonymous=True, disable_signals=True)
    client = actionlib.SimpleActionClient(name, getattr(control_msgs.msg, action + "Action"))
    client.wait_for_server()
    client.send_goal(goal)
    wait_until(client.get_state, "an answer to the goal")  # 0: pending
    advance = rospy.ServiceProxy("/ardee/step", Step)
    advance(steps=steps)
    if cancel:
        client.cancel_goal()
    # The state may come before the result.
    wait_until(lambda: client.get_state() > 1 and client.get_result(), "the end of the goal")
    return client.get_state(), client.get_result()


def follow(
    graph: RosGraph, kind: str, positions: List[float], steps: int, cancel: bool = False
) -> Any:
    """Returns the end of a goal of the arm that is reached after 1 s."""
    import rospy
    from trajectory_msgs.msg import JointTrajectoryPoint

    from control_msgs.msg import FollowJointTrajectoryGoal

    goal = FollowJointTrajectoryGoal()
    goal.trajectory.joint_names = JOINTS
    still = [0.0] * len(JOINTS)
    goal.trajectory.points = [
        JointTrajectoryPoint(
            positions=positions, velocities=still, time_from_start=rospy.Duration(1)
        )
    ]
    name = f"/{kind}/arm/follow_joint_trajectory"
    return graph.call(send, name, "FollowJointTrajectory", goal, steps, cancel)


def positions(graph: RosGraph, kind: str) -> List[float]:
    """Returns the positions of the arm's joints from the trajectory's state."""
    state = graph.call(
        next_message, f"/{kind}/arm/state", "control_msgs/JointTrajectoryControllerState"
    )
    assert state.joint_names == JOINTS
    return list(state.actual.positions)


def next_message(topic: str, kind: str) -> Any:
    """Returns the first message within the next 50 steps."""
    import roslib.message
    import rospy

    from ardee_common.ros_node import is_connected
    from ardee_msgs.srv import Step

    rospy.init_node("listener", anonymous=True, disable_signals=True)
    heard = []  # type: List[Any]
    message = roslib.message.get_message_class(kind)
    subscriber = rospy.Subscriber(topic, message, heard.append)
    wait_until(lambda: is_connected(subscriber), f"a publisher of {topic}")
    rospy.ServiceProxy("/ardee/step", Step)(steps=50)
    wait_until(lambda: heard, "a message")
    return heard[-1]


@pytest.mark.parametrize("kind", KINDS)
def test_a_goal_is_reached(arms: RosGraph, kind: str) -> None:
    state, result = follow(arms, kind, [0.5, -0.4, 0.3], 1600)
    assert (state, result.error_code, result.error_string) == (SUCCEEDED, 0, "")
    assert positions(arms, kind) == pytest.approx([0.5, -0.4, 0.3], abs=ACCURACY_RAD)


@pytest.mark.parametrize("kind", KINDS)
def test_a_goal_beyond_a_limit_is_aborted(arms: RosGraph, kind: str) -> None:
    state, result = follow(arms, kind, [0.0, 0.0, 1.5], 1600)
    assert (state, result.error_code) == (ABORTED, GOAL_TOLERANCE_VIOLATED)
    assert result.error_string.startswith("wrist goal error 0.")


@pytest.mark.parametrize("kind", KINDS)
def test_a_cancelled_arm_stays_where_it_is(arms: RosGraph, kind: str) -> None:
    follow(arms, kind, [0.0, 0.0, 0.0], 1600)
    state, _ = follow(arms, kind, [1.0, 0.0, 0.0], 500, cancel=True)
    assert state == PREEMPTED
    call(arms, step(1000))
    assert 0.3 < positions(arms, kind)[0] < 0.7  # half way


def grip(graph: RosGraph, kind: str, position: float) -> Any:
    """Returns the end of a goal of the gripper."""
    from control_msgs.msg import GripperCommand, GripperCommandGoal

    goal = GripperCommandGoal(GripperCommand(position=position, max_effort=20.0))
    return graph.call(send, f"/{kind}/gripper/gripper_cmd", "GripperCommand", goal, 3000, False)


@pytest.mark.parametrize("kind", KINDS)
def test_a_gripper_reaches_its_goal(arms: RosGraph, kind: str) -> None:
    state, result = grip(arms, kind, 0.03)
    assert (state, result.reached_goal, result.stalled) == (SUCCEEDED, True, False)
    assert result.position == pytest.approx(0.03, abs=0.003)


@pytest.mark.parametrize("kind", KINDS)
def test_a_gripper_stalls_at_its_limit(arms: RosGraph, kind: str) -> None:
    state, result = grip(arms, kind, 0.08)
    assert (state, result.reached_goal, result.stalled) == (ABORTED, False, True)
    assert result.position == pytest.approx(0.05, abs=0.003)


def test_a_joint_feels_what_it_carries(arms: RosGraph) -> None:
    wrench = arms.call(next_message, "/effort/shoulder", "geometry_msgs/WrenchStamped")
    assert wrench.header.frame_id == "shoulder_link"
    assert wrench.wrench.force.z == pytest.approx(-4 * 9.8, abs=0.05)  # four links of 1 kg


def test_the_state_of_a_trajectory_is_told(arms: RosGraph) -> None:
    follow(arms, "effort", [0.2, 0.1, 0.0], 1600)
    answer = call(
        arms,
        ("/effort/arm/query_state", "control_msgs/QueryTrajectoryState", {"time": far_away()}),
    )[0]
    assert answer.name == JOINTS
    assert list(answer.position) == pytest.approx([0.2, 0.1, 0.0], abs=1e-9)
    assert list(answer.velocity) == [0.0, 0.0, 0.0]


def far_away() -> Any:
    import rospy

    return rospy.Time(1000)


def test_a_goal_of_other_joints_is_rejected(arms: RosGraph) -> None:
    from control_msgs.msg import FollowJointTrajectoryGoal

    goal = FollowJointTrajectoryGoal()
    goal.trajectory.joint_names = ["shoulder", "elbow", "knee"]
    name = "/effort/arm/follow_joint_trajectory"
    state, result = arms.call(send, name, "FollowJointTrajectory", goal, 1, False)
    assert (state, result.error_code) == (5, -2)
    assert "'knee'" in result.error_string


def command(graph: RosGraph, *words: str) -> str:
    return graph.run("rosrun", "controller_manager", "controller_manager", *words, "__ns:=/effort")


def test_the_commands_of_controller_manager(arms: RosGraph) -> None:
    assert command(arms, "stop", "gripper") == "Stopped ['gripper'] successfully\n"
    assert states(arms, "effort")["gripper"] == "stopped"
    assert "'gripper' - 'hardware_interface::EffortJointInterface' ( stopped )" in command(
        arms, "list"
    )
    assert command(arms, "start", "gripper") == "Started ['gripper'] successfully\n"
    assert "effort_controllers/GripperActionController" in command(arms, "list-types").split()
    with pytest.raises(RuntimeError, match="Error when loading 'ghost'"):
        command(arms, "load", "ghost")


def test_an_unspawner_and_a_spawner_put_back_what_they_found(arms: RosGraph) -> None:
    def ended_by(process: Any, condition: Callable[[], bool], what: str) -> None:
        wait_until(condition, what)
        process.stop()

    rosrun = ("rosrun", "controller_manager")
    unspawner = arms.spawn(*rosrun, "unspawner", "gripper", "__ns:=/effort")
    ended_by(unspawner, lambda: states(arms, "effort")["gripper"] == "stopped", "a stopped gripper")
    wait_until(lambda: states(arms, "effort")["gripper"] == "running", "a gripper that runs again")

    arms.run("rosparam", "set", "/effort/other/type", "joint_state_controller/JointStateController")
    arms.run("rosparam", "set", "/effort/other/publish_rate", "10")
    spawner = arms.spawn(*rosrun, "spawner", "--stopped", "other", "__ns:=/effort")
    ended_by(
        spawner, lambda: states(arms, "effort").get("other") == "initialized", "a loaded controller"
    )
    wait_until(lambda: "other" not in states(arms, "effort"), "a controller that is gone")


GROUPS = """
controller_groups: {reach: [joints, arm], grip: [joints, gripper], all: [joints, arm, gripper]}
late: {type: joint_state_controller/JointStateController, publish_rate: 10}
"""


def test_groups_of_controllers_and_a_reload_that_restores_them(arms: RosGraph) -> None:
    def group(*words: str) -> str:
        return arms.run("rosrun", "controller_manager", "controller_group", *words, "__ns:=/effort")

    file = arms.folder / "groups.yaml"
    file.write_text(GROUPS)
    arms.run("rosparam", "load", str(file), "/effort")
    assert group("switch", "grip") == "Started [], stopped ['arm']\n"
    assert group("switch", "reach") == "Started ['arm'], stopped ['gripper']\n"
    assert "grip: 1 of 2 running\n  joints ( running )\n  gripper ( stopped )" in group("list")

    before = states(arms, "effort")
    running = [name for name, state in before.items() if state == "running"]
    restored = command(arms, "reload-libraries", "--restore").splitlines()
    assert restored[0] == "Successfully reloaded libraries"
    assert restored[-1] == f"Started {running} successfully"
    assert states(arms, "effort") == {**before, "gripper": "initialized"}
    assert group("spawn", "all") == "Started ['gripper'], stopped []\n"
    assert set(states(arms, "effort").values()) == {"running"}


def test_a_spawner_waits_for_what_it_is_told(arms: RosGraph) -> None:
    file = arms.folder / "groups.yaml"
    file.write_text(GROUPS)
    arms.run("rosparam", "load", str(file), "/effort")
    before = list(states(arms, "effort"))
    spawner = arms.spawn(
        "rosrun", "controller_manager", "spawner", "--wait-for", "go", "late", "__ns:=/effort"
    )
    assert arms.call(allow, "/effort/go", "late") == before
    wait_until(lambda: states(arms, "effort")["late"] == "running", "a controller that runs")
    spawner.stop()
    assert "late" not in states(arms, "effort")


def allow(topic: str, controller: str) -> List[str]:
    """Publishes false, then true, until the controller is loaded; returns the controllers present after false."""
    import time

    import rospy
    from std_msgs.msg import Bool

    from controller_manager_msgs.srv import ListControllers

    rospy.init_node("starter", anonymous=True, disable_signals=True)
    publisher = rospy.Publisher(topic, Bool, queue_size=1, latch=True)
    ask = rospy.ServiceProxy("/effort/controller_manager/list_controllers", ListControllers)
    publisher.publish(False)
    wait_until(publisher.get_num_connections, f"a listener on {topic}")
    time.sleep(0.5)
    before = [each.name for each in ask().controller]
    publisher.publish(True)
    wait_until(lambda: controller in [each.name for each in ask().controller], "a controller")
    return before
