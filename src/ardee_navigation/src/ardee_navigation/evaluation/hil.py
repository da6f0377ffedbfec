# SPDX-License-Identifier: MIT
"""Drives a run with hardware in the loop: in real time, the row follower without ROS behind the UDP bridge."""
import contextlib
import dataclasses
import json
import os
import socket
import subprocess
import tempfile
import threading
import time
from collections import deque
from pathlib import Path
from typing import Callable, Deque, List, Optional, Union

import rospy
import yaml
from geometry_msgs.msg import Twist
from std_srvs.srv import Empty

from ardee_common.process import start_child, stop_child
from ardee_navigation.evaluation.answers import Answers
from ardee_navigation.evaluation.record import Record
from ardee_navigation.evaluation.ros_simulation import RosSimulation
from ardee_navigation.evaluation.simulation import SimulationError
from ardee_navigation.evaluation.trial import Judge, Seen
from ardee_navigation.lbirnt import Parameters
from ardee_world.trial import Trial

SETTLE_STEPS = 200  # 1 s: the robot comes to rest on its springs
ANSWER_WITHIN_S = 5.0  # time limit of an answer; the first one waits for the bridge to start
START_WITHIN_S = 30.0


def _free_ports(count: int) -> List[int]:
    """Returns UDP ports of loopback that are free at the moment, so that experiments can run side by side."""
    with contextlib.ExitStack() as stack:
        sockets = [
            stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
            for _ in range(count)
        ]
        for opened in sockets:
            opened.bind(("127.0.0.1", 0))
        return [opened.getsockname()[1] for opened in sockets]


class Bridge:
    """Both nodes of ardee_bridge, which send only requested data."""

    def __init__(self) -> None:
        self.sensors_port, self.controls_port = _free_ports(2)
        server = ["sensor_server_node", f"_port:={self.sensors_port}", "_peers:=[]"]
        client = ["controls_client_node", f"_port:={self.controls_port}"]
        self._nodes = [start_child(["rosrun", "ardee_bridge", *node]) for node in (server, client)]

    def stop(self) -> None:
        """Ends both nodes."""
        for node in self._nodes:
            stop_child(node)


class Follower:
    """Row follower as a process without ROS: its environment has no master; it reports on its standard output."""

    def __init__(self, parameters: Path, bridge: Bridge) -> None:
        command = ["rosrun", "ardee_navigation", "hil_row_follower", "--log", "-"]
        command += ["--sensors", f"127.0.0.1:{bridge.sensors_port}"]
        command += ["--controls", f"127.0.0.1:{bridge.controls_port}"]
        environment = {k: v for k, v in os.environ.items() if k != "ROS_MASTER_URI"}
        self._child = start_child(
            [*command, f"--parameters={parameters}"],
            environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            text=True,
        )
        self._answers = Answers()
        threading.Thread(target=self._read, daemon=True).start()

    def _read(self) -> None:
        for line in self._child.stdout:
            self._answers.put(json.loads(line))

    def stop(self) -> None:
        """Ends the process."""
        stop_child(self._child)

    def _check(self) -> None:
        if self._child.poll() is not None:
            raise SimulationError("hil_row_follower has ended")

    def answer(self, time_s: float, patience_s: float) -> Optional[dict]:
        """Returns the answer to the scan of this simulated time; None if there is none in time."""
        return self._answers.take(time_s, patience_s, self._check)


class Latency:
    """Measures from a scan's arrival on its ROS topic to the next command on cmd_vel, both in this process."""

    def __init__(self) -> None:
        self.milliseconds: List[float] = []
        self._scans: Deque[float] = deque(maxlen=1)
        self._subscriber = rospy.Subscriber("/cmd_vel", Twist, self._on_command, tcp_nodelay=True)

    def on_scan(self) -> None:
        """Takes the arrival time of a scan."""
        self._scans.append(time.monotonic())

    def _on_command(self, _command: Twist) -> None:
        if self._scans:
            self.milliseconds.append(1e3 * (time.monotonic() - self._scans.pop()))

    def stop(self) -> None:
        """Stops listening."""
        self._subscriber.unregister()


def _seen(answer: dict) -> Seen:
    valid = (bool(answer["valid"][0]), bool(answer["valid"][1]))
    return Seen(answer["left_m"], answer["right_m"], valid, answer["state"])


def _look(simulation: RosSimulation, judge: Judge, follower: Follower, patience_s: float) -> object:
    """Judges the next scan if the follower answered it."""
    scan = simulation.scan()
    now_s = scan.time_s
    answer = follower.answer(now_s, patience_s)
    if answer is None:
        judge.record.unanswered += 1
        return None
    command = (answer["speed_m_s"], answer["turn_rad_s"])
    back = judge.look(now_s, simulation.pose(), command, _seen(answer))
    judge.keep_scan(scan)
    return back


def _wait_for_first_answer(simulation: RosSimulation, follower: Follower) -> None:
    deadline = time.monotonic() + START_WITHIN_S
    while follower.answer(simulation.scan().time_s, 0.02) is None:
        if time.monotonic() > deadline:
            raise SimulationError(f"hil_row_follower answered no scan in {START_WITHIN_S:.0f} s")


def drive(
    simulation: RosSimulation,
    trial: Trial,
    parameters: Parameters,
    judge: Judge,
    progress: Callable[[float], None],
) -> Record:
    """Drives one run in real time. After an intervention the follower is started anew."""
    with tempfile.NamedTemporaryFile("w", prefix="ardee_lbirnt_", suffix=".yaml") as file:
        yaml.safe_dump(dataclasses.asdict(parameters), file)
        file.flush()
        return _drive(simulation, trial, Path(file.name), judge, progress)


def _drive(
    simulation: RosSimulation,
    trial: Trial,
    parameters: Path,
    judge: Judge,
    progress: Callable[[float], None],
) -> Record:
    bridge = Bridge()
    processes = [bridge]  # type: List[Union[Bridge, Follower]]
    latency = Latency()
    simulation.on_scan = latency.on_scan
    try:
        simulation.step(SETTLE_STEPS)
        simulation.wait_for_commander()
        simulation.call("/gazebo/unpause_physics", Empty)
        follower = Follower(parameters, bridge)
        processes.append(follower)
        _wait_for_first_answer(simulation, follower)
        began = time.monotonic()
        while not judge.record.end:
            back = _look(simulation, judge, follower, ANSWER_WITHIN_S)
            if judge.record.samples:
                progress(judge.record.samples[-1].along_m)
            if back is not None:
                follower.stop()
                simulation.set_pose(back, trial.height_m(back))
                follower = Follower(parameters, bridge)
                processes.append(follower)
                _wait_for_first_answer(simulation, follower)
        wall_s = time.monotonic() - began
    finally:
        latency.stop()
        for process in reversed(processes):
            process.stop()
    judge.record.latency_ms = tuple(latency.milliseconds)
    return judge.finish(wall_s)
