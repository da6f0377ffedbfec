# SPDX-License-Identifier: MIT
"""The simulated robot driven by hand: joystick events through joy and teleop, and keys through a terminal."""
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
from typing import Any, Iterator, List, Tuple

import probes
import pytest
from ros_graph import RosGraph, wait_until

BUTTON, AXIS, INIT = 0x01, 0x02, 0x80
ENABLE = 7  # the Xbox controller's, see the launch file
DRIVE_AXIS, TURN_AXIS = 1, 2


class Joystick:
    """A named pipe in the place of /dev/input/jsN."""

    def __init__(self, path: pathlib.Path) -> None:
        self.path, self._file = path, -1

    def plug_in(self) -> None:
        """Appear, with the initial events that the kernel sends for 6 axes and 11 buttons."""
        os.mkfifo(self.path)
        self._file = wait_until(self._open, "joy_node opens the joystick")
        for number in range(6):
            self.event(AXIS | INIT, number, 0)
        for number in range(11):
            self.event(BUTTON | INIT, number, 0)

    def _open(self) -> int:
        try:
            return os.open(self.path, os.O_WRONLY | os.O_NONBLOCK)
        except OSError:
            return 0  # nobody reads yet

    def event(self, kind: int, number: int, value: int) -> None:
        """One js_event."""
        os.write(self._file, struct.pack("=IhBB", 0, value, kind, number))

    def unplug(self) -> None:
        """Disappear."""
        self.path.unlink()
        os.close(self._file)


def watch_commands(seconds: float) -> List[Tuple[float, float]]:
    """The commands (m/s, rad/s) on cmd_vel in a while of wall time."""
    import rospy
    from geometry_msgs.msg import Twist

    probes._start()
    heard = []  # type: List[Any]
    rospy.Subscriber("/cmd_vel", Twist, heard.append, queue_size=1000)
    time.sleep(seconds)
    return [(twist.linear.x, twist.angular.z) for twist in heard]


def speed() -> float:
    """Forward speed (m/s) of the robot by its odometry."""
    return probes.collect("/odom", "nav_msgs/Odometry", 1)[0].twist.twist.linear.x


def robot_moves(moves: bool) -> bool:
    """Has the robot come to drive, or to stand, within a while?"""
    import rospy
    from nav_msgs.msg import Odometry

    probes._start()
    last = []  # type: List[float]
    rospy.Subscriber(
        "/odom",
        Odometry,
        lambda message: last.append(abs(message.twist.twist.linear.x)),
        queue_size=1000,
    )
    wait_until(lambda: last and (last[-1] > 0.3) == moves and (moves or last[-1] < 0.02), "speed")
    return True


def joy_after(path: str) -> Any:
    """The next state of the joystick, an axis of which is moved to and fro here."""
    import rospy
    from sensor_msgs.msg import Joy

    probes._start()
    heard = []  # type: List[Any]
    rospy.Subscriber("/joy", Joy, heard.append, queue_size=1000)
    file = os.open(path, os.O_WRONLY)
    value = 0

    def answered() -> Any:
        nonlocal value
        value = 8000 - value
        os.write(file, struct.pack("=IhBB", 0, value, AXIS, TURN_AXIS))
        return heard and heard[-1]

    state = wait_until(answered, "messages on /joy")
    os.write(file, struct.pack("=IhBB", 0, 0, AXIS, TURN_AXIS))
    return state


@pytest.fixture
def robot(graph: RosGraph) -> RosGraph:
    """A graph with a world."""
    graph.launch("ardee_world", "custom_world.launch", "world:=empty.world")
    graph.call(probes.clock_at_least, 0.2)
    return graph


def launch_robot(graph: RosGraph, *args: str) -> None:
    graph.launch("terrasentia_description", "launch_default_tsv1.launch", "use_rviz:=false", *args)
    graph.call(probes.wait_for_topics, ["/odom"], [])


def push(joystick: Joystick) -> None:
    """Hold the enable button and push the stick fully forward."""
    joystick.event(BUTTON, ENABLE, 1)
    joystick.event(AXIS, DRIVE_AXIS, -32767)


def test_a_joystick_drives_until_let_go_or_unplugged(
    robot: RosGraph, tmp_path: pathlib.Path
) -> None:
    joystick = Joystick(tmp_path / "js0")
    launch_robot(robot, "use_joy:=true", f"dev_joy:={joystick.path}")
    robot.call(probes.wait_for_topics, ["/joy", "/cmd_vel"], [])
    joystick.plug_in()
    state = robot.call(joy_after, str(joystick.path))
    assert (len(state.axes), len(state.buttons)) == (6, 11)

    joystick.event(AXIS, DRIVE_AXIS, -32767)
    assert robot.call(watch_commands, 0.5) == []  # nothing without the enable button
    joystick.event(BUTTON, ENABLE, 1)
    assert robot.call(robot_moves, True)
    assert robot.call(speed) == pytest.approx(1.0, abs=0.1)  # scale_linear of the launch file
    joystick.event(BUTTON, ENABLE, 0)
    assert robot.call(robot_moves, False)

    push(joystick)
    assert robot.call(robot_moves, True)
    joystick.unplug()
    assert robot.call(robot_moves, False)

    joystick.plug_in()
    assert robot.call(watch_commands, 0.5) == []  # plugged in again it drives only when told
    push(joystick)
    assert robot.call(robot_moves, True)

    (pid,) = [pid for pid, words in robot.alive().items() if "/joy_node" in words]
    os.kill(pid, signal.SIGKILL)
    assert robot.call(robot_moves, False)


@contextlib.contextmanager
def held_key(terminal: int, key: bytes) -> Iterator[None]:
    """The key comes 20 times a second, as from a keyboard that repeats."""
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
    launch_robot(robot)
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
            assert robot.call(robot_moves, True)
        assert robot.call(robot_moves, False)  # keys have ceased
        os.write(master, b"\x03")
        assert teleop.wait(10) == 0
        assert termios.tcgetattr(slave) == before
    finally:
        if teleop.poll() is None:
            os.killpg(teleop.pid, signal.SIGKILL)
            teleop.wait()
        os.close(master)
        os.close(slave)
