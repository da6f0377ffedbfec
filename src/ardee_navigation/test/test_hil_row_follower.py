# SPDX-License-Identifier: MIT
"""Tests the row follower of a target computer, on sockets of the loopback."""
import socket
from dataclasses import replace
from typing import Any, Iterator, Tuple

import numpy as np
import pytest
from scans import ANGLE_MIN_RAD, INCREMENT_RAD, lane_walls, scan_of

from ardee_bridge.wire import codec
from ardee_navigation.lbirnt import Parameters
from ardee_navigation.nodes.hil_row_follower import Clock, Target, _arguments

LOOPBACK = ("127.0.0.1", 0)


def bound() -> socket.socket:
    made = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    made.bind(LOOPBACK)
    made.settimeout(5.0)
    return made


@pytest.fixture()
def ends() -> Iterator[Tuple[Any, socket.socket, socket.socket]]:
    """Yields the target, the sensor server's socket, the robot's."""
    server, robot = bound(), bound()
    target = Target(Parameters(), server.getsockname(), robot.getsockname(), LOOPBACK)
    yield target, server, robot
    target.stop()
    server.close()
    robot.close()


@pytest.mark.parametrize(
    "words, host",
    [
        ("", "127.0.0.1"),
        ("--sensors 127.0.0.1:1 --controls 127.3.2.1:2", "127.0.0.1"),
        ("--sensors 192.168.1.1:30001 --controls 192.168.1.1:35555", "0.0.0.0"),
        ("--controls 192.168.1.1:35555", "0.0.0.0"),
        ("--sensors 192.168.1.1:30001", "0.0.0.0"),
    ],
)
def test_listens_on_loopback_only_where_all_are_there(words: str, host: str) -> None:
    assert _arguments(words.split()).bind == (host, 0)
    assert _arguments([*words.split(), "--bind", "10.0.0.7:5"]).bind == ("10.0.0.7", 5)


@pytest.mark.parametrize(
    "words, why",
    [
        ("--sensors 127.0.0.1:99999", "HOST:PORT with a port from 1 to 65535"),
        ("--controls 127.0.0.1:0", "HOST:PORT with a port from 1 to 65535"),
        ("--bind 127.0.0.1:65536", "HOST:PORT with a port from 0 to 65535"),
        ("--bind 127.0.0.1", "HOST:PORT with a port from 0 to 65535"),
    ],
)
def test_a_bad_address_is_one_line(words: str, why: str, capsys: pytest.CaptureFixture) -> None:
    option, address = words.split()
    with pytest.raises(SystemExit) as ended:
        _arguments([option, address])
    line = f"hil_row_follower: argument {option}: found {address!r}, expected {why} (--help lists all arguments)\n"
    assert ended.value.code == 2 and capsys.readouterr().err == line


def scan_message(ranges_m: np.ndarray) -> Tuple[bytes, bytes]:
    scan = codec.LidarData(
        angle_min=ANGLE_MIN_RAD,
        angle_max=-ANGLE_MIN_RAD,
        dAngle=INCREMENT_RAD,
        scan_time=0.025,
        dTime=0.0,
        range_min=0.06,
        range_max=10.0,
    ).to_raw()
    scan.ranges = codec.range_counts(ranges_m, 0.06, 10.0)
    return codec.encode(codec.DataType.LIDAR, 0, scan.pack(), count=len(ranges_m))


def asked_by(target: Any, server: socket.socket) -> Tuple[str, int]:
    """Returns the target's address; it asks for scans and their times."""
    target.ask()
    header, sender = server.recvfrom(65535)
    data, _ = server.recvfrom(65535)
    assert codec.Header.unpack(header).msg_type == codec.MessageType.SET_PORT
    wanted = codec.type_mask([codec.DataType.LIDAR, codec.DataType.TIME])
    assert codec.SetPort.unpack(data).data_types == wanted
    return sender


def answer_to(target: Any, datagrams: int) -> Any:
    """Returns the answer to the last of these datagrams."""
    return [target.receive() for _ in range(datagrams)][-1]


