# SPDX-License-Identifier: MIT
"""For the benchmark: when each message of a topic began to arrive at a subscriber's socket, by the kernel's clock.

A bare TCPROS connection to the publisher, beside the subscriber that is measured: what a subscriber of roscpp or rospy
does with a message before its callback counts as that subscriber's own time.
"""
import contextlib
import os
import select
import socket
import struct
import time
from typing import Any, Dict, List, Mapping, Optional, Sequence

import rosgraph

from ardee_bridge import tcpros

SO_TIMESTAMPNS = 35  # Linux; Python's socket module does not name it
CALLER = "/latency_witness"
# As on Ethernet: after the beginning of a frame, which is all that the witness looks at, its publisher turns to the
# subscriber that is measured, and does not make it wait for a copy of the whole frame.
SEGMENT_BYTES = 1448
# Length of a message that begins with a std_msgs/Header: its seq, seconds and nanoseconds.
_BEGIN = struct.Struct("<IIII")


def timestamp_ns(extras: Sequence[Any]) -> Optional[int]:
    """The kernel's, of what recvmsg() returned."""
    for _, kind, value in extras:
        if kind == SO_TIMESTAMPNS:
            seconds, nanoseconds = struct.unpack("=qq", value)
            return seconds * 10**9 + nanoseconds
    return None


def go_first(priority: int = 1) -> None:
    """Run before programs without real-time priority, where that is granted."""
    with contextlib.suppress(PermissionError):
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(priority))


def go_next() -> bool:
    """Run after those with real-time priority and before all others; False where that is not granted."""
    try:
        os.setpriority(os.PRIO_PROCESS, 0, -20)
    except PermissionError:
        return False
    return True


class Connection:
    """To the publisher of a topic. Of each message it looks at the beginning, and has the kernel drop the rest."""

    def __init__(self, topic: str, patience_s: float) -> None:
        # stamp of the message [ns]: arrival of its first bytes [ns]
        self.times: Dict[int, int] = {}
        self._begin = b""
        self._rest = 0
        self._at_ns: Optional[int] = None
        uri = _publisher(topic, time.monotonic() + patience_s)
        self.socket = tcpros.connect(uri, topic, CALLER, "*", "*", SEGMENT_BYTES)
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)

    def read(self) -> None:
        """Take what has arrived."""
        with contextlib.suppress(BlockingIOError):
            while True:
                self._drop_rest() if self._rest else self._read_begin()

    def _read_begin(self) -> None:
        data, extras, _, _ = self.socket.recvmsg(_BEGIN.size - len(self._begin), 256)
        if not data:
            raise ConnectionError("the publisher has ended")
        if not self._begin:
            self._at_ns = timestamp_ns(extras)
        self._begin += data
        if len(self._begin) < _BEGIN.size:
            return
        size, _, seconds, nanoseconds = _BEGIN.unpack(self._begin)
        self._begin, self._rest = b"", size + 4 - _BEGIN.size
        if self._at_ns is not None:
            self.times[seconds * 10**9 + nanoseconds] = self._at_ns

    def _drop_rest(self) -> None:
        dropped = len(self.socket.recv(self._rest, socket.MSG_TRUNC))
        if not dropped:
            raise ConnectionError("the publisher has ended")
        self._rest -= dropped


def publisher(topic: str, env: Mapping[str, str]) -> str:
    """Name of the first publisher that the environment's master knows, or nothing."""
    master = rosgraph.Master(CALLER, env["ROS_MASTER_URI"])
    for name, nodes in master.getSystemState()[0]:
        if name == topic:
            return nodes[0]
    return ""


def _publisher(topic: str, deadline_s: float) -> str:
    """URI of the first publisher that the master knows."""
    while True:
        name = publisher(topic, os.environ)
        if name:
            return rosgraph.Master(CALLER).lookupNode(name)
        if time.monotonic() > deadline_s:
            raise TimeoutError(f"nobody publishes {topic}")
        time.sleep(0.1)


def watch(pipe: Any, topics: List[str], patience_s: float) -> None:
    """Body of a process: says when it listens; told to end, says what arrived when, by topic."""
    go_first()
    connections = {topic: Connection(topic, patience_s) for topic in topics}
    by_socket = {each.socket: each for each in connections.values()}
    pipe.send("listening")
    while not pipe.poll():
        for readable in select.select(list(by_socket), [], [], 0.05)[0]:
            by_socket[readable].read()
    pipe.send({topic: each.times for topic, each in connections.items()})
