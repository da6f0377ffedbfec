# SPDX-License-Identifier: MIT
"""Reads topics in one thread: what the simulator publishes in a step comes at one time.

With a thread for each topic, as rospy has it, they would stand in each other's way; and rospy copies a large message
several times. The master tells a node of new publishers only where that node calls itself at home, so the reader is a
node of its own beside rospy's.
"""
import contextlib
import itertools
import os
import select
import socket
import threading
import time
import traceback
from typing import Any, Callable, Dict, FrozenSet, List, NamedTuple, Optional, Set, Tuple

from ardee_bridge import tcpros
from ardee_bridge.registrar import Owner, Registrar

RETRY_S = 1.0
CLOSE_POLL_S = 0.2
# The rest of a large message, which a program on this computer is writing, is there sooner than a thread that sleeps is
# woken: the benchmark's bare forwarder, which is, takes 0.1 ms for nothing else. On the only processor the reader would
# keep that program from writing.
AWAKE_S = 50e-6 if len(os.sched_getaffinity(0)) > 1 else 0.0

Warn = Callable[[str], None]


class Kind(NamedTuple):
    """A type of message: name, md5sum, and how to make one of its bytes, which are gone after the callbacks."""

    name: str
    md5sum: str
    decode: Callable[[memoryview], Any]


class _Topic:
    """A topic of one type, who wants its messages, and the links to its publishers."""

    def __init__(self, name: str, kind: Kind, number: int, warn: Warn) -> None:
        self.name, self.kind, self.number, self._warn = name, kind, number, warn
        self.callbacks: List[Callable[[Any], None]] = []
        self.links: Dict[str, _Link] = {}

    def take(self, data: memoryview) -> None:
        """Give a message to all that want it; an error of theirs is not the connection's."""
        try:
            message = self.kind.decode(data)
        except Exception as error:
            raise tcpros.Refused(f"a message that cannot be read: {error}") from error
        for callback in tuple(self.callbacks):
            try:
                callback(message)
            except Exception:
                self._warn(f"{self.name}: {traceback.format_exc()}")


class _Link:
    """To one publisher of a topic: connects, and again when the connection has ended, until it is dropped."""

    def __init__(self, reader: "Reader", topic: _Topic, uri: str) -> None:
        self.topic, self.uri, self._reader = topic, uri, reader
        self.socket: Optional[socket.socket] = None
        self.splitter = tcpros.Splitter(topic.take)
        self.has_ended, self._is_dropped = threading.Event(), threading.Event()
        threading.Thread(target=self._keep, daemon=True).start()

    def _keep(self) -> None:
        said = ""
        while not self._is_dropped.is_set():
            try:
                self._connect()
                self.has_ended.wait()
            except tcpros.Refused as why:
                if str(why) != said:
                    self._reader.warn(f"{self}: {why}")
                said = str(why)
            except tcpros.AWAY:
                pass  # until it comes back, or the master says that it is gone
            self._is_dropped.wait(RETRY_S)

    def __str__(self) -> str:
        return f"{self.topic.name} of {self.uri}"

    def _connect(self) -> None:
        kind = self.topic.kind
        opened = tcpros.connect(
            self.uri, self.topic.name, self._reader.name, kind.name, kind.md5sum
        )
        self.splitter = tcpros.Splitter(self.topic.take)
        self.has_ended.clear()
        self.socket = opened
        self._reader.watch(self)
        if self._is_dropped.is_set():
            self.drop()

    def drop(self) -> None:
        """End it for good."""
        self._is_dropped.set()
        if self.socket is not None:
            with contextlib.suppress(OSError):
                self.socket.shutdown(socket.SHUT_RDWR)  # the reading thread then finds it ended


class Watch:
    """Who publishes a topic, as the master says; nobody is connected to it."""

    def __init__(self, name: str, kind: str, number: int) -> None:
        self.name, self.kind, self.number = name, kind, number
        self._publishers: Optional[FrozenSet[str]] = None

    @property
    def is_known(self) -> bool:
        """Has the master said anything yet?"""
        return self._publishers is not None

    def has_publishers(self) -> bool:
        return bool(self._publishers)

    def hear(self, uris: List[str]) -> None:
        """These publish it."""
        self._publishers = frozenset(uris)


class Subscription:
    """A callback's; ends with unregister(), as rospy's do."""

    def __init__(self, end: Callable[[], None]) -> None:
        self._end = end

    def unregister(self) -> None:
        """Call back no more."""
        self._end()


