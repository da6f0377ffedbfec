# SPDX-License-Identifier: MIT
"""The sensor server's reader of topics: publishers that come, die, return, and publish something else; its node."""
import os
import signal
import socket
import struct
import threading
from typing import Any, Callable, Iterator, List, Tuple
from xmlrpc.server import SimpleXMLRPCServer

import pytest
import rosgraph
from ros_graph import Process, RosGraph, wait_until
from rosgraph.network import encode_ros_handshake_header
from std_msgs.msg import Float64, Int32

from ardee_bridge import reader, tcpros
from ardee_bridge.reader import Kind, Reader

NAME = "/reader_of_the_test"
INT = Kind(Int32._type, Int32._md5sum, lambda data: Int32().deserialize(data).data)


class Bench:
    """A reader in this process, what it has said, and publishers in processes of their own."""

    def __init__(self, graph: RosGraph) -> None:
        self.graph = graph
        self.said: List[str] = []
        self.ended: List[str] = []
        self.dropped: List[str] = []
        self.reader = Reader(NAME, self.said.append, self.ended.append, self.dropped.append)

    def keep(self, topic: str) -> List[int]:
        """Subscribe; the list of what comes."""
        kept: List[int] = []
        self.reader.subscribe(topic, INT, kept.append)
        return kept

    def publish(self, topic: str, value: int, kind: Any = Int32) -> Process:
        """Somebody who publishes this value again and again."""
        return self.graph.spawn("rostopic", "pub", "-r", "20", topic, kind._type, str(value))

    def subscribed(self) -> List[str]:
        """Topics that the master has the reader down for."""
        topics = rosgraph.Master("/test").getSystemState()[1]
        return [topic for topic, nodes in topics if NAME in nodes]


@pytest.fixture
def make(graph: RosGraph, monkeypatch: pytest.MonkeyPatch) -> Iterator[Callable[[], Bench]]:
    """Makes a bench in a graph of its own, and takes it away."""
    monkeypatch.setenv("ROS_MASTER_URI", graph.uri)
    monkeypatch.setenv("ROS_IP", "127.0.0.1")
    made: List[Bench] = []

    def make_one() -> Bench:
        made.append(Bench(graph))
        return made[-1]

    yield make_one
    for each in made:
        each.reader.close()


def test_a_publisher_dies_without_a_word_and_another_comes(make: Callable[[], Bench]) -> None:
    bench = make()
    kept = bench.keep("/number")
    first = bench.publish("/number", 1)
    wait_until(lambda: 1 in kept, "the first one's")
    os.killpg(first.pid, signal.SIGKILL)
    first.wait()
    bench.publish("/number", 2)
    wait_until(lambda: 2 in kept, "the second one's")
    assert set(kept) == {1, 2} and bench.said == []


def test_all_publishers_of_a_topic_are_read_and_every_callback_is_called(
    make: Callable[[], Bench],
) -> None:
    bench = make()
    bench.publish("/number", 1)
    kept, also_kept = bench.keep("/number"), bench.keep("/number")
    bench.publish("/number", 2)
    wait_until(lambda: {1, 2} == set(kept) == set(also_kept), "both")


def test_an_error_of_a_callback_is_said_and_the_next_messages_come(
    make: Callable[[], Bench],
) -> None:
    bench = make()
    tried: List[int] = []

    def fail(value: int) -> None:
        tried.append(value)
        raise KeyError("of the test")

    bench.reader.subscribe("/number", INT, fail)
    kept = bench.keep("/number")
    bench.publish("/number", 3)
    wait_until(lambda: len(kept) > 2, "messages after the error")
    assert len(tried) > 2 and "KeyError: 'of the test'" in bench.said[0]


def test_another_type_is_refused_once_and_the_right_one_read(make: Callable[[], Bench]) -> None:
    bench = make()
    kept = bench.keep("/number")
    wrong = bench.publish("/number", 1, Float64)
    wait_until(lambda: bench.said, "it says so")
    bench.publish("/number", 2)
    wait_until(lambda: len(kept) > 40, "messages of the other publisher, for two seconds")
    assert len(bench.said) == 1 and "/number of http" in bench.said[0]
    assert set(kept) == {2} and wrong.exit_code() is None


def refuse(_: memoryview) -> None:
    """In the place of a decoder that the bytes do not suit."""
    raise ValueError("4 bytes, expected 5")


def test_each_message_that_cannot_be_read_is_counted_and_the_others_are_read(
    make: Callable[[], Bench],
) -> None:
    bench = make()
    kept = bench.keep("/good")
    bench.reader.subscribe("/bad", Kind(Int32._type, Int32._md5sum, refuse), kept.append)
    bench.publish("/bad", 5)
    bench.publish("/good", 7)
    wait_until(lambda: 7 in kept and len(bench.dropped) > 1, "both are heard")
    assert 5 not in kept and bench.said == []
    assert "a message that cannot be read: 4 bytes, expected 5" in bench.dropped[0]


