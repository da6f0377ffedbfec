# SPDX-License-Identifier: MIT
"""Command `hil_row_follower`: the row follower of a target computer, without ROS, over UDP alone (thesis 4.5).

It asks the sensor server for scans and their time stamps (SET_PORT), follows the rows and sends motion commands to
the controls client. With --log each answer is written as a line of JSON.
"""
import argparse
import ipaddress
import json
import math
import signal
import socket
import sys
import time
from pathlib import Path
from typing import IO, Any, Dict, List, NoReturn, Optional, Set, Tuple

import numpy as np

from ardee_bridge.wire import codec
from ardee_bridge.wire.pairing import Message, Pairer
from ardee_common.cli import Parser
from ardee_common.errors import GeneratorError, known_names
from ardee_navigation.evaluation.scenario_files import read_parameters, read_scenarios
from ardee_navigation.lbirnt import Output, Parameters, RowFollower

ASK_EVERY_S = 5.0  # the server forgets a client after 30 s of silence
LARGEST_DATAGRAM = 65_535
BACK_S = 1.0  # a larger step back in time means another simulation, not reordered datagrams
WANTED = (codec.DataType.LIDAR, codec.DataType.TIME)
Address = Tuple[str, int]


class Clock:
    """Simulated time of a scan: that of the time stamp sent before it, else the last one plus the scan's own period.

    A scan without a period (simulated lidars leave it 0) counts with the time since the scan before it.
    """

    def __init__(self) -> None:
        self._stamps: Dict[int, float] = {}
        self._last_s = self._arrived_s = 0.0

    def stamp(self, data: codec.TimeStamp) -> None:
        """Takes a time stamp, which the next message of its component belongs to."""
        if data.data_type == codec.DataType.LIDAR:
            self._stamps = {data.component_id: data.sec + 1e-9 * data.nsec}

    def of_scan(self, component_id: int, period_s: float, arrived_s: float) -> float:
        """Returns the time [s] of the scan that has arrived at `arrived_s` by this computer's clock."""
        waited_s = arrived_s - self._arrived_s if self._arrived_s else 0.0
        self._arrived_s = arrived_s
        step_s = period_s if 0.0 < period_s < math.inf else waited_s
        self._last_s = self._stamps.pop(component_id, self._last_s + step_s)
        return self._last_s


class Target:
    """Follows rows over one socket."""

    def __init__(
        self, parameters: Parameters, sensors: Address, controls: Address, bind: Address
    ) -> None:
        self._follower = RowFollower(parameters)
        self._sensors, self._controls = sensors, controls
        self._pairer, self._clock, self._asked_s = Pairer(), Clock(), -float("inf")
        self._last_s = -float("inf")  # simulated time of the latest scan
        self._out_of_reach: Set[Address] = set()
        self._is_astray = False  # whether the latest answer was not finite
        self._socket = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 1 << 20)
        self._socket.settimeout(0.2)
        self._socket.bind(bind)

    def _send(self, datagrams: codec.Datagrams, to: Address) -> None:
        for datagram in datagrams:
            try:
                self._socket.sendto(datagram, to)
            except OSError as error:  # the network is away, or no route leads there
                self._say_once(to, error)
                return
        self._out_of_reach.discard(to)

    def _say_once(self, to: Address, error: OSError) -> None:
        """Logs once why sending fails, until a message could be sent again."""
        if to not in self._out_of_reach:
            self._out_of_reach.add(to)
            text = f"hil_row_follower: cannot send to {to[0]}:{to[1]}: {error.strerror or error}"
            print(text, file=sys.stderr, flush=True)

    def ask(self) -> None:
        """Asks the server for scans, repeatedly, so that either may start first or start again."""
        if time.monotonic() - self._asked_s >= ASK_EVERY_S:
            self._asked_s = time.monotonic()
            self._send(codec.encode_set_port(WANTED), self._sensors)

    def receive(self) -> Optional[Dict[str, Any]]:
        """Waits a moment for a datagram; returns the answer if it completed a scan."""
        try:
            datagram, sender = self._socket.recvfrom(LARGEST_DATAGRAM)
        except (socket.timeout, ConnectionError):
            return None
        if sender != self._sensors:
            return None
        message = self._pairer.feed(sender, datagram, time.monotonic())
        return self._answer(message) if message else None

    def _answer(self, message: Message) -> Optional[Dict[str, Any]]:
        kind = codec.data_struct(message.header)
        if kind is codec.TimeStamp:
            self._clock.stamp(codec.TimeStamp.unpack(message.data))
        if kind is not codec.LidarData:
            return None
        raw = codec.LidarData.unpack(message.data)
        scan, ranges = raw.to_si(), np.array(codec.ranges_m(message.header, raw))
        now_s = self._clock.of_scan(message.header.component_id, scan.scan_time, time.monotonic())
        if now_s < self._last_s - BACK_S:
            self._follower.reset()  # the simulation was started again
        self._last_s = now_s
        output = self._follower.update(ranges, scan.angle_min, scan.dAngle, now_s)
        self._send(self._command(output), self._controls)
        return _line(now_s, output)

    def _command(self, output: Output) -> codec.Datagrams:
        """Returns the motion command of an answer; a standstill, logged once, if the answer is not finite."""
        try:
            command = codec.encode_motion_si(output.speed_m_s, output.turn_rad_s)
            self._is_astray = False
        except ValueError as error:
            if not self._is_astray:
                print(f"hil_row_follower: {error}; stopped", file=sys.stderr, flush=True)
            self._is_astray = True
            command = codec.encode_motion_si(0.0, 0.0)
        return command

    def stop(self) -> None:
        """Tells the robot to stand still and the server to send nothing more, and closes the socket."""
        self._send(codec.encode_motion_si(0.0, 0.0), self._controls)
        self._send(codec.encode_set_port(()), self._sensors)
        self._socket.close()


