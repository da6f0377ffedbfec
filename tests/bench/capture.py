# SPDX-License-Identifier: MIT
"""Captures packets on loopback, and finds when each message of a topic began to arrive at its subscriber.

It captures as tcpdump does, without any traffic of its own. It needs the rights to capture packets and to enlarge
its buffer (CAP_NET_RAW and CAP_NET_ADMIN).
"""
import ctypes
import socket
import struct
import time
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

from bench import kernel_clock, priority
from bench.latency import SO_RCVBUFFORCE
from rosgraph.network import ROSHandshakeException, decode_ros_handshake_header

from ardee_bridge.wire.codec import Buffer

INTERFACE = "lo"
BUFFER_BYTES = 64 << 20
READ_AT_ONCE = 1000  # packets; then other work has a turn
# Greatest number of packets that wait for one that they overtook on another processor.
MOST_EARLY, LATE_S = 100, 1.0
# Numbers of Linux that Python's socket module does not name.
SO_ATTACH_FILTER = 26
SOL_PACKET, PACKET_STATISTICS, PACKET_IGNORE_OUTGOING = 263, 6, 23
# For a socket of one protocol, the packet's time would be taken after the subscriber has been woken.
ETH_P_ALL = 3
_ETHERNET_BYTES, _MAX_PACKET = 14, 66_000
# Classic BPF: whole packets of IPv4 (Ethernet's 0x800) with protocol TCP (6), no fragments.
_ONLY_TCP = b"".join(
    struct.pack("=HBBI", *each)
    for each in (
        (0x28, 0, 0, 12),
        (0x15, 0, 5, 0x0800),
        (0x30, 0, 0, 23),
        (0x15, 0, 3, 6),
        (0x28, 0, 0, 20),
        (0x45, 1, 0, 0x3FFF),
        (0x06, 0, 0, 0x40000),
        (0x06, 0, 0, 0),
    )
)
# Lengths at the start of a message with a std_msgs/Header: its seq, seconds and nanoseconds.
BEGIN = struct.Struct("<IIII")
_SEQUENCES = 1 << 32

Times = Dict[int, int]  # stamp of a message [ns]: arrival of its first bytes [ns]


class Missing(OSError):
    """Error: packets were not captured."""


class Segment(NamedTuple):
    """TCP segment: both ends (address and port), number of its first byte, next number expected back, bytes."""

    source: bytes
    destination: bytes
    sequence: int
    expected: int
    data: Buffer


def segment(packet: memoryview) -> Optional[Segment]:
    """Parses an Ethernet packet with IPv4 and TCP; returns None if it is too short for them."""
    ip = packet[_ETHERNET_BYTES:]
    try:
        (size,) = struct.unpack_from(">H", ip, 2)
        addresses = struct.unpack_from("4s4s", ip, 12)
        tcp = ip[(ip[0] & 15) * 4 : size]
        source, destination, sequence, expected = struct.unpack_from(">2s2sII", tcp)
        data = tcp[(tcp[12] >> 4) * 4 :]
    except (struct.error, IndexError):
        return None
    return Segment(addresses[0] + source, addresses[1] + destination, sequence, expected, data)


