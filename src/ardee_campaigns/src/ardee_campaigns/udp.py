# SPDX-License-Identifier: MIT
"""A controller that is another program, in real time: scans and commands are UDP datagrams of the bridge's format."""
import json
import os
import select
import signal
import socket
import subprocess
import time
from functools import partial
from types import SimpleNamespace
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

from ardee_bridge.nodes import convert
from ardee_bridge.wire import codec
from ardee_bridge.wire.c_struct import NO_VALUE
from ardee_bridge.wire.pairing import Pairer
from ardee_campaigns.program import check, end_with_parent, filled
from ardee_campaigns.robot import Observation, Robot
from ardee_common.errors import GeneratorError
from ardee_common.process import start_child, stop_child

START_WITHIN_S = 30.0  # from the start of the program to its first answer
ASK_EVERY_S = 0.2  # until then the scan is sent again
START_TELL_S = 0.2  # of its first answer: what it prints of that, if it prints anything
TELL_WITHIN_S = 0.01  # of its answer: what it prints of that scan, if it prints anything
_LARGEST = 65535
_PLACES = ("bind", "sensors", "controls")  # names in the command
Command = Tuple[float, float]


def _socket() -> socket.socket:
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    made.bind(("127.0.0.1", 0))
    return made


def _address(made: socket.socket) -> str:
    return "{}:{}".format(*made.getsockname())


class UdpController:
    """Sends each scan at its time, and takes the answer that comes before the next one; without one the last holds.

    command : words of the program's command; `{bind}` is the HOST:PORT at which it is to listen, `{sensors}` whence
        scans come, `{controls}` whither it sends motion commands, `{NAME}` a parameter
    seen, is_finished : as the program tells in a line of JSON an answer on its standard output, if it does: `left_m`,
        `right_m`, and `state`, in the end `finished`
    """

    def __init__(self, command: Sequence[str], params: Mapping[str, Any], robot: Robot) -> None:
        check(command, params, _PLACES)
        self._command, self._params, self._period_s = command, params, robot.period_s
        self._child: Optional[subprocess.Popen] = None
        self._sockets: Tuple[socket.socket, ...] = ()
        self._unanswered = 0
        self._latency_ms: List[float] = []

    @property
    def about(self) -> Dict[str, Any]:
        """Returns the times from scans to commands, and how many scans got none before the next one."""
        return {"latency_ms": self._latency_ms, "unanswered": self._unanswered}

    def reset(self) -> None:
        """Starts the program anew."""
        self.close()
        free, self._sensors, self._controls = self._sockets = tuple(_socket() for _ in range(3))
        self._target = free.getsockname()
        places = dict(zip(_PLACES, map(_address, self._sockets)))
        free.close()  # the program's from now on
        words = filled(self._command, {**self._params, **places})
        end, out = partial(end_with_parent, signal.SIGKILL), subprocess.PIPE
        self._child = start_child(words, preexec_fn=end, stdout=out, stderr=subprocess.DEVNULL)
        self._pairer, self._latest = Pairer(), (0.0, 0.0)
        self._rest, self._tells = b"", False
        self.seen: Optional[Tuple[float, float]] = None
        self.is_finished: Optional[bool] = None
        self._began: Optional[Tuple[float, float]] = None

    def step(self, observation: Observation, time_s: float) -> Command:
        """Returns the program's answer to the LidarReading of use `scan`."""
        parts = _scan(observation["scan"])
        if self._began is None:
            self._wait_for_first_answer(parts)
            self._hear(START_TELL_S)
            self._began = time.monotonic(), time_s
            return self._latest
        due = self._began[0] + time_s - self._began[1]
        time.sleep(max(due - time.monotonic(), 0.0))
        while self._receive(0.0):
            pass  # answers to earlier scans, which are none to this one
        self._send(parts)
        sent_s = time.monotonic()
        is_answered = self._receive(due + self._period_s)
        if is_answered:
            self._latency_ms.append(1e3 * (time.monotonic() - sent_s))
        self._unanswered += not is_answered
        self._hear(TELL_WITHIN_S if is_answered and self._tells else 0.0)
        return self._latest

    def _wait_for_first_answer(self, parts: codec.Datagrams) -> None:
        end = time.monotonic() + START_WITHIN_S
        while True:
            self._send(parts)
            if self._receive(time.monotonic() + ASK_EVERY_S):
                return
            if time.monotonic() > end:
                raise GeneratorError(
                    f"{self._command[0]} answered no scan in {START_WITHIN_S:.0f} s"
                )

    def _send(self, parts: codec.Datagrams) -> None:
        assert self._child is not None
        if self._child.poll() is not None:
            code = self._child.returncode
            raise GeneratorError(f"{self._command[0]} has ended with exit code {code}")
        for part in parts:
            self._sensors.sendto(part, self._target)

    def _hear(self, wait_s: float) -> None:
        """Takes what the program has printed, or prints within a time."""
        assert self._child is not None and self._child.stdout is not None
        pipe, end_s, lines = self._child.stdout.fileno(), time.monotonic() + wait_s, []
        while not lines and select.select([pipe], [], [], max(end_s - time.monotonic(), 0.0))[0]:
            data = os.read(pipe, _LARGEST)
            *lines, self._rest = (self._rest + data).split(b"\n")
            if not data:
                return
        for line in lines:
            self._take(line)

    def _take(self, line: bytes) -> None:
        try:
            told = json.loads(line)
            self.seen = float(told["left_m"]), float(told["right_m"])
        except (ValueError, KeyError, TypeError):
            return  # a program may print what it likes
        self._tells, self.is_finished = True, told.get("state") == "finished"

    def _receive(self, until_s: float) -> bool:
        """Takes motion commands until one has come, or until a time; returns whether one has come."""
        while True:
            self._controls.settimeout(max(until_s - time.monotonic(), 1e-4))
            try:
                datagram, sender = self._controls.recvfrom(_LARGEST)
            except socket.timeout:
                return False
            message = self._pairer.feed(sender, datagram, time.monotonic())
            if message and codec.data_struct(message.header) is codec.MotionCommands:
                commands = codec.MotionCommands.unpack(message.data)
                is_whole = NO_VALUE not in (
                    commands.normalized_speed,
                    commands.normalized_yaw_rate,
                )
                if commands.multiplier >= 1 and is_whole:
                    self._latest = _motion(commands)
                    return True

    def close(self) -> None:
        """Ends the program."""
        if self._child is not None:
            stop_child(self._child)
            self._child.stdout.close()
        for made in self._sockets:
            made.close()
        self._child, self._sockets = None, ()