class Reader:
    """A node of this name that reads topics. Callbacks are called in one thread, and should be quick.

    `drop` gets a line for each message that cannot be read, which ends its connection; by default `warn` does.
    """

    def __init__(
        self,
        name: str,
        warn: Warn,
        on_shutdown: Callable[[str], None],
        drop: Optional[Warn] = None,
    ) -> None:
        self.name, self.warn, self._drop = name, warn, drop or warn
        # a signal that closes it may come in the midst of subscribe()
        self._lock = threading.RLock()
        self._topics: Dict[Tuple[str, str], _Topic] = {}
        self._watches: Set[Watch] = set()
        self._numbers = itertools.count()
        self._poll = select.epoll()
        self._watched: Dict[int, _Link] = {}
        self._is_closed = threading.Event()
        owner = Owner(self._on_publishers, on_shutdown, self._connections)
        self._registrar = Registrar(name, owner)
        self._thread = threading.Thread(target=self._read, daemon=True)
        self._thread.start()

    def subscribe(self, name: str, kind: Kind, callback: Callable[[Any], None]) -> Subscription:
        """Call back with every message of a topic, given by its full name."""
        key = (name, kind.name)
        with self._lock:
            if key not in self._topics:
                self._topics[key] = _Topic(name, kind, next(self._numbers), self.warn)
            self._topics[key].callbacks.append(callback)
            self._register()
        return Subscription(lambda: self._end(key, callback))

    def watch_publishers(self, name: str, kind: str) -> Watch:
        """Be told who publishes a topic, given by its full name, of this type."""
        with self._lock:
            made = Watch(name, kind, next(self._numbers))
            self._watches.add(made)
            self._register()
        return made

    def refresh(self, watch: Watch) -> None:
        """Ask the master: it does not say that the topics of a node that crashed and was started again are gone."""
        with self._lock:
            watch.number = next(self._numbers)
            self._register()

    def end_watch(self, watch: Watch) -> None:
        """Be told no more."""
        with self._lock:
            self._watches.discard(watch)
            self._register()

    def _end(self, key: Tuple[str, str], callback: Callable[[Any], None]) -> None:
        with self._lock:
            topic = self._topics[key]
            topic.callbacks.remove(callback)
            if topic.callbacks:
                return
            for link in topic.links.values():
                link.drop()
            del self._topics[key]
            self._register()

    def _register(self) -> None:
        topics = [(each.name, each.kind.name, each.number) for each in self._topics.values()]
        watches = [(each.name, each.kind, each.number) for each in self._watches]
        self._registrar.want(topics + watches)

    def _on_publishers(self, name: str, uris: List[str], are_all: bool) -> None:
        with self._lock:
            for watch in [watch for watch in self._watches if watch.name == name]:
                watch.hear(uris)
            for topic in [topic for topic in self._topics.values() if topic.name == name]:
                for uri in uris:
                    if uri not in topic.links:
                        topic.links[uri] = _Link(self, topic, uri)
                for uri in set(topic.links) - set(uris) if are_all else ():
                    topic.links.pop(uri).drop()

    def _connections(self) -> List[Tuple[str, str]]:
        return [(link.topic.name, link.uri) for link in list(self._watched.values())]

    def watch(self, link: _Link) -> None:
        """Read this link's socket from now on."""
        self._watched[link.socket.fileno()] = link
        self._poll.register(link.socket, select.EPOLLIN)

    def _read(self) -> None:
        awake_until_s = 0.0
        while self._watched or not self._is_closed.is_set():
            is_awake = time.perf_counter() < awake_until_s
            for number, _ in self._poll.poll(0.0 if is_awake else CLOSE_POLL_S):
                link = self._watched[number]
                self._read_link(number, link)
                if link.splitter.is_arriving:
                    awake_until_s = time.perf_counter() + AWAKE_S

    def _read_link(self, number: int, link: _Link) -> None:
        try:
            if not link.splitter.read(link.socket.recv_into):
                self._forget(number)
        except BlockingIOError:
            pass
        except OSError:
            self._forget(number)
        except tcpros.Refused as why:
            self._drop(f"{link}: {why}")
            self._forget(number)

    def _forget(self, number: int) -> None:
        link = self._watched.pop(number)
        self._poll.unregister(number)
        link.socket.close()
        link.has_ended.set()

    def close(self) -> None:
        """End all subscriptions, and the node."""
        with self._lock:
            links = [link for topic in self._topics.values() for link in topic.links.values()]
            self._topics.clear()
            self._watches.clear()
        for link in links:
            link.drop()
        self._registrar.close()
        self._is_closed.set()
        self._thread.join(2 * CLOSE_POLL_S)
