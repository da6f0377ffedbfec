# SPDX-License-Identifier: MIT
"""Tests the bridge's nodes by all names, alone and from the launch file, and their messages about bad settings."""
import pathlib
import re
import signal

import pytest
from bridge_bench import free_port

from ardee_common.ros_graph import RosGraph, wait_until

NODES = [
    ("ardee_bridge", "sensor_server_node"),
    ("ardee_bridge", "controls_client_node"),
    ("ardee_bridge", "ardee_rc_controller_node"),
    ("ardee_sensors", "ardee_sensor_relay_node"),
]


@pytest.mark.parametrize("package, name", NODES)
def test_each_name_starts_alone_on_loopback_and_ends_by_ctrl_c(
    shared_graph: RosGraph, package: str, name: str
) -> None:
    node = shared_graph.spawn("rosrun", package, name, "_port:=0")
    wait_until(lambda: "127.0.0.1:" in node.output(), "it says where its socket is")
    assert f"/{name}" in shared_graph.run("rosnode", "list").split()
    node.interrupt()
    assert node.wait(20.0) == 0, node.output()


def test_a_multicast_that_nobody_else_gets_is_told(shared_graph: RosGraph) -> None:
    parameters = ("_port:=0", "_peers:=[{address: 239.7.7.7, port: 30000, data_types: [imu]}]")
    node = shared_graph.spawn("rosrun", "ardee_bridge", "sensor_server_node", *parameters)
    said = "messages to 239.7.7.7 stay on this computer: found bind_address 127.0.0.1"
    wait_until(lambda: said in node.output(), "the warning")
    node.interrupt()
    assert node.wait(20.0) == 0, node.output()
    shared_graph.run("rosparam", "delete", "/sensor_server_node")


WAITING = [*NODES, ("ardee_navigation", "row_follower")]


@pytest.mark.parametrize("package, name", WAITING)
def test_ctrl_c_before_there_is_a_master_ends_it_with_the_line_that_it_waits(
    shared_graph: RosGraph, package: str, name: str
) -> None:
    uri = f"http://127.0.0.1:{free_port()}"
    node = shared_graph.spawn("rosrun", package, name, "_a:=1", ROS_MASTER_URI=uri)
    line = f"{name}: waiting for the ROS master at {uri}\n"
    wait_until(lambda: node.output() == line, f"only {line!r}")
    node.interrupt()
    assert (node.wait(20.0), node.output()) == (-signal.SIGINT, line)


@pytest.mark.parametrize("package, name", WAITING)
def test_help_needs_no_master_and_a_word_that_is_none_of_ros_is_refused(
    shared_graph: RosGraph, package: str, name: str
) -> None:
    uri = f"http://127.0.0.1:{free_port()}"
    for word in ("-h", "--help"):
        node = shared_graph.spawn("rosrun", package, name, "_port:=0", word, ROS_MASTER_URI=uri)
        assert node.wait() == 0
        assert node.output().startswith(f"usage: {name} [-h]") and "_PARAMETER" in node.output()
    node = shared_graph.spawn("rosrun", package, name, "_port=0", ROS_MASTER_URI=uri)
    assert (node.wait(), node.output()) == (
        2,
        f"{name}: unrecognized arguments: _port=0 (--help lists all arguments)\n",
    )


@pytest.mark.parametrize("package, name", NODES)
def test_a_node_with_parameters_starts_once_there_is_a_master(
    graph: RosGraph, package: str, name: str
) -> None:
    graph.end_master()
    node = graph.spawn("rosrun", package, name, "_port:=0")
    wait_until(lambda: "waiting for the ROS master" in node.output(), "it waits")
    graph.start_master()
    wait_until(lambda: "127.0.0.1:" in node.output().partition("\n")[2], "a socket")
    assert "Traceback" not in node.output()


@pytest.mark.parametrize("package, name", WAITING)
def test_ctrl_c_amid_the_imports_ends_it_without_a_word(
    graph: RosGraph, package: str, name: str, tmp_path: pathlib.Path
) -> None:
    (tmp_path / "rospy.py").write_text(
        "import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\ntime.sleep(60)\n"
    )
    path = f"{tmp_path}:{graph.env.get('PYTHONPATH', '')}"
    node = graph.spawn("rosrun", package, name, PYTHONPATH=path)
    assert (node.wait(20.0), node.output()) == (-signal.SIGINT, "")


def test_a_priority_is_accepted_and_said_to_have_no_effect(shared_graph: RosGraph) -> None:
    parameters = ("_port:=0", "_realtime_priority:=1")
    node = shared_graph.spawn("rosrun", "ardee_bridge", "sensor_server_node", *parameters)
    wait_until(lambda: "realtime_priority: found 1, which has no effect" in node.output(), "a line")
    node.interrupt()
    assert node.wait(20.0) == 0, node.output()
    shared_graph.run("rosparam", "delete", "/sensor_server_node")


@pytest.mark.parametrize(
    "name, parameter, message",
    [
        (
            "sensor_server_node",
            "_peers:=[{address: 10.1.2.3, port: 1, data_types: [all]}]",
            "cannot be reached from bind_address",
        ),
        (
            "sensor_server_node",
            "_sources:=[{name: a, topic: t, kind: sonar}]",
            "found 'sonar', expected one of imu",
        ),
        (
            "controls_client_node",
            "_watchdog_s:=never",
            "watchdog_s: found 'never', expected 0.01 to 60",
        ),
        ("controls_client_node", "_bind_address:=203.0.113.7", "UDP 203.0.113.7:35555"),
        (
            "controls_client_node",
            "_wachdog_s:=1",
            "unknown key 'wachdog_s', nearest",
        ),
    ],
)
def test_a_bad_setting_is_one_line_and_exit_2(
    shared_graph: RosGraph, name: str, parameter: str, message: str
) -> None:
    node = shared_graph.spawn("rosrun", "ardee_bridge", name, parameter)
    assert node.wait(30.0) == 2
    assert node.output().startswith(f"/{name}: ") and message in node.output()
    assert len(node.output().strip().split("\n")) == 1
    shared_graph.run("rosparam", "delete", f"/{name}")


def test_the_launch_file_starts_both_with_its_arguments(graph: RosGraph) -> None:
    sensors, controls = free_port(), free_port()
    ports = (f"sensors_port:={sensors}", f"controls_port:={controls}")
    more = ("watchdog_s:=0.25", "multicast_ttl:=3")
    launched = graph.launch("ardee_bridge", "bridge.launch", *ports, *more)
    for port in (sensors, controls):
        wait_until(lambda: f"127.0.0.1:{port}" in launched.output(), f"a socket at {port}")
    found = graph.run("rosparam", "get", "/udp_control_node")
    assert "watchdog_s: 0.25" in found and re.search(r"peers:\n- 127\.0\.0\.1", found)
    assert "multicast_ttl: 3" in graph.run("rosparam", "get", "/sim_sensor_node")
