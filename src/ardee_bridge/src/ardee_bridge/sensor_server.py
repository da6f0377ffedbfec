# SPDX-License-Identifier: MIT
"""Sends sensor messages to whom they are for, and answers SET_PORT messages; without rospy."""
import itertools
import select
import socket
import time
from typing import Any, Callable, Dict, Iterable, Iterator, List, NamedTuple, Optional, Set, Tuple

from ardee_bridge import chunks, codec, convert
from ardee_bridge.counters import Counters
from ardee_bridge.handover import Handover
from ardee_bridge.pairing import Message, Pairer
from ardee_bridge.settings import COMPRESSED, ServerSettings, Source
from ardee_bridge.udp import Inbox, PairLock, Sender

_ALL_BIT = 1 << codec.DataType.ALL
_TIME_BIT = 1 << codec.DataType.TIME
# Sent while the lock is held once: taking it for each chunk of an image took a tenth of the time. Another sensor's
# message waits for so many at most, 0.5 ms.
_MESSAGES_TOGETHER = 20
# Headers and data by turns, each in the pieces that it is sent from.
Datagrams = Tuple[Tuple[codec.Buffer, ...], ...]


class Target(NamedTuple):
    """Who gets messages: address, data types wanted, one component or all, end of the lease (None: configured)."""

    address: Sender
    data_types: int
    component_id: int
    until_s: Optional[float]

    def wants(self, data_type: int, component_id: int) -> bool:
        """Does it get this sensor's messages?"""
        return bool(self.data_types & (_ALL_BIT | 1 << data_type)) and self.component_id in (
            codec.ALL_COMPONENTS,
            component_id,
        )


class RateLimit:
    """Lets through at most so many messages a second of simulated time, exact in the mean; 0: all.

    Messages whose time stamp is left at 0 are all let through: nothing tells how many they are in a second.
    """

    def __init__(self, max_rate_hz: float) -> None:
        self._period_s = 1.0 / max_rate_hz if max_rate_hz else 0.0
        self._due_s = self._last_s = float("-inf")

    def admits(self, stamp_s: float) -> bool:
        """Is the message of this time let through?"""
        if not self._period_s or stamp_s == self._last_s == 0.0:
            return True
        if stamp_s < self._last_s:  # the simulation was reset
            self._due_s = float("-inf")
        self._last_s = stamp_s
        if stamp_s < self._due_s - 1e-6:
            return False
        is_late = stamp_s > self._due_s + self._period_s
        self._due_s = (stamp_s if is_late else self._due_s) + self._period_s
        return True


