# SPDX-License-Identifier: MIT
"""Test bench of the UDP bridge: simulator, robot, both nodes and clients without ROS, each a process of its own."""
import os
import pathlib
import re
import signal
import socket
import subprocess
import time
from multiprocessing import get_context
from typing import Any, Callable, Dict, List, NamedTuple, Set, Tuple

import probes

from ardee_common.ros_graph import Process, RosGraph, wait_until

TESTS = pathlib.Path(__file__).resolve().parent
PACKAGE = TESTS.parent / "src" / "ardee_bridge"
PLANE = str(TESTS / "data" / "plane.world")
# A target computer has neither ROS's paths nor its variables.
BARE_ENV = {"PATH": "/usr/bin:/bin"}
# The sensors are on topics of the tests' own, independent of the robot's equipment.
SOURCES = (
    "[{name: lidar, kind: lidar, topic: /ardee/hokuyo}, {name: imu, kind: imu, topic: /fed/imu}, "
    "{name: gps, kind: gps, topic: /fed/gps, velocity_topic: /fed/gps_velocity}, "
    "{name: battery, kind: battery, topic: /fed/battery}, "
    "{name: fr, kind: encoder, topic: /fed/fr, component_id: 0}, "
    "{name: fl, kind: encoder, topic: /fed/fl, component_id: 1}, "
    "{name: camera, kind: image, topic: /fed/camera, component_id: 2}, "
    "{name: depth, kind: image, topic: /fed/depth, component_id: 3, format: raw}, "
    "{name: points, kind: point_cloud, topic: /fed/points}]"
)
SENSORS = {"imu 0", "gps 0", "battery 0", "encoder 0", "encoder 1", "image 2", "image 3"}
SENSORS |= {"lidar 0", "point_cloud 0", "time 0"}


def free_port() -> int:
    """Returns a UDP port of loopback that is free at the moment."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        opened.bind(("127.0.0.1", 0))
        return opened.getsockname()[1]


def resident_mb(pid: int) -> float:
    """Returns the memory that a process holds now [MB]."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    return int(re.search(r"VmRSS:\s+(\d+) kB", status).group(1)) / 1e3


class State(NamedTuple):
    """Pose and speed of the robot, by its odometry."""

    x_m: float
    y_m: float
    turn: float  # z of the quaternion
    speed_m_s: float
    yaw_rate_rad_s: float


def start_in(graph: RosGraph, body: Callable[[Any], None]) -> Tuple[Any, Any]:
    """Starts body(pipe) in a process of its own in this graph; returns the process, and our end of the pipe."""
    context = get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_enter, args=(graph.env, body, theirs), daemon=True)
    process.start()
    return process, ours


def _enter(env: Dict[str, str], body: Callable[[Any], None], pipe: Any) -> None:
    os.environ.update(env)
    body(pipe)


def watch_until_killed(pipe: Any) -> None:
    """Answers, as the body of a process, questions with newer messages: "odom", or the name of a node."""
    import rospy
    from diagnostic_msgs.msg import DiagnosticArray
    from nav_msgs.msg import Odometry

    latest = {}  # type: Dict[str, Tuple[int, Any]]

    def keep(name: str, value: Any) -> None:
        latest[name] = (latest.get(name, (0, None))[0] + 1, value)

    def keep_odometry(message: Odometry) -> None:
        place, twist = message.pose.pose, message.twist.twist
        turn = place.orientation.z
        found = State(place.position.x, place.position.y, turn, twist.linear.x, twist.angular.z)
        keep("odom", found)

    def keep_diagnostics(message: DiagnosticArray) -> None:
        for status in message.status:
            keep(status.name, {pair.key: int(pair.value) for pair in status.values})

    rospy.init_node("watcher", anonymous=True, disable_signals=True, disable_rostime=True)
    rospy.Subscriber("/odom", Odometry, keep_odometry, queue_size=1)
    rospy.Subscriber("/diagnostics", DiagnosticArray, keep_diagnostics)
    while True:
        name = pipe.recv()
        # The next message may be older than the question, but not the one after it.
        enough = latest.get(name, (0, None))[0] + 2
        wait_until(lambda: latest.get(name, (0, None))[0] >= enough, name)
        pipe.send(latest[name][1])


