# SPDX-License-Identifier: MIT
"""Tests the controls client on real sockets: limits, control codes, peers, watchdog, drops and their reasons."""
import re
import socket
import time
from pathlib import Path

import pytest

from ardee_bridge.nodes.controls import STANDSTILL, ControlsClient, Motion, to_motion
from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.settings import ControlSettings
from ardee_bridge.wire import codec
from ardee_bridge.wire.udp import open_socket
from ardee_common.config import from_values, read_yaml_lines

STAMPS_BEGIN_S = 0.2  # so long after a first socket asked, Linux begins to take times of arrival
SHIPPED = Path(__file__).resolve().parents[1] / "config/controls_client.yaml"


class Bench:
    """Controls client whose clock the test sets, and a peer."""

    def __init__(self, **values):
        self.now_s, self.motions, self.pauses, self.warnings = 0.0, [], [], []
        settings = from_values(ControlSettings, {**read_yaml_lines(SHIPPED), "port": 0, **values})
        self.server = open_socket(settings.bind_address, settings.port)
        self.peer = open_socket("127.0.0.1", 0)
        self.peer.settimeout(5.0)
        self.counters = Counters(self.warnings.append)
        self.client = ControlsClient(
            settings,
            self.server,
            self.counters,
            self.motions.append,
            self.pauses.append,
            lambda: self.now_s,
        )

    def send(self, *datagrams, by=None):
        for datagram in datagrams:
            (by or self.peer).sendto(datagram, self.server.getsockname())
        self.client.receive(0.05)

    def close(self):
        self.server.close()
        self.peer.close()


@pytest.mark.parametrize(
    "speed, yaw_rate, multiplier, expected",
    [
        (50, -100, 100, (0.6, -1.2 / 0.381)),
        (1, 0, 1, (1.2, 0.0)),
        (-250, 300, 100, (-1.2, 1.2 / 0.381)),
        (2**31 - 1, -(2**31), 2**31 - 1, (1.2, -1.2 / 0.381)),
    ],
)
def test_limits(speed, yaw_rate, multiplier, expected):
    commands = codec.MotionCommands(
        normalized_speed=speed, normalized_yaw_rate=yaw_rate, multiplier=multiplier
    )
    assert to_motion(
        commands, from_values(ControlSettings, read_yaml_lines(SHIPPED))
    ) == pytest.approx(expected)


def test_a_command_moves_and_its_end_stops(bench):
    bench.send(*codec.encode_motion(0.5, 0.0))
    assert bench.motions == [Motion(0.6, 0.0)]
    bench.now_s = 0.3  # and the command is older by the time it took to be read
    bench.client.receive(0.0)
    assert len(bench.motions) == 1
    bench.now_s = 0.5
    bench.client.receive(0.0)
    assert bench.motions[1:] == [STANDSTILL]
    bench.now_s = 5.0
    bench.client.receive(0.0)
    assert len(bench.motions) == 2
    assert bench.counters.done()["watchdog stops"] == 1


def test_after_the_end_no_command_moves(bench):
    bench.client.stop()
    assert bench.motions == []  # it had no command
    bench.send(*codec.encode_motion(0.5, 0.0))
    assert bench.motions == []


def test_the_end_stops_what_still_receives(bench):
    bench.send(*codec.encode_motion(0.5, 0.0))
    bench.client.stop()
    bench.send(*codec.encode_motion(0.5, 0.0))
    bench.now_s += 1.0
    bench.client.receive(0.0)
    assert bench.motions == [Motion(0.6, 0.0), STANDSTILL]


def test_without_a_command_from_the_start_it_stops_what_another_may_have_left_driving(bench):
    bench.client.receive(0.0)
    assert bench.motions == []
    bench.now_s = 0.5
    bench.client.receive(0.0)
    bench.now_s = 5.0
    bench.client.receive(0.0)
    assert bench.motions == [STANDSTILL]


def test_a_command_that_was_read_too_late_does_not_move(bench):
    time.sleep(STAMPS_BEGIN_S)
    for datagram in codec.encode_motion(0.5, 0.0):
        bench.peer.sendto(datagram, bench.server.getsockname())
    time.sleep(0.6)  # as if the node had been kept from its processor
    bench.client.receive(0.0)
    assert bench.motions == []
    assert bench.counters.dropped() == {"motion commands read too late": 1}
    (warning,) = bench.warnings
    assert re.fullmatch(r"dropped 1: motion commands read too late, 0\.[6-9] s .*", warning)


def test_the_watchdog_counts_from_a_command_s_arrival(bench):
    time.sleep(STAMPS_BEGIN_S)
    for datagram in codec.encode_motion(0.5, 0.0):
        bench.peer.sendto(datagram, bench.server.getsockname())
    time.sleep(0.2)
    bench.client.receive(0.0)
    assert bench.motions == [Motion(0.6, 0.0)]
    bench.now_s = 0.3
    bench.client.receive(0.0)
    assert bench.motions == [Motion(0.6, 0.0), STANDSTILL]


def test_commands_keep_the_watchdog_quiet(bench):
    for number in range(20):
        bench.now_s = 0.3 * number
        bench.send(*codec.encode_motion(0.5, 0.0))
    assert STANDSTILL not in bench.motions


