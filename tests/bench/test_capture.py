# SPDX-License-Identifier: MIT
"""Tests packets on loopback: which messages they begin, and when; with streams cut by hand, and real connections."""
import contextlib
import os
import random
import socket
import struct
import time
from typing import Dict, Iterator, List, Tuple

import pytest
from bench import capture as module
from bench import kernel_clock
from bench.capture import MOST_EARLY, Capture, Flow, Missing, Segment, segment
from rosgraph.network import encode_ros_handshake_header

# All processes of this machine share its loopback.
SERVER, OTHER = (f"/{name}_{os.getpid()}" for name in ("server", "other"))
HEADER = encode_ros_handshake_header(dict(type="a/B", md5sum="1234"))


def message(stamp: Tuple[int, int], rest_bytes: int) -> bytes:
    return struct.pack("<IIII", 12 + rest_bytes, 7, *stamp) + bytes(rest_bytes)


def flow_from(first: int) -> Flow:
    return Flow("/image", Segment(b"subscriber", b"publisher", 1, first, b""))


def segments(stream: bytes, sizes: Iterator[int], first: int) -> List[Segment]:
    """Returns the stream cut into these sizes, from this sequence number on."""
    cut, at = [], 0
    while at < len(stream):
        part = stream[at : at + next(sizes)]
        sequence = (first + at) % (1 << 32)
        cut.append(Segment(b"publisher", b"subscriber", sequence, 9, memoryview(part)))
        at += len(part)
    return cut


@pytest.mark.parametrize("is_shuffled", [False, True])
@pytest.mark.parametrize("seed", range(20))
def test_each_message_has_the_time_of_its_first_byte(seed: int, is_shuffled: bool) -> None:
    rng = random.Random(seed)
    stream, begins = bytearray(HEADER), {}
    for number in range(30):
        begins[number * 10**9 + 5] = len(stream)
        stream += message((number, 5), rng.choice((0, 1, 100, 70_000)))
    sizes = iter(lambda: rng.choice((1, 3, 15, 16, 17, 1448, 65_483)), None)
    first = (1 << 32) - rng.randrange(50_000)  # the numbers begin again at zero
    cut, flow = segments(bytes(stream), sizes, first), flow_from(first)
    at, expected, order = 0, {}, list(range(len(cut)))
    for number, each in enumerate(cut):
        ends = at + len(each.data)
        expected.update({stamp: number for stamp, begin in begins.items() if at <= begin < ends})
        at = ends
    if is_shuffled:  # shuffled by up to 10 places
        order.sort(key=lambda number: number + rng.uniform(0, 10))
    for number in order:
        flow.take(cut[number], number)
    for number in order:
        flow.take(cut[number], number + 10**6)  # a repeated segment
    assert flow.times == expected and len(expected) == 30
    assert not flow.is_waiting()


def test_bytes_that_are_sent_again_with_others_count_once() -> None:
    stream = HEADER + message((1, 0), 50) + message((2, 0), 50)
    middle, flow = len(HEADER) + 30, flow_from(0)
    for at_ns, (begin, end) in enumerate([(0, middle), (middle + 50, None), (10, middle + 60)]):
        flow.take(Segment(b"p", b"s", begin, 9, stream[begin:end]), at_ns)
    assert flow.times == {1 * 10**9: 0, 2 * 10**9: 2} and not flow.is_waiting()


def test_early_segments_may_overlap() -> None:
    stream, flow = HEADER + message((1, 0), 50) + message((2, 0), 50), flow_from(0)
    for at_ns, (begin, end) in enumerate([(20, 70), (10, None), (10, 30), (0, 20)]):
        flow.take(Segment(b"p", b"s", begin, 9, stream[begin:end]), at_ns)
    assert sorted(flow.times) == [1 * 10**9, 2 * 10**9] and not flow.is_waiting()


def test_a_segment_that_is_missing_is_waited_for_and_then_said() -> None:
    cut = segments(HEADER + message((1, 2), 3 * MOST_EARLY), iter(lambda: 2, None), 5)
    flow = flow_from(5)
    for each in cut[1 : MOST_EARLY + 1]:
        flow.take(each, 1)
    assert flow.is_waiting() and not flow.times
    with pytest.raises(Missing, match="a segment of /image was not captured"):
        flow.take(cut[MOST_EARLY + 1], 2)


def test_a_message_without_a_stamp_is_said() -> None:
    stream, flow = HEADER + struct.pack("<I", 8) + bytes(8), flow_from(5)
    with pytest.raises(ValueError, match="/image: a message of 8 bytes"):
        for each in segments(stream + message((1, 2), 0), iter([len(stream), 99]), 5):
            flow.take(each, 1)