def test_a_scan_is_answered_with_a_command(ends: tuple) -> None:
    target, server, robot = ends
    address = asked_by(target, server)
    stamp = codec.TimeStamp(sec=3, nsec=500_000_000, data_type=codec.DataType.LIDAR)
    messages = [codec.encode(codec.DataType.TIME, 0, stamp.pack())]
    messages.append(scan_message(scan_of(*lane_walls(0.05, 0.0))))
    for datagram in (d for message in messages for d in message):
        server.sendto(datagram, address)
    answer = answer_to(target, 4)
    assert answer["state"] == "following" and answer["time_s"] == 3.5
    header, command = (robot.recvfrom(65535)[0] for _ in range(2))
    assert codec.data_struct(codec.Header.unpack(header)) is codec.MotionCommands
    motion = codec.MotionCommands.unpack(command)
    assert motion.normalized_speed / motion.multiplier * 1.2 == pytest.approx(0.5, abs=1e-5)
    assert motion.normalized_yaw_rate < 0  # the middle is on the right


def test_strangers_and_rubbish_are_not_answered(ends: tuple) -> None:
    target, server, robot = ends
    address = asked_by(target, server)
    message = scan_message(scan_of(*lane_walls(0.0, 0.0)))
    stranger = bound()
    for datagram in message:
        stranger.sendto(datagram, address)
    stranger.close()
    rubbish = [
        b"",
        b"x" * 20,
        b"y" * 8676,
        message[0][:19],
        message[1],
        message[0],
        message[1][:-1],
    ]
    for datagram in rubbish:
        server.sendto(datagram, address)
    assert [target.receive() for _ in range(2 + len(rubbish))] == [None] * (2 + len(rubbish))
    robot.settimeout(0.05)
    with pytest.raises(socket.timeout):
        robot.recvfrom(65535)


def test_without_time_stamps_the_scans_period_counts() -> None:
    clock = Clock()
    assert clock.of_scan(0, 0.025, 100.0) == pytest.approx(0.025)
    assert clock.of_scan(0, 0.025, 100.1) == pytest.approx(0.050)
    clock.stamp(codec.TimeStamp(sec=7, nsec=0, data_type=codec.DataType.LIDAR))
    assert clock.of_scan(0, 0.025, 100.2) == 7.0
    clock.stamp(codec.TimeStamp(sec=9, nsec=0, data_type=codec.DataType.IMU))
    assert clock.of_scan(0, 0.025, 100.3) == pytest.approx(7.025)


@pytest.mark.parametrize("period_s", [0.0, float("nan"), -1.0])
def test_without_a_period_either_the_wait_counts(period_s: float) -> None:
    clock = Clock()
    assert clock.of_scan(0, period_s, 100.0) == 0.0
    assert clock.of_scan(0, period_s, 100.03) == pytest.approx(0.03)
    clock.stamp(codec.TimeStamp(sec=7, nsec=0, data_type=codec.DataType.LIDAR))
    assert clock.of_scan(0, period_s, 100.05) == 7.0
    assert clock.of_scan(0, period_s, 100.07) == pytest.approx(7.02)


def test_an_answer_that_is_not_finite_stops_the_robot_and_is_said_once(
    ends: tuple, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    target, server, robot = ends
    address = asked_by(target, server)
    update = target._follower.update
    monkeypatch.setattr(
        target._follower, "update", lambda *scan: replace(update(*scan), turn_rad_s=float("nan"))
    )
    for _ in range(2):
        for datagram in scan_message(scan_of(*lane_walls(0.05, 0.0))):
            server.sendto(datagram, address)
        answer_to(target, 2)
        _, command = (robot.recvfrom(65535)[0] for _ in range(2))
        motion = codec.MotionCommands.unpack(command)
        assert (motion.normalized_speed, motion.normalized_yaw_rate) == (0, 0)
    found = "yaw_rate_rad_s: found nan, expected a finite number"
    assert capsys.readouterr().err == f"hil_row_follower: {found}; stopped\n"
