# SPDX-License-Identifier: MIT
"""Sends sensor messages to their targets, and answers SET_PORT messages; without rospy."""
import socket
import threading
import time
from collections import Counter
from typing import Any, Callable, Dict, List, NamedTuple, Optional, Set, Tuple

from ardee_bridge.nodes import convert
from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.requests import Requests
from ardee_bridge.nodes.settings import COMPRESSED, ServerSettings, Source
from ardee_bridge.wire import chunks, codec
from ardee_bridge.wire.pairing import Message
from ardee_bridge.wire.udp import Sender

_ALL_BIT = 1 << codec.DataType.ALL
_TIME_BIT = 1 << codec.DataType.TIME


class Target(NamedTuple):
    """A receiver of messages: address, data types wanted, one component or all, end of the lease (None: configured)."""

    address: Sender
    data_types: int
    component_id: int
    until_s: Optional[float]

    def wants(self, source: Source) -> bool:
        """Returns whether it gets this sensor's messages."""
        is_component = self.component_id in (codec.ALL_COMPONENTS, source.component_id)
        return is_component and bool(self.data_types & (_ALL_BIT | 1 << source.data_type))


class RateLimit:
    """Limits messages to a rate of simulated time, exact in the mean; 0: no limit.

    Messages whose time stamp is left at 0 all pass, because their rate is unknown.
    """

    def __init__(self, max_rate_hz: float) -> None:
        self._period_s = 1.0 / max_rate_hz if max_rate_hz else 0.0
        self._due_s = self._last_s = float("-inf")

    def admits(self, stamp_s: float) -> bool:
        """Returns whether the message of this time passes."""
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
    ) -> None:
        self._settings, self._socket, self._counters = settings, opened, counters
        self._on_targets, self._clock = on_targets, clock
        self._lock = threading.Lock()
        self._requests = Requests(
            opened, settings.allowed_clients, counters, clock, "sender not allowed", "requests: "
        )
        self._limits = {source.name: RateLimit(source.max_rate_hz) for source in settings.sources}
        self._sequences: Dict[str, int] = {}
        # by component: stamp and form of its latest image
        self._images: Dict[int, Tuple[Any, str]] = {}
        peers = [((peer.address, peer.port), peer.data_types) for peer in settings.peers]
        self._targets = {at: Target(at, types, codec.ALL_COMPONENTS, None) for at, types in peers}

    # -- sensors

    def wanted(self) -> Set[str]:
        """Returns the names of the sources that some target wants."""
        return {source.name for source in self._settings.sources if self._targets_of(source)}

    def publish(self, source: Source, message: Any, velocity: Any = None) -> None:
        """Sends a ROS message to all that want it."""
        targets = self._targets_of(source)
        if not targets:
            return
        try:
            if not self._limits[source.name].admits(convert.stamp_s(message)):
                return
            messages = self._messages(source, message, velocity)
        except ValueError as error:
            what = "sensor messages that the wire cannot carry"
            self._counters.drop(what, f"{source.topic}: {error}")
            return
        if messages:
            stamp = _stamp(source, message)
            for target in targets:
                has_stamp = target.data_types & _TIME_BIT
                self._send(target.address, [stamp, *messages] if has_stamp else messages)
            self._counters.did(f"sent {source.name}")

    def _messages(self, source: Source, message: Any, velocity: Any) -> List[codec.Datagrams]:
        """Returns the messages of the wire; none for an image that was sent already."""
        if source.format == COMPRESSED:
            frame = convert.compressed_image(message)
        elif source.kind == "image":
            frame = convert.image(message, source.format, source.jpeg_quality)
        elif source.kind == "point_cloud":
            frame = convert.point_cloud(message)
        else:
            more = () if velocity is None else (velocity,)
            reading = convert.SINGLES[source.kind](message, *more)
            return [codec.encode(source.data_type, source.component_id, *reading)]
        if source.format in (COMPRESSED, "jpeg") and not self._is_first(source, message):
            return []
        sequence = self._sequences.get(source.name, 0)
        self._sequences[source.name] = (sequence + 1) & 0x7FFFFFFF
        frame.head.chunk.sequence = sequence
        place = (source.data_type, source.component_id)
        return chunks.split(*place, frame.head, frame.payload, source.chunk_bytes)

    def _is_first(self, source: Source, message: Any) -> bool:
        """Returns whether the image of this stamp was not sent in the camera's other form.

        Drivers that leave the stamp at 0 lose one image when the form changes.
        """
        stamp = (message.header.stamp.secs, message.header.stamp.nsecs)
        with self._lock:
            before = self._images.get(source.component_id, (None, ""))
            self._images[source.component_id] = (stamp, source.format)
        return before[0] != stamp or before[1] == source.format

    def _targets_of(self, source: Source) -> List[Target]:
        return [target for target in self.clients() if target.wants(source)]

    def _send(self, address: Sender, messages: List[codec.Datagrams]) -> None:
        """Sends headers and data back to back, whatever other threads send."""
        refused: "Counter[Tuple[str, str]]" = Counter()
        with self._lock:
            for pair in messages:
                try:
                    for datagram in pair:
                        self._socket.sendto(datagram, socket.MSG_DONTWAIT, address)
                except OSError as error:
                    is_full = isinstance(error, BlockingIOError)
                    kind = "to a full send buffer" if is_full else "that could not be sent"
                    refused[f"messages {kind}", error.strerror] += 1
        for (kind, why), count in refused.items():
            self._counters.drop(kind, f"{address[0]}:{address[1]}: {why}", count)

    # -- clients

    def receive(self, timeout_s: float) -> None:
        """Waits at most this long for requests, and answers them; drops clients whose lease has ended."""
        for message, sender, _ in self._requests.receive(timeout_s):
            if message.header.msg_type == codec.MessageType.SET_PORT:
                self._set_port(message, sender)
            else:
                self._counters.drop("requests: not SET_PORT", f"type {message.header.msg_type}")
        self._forget()

    def _set_port(self, message: Message, sender: Sender) -> None:
        request = codec.SetPort.unpack(message.data)
        if not 0 <= request.port <= 65535 or request.component_id < codec.ALL_COMPONENTS:
            what = f"port {request.port}, component {request.component_id}"
            self._counters.drop("requests: malformed SET_PORT", what)
            return
        address = (sender[0], request.port or sender[1])
        if not self._register(address, request):
            return
        unsent = self._unsent(self._targets.get(address))
        if unsent:
            what = "requests: sensors that no source sends"
            self._counters.drop(what, f"{address[0]}:{address[1]}: {', '.join(unsent)}")
        self._counters.did("SET_PORT obeyed")
        self._send(sender, [codec.encode_ack(message.header)])
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
        """Returns the names of the data types that the target wants but that have no source."""
        if target is None:
            return []
        sent = {each.data_type for each in self._settings.sources if target.wants(each)}
        if sent:
            sent.add(codec.DataType.ALL)
        wanted = {each for each in codec.DataType if target.data_types & 1 << each}
        missing = wanted - sent - {codec.DataType.NONE, codec.DataType.TIME}
        return [each.name.lower() for each in sorted(missing)]

    def _forget(self) -> None:
        now = self._clock()
        for address, target in list(self._targets.items()):
            if target.until_s is not None and target.until_s < now:
                del self._targets[address]
                self._counters.did("clients forgotten")
                self._on_targets()

    def clients(self) -> Tuple[Target, ...]:
        """Returns all targets that get messages."""
        return tuple(self._targets.values())


def _stamp(source: Source, message: Any) -> codec.Datagrams:
    data = codec.TimeStamp(data_type=source.data_type, component_id=source.component_id)
    data.sec, data.nsec = message.header.stamp.secs, message.header.stamp.nsecs
    return codec.encode(codec.DataType.TIME, source.component_id, data.pack())
