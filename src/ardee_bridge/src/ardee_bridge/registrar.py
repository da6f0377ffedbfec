# SPDX-License-Identifier: MIT
"""A node of ROS that subscribes to topics, without rospy: it tells the master, which tells it of publishers."""
import contextlib
import os
import threading
from typing import Any, Callable, FrozenSet, Iterable, List, NamedTuple, Set, Tuple

import rosgraph
from rosgraph.xmlrpc import XmlRpcHandler, XmlRpcNode

from ardee_bridge.tcpros import AWAY

RETRY_S = 1.0
START_S = 10.0
MASTER_AWAY = AWAY + (rosgraph.MasterException,)

# Name, type, and a number, for a topic that is subscribed to anew wants its publishers anew.
Topic = Tuple[str, str, int]
Answer = Tuple[int, str, Any]  # of the slave API: 1 and a value, or 0 and why there is none


class Owner(NamedTuple):
    """Whose node it is: what it is told, and asked."""

    # name of a topic, URIs of publishers, are these all there are?
    on_publishers: Callable[[str, List[str], bool], None]
    # somebody tells the node to end: why
    on_shutdown: Callable[[str], None]
    # name of a topic and URI of a publisher that is connected
    connections: Callable[[], List[Tuple[str, str]]]


class Registrar:
    """Keeps the master informed of what is subscribed to, from a thread of its own: no caller waits for the master."""

    def __init__(self, name: str, owner: Owner) -> None:
        self._owner, self._master = owner, rosgraph.Master(name)
        self._wanted: FrozenSet[Topic] = frozenset()
        self._registered: Set[Topic] = set()
        self._is_changed, self._is_closed = threading.Event(), threading.Event()
        self._api = _SlaveApi(self, owner)
        self._server = XmlRpcNode(0, self._api)
        self._server.start()
        if not self._api.is_ready.wait(START_S):
            raise OSError(f"{name}: its XML-RPC server does not start")
        self._thread = threading.Thread(target=self._keep, daemon=True)
        self._thread.start()

    @property
    def master_uri(self) -> str:
        return self._master.master_uri

    def wanted(self) -> List[Topic]:
        """What it is to be subscribed to."""
        return sorted(self._wanted)

    def want(self, topics: Iterable[Topic]) -> None:
        """Be subscribed to these from now on."""
        self._wanted = frozenset(topics)
        self._is_changed.set()

    def close(self) -> None:
        """Be subscribed to nothing, and end."""
        self._is_closed.set()
        self.want(())
        self._thread.join(START_S)
        server, self._server.is_shutdown = self._server.server, True
        server.shutdown()
        server.server_close()

    def _keep(self) -> None:
        while not self._is_closed.is_set():
            self._is_changed.wait()
            self._is_changed.clear()
            try:
                self._reconcile()
            except MASTER_AWAY:
                self._is_changed.set()
                self._is_closed.wait(RETRY_S)
        with contextlib.suppress(*MASTER_AWAY):
            self._reconcile()

    def _reconcile(self) -> None:
        wanted, uri = self._wanted, self._server.uri
        for topic in self._registered - wanted:
            if topic[0] not in {name for name, _, _ in wanted}:
                self._master.unregisterSubscriber(topic[0], uri)
            self._registered.remove(topic)
        for topic in wanted - self._registered:
            publishers = self._master.registerSubscriber(topic[0], topic[1], uri)
            self._registered.add(topic)
            # another publisher may have come since, of which the slave API was told first
            self._owner.on_publishers(topic[0], publishers, False)


class _SlaveApi(XmlRpcHandler):
    """What the master and tools ask a node (https://wiki.ros.org/ROS/Slave_API)."""

    def __init__(self, registrar: Registrar, owner: Owner) -> None:
        self._registrar, self._owner = registrar, owner
        self.is_ready = threading.Event()

    def _ready(self, uri: str) -> None:
        self.is_ready.set()

    def publisherUpdate(self, _caller: str, topic: str, publishers: List[str]) -> Answer:
        if not isinstance(publishers, list) or not all(isinstance(uri, str) for uri in publishers):
            return -1, "found no list of URIs", 0
        self._owner.on_publishers(topic, publishers, True)
        return 1, "", 0

    def requestTopic(self, _caller: str, topic: str, _protocols: List[Any]) -> Answer:
        return 0, f"not a publisher of {topic}", 0

    def paramUpdate(self, _caller: str, _key: str, _value: Any) -> Answer:
        return 1, "", 0

    def getPid(self, _caller: str) -> Answer:
        return 1, "", os.getpid()

    def getMasterUri(self, _caller: str) -> Answer:
        return 1, "", self._registrar.master_uri

    def getPublications(self, _caller: str) -> Answer:
        return 1, "", []

    def getSubscriptions(self, _caller: str) -> Answer:
        return 1, "", [[name, kind] for name, kind, _ in self._registrar.wanted()]

    def getBusStats(self, _caller: str) -> Answer:
        return 1, "", [[], [], []]

    def getBusInfo(self, _caller: str) -> Answer:
        connections = self._owner.connections()
        return (
            1,
            "",
            [[n, uri, "i", "TCPROS", topic, 1] for n, (topic, uri) in enumerate(connections)],
        )

    def shutdown(self, _caller: str, reason: str = "") -> Answer:
        self._owner.on_shutdown(reason)
        return 1, "", 0
