# SPDX-License-Identifier: MIT
"""Tests the launch files as roslaunch reads them, without starting anything."""
import os
import pathlib
import re
import subprocess

import pytest
import yaml
from xacro_runner import SOURCES, XACRO, ros_environment

LAUNCH = pathlib.Path(__file__).resolve().parents[1] / "launch"
DESCRIBE = LAUNCH.parent / "scripts/describe_robot"
FILES = ["launch_default_tsv1.launch", "launch_default_bot.launch"]


@pytest.fixture(scope="module", autouse=True)
def workspace(tmp_path_factory: pytest.TempPathFactory):
    """Returns a catkin workspace of links, built as far as launch files look for executables."""
    root = tmp_path_factory.mktemp("workspace")
    sources = root / "src"
    sources.mkdir()
    for package in ("ardee_sensors", "terrasentia_description"):
        (sources / package).symlink_to(SOURCES / package)
    (sources / "xacro").symlink_to(XACRO.parents[1])
    for package, script in (("xacro", XACRO), ("terrasentia_description", DESCRIBE)):
        scripts = root / "devel/lib" / package
        scripts.mkdir(parents=True)
        (scripts / script.name).symlink_to(script)
    (root / "devel/.catkin").write_text(str(sources))
    with pytest.MonkeyPatch.context() as patch:
        prefixes = [str(root / "devel"), os.environ.get("CMAKE_PREFIX_PATH", "")]
        patch.setenv("CMAKE_PREFIX_PATH", os.pathsep.join(p for p in prefixes if p))
        patch.setenv("ROS_PACKAGE_PATH", str(sources))
        yield


def roslaunch(file: str, option: str, *arguments: str, display: str = "") -> str:
    """Returns the output of `roslaunch <option>` for a file; fails on any message."""
    environment = ros_environment()
    environment.pop("DISPLAY", None)
    if display:
        environment["DISPLAY"] = display
    done = subprocess.run(
        ["/usr/bin/roslaunch", option, str(LAUNCH / file), *arguments],
        env=environment,
        capture_output=True,
        text=True,
    )
    assert not done.stderr.strip(), done.stderr
    return done.stdout


def nodes(file: str, *arguments: str, display: str = "") -> list:
    """Returns names of the nodes that would start, the spawner's without its unique ending."""
    names = roslaunch(file, "--nodes", *arguments, display=display).split()
    return sorted(re.sub(r"(?<=/spawn_terrasentia)_\w+", "", name) for name in names)


@pytest.mark.parametrize("file", FILES)
def test_without_a_display_rviz_is_left_out(file: str):
    assert nodes(file) == ["/no_window", "/robot_state_publisher", "/spawn_terrasentia"]
    assert "/rviz" in nodes(file, display=":0") and "/no_window" not in nodes(file, display=":0")
    assert "/rviz" not in nodes(file, "use_rviz:=false", display=":0")
    assert "/no_window" not in nodes(file, "use_rviz:=false")


def test_a_namespace_takes_everything_along():
    arguments = ["ns:=robot2", "y:=2"]
    expected = ["/robot2/robot_state_publisher", "/robot2/spawn_terrasentia"]
    assert nodes(FILES[0], *arguments, display=":0") == expected
    parameters = yaml.safe_load(roslaunch(FILES[0], "--dump-params", *arguments))
    assert parameters["/robot2/tf_prefix"] == "robot2"
    assert parameters["/robot2/robot_description"].count(">/robot2</robotNamespace>") > 10
    assert "/robot_description" not in parameters and "/tf_prefix" not in parameters


@pytest.mark.parametrize("file", FILES)
def test_without_a_namespace_there_is_no_prefix(file: str):
    parameters = yaml.safe_load(roslaunch(file, "--dump-params"))
    assert "/tf_prefix" not in parameters
    assert parameters["/robot_description"].count(">/</robotNamespace>") > 10


@pytest.mark.parametrize("xbox, button", [("true", 7), ("false", 11)])
def test_joystick(xbox: str, button: int):
    arguments = ["use_joy:=true", f"use_xbox:={xbox}", "dev_joy:=/dev/input/js0"]
    assert {"/joy_node", "/joy_controller_node"} <= set(nodes(FILES[0], *arguments))
    parameters = yaml.safe_load(roslaunch(FILES[0], "--dump-params", *arguments))
    assert parameters["/joy_node/dev"] == "/dev/input/js0"
    assert parameters["/joy_controller_node/enable_button"] == button