class Bench:
    """Bridge's nodes in a graph; simulator and clients come and go."""

    def __init__(self, graph: RosGraph) -> None:
        self.graph = graph
        self._watcher, self._questions = start_in(graph, watch_until_killed)
        self.server_port, self.controls_port = free_port(), free_port()
        self.server = self._node(
            "sensor_server_node", self.server_port, "_peers:=[]", f"_sources:={SOURCES}"
        )
        self.controls = self._node("controls_client_node", self.controls_port)
        self.simulator = self.start_simulator()
        self._c_client = compile_client(graph.folder)
        self._urdf = graph.folder / "robot.urdf"
        source = "$(rospack find terrasentia_description)/robots/tsv1_default.urdf.xacro"
        self._urdf.write_text(graph.run("bash", "-c", f'rosrun xacro xacro "{source}"'))
        self.spawn_robot()

    def _node(self, name: str, port: int, *parameters: str) -> Process:
        return self.graph.spawn("rosrun", "ardee_bridge", name, f"_port:={port}", *parameters)

    def start_simulator(self) -> Process:
        """Starts the simulator on level ground."""
        self.simulator = self.graph.spawn("rosrun", "ardee_sim_cpp", "simulator", PLANE)
        self.graph.call(probes.clock_at_least, 0.1)
        return self.simulator

    def spawn_robot(self) -> None:
        """Spawns a TerraSentia well away from the wall."""
        place = "-x -5 -y 0 -z 0.2 -urdf -model TerraSentia_0".split()
        spawn = ("rosrun", "ardee_sim_cpp", "spawn_model", *place, "-file", str(self._urdf))
        self.graph.run(*spawn)

    def kill_simulator(self) -> None:
        """Kills the simulator, as a crash would."""
        os.killpg(self.simulator.pid, signal.SIGKILL)
        self.simulator.wait()

    def c_client(self, *arguments: str) -> subprocess.Popen:
        """Starts the client in C, driving if told so."""
        command = [str(self._c_client), "-p", "0", "-a", self.server_port, "-c", self.controls_port]
        return start_client([*command, *arguments])

    def python_client(self, *arguments: str) -> subprocess.Popen:
        """Starts the client in Python."""
        command = [
            "/usr/bin/python3",
            "-I",
            PACKAGE / "examples" / "ardee_client.py",
            "--port",
            "0",
        ]
        ports = ["--ask", self.server_port, "--controls", self.controls_port]
        return start_client([*command, *ports, *arguments])

    def control(self, code: str) -> None:
        """Sends a control code; fails unless it is answered."""
        assert "ack" in finish(self.python_client("--control", code, "--duration-s", "0.5"))

    def _ask(self, name: str) -> Any:
        self._questions.send(name)
        assert self._questions.poll(40.0), f"nothing of {name}"
        return self._questions.recv()

    def state(self) -> State:
        """Returns the robot's present state."""
        return self._ask("odom")

    def standing_within(self, wall_time_s: float) -> None:
        """Fails unless the robot stops within this time."""
        wait_until(lambda: abs(self.state().speed_m_s) < 0.02, "the robot stands", wall_time_s)

    def counters(self, node: str) -> Dict[str, int]:
        """Returns the latest counters of a node, from its diagnostics."""
        return self._ask(f"/{node}")

    def close(self) -> None:
        """Ends the process that watches."""
        self._watcher.terminate()
        self._watcher.join()

    def interrupt_once_it_gets_scans(self, client: subprocess.Popen) -> None:
        """Ends a client that has asked already; fails unless it got some scans."""
        before = self.counters("sensor_server_node").get("sent lidar", 0)
        wait_until(
            lambda: self.counters("sensor_server_node").get("sent lidar", 0) > before + 5,
            "scans leave",
            60.0,
        )
        assert interrupt(client)["lidar 0"][0] > 0

    def alive(self) -> bool:
        """Returns whether both nodes still run."""
        return self.server.exit_code() is None and self.controls.exit_code() is None