def _scan(reading: Any) -> codec.Datagrams:
    """Returns a LidarReading as messages of the wire: its time, and the scan."""
    stamp = codec.TimeStamp(data_type=codec.DataType.LIDAR, component_id=0)
    stamp.sec, stamp.nsec = divmod(reading.stamp_ns, 10**9)
    message = SimpleNamespace(
        angle_min=reading.angle_min_rad,
        angle_max=reading.angle_max_rad,
        angle_increment=reading.angle_increment_rad,
        time_increment=reading.time_increment_s,
        scan_time=reading.scan_time_s,
        range_min=reading.range_min_m,
        range_max=reading.range_max_m,
        ranges=reading.ranges_m.tolist(),
        intensities=reading.intensities.tolist(),
    )
    made = convert.lidar(message)
    scan = codec.encode(codec.DataType.LIDAR, 0, made.data, made.count)
    return (*codec.encode(codec.DataType.TIME, 0, stamp.pack()), *scan)


def _motion(data: codec.MotionCommands) -> Command:
    """Returns speed [m/s] and turn rate [rad/s] of a motion command, within the limits of the wire."""
    shares = (data.normalized_speed, data.normalized_yaw_rate)
    speed, turn = (max(-1.0, min(1.0, share / data.multiplier)) for share in shares)
    return speed * codec.MAX_SPEED_M_S, turn * codec.MAX_YAW_RATE_RAD_S