def test_commands_that_arrive_together_are_passed_on_in_order(bench):
    bench.send(*codec.encode_motion(0.1, 0.0), *codec.encode_motion(1.0, 0.0))
    assert bench.motions == [pytest.approx((0.12, 0.0)), Motion(1.2, 0.0)]


def test_of_very_many_at_once_the_newest_are_passed_on(bench):
    for number in range(100):
        for datagram in codec.encode_motion(number / 100, 0.0):
            bench.peer.sendto(datagram, bench.server.getsockname())
    bench.client.receive(0.05)
    speeds = [motion.speed_m_s for motion in bench.motions]
    assert speeds == pytest.approx([1.2 * number / 100 for number in range(36, 100)])
    assert bench.counters.dropped() == {"motion commands overtaken by newer ones": 36}


def test_stop_holds_until_start(bench):
    bench.send(*codec.encode_motion(0.5, 0.0))
    bench.send(*codec.encode_control(codec.ControlCode.STOP))
    bench.send(*codec.encode_motion(0.5, 0.0))
    assert bench.motions == [Motion(0.6, 0.0), STANDSTILL]
    assert bench.pauses == []
    bench.send(*codec.encode_control(codec.ControlCode.START))
    bench.send(*codec.encode_motion(0.25, 0.0))
    assert bench.motions[2:] == [Motion(0.3, 0.0)]
    assert bench.pauses == [False]
    assert bench.counters.dropped() == {"motion command between STOP and START": 1}


def test_stop_after_a_command_of_the_same_batch_wins(bench):
    bench.send(
        *codec.encode_motion(0.5, 0.0),
        *codec.encode_control(codec.ControlCode.STOP),
        *codec.encode_motion(0.5, 0.0),
    )
    assert bench.motions == [STANDSTILL]


def test_pause_and_resume(bench):
    for code in (codec.ControlCode.PAUSE, codec.ControlCode.RESUME):
        bench.send(*codec.encode_control(code))
    assert bench.pauses == [True, False]
    assert bench.motions == []


def test_control_codes_are_answered(bench):
    bench.send(*codec.encode_control(codec.ControlCode.PAUSE, request_id=77))
    header = codec.Header.unpack(bench.peer.recv(100))
    assert header.msg_type == codec.MessageType.ACK
    assert codec.Ack.unpack(bench.peer.recv(100)).sequence == 77


def raw_motion(speed, yaw_rate, multiplier):
    """Returns a command of any integers."""
    raw = codec.MotionCommands(multiplier=multiplier)
    raw.normalized_speed, raw.normalized_yaw_rate = speed, yaw_rate
    return codec.encode_motion(0.0, 0.0)[0], raw.pack()


@pytest.mark.parametrize(
    "datagrams, reason",
    [
        (raw_motion(0, 0, 0), "malformed motion command"),
        (raw_motion(-2, 0, -5), "malformed motion command"),
        (raw_motion(-(2**31), 0, 1), "malformed motion command"),
        (raw_motion(0, -(2**31), 1), "malformed motion command"),
        (codec.encode_control(9), "unknown control code"),
        (codec.encode_set_port([]), "neither motion nor control"),
        (codec.encode(codec.DataType.BATTERY, 0, bytes(12)), "neither motion nor control"),
        ((codec.Header(msg_type=55).pack(),), "unknown or invalid header"),
        ((b"\1" * 12,), "data without header"),
        ((codec.encode_motion(1, 0)[0], b"\1" * 11), "data of the wrong size"),
        ((codec.encode_motion(1, 0)[0], b"\1" * 60000), "data of the wrong size"),
        ((b"",), "data without header"),
    ],
)
def test_what_is_not_well_formed_is_dropped_counted_and_said_once(bench, datagrams, reason):
    for _ in range(3):
        bench.send(*datagrams)
    assert bench.motions == [] and bench.pauses == []
    dropped = bench.counters.dropped()
    assert dropped[reason] == 3
    assert sum(reason in warning for warning in bench.warnings) == 1


@pytest.mark.parametrize("peers", [["127.0.0.2"], ["10.0.0.0/8"], ["127.0.0.1:1"], []])
def test_others_are_not_obeyed(peers):
    bench = Bench(peers=peers)
    bench.send(*codec.encode_motion(0.5, 0.0), *codec.encode_control(codec.ControlCode.STOP))
    assert bench.motions == [] and bench.counters.dropped() == {"sender is no peer": 4}
    bench.close()


def test_a_network_is_a_peer():
    bench = Bench(peers=["10.1.2.3", "127.0.0.0/8"])
    bench.send(*codec.encode_motion(0.5, 0.0), by=None)
    assert bench.motions == [Motion(0.6, 0.0)]
    bench.close()


def test_a_wrong_peer_cannot_come_between_header_and_data(bench):
    header, data = codec.encode_motion(0.5, 0.0)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as other:
        other.bind(("127.0.0.3", 0))
        bench.send(header)
        bench.send(header, b"\0" * 12, by=other)
        bench.send(data)
    assert bench.motions == [Motion(0.6, 0.0)]
