# SPDX-License-Identifier: MIT
"""For the benchmark where it may not capture packets: when each message of a topic began to arrive at a socket.

A bare TCPROS connection to the publisher, beside the subscriber that is measured, by the kernel's clock: what a
subscriber of roscpp or rospy does with a message before its callback counts as that subscriber's own time.
"""
import contextlib
import os
import select
import socket
import time
from typing import Any, List, Mapping, Optional

import rosgraph

from ardee_bridge import kernel_clock, priority, tcpros
from ardee_bridge.capture import BEGIN, Times

CALLER = "/latency_witness"
# As on Ethernet: after the beginning of a frame, which is all that the witness looks at, its publisher turns to the
# subscriber that is measured, and does not make it wait for a copy of the whole frame.
SEGMENT_BYTES = 1448


class Connection:
    """To the publisher of a topic. Of each message it looks at the beginning, and has the kernel drop the rest."""

    def __init__(self, topic: str, patience_s: float) -> None:
        self.times: Times = {}
        self._begin = b""
        self._rest = 0
        self._at_ns: Optional[int] = None
        uri = _publisher(topic, time.monotonic() + patience_s)
        self.socket = tcpros.connect(uri, topic, CALLER, "*", "*", SEGMENT_BYTES)
        kernel_clock.use(self.socket)

    def read(self) -> None:
        """Take what has arrived."""
        with contextlib.suppress(BlockingIOError):
            while True:
                self._drop_rest() if self._rest else self._read_begin()

    def _read_begin(self) -> None:
        data, extras, _, _ = self.socket.recvmsg(BEGIN.size - len(self._begin), 256)
        if not data:
            raise ConnectionError("the publisher has ended")
        if not self._begin:
            self._at_ns = kernel_clock.arrival_ns(extras)
        self._begin += data
        if len(self._begin) < BEGIN.size:
            return
        size, _, seconds, nanoseconds = BEGIN.unpack(self._begin)
        self._begin, self._rest = b"", size + 4 - BEGIN.size
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
    priority.hurry()
    connections = {topic: Connection(topic, patience_s) for topic in topics}
    by_socket = {each.socket: each for each in connections.values()}
    pipe.send("listening")
    while not pipe.poll():
        for readable in select.select(list(by_socket), [], [], 0.05)[0]:
            by_socket[readable].read()
    pipe.send({topic: each.times for topic, each in connections.items()})
