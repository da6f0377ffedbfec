# SPDX-License-Identifier: MIT
"""For the benchmark: when each message of a topic arrived at a subscriber's socket, by the kernel's clock.

A bare TCPROS connection to the publisher, beside the subscriber that is measured: what a subscriber of roscpp or rospy
does with a message before its callback counts as that subscriber's own time.
"""
import select
import socket
import struct
import time
import xmlrpc.client
from typing import Any, Dict, List, Optional, Sequence

import rosgraph

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
        self._buffer = bytearray()
        address = _publisher(topic, time.monotonic() + patience_s)
        self.socket = socket.create_connection(address, patience_s)
        self.socket.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        header = dict(topic=topic, md5sum="*", type="*", callerid=CALLER, tcp_nodelay="1")
        rosgraph.network.write_ros_handshake_header(self.socket, header)
        self._expect_header = True

    def read(self) -> None:
        """Take what has arrived."""
        data, extras, _, _ = self.socket.recvmsg(1 << 16, 256)
        if not data:
            raise ConnectionError("the publisher has ended")
        at_ns = timestamp_ns(extras)
        self._buffer += data
        while len(self._buffer) >= 4:
            size = 4 + int.from_bytes(self._buffer[:4], "little")
            if len(self._buffer) < size:
                return
            message = bytes(self._buffer[4:size])
            del self._buffer[:size]
            if self._expect_header:
                self._expect_header = False
            elif at_ns is not None:
                seconds, nanoseconds = struct.unpack_from("<II", message, STAMP_AT)
                self.times[seconds * 10**9 + nanoseconds] = at_ns


def _publisher(topic: str, deadline_s: float) -> Any:
    """Address of the first publisher that the master knows."""
    master = rosgraph.Master(CALLER)
    while True:
        publishers = [nodes for name, nodes in master.getSystemState()[0] if name == topic]
        if publishers:
            slave = xmlrpc.client.ServerProxy(master.lookupNode(publishers[0][0]))
            code, status, answer = slave.requestTopic(CALLER, topic, [["TCPROS"]])
            if code != 1:
                raise ConnectionError(f"{topic}: {status}")
            return answer[1], answer[2]
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
