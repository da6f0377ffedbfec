# SPDX-License-Identifier: MIT
"""Sockets of the bridge."""
import socket
from typing import Tuple

Sender = Tuple[str, int]

# Linux's numbers, which Python's socket module does not name.
SO_RXQ_OVFL = 40
SO_TIMESTAMPNS = 35
BUFFER_BYTES = 4 << 20
MAX_DATAGRAM = 65535


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
        opened.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)
        opened.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, multicast_ttl)
        interface = socket.inet_aton(address)
        opened.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, interface)
        opened.bind((address, port))
    except OSError as error:
        opened.close()
        raise OSError(error.errno, f"UDP {address}:{port}: {error.strerror}") from None
    return opened
