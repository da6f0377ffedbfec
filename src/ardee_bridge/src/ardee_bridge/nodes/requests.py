# SPDX-License-Identifier: MIT
"""Receives messages of target computers: whole ones of allowed senders; counts all others."""
import select
import socket
import struct
import time
from typing import Callable, Iterator, Tuple

from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.settings import Peers
from ardee_bridge.wire.pairing import Message, Pairer
from ardee_bridge.wire.udp import MAX_DATAGRAM, SO_RXQ_OVFL, SO_TIMESTAMPNS, Sender

MOST_AT_ONCE = 256
_EXTRAS_BYTES = socket.CMSG_SPACE(4) + socket.CMSG_SPACE(16)  # overflow, time of arrival


class Requests:
    """Messages arriving at a socket. `prefix` begins the names of counters; `stranger` is that of unknown senders."""

    def __init__(
        self,
        opened: socket.socket,
        allowed: Peers,
        counters: Counters,
        clock: Callable[[], float],
        stranger: str,
        prefix: str = "",
    ) -> None:
        self._socket, self._allowed, self._counters, self._clock = opened, allowed, counters, clock
        self._stranger, self._prefix = prefix + stranger, prefix
        self._pairer, self._overflowed = Pairer(), 0

    def receive(self, timeout_s: float) -> Iterator[Tuple[Message, Sender, float]]:
        """Waits at most this long; yields each message, its sender and the time of its arrival on the clock [s]."""
        if not select.select([self._socket], [], [], timeout_s)[0]:
            return
        for datagram, sender, age_s in self._datagrams():
            if not self._allowed.include(sender):
                self._counters.drop(self._stranger, f"{sender[0]}:{sender[1]}")
                continue
            at_s = self._clock() - age_s
            message = self._pairer.feed(sender, datagram, at_s)
            if message is not None:
                yield message, sender, at_s
        for reason, count, detail in self._pairer.take_drops():
            self._counters.drop(self._prefix + reason, detail, count)

    def _datagrams(self) -> Iterator[Tuple[bytes, Sender, float]]:
        """Yields the datagrams that have arrived: data, sender, and their age [s]."""
        for _ in range(MOST_AT_ONCE):
            try:
                read = self._socket.recvmsg(MAX_DATAGRAM, _EXTRAS_BYTES, socket.MSG_DONTWAIT)
            except (BlockingIOError, InterruptedError):
                return
            except ConnectionError:  # an answer went to a closed port
                continue
            data, extras, _, sender = read
            age_s = 0.0
            for _, kind, value in extras:
                if kind == SO_RXQ_OVFL:
                    self._count_overflow(struct.unpack("=I", value[:4])[0])
                elif kind == SO_TIMESTAMPNS:
                    seconds, nanoseconds = struct.unpack("=qq", value)
                    age_s = max(0.0, time.time() - seconds - nanoseconds * 1e-9)
            yield data, sender, age_s

    def _count_overflow(self, total: int) -> None:
        """Counts datagrams that the system dropped because the socket's buffer was full."""
        if total > self._overflowed:
            fresh, self._overflowed = total - self._overflowed, total
            self._counters.drop(f"{self._prefix}receive buffer full", count=fresh)