def test_the_joystick_is_the_default_of_a_desk():
    """Listing A.21 drives by joystick by default; here only with a DISPLAY, and for one robot."""
    joystick = {"/joy_node", "/joy_controller_node"}
    assert joystick <= set(nodes(FILES[0], display=":0"))
    for arguments in (["use_joy:=false"], ["use_udp:=true"], ["ns:=robot2"]):
        names = nodes(FILES[0], *arguments, display=":0")
        assert not [name for name in names if "joy" in name]


def test_spawn_arguments():
    start, description = "-at_start 0 0 0.175 -3.14", "-R 0 -P 0 -urdf -param robot_description"
    assert spawn_arguments(FILES[1]) == f"{start} {description} -model TerraSentia_0 -b"
    text = spawn_arguments(FILES[0], "x:=1.5", "y:=0", "yaw:=-1e-3", "ns:=robot2")
    assert text == f"{start} -x 1.5 -y 0 -Y -1e-3 {description} -model TerraSentia_robot2 -b"
    text = spawn_arguments(FILES[0], "z:=0.2", "model_name:=A")
    assert text == f"{start} -z 0.2 {description} -model A -b"


def test_the_robot_stops_after_its_last_command_unless_told_otherwise():
    for arguments, timeout in (([], "0.5"), (["command_timeout:=0"], "0")):
        text = yaml.safe_load(roslaunch(FILES[0], "--dump-params", *arguments))
        assert f"<commandTimeout>{timeout}</commandTimeout>" in text["/robot_description"]


def spawn_arguments(file: str, *arguments: str) -> str:
    """Returns arguments of the node that spawns the robot."""
    code = (
        "import sys, roslaunch.config, roslaunch.xmlloader as x;"
        "c = roslaunch.config.ROSLaunchConfig();"
        "x.XmlLoader().load(sys.argv[1], c, argv=sys.argv[2:], verbose=False);"
        "print(next(n.args for n in c.nodes if n.type == 'spawn_model'))"
    )
    command = ["/usr/bin/python3", "-c", code, str(LAUNCH / file), *arguments]
    done = subprocess.run(command, env=ros_environment(), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


def test_a_robot_that_does_not_exist_is_an_error():
    done = subprocess.run(
        ["/usr/bin/roslaunch", "--nodes", str(LAUNCH / FILES[0]), "bot_model:=nobody.urdf.xacro"],
        env=ros_environment(),
        capture_output=True,
        text=True,
    )
    assert "nobody.urdf.xacro" in done.stderr
    assert not done.stdout.strip()


@pytest.mark.parametrize("robot", ["tsv1", "tsv2", "tsv3"])
def test_the_command_line_chooses_robot_and_sensors(robot: str, tmp_path: pathlib.Path):
    model = f"bot_model:={robot}_default.urdf.xacro"
    text = yaml.safe_load(roslaunch(FILES[0], "--dump-params", model))["/robot_description"]
    assert f'<robot name="{robot.replace("tsv", "TSv")}"' in text
    own = tmp_path / "own_sensors.urdf.xacro"
    own.write_text(
        '<robot xmlns:xacro="http://ros.org/wiki/xacro"><link name="own_link" /></robot>'
    )
    for sensors, expected in (
        ("tsv3_sensors_config.urdf.xacro", "camera_left_gimbal_joint"),
        (str(own), "own_link"),
    ):
        arguments = [model, f"sensors:={sensors}"]
        text = yaml.safe_load(roslaunch(FILES[0], "--dump-params", *arguments))
        assert f'name="{expected}"' in text["/robot_description"]


def test_udp_nodes_start_when_asked_for():
    """In Listing A.21 the sensors are relayed, and commands come by UDP if there is no joystick."""
    udp = {"/sim_sensor_node", "/udp_control_node"}
    assert not udp & set(nodes(FILES[0]))
    assert udp <= set(nodes(FILES[0], "use_udp:=true"))
    assert udp & set(nodes(FILES[0], "use_udp:=true", "use_joy:=true")) == {"/sim_sensor_node"}


@pytest.mark.parametrize(
    "arguments, clients",
    [
        ([], ["127.0.0.1"]),
        (["udp_target:=192.168.1.135"], ["127.0.0.1", "192.168.1.135"]),
        (["udp_target:=239.7.7.7", "udp_clients:=[192.168.1.0/24]"], ["192.168.1.0/24"]),
    ],
)
def test_who_may_ask_and_drive_by_udp(arguments: list, clients: list):
    arguments = ["use_udp:=true", *arguments]
    parameters = yaml.safe_load(roslaunch(FILES[1], "--dump-params", *arguments))
    assert parameters["/sim_sensor_node/allowed_clients"] == clients
    assert parameters["/udp_control_node/peers"] == clients
