# SPDX-License-Identifier: MIT
"""Sockets of the bridge."""
import fcntl
import os
import socket
import struct
import threading
import time
from typing import Iterator, List, Tuple

from ardee_bridge import kernel_clock

Sender = Tuple[str, int]

# Linux's numbers, which Python's socket module does not name.
SO_RXQ_OVFL = 40
SO_RCVBUFFORCE = 33
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


class PairLock:
    """Held while the two datagrams of a message are sent, among threads and among the processes that share the file.

    The system takes it back from a process that dies with it. Taking the file lets another thread run each time, which
    a burst of messages feels: without another process there is no need for it. With a real-time priority, whoever holds
    the lock has it: a thread that other programs keep from its processor would keep everybody waiting.
    """

    def __init__(self, file: int, is_shared: bool, priority: int = 0) -> None:
        self.file, self.is_shared, self.priority = file, is_shared, priority
        self._threads = threading.Lock()

    @classmethod
    def make(cls) -> "PairLock":
        """On a file in memory of its own; set is_shared before another process gets it."""
        return cls(os.memfd_create("ardee_bridge_pairs"), is_shared=False)

    def __enter__(self) -> None:
        self._threads.acquire()
        self._hurry(os.SCHED_RR, self.priority)
        if self.is_shared:
            fcntl.lockf(self.file, fcntl.LOCK_EX)

    def __exit__(self, *_: object) -> None:
        if self.is_shared:
            fcntl.lockf(self.file, fcntl.LOCK_UN)
        self._hurry(os.SCHED_OTHER, 0)
        self._threads.release()

    def _hurry(self, policy: int, priority: int) -> None:
        if not self.priority:
            return
        try:
            os.sched_setscheduler(0, policy, os.sched_param(priority))
        except PermissionError:
            self.priority = 0


class Inbox:
    """Reads what has arrived at a socket; counts what the system dropped because its buffer was full."""

    def __init__(self, source: socket.socket) -> None:
        self._socket = source
        self.overflowed = 0
        kernel_clock.use(source)

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
            self._look_for_overflow(extras)
            yield data, sender, _age_s(extras)

    def _look_for_overflow(self, extras: List[Tuple[int, int, bytes]]) -> None:
        for level, kind, data in extras:
            if level == socket.SOL_SOCKET and kind == SO_RXQ_OVFL:
                self.overflowed = struct.unpack("=I", data[:4])[0]


def _age_s(extras: List[Tuple[int, int, bytes]]) -> float:
    at_ns = kernel_clock.arrival_ns(extras)
    return 0.0 if at_ns is None else max(0.0, (time.time_ns() - at_ns) * 1e-9)