class Flow:
    """Bytes from a publisher to one subscriber: a connection header, then messages, each after its length."""

    def __init__(self, topic: str, asked: Segment) -> None:
        """Takes the topic and the segment of the subscriber's handshake."""
        self.topic, self.handshake = topic, asked.sequence
        self.times: Times = {}
        self._next = asked.expected  # number of the next byte
        # segments ahead of their turn, by number of the first byte
        self._early: Dict[int, Tuple[Segment, int]] = {}
        self._begin = b""
        self._begin_ns = 0
        self._rest = 0
        self._is_header = True

    def is_waiting(self) -> bool:
        """Returns whether the flow waits for segments that others overtook."""
        return bool(self._early)

    def take(self, arrived: Segment, at_ns: int) -> None:
        """Takes the next segment, or one ahead of its turn; skips bytes that were sent again.

        Raises Missing if too many segments overtook one, and ValueError for a message without a stamp.
        """
        known = (self._next - arrived.sequence) % _SEQUENCES
        if known >= _SEQUENCES // 2:
            kept = arrived._replace(data=bytes(arrived.data)), at_ns
            self._early.setdefault(arrived.sequence, kept)
            if len(self._early) > MOST_EARLY:
                raise Missing(f"a segment of {self.topic} was not captured")
            return
        data = arrived.data[known:]
        self._next = (self._next + len(data)) % _SEQUENCES
        while len(data):
            data = data[self._pass(data, at_ns) :]
        for begin in [at for at in self._early if (self._next - at) % _SEQUENCES < _SEQUENCES // 2]:
            if begin in self._early:  # another segment may have covered this one
                self.take(*self._early.pop(begin))

    def _pass(self, data: Buffer, at_ns: int) -> int:
        """Skips bytes of the present message; returns their number."""
        if self._rest:
            count = min(self._rest, len(data))
            self._rest -= count
            return count
        if not self._begin:
            self._begin_ns = at_ns
        part = bytes(data[: BEGIN.size - len(self._begin)])
        self._begin += part
        if len(self._begin) == BEGIN.size:
            size, _, seconds, nanoseconds = BEGIN.unpack(self._begin)
            self._begin, self._rest = b"", size + 4 - BEGIN.size
            if self._rest < 0:
                raise ValueError(
                    f"{self.topic}: a message of {size} bytes, expected one with a stamp"
                )
            if not self._is_header:
                self.times[seconds * 10**9 + nanoseconds] = self._begin_ns
            self._is_header = False
        return len(part)


class Capture:
    """Captures the messages to a node and to nodes whose names begin with its name."""

    def __init__(self, caller: str) -> None:
        """Opens the socket; raises OSError without the rights to capture packets, or before Linux 4.20."""
        self._caller = caller
        self._flows: List[Flow] = []
        # flows by their ends, from publisher to subscriber
        self._open: Dict[Tuple[bytes, bytes], Flow] = {}
        self._room = memoryview(bytearray(_MAX_PACKET))
        self._socket = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, 0)
        try:
            self._listen()
        except OSError:
            self.close()
            raise

    def _listen(self) -> None:
        code = ctypes.create_string_buffer(_ONLY_TCP)
        program = struct.pack("@HP", len(_ONLY_TCP) // 8, ctypes.addressof(code))
        self._socket.setsockopt(socket.SOL_SOCKET, SO_ATTACH_FILTER, program)
        self._socket.setsockopt(SOL_PACKET, PACKET_IGNORE_OUTGOING, 1)
        self._socket.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, BUFFER_BYTES)
        kernel_clock.use(self._socket)
        kernel_clock.wait()
        self._socket.bind((INTERFACE, ETH_P_ALL))

    def read(self) -> bool:
        """Takes arrived packets; returns whether any is left. Raises Missing if packets are."""
        for _ in range(READ_AT_ONCE):
            try:
                size, extras, _, _ = self._socket.recvmsg_into(
                    [self._room], 256, socket.MSG_DONTWAIT
                )
            except BlockingIOError:
                return False
            arrived, at_ns = segment(self._room[:size]), kernel_clock.arrival_ns(extras)
            if at_ns is None:
                raise Missing("a packet came without a time")
            if arrived is not None and len(arrived.data):
                self._take(arrived, at_ns)
        return True

    def _take(self, arrived: Segment, at_ns: int) -> None:
        flow = self._open.get((arrived.source, arrived.destination))
        if flow is not None:
            flow.take(arrived, at_ns)
            return
        topic = self._asked_for(arrived.data)
        back = arrived.destination, arrived.source
        if topic and not (back in self._open and self._open[back].handshake == arrived.sequence):
            self._open[back] = Flow(topic, arrived)
            self._flows.append(self._open[back])

    def _asked_for(self, data: Buffer) -> str:
        """Returns the topic if these bytes are the handshake of a wanted subscriber."""
        if len(data) > 4096 or b"callerid=" not in bytes(data):
            return ""
        try:
            header = decode_ros_handshake_header(bytes(data))
        except (ROSHandshakeException, ValueError, struct.error):
            return ""
        is_meant = header.get("callerid", "").startswith(self._caller)
        return header.get("topic", "") if is_meant else ""

    def times(self) -> Dict[str, Times]:
        """Returns arrival times by topic; with several connections, the first one's. Raises Missing if packets are."""
        deadline = time.monotonic() + LATE_S
        while (is_any_left := self.read()) or any(flow.is_waiting() for flow in self._flows):
            if time.monotonic() > deadline:
                raise Missing(f"packets were missing, or came without end, for {LATE_S} s")
            if not is_any_left:
                time.sleep(kernel_clock.LOOK_S)
        counts = self._socket.getsockopt(SOL_PACKET, PACKET_STATISTICS, 8)
        _, dropped = struct.unpack("=II", counts)
        if dropped:
            raise Missing(f"{dropped} packets were not captured")
        found = {}  # type: Dict[str, Times]
        for flow in self._flows:
            of_topic = found.setdefault(flow.topic, {})
            for stamp, at_ns in flow.times.items():
                of_topic[stamp] = min(at_ns, of_topic.get(stamp, at_ns))
        return found

    def close(self) -> None:
        """Stops the capture."""
        self._socket.close()


def watch(pipe: Any, caller: str) -> None:
    """Captures, as a process's body: reports that it listens, or its error; when told to end, arrivals by topic."""
    try:
        capture = Capture(caller)
    except OSError as error:
        pipe.send(str(error))
        return
    priority.go_next()
    pipe.send("listening")
    while not pipe.poll():
        time.sleep(kernel_clock.LOOK_S)
        capture.read()
    pipe.send(capture.times())
    capture.close()
