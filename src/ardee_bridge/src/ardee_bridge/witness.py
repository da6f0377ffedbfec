# SPDX-License-Identifier: MIT
"""For the benchmark: when each message of a topic arrived at a subscriber's socket, by the kernel's clock.

A bare TCPROS connection to the publisher, beside the subscriber that is measured: what a subscriber of roscpp or rospy
does with a message before its callback counts as that subscriber's own time.
"""
import select
import socket
import struct
import time
from typing import Any, Dict, List, Optional, Sequence

import rosgraph

from ardee_bridge import tcpros

SO_TIMESTAMPNS = 35  # Linux; Python's socket module does not name it
CALLER = "/latency_witness"
STAMP_AT = 4  # of a message that begins with a std_msgs/Header: after seq


def timestamp_ns(extras: Sequence[Any]) -> Optional[int]:
    """The kernel's, of what recvmsg() returned."""
    for _, kind, value in extras:
        if kind == SO_TIMESTAMPNS:
            seconds, nanoseconds = struct.unpack("=qq", value)
            return seconds * 10**9 + nanoseconds
    return None


class Connection:
    """To the publisher of a topic."""

    def __init__(self, topic: str, patience_s: float) -> None:
        self.times: Dict[int, int] = {}  # stamp of the message [ns]: arrival [ns]
        self._splitter = tcpros.Splitter(self._keep)
        self._at_ns: Optional[int] = None
        uri = _publisher(topic, time.monotonic() + patience_s)
        self.socket = tcpros.connect(uri, topic, CALLER, "*", "*")
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)

    def read(self) -> None:
        """Take what has arrived."""
        if not self._splitter.read(self._receive_into):
            raise ConnectionError("the publisher has ended")

    def _receive_into(self, room: memoryview) -> int:
        count, extras, _, _ = self.socket.recvmsg_into([room], 256)
        self._at_ns = timestamp_ns(extras)
        return count

    def _keep(self, message: memoryview) -> None:
        if self._at_ns is not None:
            seconds, nanoseconds = struct.unpack_from("<II", message, STAMP_AT)
            self.times[seconds * 10**9 + nanoseconds] = self._at_ns


def _publisher(topic: str, deadline_s: float) -> str:
    """URI of the first publisher that the master knows."""
    master = rosgraph.Master(CALLER)
    while True:
        publishers = [nodes for name, nodes in master.getSystemState()[0] if name == topic]
        if publishers:
            return master.lookupNode(publishers[0][0])
        if time.monotonic() > deadline_s:
            raise TimeoutError(f"nobody publishes {topic}")
        time.sleep(0.1)


def watch(pipe: Any, topics: List[str], patience_s: float) -> None:
    """Body of a process: says when it listens; told to end, says what arrived when, by topic."""
    connections = {topic: Connection(topic, patience_s) for topic in topics}
    by_socket = {each.socket: each for each in connections.values()}
    pipe.send("listening")
    while not pipe.poll():
        for readable in select.select(list(by_socket), [], [], 0.05)[0]:
            by_socket[readable].read()
    pipe.send({topic: each.times for topic, each in connections.items()})
