#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A target computer's side of the bridge, without ROS: receives every sensor, prints what came, drives the robot.

Needs Python's standard library and the folder ardee_bridge of this package's src.
"""
import argparse
import math
import select
import signal
import socket
import sys
import time
from pathlib import Path
from typing import Any, Callable, Dict, List, NoReturn, Tuple

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "src"))

from ardee_bridge.wire import codec  # noqa: E402
from ardee_bridge.wire.chunks import Assembler, points_si  # noqa: E402
from ardee_bridge.wire.pairing import Message, Pairer  # noqa: E402

COMMAND_PERIOD_S = 0.05
ASK_AGAIN_S = 5.0
BUFFER_BYTES = 4 << 20


def fail(text: str) -> NoReturn:
    """Ends with one line and code 2."""
    print(f"ardee_client: {text}", file=sys.stderr)
    sys.exit(2)


class Parser(argparse.ArgumentParser):
    """Parser that reports an error without the usage."""

    def error(self, message: str) -> NoReturn:
        """Ends."""
        fail(message)


def options() -> argparse.Namespace:
    """Returns the parsed command line."""
    port = number_in(int, 0, 65535, "a port, 0 to 65535")
    share = number_in(float, -1.0, 1.0, "a share of the limit, -1 to 1")
    parser = Parser(description=__doc__.split("\n")[0])
    parser.add_argument(
        "--simulator",
        type=address,
        default="127.0.0.1",
        help="address of the simulator's computer",
    )
    parser.add_argument(
        "--port",
        type=port,
        default=30000,
        help="UDP port to listen at; 0: any free port, needs --ask",
    )
    parser.add_argument(
        "--group",
        type=address,
        help="multicast group to join, on the interface that leads to the simulator",
    )
    parser.add_argument(
        "--ask",
        type=port,
        metavar="PORT",
        help="ask the sensor server at this port, usually 30001, for every sensor and for time stamps",
    )
    parser.add_argument(
        "--controls", type=port, default=35555, help="UDP port of the controls client"
    )
    parser.add_argument(
        "--speed", type=share, help="speed to drive at, -1...1 of the robot's limit"
    )
    parser.add_argument(
        "--yaw-rate", type=share, help="rate to turn at, -1...1 of the robot's limit"
    )
    parser.add_argument(
        "--control",
        choices=[code.name for code in codec.ControlCode],
        help="control of the simulation to send once",
    )
    parser.add_argument(
        "--duration-s",
        type=number_in(float, 0.0, 1e9, "a time in s, at least 0"),
        default=5.0,
        help="time until it ends (default %(default)s)",
    )
    found = parser.parse_args()
    if not found.port and not found.ask:
        fail("argument --port: found 0, expected a port, or --ask too")
    return found


def number_in(kind: type, low: float, high: float, expected: str) -> Callable[[str], Any]:
    """Returns the argparse type of a number within limits, which `expected` says in words."""

    def read(text: str) -> Any:
        try:
            value = kind(text)
        except ValueError:
            value = math.nan
        if not low <= value <= high:
            raise argparse.ArgumentTypeError(f"found {text}, expected {expected}")
        return value

    return read


def address(text: str) -> str:
    """Returns the IPv4 address of a computer or group, given by it or by a name."""
    try:
        return socket.gethostbyname(text)
    except OSError:
        expected = "expected an IPv4 address or a known name"
        raise argparse.ArgumentTypeError(f"found {text}, {expected}") from None


def join(opened: socket.socket, group: str, simulator: str) -> None:
    """Joins a multicast group. Without a default route the system cannot choose the interface."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as towards:
        towards.connect((simulator, 9))  # sends nothing
        interface = towards.getsockname()[0]
    member = socket.inet_aton(group) + socket.inet_aton(interface)
    opened.setsockopt(socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, member)


