# SPDX-License-Identifier: MIT
"""Which data datagram belongs to which header, though datagrams may be lost, doubled or change places.

The rule: no data datagram has the size of a header, so one of 20 bytes is a header and any other is data. A receiver
keeps, for each sender, its latest header that is not used up. Data of the size that this header asks for, within
WINDOW_S of it, completes the message and uses the header up. Everything else is dropped and counted.
"""
from collections import Counter, OrderedDict
from typing import Hashable, NamedTuple, Optional, Tuple

from ardee_bridge import codec

WINDOW_S = 1.0
MAX_SENDERS = 64


class Message(NamedTuple):
    """A header and the bytes of its data datagram."""

    header: codec.Header
    data: bytes


class Pairer:
    """Makes messages of the datagrams of several senders, within bounded memory; `dropped` counts by reason."""

    def __init__(self) -> None:
        self.dropped: "Counter[str]" = Counter()
        self._waiting: "OrderedDict[Hashable, Tuple[codec.Header, int, float]]" = OrderedDict()

    def feed(self, sender: Hashable, datagram: bytes, now_s: float) -> Optional[Message]:
        """The message that this datagram completes, if it does; `now_s` on any clock that does not go back."""
        if len(datagram) == codec.Header.size:
            self._keep(sender, codec.Header.unpack(datagram), now_s)
            return None
        return self._complete(sender, datagram, now_s)

    def _keep(self, sender: Hashable, header: codec.Header, now_s: float) -> None:
        size = codec.data_size(header)
        if self._waiting.pop(sender, None) is not None:
            self.dropped["header without data"] += 1
        if size is None:
            self.dropped["unknown or invalid header"] += 1
            return
        self._waiting[sender] = (header, size, now_s)
        if len(self._waiting) > MAX_SENDERS:
            self._waiting.popitem(last=False)
            self.dropped["too many senders"] += 1

    def _complete(self, sender: Hashable, datagram: bytes, now_s: float) -> Optional[Message]:
        if sender not in self._waiting:
            self.dropped["data without header"] += 1
            return None
        header, size, since_s = self._waiting[sender]
        if len(datagram) != size:
            self.dropped["data of the wrong size"] += 1
            return None
        del self._waiting[sender]
        if now_s - since_s > WINDOW_S:
            self.dropped["data too late"] += 1
            return None
        return Message(header, datagram)
