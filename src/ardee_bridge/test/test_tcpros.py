# SPDX-License-Identifier: MIT
"""Messages from the bytes of a connection, and handshakes with publishers that say what they should not."""
import itertools
import random
import socket
import struct
import threading
from typing import Callable, Iterator, List
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from rosgraph.network import encode_ros_handshake_header

from ardee_bridge import tcpros


class Stream:
    """Bytes that arrive in parts of these sizes, as far as there is room for them."""

    def __init__(self, stream: bytes, sizes: Iterator[int]) -> None:
        self.rest, self._sizes = stream, sizes

    def receive_into(self, room: memoryview) -> int:
        assert len(room) > 0
        part = self.rest[: min(len(room), next(self._sizes))]
        self.rest = self.rest[len(part) :]
        room[: len(part)] = part
        return len(part)


def framed(messages: List[bytes]) -> bytes:
    return b"".join(struct.pack("<I", len(message)) + message for message in messages)


@pytest.mark.parametrize("seed", range(20))
def test_messages_are_the_same_however_their_bytes_arrive(seed):
    rng = random.Random(seed)
    sent = [rng.randbytes(rng.choice((0, 1, 3, 4, 5, 100, 70_000, 300_000))) for _ in range(30)]
    sizes = iter(lambda: rng.choice((1, 2, 3, 4, 5, 50, 65536, 1 << 20)), None)
    stream = Stream(framed(sent), sizes)
    found: List[bytes] = []
    splitter = tcpros.Splitter(lambda message: found.append(bytes(message)))
    while splitter.read(stream.receive_into):
        pass
    assert stream.rest == b"" and found == sent


def test_a_message_is_handed_on_where_it_was_received():
    views: List[memoryview] = []
    splitter = tcpros.Splitter(views.append)
    stream = Stream(framed([b"x" * 1000, b"y" * 1000]), itertools.repeat(1004))
    while splitter.read(stream.receive_into):
        pass
    assert views[0].obj is views[1].obj and bytes(views[0]) == bytes(views[1]) == b"y" * 1000


def test_a_length_that_no_message_has_is_refused():
    splitter = tcpros.Splitter(lambda message: None)
    with pytest.raises(tcpros.Refused, match="a message of 4294967295 bytes, expected at most"):
        splitter.read(Stream(b"\xff\xff\xff\xff", itertools.repeat(4)).receive_into)


def test_room_is_made_for_what_came_and_not_for_what_is_claimed():
    rooms: List[int] = []
    stream = Stream(struct.pack("<I", 60 << 20) + b"x" * 200_000, itertools.repeat(50_000))

    def receive_into(room: memoryview) -> int:
        rooms.append(len(room.obj))
        return stream.receive_into(room)

    splitter = tcpros.Splitter(lambda message: None)
    while splitter.read(receive_into):
        pass
    assert max(rooms) <= 2 * 200_004


@pytest.mark.parametrize(
    "parts, expected",
    [
        ((20_000, 20_000), [True, True]),
        ((20_000, 80_004), [True, False]),  # which is the whole message
        ((20_000, 100), [True, False]),
        ((100, 20_000), [False, True]),
        ((3, 3, 16_384, 16_383), [False, False, True, False]),
        ((100_004, 4, 20_000), [False, False, True]),  # the next one after it
    ],
)
def test_more_is_expected_after_large_parts_of_messages(parts, expected):
    splitter, found = tcpros.Splitter(lambda message: None), []
    before = Stream(framed([bytes(100_000)]), itertools.repeat(1 << 20))
    while splitter.read(before.receive_into):
        pass  # until there is room for a whole message
    stream = Stream(framed([bytes(100_000)] * 2), iter(parts))
    for _ in parts:
        splitter.read(stream.receive_into)
        found.append(splitter.is_arriving)
    assert found == expected