def _line(time_s: float, output: Output) -> Dict[str, Any]:
    return {
        "time_s": round(time_s, 6),
        "left_m": output.lane.left.distance_m,
        "right_m": -output.lane.right.distance_m,
        "valid": list(output.valid),
        "state": output.state.value,
        "speed_m_s": output.speed_m_s,
        "turn_rad_s": output.turn_rad_s,
    }


def _address(text: str, least_port: int = 0) -> Address:
    host, _, port = text.rpartition(":")
    try:
        if not least_port <= int(port) <= 65535:
            raise ValueError
        return socket.gethostbyname(host), int(port)
    except (OSError, ValueError):
        expected = f"HOST:PORT with a port from {least_port} to 65535"
        raise argparse.ArgumentTypeError(f"found {text!r}, expected {expected}") from None


def _peer(text: str) -> Address:
    host, port = _address(text, least_port=1)
    if ipaddress.ip_address(host).is_unspecified:  # what it sends would come from another address
        expected = "the address of a computer, such as 127.0.0.1"
        raise argparse.ArgumentTypeError(f"found {text!r}, expected {expected}")
    return host, port


def _own_address(*others: Address) -> Address:
    """Returns the address to listen at: loopback, which keeps the network out, unless a peer is farther away."""
    is_here = all(ipaddress.ip_address(host).is_loopback for host, _ in others)
    return ("127.0.0.1" if is_here else "0.0.0.0"), 0


def _arguments(argv: List[str]) -> argparse.Namespace:
    parser = Parser(prog="hil_row_follower", description=__doc__.splitlines()[0])
    parser.add_argument(
        "--sensors", type=_peer, default="127.0.0.1:30001", help="ADDRESS:PORT of the sensor server"
    )
    parser.add_argument(
        "--controls",
        type=_peer,
        default="127.0.0.1:35555",
        help="ADDRESS:PORT of the controls client",
    )
    parser.add_argument(
        "--bind",
        type=_address,
        help="own ADDRESS:PORT; port 0: any (default: 127.0.0.1:0 if both others are on this computer, else 0.0.0.0:0)",
    )
    parser.add_argument(
        "--parameters",
        default="",
        help="YAML file of parameters that differ from the scenario's, or the defaults",
    )
    parser.add_argument("--scenarios", type=Path, help="scenarios.yaml, for --scenario")
    parser.add_argument("--scenario", help="take the parameters of this scenario")
    parser.add_argument("--log", help="file for a line of JSON a scan; -: standard output")
    args = parser.parse_args([word for word in argv if not word.startswith("__")])  # roslaunch's
    args.bind = args.bind or _own_address(args.sensors, args.controls)
    return args


def _parameters(args: argparse.Namespace) -> Parameters:
    """Returns those of the file, over those of the scenario, over the defaults."""
    usual = Parameters()
    if args.scenario:
        if not args.scenarios:
            raise GeneratorError("--scenario: found no --scenarios, expected the file it is in")
        known = read_scenarios(args.scenarios)
        if args.scenario not in known:
            raise GeneratorError(
                f"--scenario: found {args.scenario!r}, {known_names(args.scenario, known)}"
            )
        usual = known[args.scenario].parameters
    return read_parameters(Path(args.parameters), usual) if args.parameters else usual


def _stop_here(_number: int, _frame: Any) -> NoReturn:
    raise SystemExit(0)


def _follow(target: Target, log: Optional[IO[str]]) -> None:
    state = ""
    while True:
        target.ask()
        answer = target.receive()
        if answer is None:
            continue
        if log:
            print(json.dumps(answer), file=log, flush=True)
        if answer["state"] != state:
            state = answer["state"]
            print(f"hil_row_follower: {state}", file=sys.stderr, flush=True)


def main() -> int:
    """Runs until it is told to end; returns the exit code, 2 for bad input."""
    args = _arguments(sys.argv[1:])
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, _stop_here)
    try:
        parameters = _parameters(args)
        target = Target(parameters, args.sensors, args.controls, args.bind)
        log = sys.stdout if args.log == "-" else open(args.log, "w") if args.log else None
    except (GeneratorError, OSError) as error:
        print(f"hil_row_follower: {error}", file=sys.stderr)
        return 2
    try:
        _follow(target, log)
    finally:
        target.stop()
        if log and log is not sys.stdout:
            log.close()
    return 0
