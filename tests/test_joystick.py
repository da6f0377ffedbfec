# SPDX-License-Identifier: MIT
"""Tests driving the simulated robot by hand: joystick events through joy and teleop, and keys through a terminal."""
import contextlib
import os
import pathlib
import pty
import signal
import struct
import subprocess
import termios
import threading
import time
import xmlrpc.client
from typing import Any, Iterator, List

import probes
import pytest

from ardee_common.ros_graph import RosGraph, wait_until

BUTTON, AXIS, INIT = 0x01, 0x02, 0x80
ENABLE, PS3_ENABLE, PS3_BUTTONS = (
    7,
    11,
    17,
)  # an Xbox controller's, a PS3 controller's: see the launch file
SCALE_LINEAR = 1.0  # m/s at full deflection, see the launch file
DRIVE_AXIS, TURN_AXIS = 1, 2


class Joystick:
    """Named pipe in the place of /dev/input/jsN."""

    def __init__(self, path: pathlib.Path, buttons: int = 11) -> None:
        self.path, self.buttons, self._file = path, buttons, -1

    def plug_in(self) -> None:
        """Makes the joystick appear, with the initial events that the kernel sends for 6 axes and all buttons."""
        os.mkfifo(self.path)
        self._file = wait_until(self._open, "joy_node opens the joystick")
        for number in range(6):
            self.event(AXIS | INIT, number, 0)
        for number in range(self.buttons):
            self.event(BUTTON | INIT, number, 0)

    def _open(self) -> int:
        try:
            return os.open(self.path, os.O_WRONLY | os.O_NONBLOCK)
        except OSError:
            return 0  # no reader yet

    def event(self, kind: int, number: int, value: int) -> None:
        """Returns one js_event."""
        os.write(self._file, struct.pack("=IhBB", 0, value, kind, number))

    def unplug(self) -> None:
        """Makes the joystick disappear."""
        self.path.unlink()
        os.close(self._file)


class Robot:
    """Messages of the robot that a probe's process receives."""

    def __init__(self) -> None:
        import rospy
        from geometry_msgs.msg import Twist
        from nav_msgs.msg import Odometry
        from sensor_msgs.msg import Joy

        probes._start()
        self.commands, self.states = [], []  # type: List[Any], List[Any]
        self.speed_m_s = 0.0
        rospy.Subscriber("/cmd_vel", Twist, self.commands.append, queue_size=1000)
        rospy.Subscriber("/joy", Joy, self.states.append, queue_size=1000)
        rospy.Subscriber("/odom", Odometry, self._on_odometry, queue_size=1000)

    def _on_odometry(self, odometry: Any) -> None:
        self.speed_m_s = odometry.twist.twist.linear.x

    def drives(self, speed_m_s: float) -> None:
        """Waits until the robot has that speed."""
        wait_until(
            lambda: abs(self.speed_m_s - speed_m_s) < 0.02,
            f"{speed_m_s} m/s, not {self.speed_m_s}",
            10.0,
        )

    def hears_nothing(self) -> None:
        """Checks that no command comes for a while."""
        count = len(self.commands)
        time.sleep(0.3)
        assert len(self.commands) == count, f"commands {self.commands[count:]}"


def wait_for_contact(joystick: Joystick, robot: Robot) -> None:
    """Moves an axis to and fro until the probe hears of it."""
    value = 0

    def answered() -> Any:
        nonlocal value
        value = 8000 - value
        joystick.event(AXIS, TURN_AXIS, value)
        return robot.states

    wait_until(answered, "messages on /joy")
    joystick.event(AXIS, TURN_AXIS, 0)


def push(joystick: Joystick) -> None:
    """Holds the enable button and pushes the stick fully forward."""
    joystick.event(BUTTON, ENABLE, 1)
    joystick.event(AXIS, DRIVE_AXIS, -32767)


def pid_of(node: str) -> int:
    """Returns the process id that the node itself reports."""
    import rosgraph

    address = rosgraph.Master("/probe").lookupNode(node)
    return xmlrpc.client.ServerProxy(address).getPid("/probe")[2]


def ride(path: str) -> None:
    """Drives by a joystick, lets go, unplugs it, plugs it in again, and loses joy_node."""
    robot, joystick = Robot(), Joystick(pathlib.Path(path))
    joystick.plug_in()
    wait_for_contact(joystick, robot)
    numbers = len(robot.states[-1].axes), len(robot.states[-1].buttons)
    assert numbers == (6, 11), f"axes and buttons: {numbers}"

    joystick.event(AXIS, DRIVE_AXIS, -32767)
    robot.hears_nothing()  # without the enable button
    joystick.event(BUTTON, ENABLE, 1)
    robot.drives(SCALE_LINEAR)
    joystick.event(BUTTON, ENABLE, 0)
    robot.drives(0.0)

    push(joystick)
    robot.drives(SCALE_LINEAR)
    joystick.unplug()
    robot.drives(0.0)

    joystick.plug_in()
    robot.hears_nothing()  # plugged in again it drives only on command
    push(joystick)
    robot.drives(SCALE_LINEAR)
    os.kill(pid_of("/joy_node"), signal.SIGKILL)
    robot.drives(0.0)