class SlowPublisher:
    """A node that has a message of 60 MB, of which it writes as much as it is told to."""

    def __init__(self, topic: str) -> None:
        self._listening = socket.create_server(("127.0.0.1", 0))
        self._listening.settimeout(30.0)
        self._server = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
        place = ["TCPROS", *self._listening.getsockname()]
        self._server.register_function(lambda *_: (1, "", place), "requestTopic")
        threading.Thread(target=self._server.serve_forever, daemon=True).start()
        uri = "http://%s:%d/" % self._server.server_address
        rosgraph.Master("/slow").registerPublisher(topic, Int32._type, uri)
        self._reader, _ = self._listening.accept()
        self._reader.settimeout(30.0)
        self._reader.recv(4096)
        said = dict(type=Int32._type, md5sum=Int32._md5sum)
        self._reader.sendall(encode_ros_handshake_header(said) + struct.pack("<I", 60_000_000))

    def write(self, count: int) -> None:
        self._reader.sendall(bytes(count))

    def close(self) -> None:
        self._server.shutdown()
        for each in (self._reader, self._listening, self._server.socket):
            each.close()


@pytest.fixture
def slow(make: Callable[[], Bench]) -> Iterator[Tuple[Bench, SlowPublisher]]:
    bench = make()
    bench.keep("/slow")
    publisher = SlowPublisher("/slow")
    yield bench, publisher
    publisher.close()


def test_half_of_a_large_message_keeps_nobody_waiting(slow: Tuple[Bench, SlowPublisher]) -> None:
    bench, publisher = slow
    publisher.write(2 * tcpros.LARGE_PART_BYTES)
    kept = bench.keep("/number")
    bench.publish("/number", 7)
    wait_until(lambda: len(kept) > 5, "messages of another publisher")


class Polls:
    """In the place of a reader's epoll: how long it was to wait, each time."""

    def __init__(self, epoll: Any) -> None:
        self._epoll, self.waits_s = epoll, []

    def poll(self, wait_s: float) -> Any:
        self.waits_s.append(wait_s)
        return self._epoll.poll(wait_s)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._epoll, name)


@pytest.mark.parametrize("awake_s", [50e-6, 0.0], ids=["several", "one"])
def test_after_a_large_part_the_reader_is_awake_and_then_sleeps(
    slow: Tuple[Bench, SlowPublisher], awake_s: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    bench, publisher = slow
    monkeypatch.setattr(reader, "AWAKE_S", awake_s)
    polls = bench.reader._poll = Polls(bench.reader._poll)
    wait_until(lambda: polls.waits_s, "it uses them")
    publisher.write(100)
    wait_until(lambda: len(polls.waits_s) > 3, "a small part is read")
    assert 0.0 not in polls.waits_s
    before = len(polls.waits_s)
    publisher.write(2 * tcpros.LARGE_PART_BYTES)
    wait_until(lambda: len(polls.waits_s) > before, "a large part is read")
    wait_until(lambda: polls.waits_s[-2:] == [reader.CLOSE_POLL_S] * 2, "it sleeps")
    before = len(polls.waits_s)
    wait_until(lambda: len(polls.waits_s) > before + 3, "it goes on")
    assert (0.0 in polls.waits_s) == bool(awake_s)
    assert 0.0 not in polls.waits_s[before:]


def test_whoever_unsubscribes_is_called_no_more_and_the_master_knows(
    make: Callable[[], Bench],
) -> None:
    bench = make()
    kept: List[int] = []
    subscription = bench.reader.subscribe("/number", INT, kept.append)
    others = bench.keep("/other")
    bench.publish("/number", 1)
    bench.publish("/other", 2)
    wait_until(lambda: kept and others, "messages")
    assert sorted(bench.subscribed()) == ["/number", "/other"]
    subscription.unregister()
    wait_until(lambda: bench.subscribed() == ["/other"], "the master knows")
    before, other = len(kept), len(others)
    wait_until(lambda: len(others) > other + 20, "the other topic goes on")
    assert len(kept) <= before + 1
    again = bench.keep("/number")
    wait_until(lambda: again, "subscribed again")


def test_a_topic_left_and_subscribed_to_at_once(make: Callable[[], Bench]) -> None:
    bench = make()
    bench.publish("/number", 6)
    kept: List[int] = []
    for _ in range(20):
        subscription = bench.reader.subscribe("/number", INT, kept.append)
        subscription.unregister()
    before = len(kept)
    last = bench.keep("/number")
    wait_until(lambda: len(last) > 5, "messages of the last subscription")
    assert len(kept) <= before + 1 and bench.subscribed() == ["/number"]


def test_without_a_master_nobody_waits_and_with_one_it_registers(
    make: Callable[[], Bench], graph: RosGraph
) -> None:
    graph.end_master()
    bench = make()
    kept = bench.keep("/number")
    graph.start_master()
    bench.publish("/number", 4)
    wait_until(lambda: kept, "messages")
    bench.reader.close()
    assert bench.subscribed() == []


def test_tools_find_a_node_like_any_other(make: Callable[[], Bench], graph: RosGraph) -> None:
    bench = make()
    kept = bench.keep("/number")
    bench.publish("/number", 5)
    wait_until(lambda: kept, "messages")
    about = graph.run("rosnode", "info", NAME)
    assert " * /number [std_msgs/Int32]" in about and "direction: inbound" in about
    assert "xmlrpc reply" in graph.run("rosnode", "ping", "-c", "1", NAME)
    graph.run("rosnode", "kill", NAME)
    wait_until(lambda: bench.ended, "it is told")
