# SPDX-License-Identifier: MIT
"""Receives what target computers send: whole messages of allowed senders; counts all else."""
import select
import socket
from typing import Callable, Iterator, Tuple

from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.settings import Peers
from ardee_bridge.wire.pairing import Message, Pairer
from ardee_bridge.wire.udp import Inbox, Sender


class Requests:
    """Messages that arrive at a socket. `prefix` begins the names of what is counted, `stranger` is such a name."""

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
        self._pairer, self._inbox = Pairer(), Inbox(opened)

    def receive(self, timeout_s: float) -> Iterator[Tuple[Message, Sender, float]]:
        """Waits so long at most; yields each message, its sender and the time of its arrival on the clock [s]."""
        if not select.select([self._socket], [], [], timeout_s)[0]:
            return
        for datagram, sender, age_s in self._inbox.drain():
            if not self._allowed.include(sender):
                self._counters.drop(self._stranger, f"{sender[0]}:{sender[1]}")
                continue
            at_s = self._clock() - age_s
            message = self._pairer.feed(sender, datagram, at_s)
            if message is not None:
                yield message, sender, at_s
        for reason, count, detail in self._pairer.take_drops():
            self._counters.drop(self._prefix + reason, detail, count)
        if self._inbox.overflowed:
            self._counters.raise_to(f"{self._prefix}receive buffer full", self._inbox.overflowed)
