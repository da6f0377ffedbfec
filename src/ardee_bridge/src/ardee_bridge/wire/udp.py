# SPDX-License-Identifier: MIT
"""Sockets of the bridge."""
import socket
import struct
import time
from typing import Iterator, Tuple

Sender = Tuple[str, int]

# Linux's numbers, which Python's socket module does not name.
SO_RXQ_OVFL = 40
SO_TIMESTAMPNS = 35
BUFFER_BYTES = 4 << 20
MAX_DATAGRAM = 65535
_EXTRAS_BYTES = socket.CMSG_SPACE(4) + socket.CMSG_SPACE(16)  # overflow, time of arrival


def open_socket(
    address: str, port: int, multicast_ttl: int = 1, receive_bytes: int = BUFFER_BYTES
) -> socket.socket:
    """A bound UDP socket that may broadcast, with buffers as large as the system lets them be, or as is asked."""
    opened = socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    try:
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_BROADCAST, 1)
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_bytes)
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, BUFFER_BYTES)
        opened.setsockopt(socket.SOL_SOCKET, SO_RXQ_OVFL, 1)
        opened.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, multicast_ttl)
        interface = socket.inet_aton(address)
        opened.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, interface)
        opened.bind((address, port))
    except OSError as error:
        opened.close()
        raise OSError(error.errno, f"UDP {address}:{port}: {error.strerror}") from None
    return opened


class Inbox:
    """Reads what has arrived at a socket; counts what the system dropped because its buffer was full."""

    def __init__(self, source: socket.socket) -> None:
        self._socket = source
        self.overflowed = 0
        source.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)

    def drain(self, most: int = 256) -> Iterator[Tuple[bytes, Sender, float]]:
        """Up to so many datagrams that are there already: data, sender, and for how long they have been there [s]."""
        for _ in range(most):
            try:
                data, extras, _, sender = self._socket.recvmsg(
                    MAX_DATAGRAM, _EXTRAS_BYTES, socket.MSG_DONTWAIT
                )
            except (BlockingIOError, InterruptedError):
                return
            except ConnectionError:  # a port that an answer went to is closed
                continue
            age_s = 0.0
            for _, kind, value in extras:
                if kind == SO_RXQ_OVFL:
                    self.overflowed = struct.unpack("=I", value[:4])[0]
                elif kind == SO_TIMESTAMPNS:
                    seconds, nanoseconds = struct.unpack("=qq", value)
                    age_s = max(0.0, time.time() - seconds - nanoseconds * 1e-9)
            yield data, sender, age_s
