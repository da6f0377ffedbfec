# SPDX-License-Identifier: MIT
"""Tests that a simulator without a good world, or without good parameters, says so once and ends."""
import os
import pathlib
import signal
import socket
import subprocess

import probes
import pytest

from ardee_common.ros_graph import RosGraph

DATA = pathlib.Path(__file__).parent / "data"
PLANE = (DATA / "plane.world").read_text()

BAD_WORLDS = {
    "cut off": (PLANE[: len(PLANE) // 2], "bad.world"),
    "not XML": ("a field of corn", "bad.world"),
    "empty": ("", "bad.world"),
    "no world": ("<sdf version='1.5'><model name='m'/></sdf>", "world"),
    "unknown model": (
        PLANE.replace("</world>", "<include><uri>model://no_such_plant</uri></include></world>"),
        "no_such_plant",
    ),
    "step that is no number": (PLANE.replace(">0.005<", ">soon<"), "soon"),
    "negative step": (PLANE.replace(">0.005<", ">-0.005<"), "max_step_size"),
    "topic with a blank": (
        PLANE.replace(
            "</world>",
            '<model name="m"><link name="a"/><link name="b"><pose>1 0 0 0 0 0</pose></link>'
            '<joint name="j" type="revolute"><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>'
            '</axis></joint><plugin name="push" filename="libgazebo_ros_force.so"><bodyName>a</bodyName>'
            "<topicName>the field/push</topicName></plugin></model></world>",
        ),
        "plugin 'push': found '/the field/push' as a topic or service",
    ),
    "box without size": (PLANE.replace("1 20 2", "1 -20 2"), "size"),
}


@pytest.mark.parametrize("what", BAD_WORLDS)
def test_one_message_and_an_exit_code(graph: RosGraph, tmp_path: pathlib.Path, what: str) -> None:
    text, named = BAD_WORLDS[what]
    file = tmp_path / "bad.world"
    file.write_text(text)
    simulator = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(file))
    assert simulator.wait(20.0) not in (0, -6, -11, 134, 139), simulator.output()
    lines = [line for line in simulator.output().splitlines() if "bad.world" in line]
    assert len(lines) == 1, simulator.output()
    assert named in lines[0]


def test_a_world_that_cannot_be_read_does_not_end_the_simulator_that_runs(
    graph: RosGraph, tmp_path: pathlib.Path
) -> None:
    """Both are nodes of one name, and a master would end the first."""
    file = tmp_path / "bad.world"
    file.write_text("a field of corn")
    running = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(DATA / "plane.world"))
    before_s = graph.call(probes.clock_at_least, 0.1)
    second = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(file))
    assert second.wait(20.0) == 2 and second.output().count("bad.world") == 1
    assert graph.call(probes.clock_at_least, before_s + 0.5)
    assert running.exit_code() is None


def test_a_missing_file(graph: RosGraph) -> None:
    simulator = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", "/nowhere/no.world")
    assert simulator.wait(20.0) not in (0, -6, -11, 134, 139)
    assert simulator.output().count("/nowhere/no.world") == 1


@pytest.mark.parametrize(
    "name, value, expected",
    [
        ("realtime_priority", "1.5", "found 1.500000, expected a whole number from 0 to 99"),
        ("realtime_priority", "100", "found 100.000000, expected a whole number from 0 to 99"),
        ("realtime_priority", "high", "expected a whole number from 0 to 99"),
        ("threads", "1.5", "found 1.500000, expected a whole number from 0"),
        ("seed", "-1", "found -1.000000, expected a whole number from 0"),
    ],
)
def test_a_parameter_that_is_no_whole_number(
    graph: RosGraph, name: str, value: str, expected: str
) -> None:
    world = str(DATA / "plane.world")
    simulator = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", world, f"_{name}:={value}")
    assert simulator.wait(20.0) == 2, simulator.output()
    lines = [line for line in simulator.output().splitlines() if name in line]
    assert len(lines) == 1 and expected in lines[0], simulator.output()


def without_master(*words: str) -> subprocess.Popen:
    """Starts the simulator with the address of a master that is not there."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        env = dict(os.environ, ROS_MASTER_URI=f"http://127.0.0.1:{free.getsockname()[1]}")
    command = ["rosrun", "ardee_sim_cpp", "simulator", *words]
    return subprocess.Popen(
        command, env=env, stderr=subprocess.PIPE, text=True, preexec_fn=obey_ctrl_c
    )


def obey_ctrl_c() -> None:
    """Undoes what a shell does to its jobs in the background: they ignore Ctrl-C, and so would their children."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)


@pytest.mark.parametrize("argument", ["{}", "_world:={}"])
def test_a_wrong_world_is_told_without_a_master(tmp_path: pathlib.Path, argument: str) -> None:
    (tmp_path / "farm.world").write_text(PLANE)
    node = without_master(argument.format(tmp_path / "fram.world"))
    said = node.communicate(timeout=60)[1]
    assert node.returncode == 2
    found = f"found no file {tmp_path}/fram.world, expected a world file; nearest: farm.world"
    assert said == f"simulator: {found}\n"


def test_a_good_world_waits_for_the_master_in_one_line(tmp_path: pathlib.Path) -> None:
    (tmp_path / "farm.world").write_text(PLANE)
    node = without_master(str(tmp_path / "farm.world"))
    assert node.stderr.readline().startswith("simulator: waiting for the ROS master at http://")
    node.send_signal(signal.SIGINT)
    assert node.communicate(timeout=60)[1] == ""
