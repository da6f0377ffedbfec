# SPDX-License-Identifier: MIT
"""Pairs each data datagram with its header, even if datagrams are lost, doubled or reordered.

The rule: no data datagram has the size of a header, so one of 20 bytes is a header and any other is data. A receiver
keeps, for each sender, its latest unused header. Data of the size that this header gives, within WINDOW_S of it,
completes the message and uses the header. Everything else is dropped and counted.
"""
from collections import Counter, OrderedDict
from typing import Any, Dict, Hashable, Iterator, NamedTuple, Optional, Tuple

from ardee_bridge.wire import codec

WINDOW_S = 1.0
MAX_SENDERS = 64


class Message(NamedTuple):
    """A header and the bytes of its data datagram."""

    header: codec.Header
    data: bytes


class Pairer:
    """Makes messages from the datagrams of several senders, within bounded memory; `dropped` counts by reason."""

    def __init__(self) -> None:
        self.dropped: "Counter[str]" = Counter()
        self._latest: Dict[str, Tuple[Hashable, Any, Any]] = {}
        self._waiting: "OrderedDict[Hashable, Tuple[codec.Header, int, float]]" = OrderedDict()

    def take_drops(self) -> Iterator[Tuple[str, int, str]]:
        """Yields and clears the drops since the last call: reason, count, and sender and content of the latest."""
        for reason, count in self.dropped.items():
            sender, found, expected = self._latest[reason]
            who = ":".join(map(str, sender)) if isinstance(sender, tuple) else sender
            yield reason, count, f"{who}: found {found}, expected {expected}"
        self.dropped.clear()

    def _drop(self, reason: str, sender: Hashable, found: Any, expected: Any) -> None:
        self.dropped[reason] += 1
        self._latest[reason] = (sender, found, expected)

    def feed(self, sender: Hashable, datagram: bytes, now_s: float) -> Optional[Message]:
        """Returns the message that this datagram completes, or None; `now_s` on any clock that does not go back."""
        if len(datagram) == codec.Header.size:
            self._keep(sender, codec.Header.unpack(datagram), now_s)
            return None
        return self._complete(sender, datagram, now_s)

    def _keep(self, sender: Hashable, header: codec.Header, now_s: float) -> None:
        size = codec.data_size(header)
        unused = self._waiting.pop(sender, None)
        if unused is not None:
            expected = f"{unused[1]} bytes of data"
            self._drop("header without data", sender, "another header", expected)
        if size is None:
            self._drop("unknown or invalid header", sender, header, "one of docs/wire_format.md")
            return
        self._waiting[sender] = (header, size, now_s)
        if len(self._waiting) > MAX_SENDERS:
            eldest, _ = self._waiting.popitem(last=False)
            self._drop("too many senders", eldest, "another sender's header", "its data")

    def _complete(self, sender: Hashable, datagram: bytes, now_s: float) -> Optional[Message]:
        if sender not in self._waiting:
            expected = f"a header of {codec.Header.size} bytes first"
            self._drop("data without header", sender, f"{len(datagram)} bytes", expected)
            return None
        header, size, since_s = self._waiting[sender]
        if len(datagram) != size:
            expected = f"{size} after a header of type {header.msg_type}"
            self._drop("data of the wrong size", sender, f"{len(datagram)} bytes", expected)
            return None
        del self._waiting[sender]
        if now_s - since_s > WINDOW_S:
            found = f"{now_s - since_s:.1f} s after its header"
            self._drop("data too late", sender, found, f"{WINDOW_S:g} s at most")
            return None
        return Message(header, datagram)