class Client:
    """Counts messages by sensor, and keeps what the last one said."""

    def __init__(self, opened: socket.socket) -> None:
        self._socket = opened
        self._pairer, self._assembler = Pairer(), Assembler()
        self._seen: Dict[Tuple[str, int], Tuple[int, str]] = {}

    def send(self, pair: codec.Datagrams, address: Tuple[str, int]) -> None:
        """Header, then data; where there is no way to the simulator yet, say so and go on."""
        try:
            for datagram in pair:
                self._socket.sendto(datagram, address)
        except OSError as error:
            where = f"{address[0]}:{address[1]}"
            print(f"ardee_client: send to {where}: {error.strerror}", file=sys.stderr)

    def receive(self, timeout_s: float) -> None:
        """Receives the messages that arrive within this time."""
        if not select.select([self._socket], [], [], timeout_s)[0]:
            return
        try:
            datagram, sender = self._socket.recvfrom(65535)
        except ConnectionError:  # nobody listens where a command went to: no simulator yet
            return
        message = self._pairer.feed(sender, datagram, time.monotonic())
        if message:
            self._take(message)

    def _take(self, message: Message) -> None:
        kind = codec.data_struct(message.header)
        if kind in (codec.ImageChunk, codec.PointCloudChunk):
            whole = self._assembler.feed(message.header, message.data)
            if whole:
                self._count(message.header, describe_frame(whole))
        elif kind is codec.LidarData:
            scan = codec.LidarData.unpack(message.data)
            ranges_m = codec.ranges_m(message.header, scan)
            nearest_m = min((r for r in ranges_m if r > -math.inf), default=math.inf)
            self._count(message.header, f"beams {len(ranges_m)} nearest {nearest_m:.3f} m")
        else:
            self._count(message.header, str(kind.unpack(message.data).to_si()))

    def _count(self, header: codec.Header, text: str) -> None:
        is_sensor = header.data_type != codec.DataType.NONE
        name = codec.DataType(header.data_type).name.lower() if is_sensor else "ack"
        count, _ = self._seen.get((name, header.component_id), (0, ""))
        self._seen[name, header.component_id] = (count + 1, text)

    def report(self) -> None:
        """Print a line for each sensor."""
        for (name, component_id), (count, text) in sorted(self._seen.items()):
            print(f"{name} {component_id} count {count} {text}")


def describe_frame(whole: Any) -> str:
    """Returns a description of an image or a point cloud."""
    if isinstance(whole.head, codec.ImageChunk):
        name = codec.ImageEncoding(whole.head.encoding).name
        return (
            f"{name} width {whole.head.width} height {whole.head.height} bytes {len(whole.payload)}"
        )
    return f"points {len(points_si(whole.payload))}"


def main() -> int:
    """Runs the client for the requested time."""
    found = options()
    controls, server = (found.simulator, found.controls), (found.simulator, found.ask)
    drives = found.speed is not None or found.yaw_rate is not None
    is_local = found.simulator.startswith("127.") and not found.group
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, BUFFER_BYTES)
        try:
            opened.bind(("127.0.0.1" if is_local else "0.0.0.0", found.port))
        except OSError as error:
            fail(f"port {found.port}: {error.strerror}")
        if found.group:
            try:
                join(opened, found.group, found.simulator)
            except OSError as error:
                fail(f"group {found.group}: {error.strerror}")
        client = Client(opened)
        if found.control:
            client.send(codec.encode_control(codec.ControlCode[found.control]), controls)
        end_s = time.monotonic() + found.duration_s
        has_to_end = []  # type: List[int]
        signal.signal(signal.SIGINT, lambda number, frame: has_to_end.append(number))
        command_s = ask_s = 0.0
        while time.monotonic() < end_s and not has_to_end:
            now = time.monotonic()
            if drives and now >= command_s:
                command = codec.encode_motion(found.speed or 0.0, found.yaw_rate or 0.0)
                client.send(command, controls)
                command_s = now + COMMAND_PERIOD_S
            if found.ask and now >= ask_s:
                wanted = [codec.DataType.ALL, codec.DataType.TIME]
                client.send(codec.encode_set_port(wanted), server)
                ask_s = now + ASK_AGAIN_S
            client.receive(0.01)
        if drives:
            client.send(codec.encode_motion(0.0, 0.0), controls)
    client.report()
    return 0


if __name__ == "__main__":
    sys.exit(main())