def packet() -> bytes:
    """Returns a packet with options of IP and of TCP, padded at its end as short ones are on Ethernet."""
    ip = bytes([0x46, 0]) + struct.pack(">H", 24 + 24 + 3) + bytes(5) + b"\x06" + bytes(2)
    ip += b"\x7f\x00\x00\x01\x7f\x00\x00\x02" + bytes(4)
    tcp = struct.pack(">HHIIBBHHH", 40001, 40002, 99, 77, 0x60, 0, 0, 0, 0) + bytes(4)
    return bytes(14) + ip + tcp + b"abc" + b"fill"


def test_a_packet_by_hand() -> None:
    found = segment(memoryview(packet()))
    assert found.source == b"\x7f\x00\x00\x01" + struct.pack(">H", 40001)
    assert found.destination == b"\x7f\x00\x00\x02" + struct.pack(">H", 40002)
    assert (found.sequence, found.expected, bytes(found.data)) == (99, 77, b"abc")


@pytest.mark.parametrize("size", range(14 + 24 + 13))
def test_a_packet_that_is_too_short_is_passed_over(size: int) -> None:
    assert segment(memoryview(packet()[:size])) is None


def new_capture() -> Capture:
    try:
        return Capture(SERVER)
    except PermissionError:
        pytest.skip("this takes the rights to capture packets")


@pytest.fixture(name="capture")
def _capture() -> Iterator[Capture]:
    with contextlib.closing(new_capture()) as found:
        yield found


def sent_over_tcp(caller: str, count: int) -> List[Tuple[int, int]]:
    """Sends messages of growing size one by one; returns when each was sent, and arrived by the subscriber's socket."""
    times = []
    with socket.create_server(("127.0.0.1", 0)) as listening:
        with socket.create_connection(listening.getsockname()) as subscriber:
            kernel_clock.use(subscriber)
            publisher, _ = listening.accept()
            with publisher:
                asked = dict(topic="/image", callerid=caller, md5sum="*", type="*")
                subscriber.sendall(encode_ros_handshake_header(asked))
                publisher.sendall(HEADER)
                assert subscriber.recv(len(HEADER)) == HEADER
                for number in range(count):
                    data, sent_ns = message((number, 0), 30_000 * number), time.time_ns()
                    publisher.sendall(data[:16])
                    _, extras, _, _ = subscriber.recvmsg(16, 256)
                    times.append((sent_ns, kernel_clock.arrival_ns(extras)))
                    publisher.sendall(data[16:])
                    rest = len(data) - 16
                    while rest:
                        rest -= len(subscriber.recv(rest))
    return times


def are_between(found: Dict[int, int], times: List[Tuple[int, int]]) -> bool:
    """Checks times; the socket's own time is taken some 0.2 us after the packet's."""
    return list(found) == [n * 10**9 for n in range(len(times))] and all(
        sent_ns <= at_ns <= arrived_ns
        for at_ns, (sent_ns, arrived_ns) in zip(found.values(), times)
    )


def test_messages_of_a_real_connection_have_the_times_of_its_socket(capture: Capture) -> None:
    sent_over_tcp(OTHER, 5)
    times = sent_over_tcp(SERVER + "_frames", 5)
    assert list(capture.times()) == ["/image"]
    assert are_between(capture.times()["/image"], times)


def test_of_two_connections_the_first_one_counts(capture: Capture) -> None:
    first = sent_over_tcp(SERVER, 3)
    second = sent_over_tcp(SERVER + "_frames", 5)
    assert are_between(capture.times()["/image"], first + second[3:])


def test_what_is_left_after_one_turn_counts(
    capture: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(module, "READ_AT_ONCE", 1)
    monkeypatch.setattr(module, "LATE_S", 60.0)  # other tests talk on this interface, too
    times = sent_over_tcp(SERVER, 5)
    assert are_between(capture.times()["/image"], times)


def test_a_handshake_that_is_sent_again_loses_nothing(capture: Capture) -> None:
    asked = encode_ros_handshake_header(dict(topic="/image", callerid=SERVER, md5sum="*", type="*"))
    handshake = Segment(b"subscriber", b"publisher", 9 - len(asked), 5, asked)
    stream = HEADER + message((1, 0), 50) + message((2, 0), 50)
    for number, each in enumerate(segments(stream, iter([100] * 9), 5)):
        capture._take(handshake, 0)
        capture._take(each, number)
    assert set(capture.times()["/image"]) == {1 * 10**9, 2 * 10**9}


def test_the_same_ports_may_be_used_again(capture: Capture) -> None:
    asked = encode_ros_handshake_header(dict(topic="/image", callerid=SERVER, md5sum="*", type="*"))
    for number, first in enumerate((5, 70_000)):
        capture._take(Segment(b"subscriber", b"publisher", first, first, asked), 0)
        for each in segments(HEADER + message((number, 0), 50), iter([999]), first):
            capture._take(each, number)
    assert capture.times() == {"/image": {0: 0, 1 * 10**9: 1}}


def test_packets_that_the_system_drops_are_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "BUFFER_BYTES", 4096)
    with contextlib.closing(new_capture()) as capture:
        sent_over_tcp(SERVER, 3)
        with pytest.raises(Missing, match="captured"):
            capture.times()
