# SPDX-License-Identifier: MIT
"""Connections to the publishers of ROS topics, as a node makes them (wiki.ros.org/ROS/TCPROS); without rospy."""
import http.client
import socket
import struct
import xmlrpc.client
from typing import Any, Callable, Dict, Tuple
from xml.parsers.expat import ExpatError

from rosgraph.network import (
    ROSHandshakeException,
    decode_ros_handshake_header,
    encode_ros_handshake_header,
)

# How long a publisher may take to answer.
PATIENCE_S = 10.0
MAX_HEADER_BYTES = 1 << 20
MAX_MESSAGE_BYTES = 64 << 20
READ_BYTES = 1 << 16
# A program on this computer writes a message in parts of 64 KB and more, of which the last read gets what is there; a
# network brings some packets of 1.5 KB at a time, with pauses.
LARGE_PART_BYTES = 1 << 14
# As rospy has them: a publisher that vanishes without a word is noticed after two and a half minutes.
KEEPALIVE = {socket.TCP_KEEPIDLE: 60, socket.TCP_KEEPINTVL: 10, socket.TCP_KEEPCNT: 9}
_LENGTH = struct.Struct("<I")
# What goes wrong when the other side has ended, or has not started yet.
AWAY = (OSError, xmlrpc.client.Error, ExpatError, http.client.HTTPException, ROSHandshakeException)


class Refused(Exception):
    """The publisher and we do not agree on what is published: what it says, or what was found and expected."""


class _PatientTransport(xmlrpc.client.Transport):
    """XML-RPC that does not wait for ever."""

    def make_connection(self, host: Any) -> Any:
        connection = super().make_connection(host)
        connection.timeout = PATIENCE_S
        return connection


def connect(
    uri: str, topic: str, caller_id: str, kind: str, md5sum: str, segment_bytes: int = 0
) -> socket.socket:
    """A connection to the node at `uri` that does not block, on which messages come at once; "*" is any type or md5sum.

    `segment_bytes` limits TCP's segments, and with them how much the publisher sends before it turns to others; 0: as
    much as the network carries. Raises Refused, or one of AWAY.
    """
    place = _place(uri, topic, caller_id)
    opened = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        if segment_bytes:
            opened.setsockopt(socket.IPPROTO_TCP, socket.TCP_MAXSEG, segment_bytes)
        opened.settimeout(PATIENCE_S)
        opened.connect(place)
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        for option, value in KEEPALIVE.items():
            opened.setsockopt(socket.IPPROTO_TCP, option, value)
        wanted = dict(topic=topic, type=kind, md5sum=md5sum, callerid=caller_id, tcp_nodelay="1")
        opened.sendall(encode_ros_handshake_header(wanted))
        _check(_read_header(opened), md5sum)
        opened.setblocking(False)
    except BaseException:
        opened.close()
        raise
    return opened


def _place(uri: str, topic: str, caller_id: str) -> Tuple[str, int]:
    """Where the node says that it publishes the topic."""
    with xmlrpc.client.ServerProxy(uri, _PatientTransport()) as publisher:
        answer = publisher.requestTopic(caller_id, topic, [["TCPROS"]])
    try:
        code, status, place = answer
        if code != 1:
            raise ConnectionError(f"{uri}: {status}")
        _, host, port = place
        if isinstance(host, str) and 0 < port < 65536:
            return host, port
    except (TypeError, ValueError):
        pass
    raise Refused(f"found {answer!r} as its place, expected protocol, host and port")


def _read_header(opened: socket.socket) -> Dict[str, str]:
    length = _exactly(opened, _LENGTH.size)
    (size,) = _LENGTH.unpack(length)
    if size > MAX_HEADER_BYTES:
        raise Refused(f"a connection header of {size} bytes, expected at most {MAX_HEADER_BYTES}")
    try:
        return decode_ros_handshake_header(length + _exactly(opened, size))
    except (ValueError, struct.error) as error:
        raise Refused(f"a connection header that cannot be read: {error}") from None


def _exactly(opened: socket.socket, count: int) -> bytes:
    read = b""
    while len(read) < count:
        part = opened.recv(count - len(read))
        if not part:
            raise ConnectionError("the publisher has ended")
        read += part
    return read


def _check(header: Dict[str, str], md5sum: str) -> None:
    if "error" in header:
        raise Refused(header["error"])
    found = header.get("md5sum", "")
    if md5sum != "*" and found not in (md5sum, "*"):
        raise Refused(
            f"messages of type {header.get('type')}, md5sum {found}; expected md5sum {md5sum}"
        )


class Splitter:
    """Makes messages of a connection's bytes, in a buffer that grows as they come to the longest of them."""

    def __init__(self, take: Callable[[memoryview], None]) -> None:
        """`take` gets the bytes of each message, which are overwritten once it has returned."""
        self._take = take
        # is more to be expected at once?
        self.is_arriving = False
        self._room = memoryview(bytearray(READ_BYTES))
        self._filled = 0

    def read(self, receive_into: Callable[[memoryview], int]) -> bool:
        """Receive, and hand on every message that is then complete; False at the end of the connection."""
        self.is_arriving = False
        count = receive_into(self._room[self._filled :])
        self._filled += count
        at = 0
        while self._filled - at >= _LENGTH.size:
            (size,) = _LENGTH.unpack_from(self._room, at)
            if size > MAX_MESSAGE_BYTES:
                raise Refused(f"a message of {size} bytes, expected at most {MAX_MESSAGE_BYTES}")
            end = at + _LENGTH.size + size
            if end > self._filled:
                self._make_room(at, end - at)
                self.is_arriving = count >= LARGE_PART_BYTES
                return count > 0
            self._take(self._room[at + _LENGTH.size : end])
            at = end
        self._make_room(at, READ_BYTES)
        return count > 0

    def _make_room(self, at: int, wanted: int) -> None:
        """Move what begins at `at` to the front. A full buffer is made twice as large, not as what is claimed."""
        rest = self._room[at : self._filled]
        if len(rest) == len(self._room):
            self._room = memoryview(bytearray(min(wanted, 2 * len(rest))))
        elif at == 0:
            return
        self._room[: len(rest)] = rest
        self._filled = len(rest)
