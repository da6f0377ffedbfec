# SPDX-License-Identifier: MIT
"""Arrival times of data by the kernel's clock, however late a process reads them."""
import socket
import struct
import time
from typing import Any, Optional, Sequence

SO_TIMESTAMPNS = 35  # Linux; Python's socket module does not name it
LOOK_S = 0.001  # period of looks at arrived data, for processes that keep arrival times


def use(opened: socket.socket) -> None:
    """Makes recvmsg() of this socket return the arrival time of its data."""
    opened.setsockopt(socket.SOL_SOCKET, SO_TIMESTAMPNS, 1)


def arrival_ns(extras: Sequence[Any]) -> Optional[int]:
    """Returns the arrival time in these ancillary data of recvmsg()."""
    for _, kind, value in extras:
        if kind == SO_TIMESTAMPNS:
            seconds, nanoseconds = struct.unpack("=qq", value)
            return seconds * 10**9 + nanoseconds
    return None


def wait() -> None:
    """Waits until Linux records arrival times, some moments after a first socket asked; until then it gives those of
    reading.
    """
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        use(opened)
        opened.bind(("127.0.0.1", 0))
        looked_ns, at_ns = 0, 0
        while at_ns >= looked_ns:
            opened.sendto(b"", opened.getsockname())
            time.sleep(LOOK_S)
            looked_ns = time.time_ns()
            _, extras, _, _ = opened.recvmsg(1, 256)
            at_ns = arrival_ns(extras) or 0