@pytest.fixture(scope="module")
def device(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """Returns the path at which a joystick will appear."""
    return tmp_path_factory.mktemp("joystick") / "js0"


def start(graph: RosGraph, device: pathlib.Path, *more: str) -> RosGraph:
    """Starts a robot in an empty world that waits for a joystick."""
    graph.launch("ardee_world", "custom_world.launch", "world:=empty.world")
    graph.call(probes.clock_at_least, 0.2)
    arguments = ("use_rviz:=false", "use_joy:=true", f"dev_joy:={device}", *more)
    graph.launch("terrasentia_description", "launch_default_tsv1.launch", *arguments)
    graph.call(probes.wait_for_topics, ["/odom", "/joy", "/cmd_vel"], [])
    return graph


@pytest.fixture(scope="module")
def robot(shared_graph: RosGraph, device: pathlib.Path) -> RosGraph:
    """Yields the robot that an Xbox controller drives."""
    return start(shared_graph, device)


def test_a_joystick_drives_until_let_go_or_unplugged(robot: RosGraph, device: pathlib.Path) -> None:
    robot.call(ride, str(device))


def ride_by_ps3(path: str) -> None:
    """Checks that the Xbox controller's button does nothing, and that the other one's enables."""
    robot, joystick = Robot(), Joystick(pathlib.Path(path), PS3_BUTTONS)
    joystick.plug_in()
    wait_for_contact(joystick, robot)
    push(joystick)
    robot.hears_nothing()
    joystick.event(BUTTON, PS3_ENABLE, 1)
    robot.drives(SCALE_LINEAR)
    joystick.event(BUTTON, PS3_ENABLE, 0)
    robot.drives(0.0)


def test_a_ps3_controller_has_a_button_of_its_own(graph: RosGraph, tmp_path: pathlib.Path) -> None:
    device = tmp_path / "js0"
    start(graph, device, "use_xbox:=false").call(ride_by_ps3, str(device))


def robot_moves(speeds_m_s: List[float]) -> None:
    """Waits for one speed after the other."""
    robot = Robot()
    for speed_m_s in speeds_m_s:
        robot.drives(speed_m_s)


@contextlib.contextmanager
def held_key(terminal: int, key: bytes) -> Iterator[None]:
    """Sends a key 20 times a second, as from a keyboard that repeats."""
    released = threading.Event()

    def repeat() -> None:
        while not released.wait(0.05):
            os.write(terminal, key)

    thread = threading.Thread(target=repeat)
    thread.start()
    try:
        yield
    finally:
        released.set()
        thread.join()


def test_the_keyboard_drives_while_keys_come_and_restores_the_terminal(robot: RosGraph) -> None:
    master, slave = pty.openpty()
    before = termios.tcgetattr(slave)
    teleop = subprocess.Popen(
        ["rosrun", "terrasentia_description", "keyboard_teleop", "_speed:=0.6"],
        env=robot.env,
        stdin=slave,
        stdout=slave,
        stderr=slave,
        start_new_session=True,
    )
    try:
        robot.call(probes.wait_for_topics, ["/cmd_vel"], [])
        wait_until(lambda: termios.tcgetattr(slave) != before, "the terminal is raw")
        with held_key(master, b"i"):
            robot.call(robot_moves, [0.6])
        robot.call(robot_moves, [0.0])  # the keys have stopped
        os.write(master, b"\x03")
        assert teleop.wait(10) == 0
        assert termios.tcgetattr(slave) == before
    finally:
        if teleop.poll() is None:
            os.killpg(teleop.pid, signal.SIGKILL)
            teleop.wait()
        os.close(master)
        os.close(slave)


@pytest.mark.parametrize("node", ["joy joy_node", "teleop_twist_joy teleop_node"])
def test_help_of_the_joystick_s_nodes_needs_no_master(node: str) -> None:
    env = dict(os.environ, ROS_MASTER_URI="http://127.0.0.1:9")
    run = subprocess.run(
        ["rosrun", *node.split(), "-h"], env=env, capture_output=True, text=True, timeout=20
    )
    assert run.returncode == 0 and run.stdout.startswith("usage: ")