class Publisher:
    """A node that says these bytes to whoever connects."""

    def __init__(self, said: bytes) -> None:
        self._listening = socket.create_server(("127.0.0.1", 0))
        self._said = said
        self._server = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
        place = ["TCPROS", *self._listening.getsockname()]
        self._server.register_function(lambda *_: (1, "", place), "requestTopic")
        self._threads = [threading.Thread(target=body) for body in (self._answer, self._say)]
        for thread in self._threads:
            thread.start()
        self.uri = "http://%s:%d/" % self._server.server_address

    def _answer(self) -> None:
        self._server.handle_request()

    def _say(self) -> None:
        connected, _ = self._listening.accept()
        with connected:
            connected.recv(4096)
            connected.sendall(self._said)

    def close(self) -> None:
        for thread in self._threads:
            thread.join()
        self._server.server_close()
        self._listening.close()


@pytest.fixture
def say():
    made: List[Publisher] = []

    def make(said: bytes) -> Callable[[], socket.socket]:
        made.append(Publisher(said))
        return lambda: tcpros.connect(made[-1].uri, "/topic", "/test", "a/B", "1234")

    yield make
    for publisher in made:
        publisher.close()


def header(**fields: str) -> bytes:
    return encode_ros_handshake_header(fields)


@pytest.mark.parametrize(
    "said, error, message",
    [
        (header(error="no such topic"), tcpros.Refused, "no such topic"),
        (header(type="c/D", md5sum="99"), tcpros.Refused, "of type c/D, md5sum 99; expected"),
        (header(type="c/D"), tcpros.Refused, "md5sum ; expected md5sum 1234"),
        (b"\xff\xff\xff\x7f", tcpros.Refused, "a connection header of 2147483647 bytes"),
        (b"\x05\x00\x00\x00ab", ConnectionError, "has ended"),
        (b"", ConnectionError, "has ended"),
        (b"\x04\x00\x00\x00\xff\xff\xff\x7f", tcpros.AWAY, ""),
        (b"\x06\x00\x00\x00\x02\x00\x00\x00=\xff", tcpros.Refused, "cannot be read"),
        (b"\x02\x00\x00\x00ab", tcpros.Refused, "cannot be read"),
    ],
)
def test_what_a_publisher_should_not_say(say, said, error, message):
    with pytest.raises(error, match=message):
        say(said)()


def test_a_connection_gives_its_messages(say):
    connect = say(header(type="a/B", md5sum="1234") + b"\x02\x00\x00\x00hi")
    found: List[bytes] = []
    with connect() as connected:
        connected.settimeout(10.0)
        splitter = tcpros.Splitter(lambda message: found.append(bytes(message)))
        while not found:
            assert splitter.read(connected.recv_into)
    assert found == [b"hi"]


@pytest.mark.parametrize(
    "answer, error, message",
    [
        ((0, "not mine", 0), ConnectionError, "not mine"),
        ((1, "", ["TCPROS", "127.0.0.1", 70_000]), tcpros.Refused, "expected protocol, host and"),
        ((1, "", ["TCPROS", "127.0.0.1", "x"]), tcpros.Refused, "expected protocol, host and port"),
        ((1, "", 7), tcpros.Refused, "found .1, '', 7. as its place"),
        ("maybe", tcpros.Refused, "found .maybe. as its place"),
    ],
)
def test_places_that_are_none(answer, error, message):
    with SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False) as server:
        server.register_function(lambda *_: answer, "requestTopic")
        answering = threading.Thread(target=server.handle_request)
        answering.start()
        with pytest.raises(error, match=message):
            uri = "http://%s:%d/" % server.server_address
            tcpros.connect(uri, "/topic", "/test", "a/B", "1234")
        answering.join()


def test_a_publisher_that_is_not_there():
    with socket.create_server(("127.0.0.1", 0)) as closed:
        port = closed.getsockname()[1]
    with pytest.raises(tcpros.AWAY):
        tcpros.connect(f"http://127.0.0.1:{port}/", "/topic", "/test", "a/B", "1234")