class SensorServer:
    """Targets, and the socket to them. `publish` may be called from any thread."""

    def __init__(
        self,
        settings: ServerSettings,
        opened: socket.socket,
        counters: Counters,
        on_targets: Callable[[], None] = lambda: None,
        clock: Callable[[], float] = time.monotonic,
        lock: Optional[PairLock] = None,
    ) -> None:
        self._settings, self._socket, self._counters = settings, opened, counters
        self._on_targets, self._clock = on_targets, clock
        self._lock = lock or PairLock.make()
        self._handover = Handover(self._lock.file)
        self._pairer = Pairer()
        self._inbox = Inbox(opened)
        self._limits = {source.name: RateLimit(source.max_rate_hz) for source in settings.sources}
        self._sequences: Dict[str, int] = {}
        self._targets: Dict[Sender, Target] = {}
        # name of a source: who wants it; of the present targets
        self._wanting: Dict[str, Tuple[Target, ...]] = {}
        for peer in settings.destinations:
            address = (peer.address, peer.port)
            self._targets[address] = Target(address, peer.data_types, codec.ALL_COMPONENTS, None)

    # -- sensors

    def wanted(self) -> Set[str]:
        """Names of the sources that somebody wants."""
        return {source.name for source in self._settings.sources if self._targets_of(source)}

    def publish(self, source: Source, message: Any, velocity: Any = None) -> None:
        """Send a ROS message to all that want it."""
        targets = self._targets_of(source)
        if not targets:
            return
        try:
            if not self._limits[source.name].admits(convert.stamp_s(message)):
                return
            messages = self._messages(source, message, velocity)
            if messages is not None:
                self._send_all(source, message, targets, messages)
        except ValueError as error:
            what = "sensor messages that the wire cannot carry"
            self._counters.drop(what, f"{source.topic}: {error}")

    def _messages(
        self, source: Source, message: Any, velocity: Any
    ) -> Optional[Iterable[codec.Pieces]]:
        """None for one that is not to be sent."""
        if source.is_frame:
            return self._frame_messages(source, message)
        is_gps = source.kind == "gps"
        reading = (
            convert.gps(message, velocity) if is_gps else convert.SINGLES[source.kind](message)
        )
        pair = codec.encode(source.data_type, source.component_id, reading.data, reading.count)
        return [_pieces(pair)]

    def _is_first(self, source: Source, message: Any) -> bool:
        """Has no other process sent this image in the camera's other form?"""
        is_compressed = source.image_format == COMPRESSED
        with self._lock:
            return self._handover.is_first(source.component_id, message.header.stamp, is_compressed)

    def _frame_messages(self, source: Source, message: Any) -> Optional[Iterable[codec.Pieces]]:
        if source.image_format == COMPRESSED:
            frame = convert.compressed_image(message)
        elif source.kind == "image":
            frame = convert.image(message, source.image_format, source.jpeg_quality)
        else:
            frame = convert.point_cloud(message)
        if source.image_format in (COMPRESSED, "jpeg") and not self._is_first(source, message):
            return None
        sequence = self._sequences.get(source.name, 0)
        self._sequences[source.name] = (sequence + 1) & 0x7FFFFFFF
        frame.head.chunk.sequence = sequence
        return chunks.split(
            source.data_type, source.component_id, frame.head, frame.payload, source.chunk_bytes
        )

    def _targets_of(self, source: Source) -> Tuple[Target, ...]:
        wanting = self._wanting  # another takes its place when the targets change
        if source.name not in wanting:
            wanting[source.name] = tuple(
                target
                for target in list(self._targets.values())
                if target.wants(source.data_type, source.component_id)
            )
        return wanting[source.name]

    def _send_all(
        self,
        source: Source,
        message: Any,
        targets: Tuple[Target, ...],
        messages: Iterable[codec.Pieces],
    ) -> None:
        stamp = _pieces(_stamp(source, message)) if _want_time(targets) else ()
        for number, datagrams in enumerate(_together(messages)):
            for target in targets:
                has_stamp = number == 0 and target.data_types & _TIME_BIT
                self._send(target.address, stamp + datagrams if has_stamp else datagrams)
        self._counters.did(f"sent {source.name}")

    def _send(self, address: Sender, datagrams: Datagrams) -> None:
        """Headers and data back to back, whatever other threads send; nothing after one that the system refuses."""
        index = 0
        try:
            with self._lock:
                for index, datagram in enumerate(datagrams):
                    self._socket.sendmsg(datagram, (), socket.MSG_DONTWAIT, address)
        except OSError as error:
            is_full = isinstance(error, BlockingIOError)
            kind = (
                "messages to a full send buffer" if is_full else "messages that could not be sent"
            )
            where = f"{address[0]}:{address[1]}: {error.strerror}"
            self._counters.drop(kind, where, count=(len(datagrams) - index + 1) // 2)

    # -- clients

    def receive(self, timeout_s: float) -> None:
        """Wait so long for requests, and answer them; forget clients whose lease has ended."""
        readable, _, _ = select.select([self._socket], [], [], timeout_s)
        if readable:
            for datagram, sender, _ in self._inbox.drain():
                self._take(datagram, sender)
            self._count_drops()
        self._forget()

    def _count_drops(self) -> None:
        for reason, count, detail in self._pairer.take_drops():
            self._counters.drop(f"requests: {reason}", detail, count)
        if self._inbox.overflowed:
            self._counters.raise_to("requests: receive buffer full", self._inbox.overflowed)

    def _take(self, datagram: bytes, sender: Sender) -> None:
        if not self._settings.allowed_clients.include(sender):
            self._counters.drop("requests: sender not allowed", f"{sender[0]}:{sender[1]}")
            return
        message = self._pairer.feed(sender, datagram, self._clock())
        if message is None:
            return
        if message.header.msg_type != codec.MessageType.SET_PORT:
            self._counters.drop("requests: not SET_PORT", f"type {message.header.msg_type}")
            return
        self._set_port(message, sender)

    def _set_port(self, message: Message, sender: Sender) -> None:
        request = codec.SetPort.unpack(message.data)
        if not 0 <= request.port <= 65535 or request.component_id < codec.ALL_COMPONENTS:
            what = f"port {request.port}, component {request.component_id}"
            self._counters.drop("requests: malformed SET_PORT", what)
            return
        address = (sender[0], request.port or sender[1])
        if not self._register(address, request):
            return
        self._wanting = {}
        unsent = self._unsent(self._targets.get(address))
        if unsent:
            what = "requests: sensors that no source sends"
            self._counters.drop(what, f"{address[0]}:{address[1]}: {', '.join(unsent)}")
        self._counters.did("SET_PORT obeyed")
        self._send(sender, _pieces(codec.encode_ack(message.header)))
        self._on_targets()

    def _register(self, address: Sender, request: codec.SetPort) -> bool:
        known = self._targets.get(address)
        is_configured = known is not None and known.until_s is None
        if request.data_types == 0 and not is_configured:
            self._targets.pop(address, None)
            return True
        clients = sum(target.until_s is not None for target in self._targets.values())
        if known is None and clients >= self._settings.max_clients:
            self._counters.drop("requests: too many clients", f"{address[0]}:{address[1]}")
            return False
        until_s = None if is_configured else self._clock() + self._settings.client_lease_s
        self._targets[address] = Target(address, request.data_types, request.component_id, until_s)
        return True

    def _unsent(self, target: Optional[Target]) -> List[str]:
        """Names of the data types that it wants and will not get, for lack of a source."""
        if target is None:
            return []
        sources = self._settings.sources
        sent = {
            each.data_type for each in sources if target.wants(each.data_type, each.component_id)
        }
        if sent:
            sent.add(codec.DataType.ALL)
        wanted = {each for each in codec.DataType if target.data_types & 1 << each}
        missing = wanted - sent - {codec.DataType.NONE, codec.DataType.TIME}
        return [each.name.lower() for each in sorted(missing)]

    def _forget(self) -> None:
        now = self._clock()
        ended = [
            address
            for address, target in self._targets.items()
            if target.until_s is not None and target.until_s < now
        ]
        for address in ended:
            del self._targets[address]
            self._counters.did("clients forgotten")
        if ended:
            self._wanting = {}
            self._on_targets()

    def clients(self) -> Tuple[Target, ...]:
        """Everybody who gets messages."""
        return tuple(self._targets.values())

    def set_clients(self, targets: Iterable[Target]) -> None:
        """Send to these from now on; for a server whose clients another process keeps."""
        self._targets = {target.address: target for target in targets}
        self._wanting = {}


def _together(messages: Iterable[codec.Pieces]) -> Iterator[Datagrams]:
    """The datagrams of some messages at a time, to be sent while the lock is held once."""
    rest = iter(messages)
    while some := tuple(itertools.islice(rest, _MESSAGES_TOGETHER)):
        yield tuple(itertools.chain.from_iterable(some))


def _pieces(pair: codec.Datagrams) -> codec.Pieces:
    """Both datagrams, each in one piece."""
    return (pair[0],), (pair[1],)


def _want_time(targets: Iterable[Target]) -> bool:
    return any(target.data_types & _TIME_BIT for target in targets)


def _stamp(source: Source, message: Any) -> codec.Datagrams:
    stamp, component_id = message.header.stamp, source.component_id
    data = codec.TimeStamp.pack_values(stamp.secs, stamp.nsecs, source.data_type, component_id)
    return codec.encode(codec.DataType.TIME, component_id, data)