def compile_client(folder: pathlib.Path) -> pathlib.Path:
    """Compiles the client in C into a folder."""
    program = folder / "ardee_client"
    source, include = PACKAGE / "examples" / "ardee_client.c", PACKAGE / "include"
    command = ["gcc", "-std=c11", "-O2", "-Wall", "-Wextra", "-Werror", f"-I{include}"]
    subprocess.run([*command, "-o", str(program), str(source)], check=True)
    return program


def start_client(command: List[Any]) -> subprocess.Popen:
    """Starts a client as on a computer without ROS."""
    words = [str(word) for word in command]
    return subprocess.Popen(
        words, env=BARE_ENV, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )


def interrupt(client: subprocess.Popen) -> Dict[str, Tuple[int, str]]:
    """Ends a client by Ctrl-C; returns its report."""
    client.send_signal(signal.SIGINT)
    return finish(client)


def finish(client: subprocess.Popen, timeout_s: float = 60.0) -> Dict[str, Tuple[int, str]]:
    """Waits for the client's end; returns sensor and component -> number of messages, text of the last one."""
    output, _ = client.communicate(timeout=timeout_s)
    assert client.returncode == 0, output
    rows = re.findall(r"^(\w+) (-?\d+) count (\d+) (.*)$", output, re.MULTILINE)
    found = {f"{name} {component}": (int(count), text) for name, component, count, text in rows}
    if any(name.startswith("ack") for name in found):
        found["ack"] = (1, "")
    return found


def finish_once_heard(
    start: Callable[[str], subprocess.Popen], wanted: Set[str]
) -> Dict[str, Tuple[int, str]]:
    """Returns the report of a client, started with a time to run [s], and with longer ones until it got all it wants.

    How long a server takes to find a camera's topics depends on the machine's load.
    """
    for seconds in (5, 20, 80):
        found = finish(start(str(seconds)), seconds + 60.0)
        if wanted <= set(found):
            return found
    raise AssertionError(f"missing {sorted(wanted - set(found))} of {found}")


def feed_until_killed(pipe: Any) -> None:
    """Publishes, as a process's body, sensors that the robot of the tests does not carry, at the devices' rates."""
    import rospy
    from bench import latency_messages

    from ardee_bridge.nodes.subscriptions import TYPES

    rospy.init_node("feeder", anonymous=True, disable_signals=True, disable_rostime=True)
    rates_hz = {"imu": 100, "gps": 20, "battery": 5, "fr": 100, "fl": 100, "camera": 5, "depth": 5}
    rates_hz["points"] = 5
    kinds = {
        "fr": "encoder",
        "fl": "encoder",
        "camera": "image",
        "depth": "image",
        "points": "point_cloud",
    }
    messages, publishers = {}, {}
    for name in rates_hz:
        kind = kinds.get(name, name)
        messages[name] = latency_messages.make(kind, name)
        publishers[name] = rospy.Publisher(f"/fed/{name}", TYPES[kind], queue_size=10)
    messages["imu"].linear_acceleration.z = 9.81
    messages["battery"].voltage = 12.34
    messages["fl"].position = -2.5
    messages["gps"].latitude = 40.1234567
    pipe.send("feeding")
    tick = 0
    while not pipe.poll():
        for name, rate_hz in rates_hz.items():
            if tick % (100 // rate_hz) == 0:
                publishers[name].publish(messages[name])
        tick += 1
        time.sleep(0.01)
