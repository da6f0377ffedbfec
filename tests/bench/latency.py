# SPDX-License-Identifier: MIT
"""Code that the bridge's measurements on loopback share: latencies and losses of messages.

A datagram's time is its arrival at the receiver's socket by the kernel. Nodes, publishers and receivers are
processes of their own, around a ROS master of their own.
"""
import contextlib
import json
import math
import os
import select
import signal
import socket
import subprocess
import time
from multiprocessing import get_context
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Sequence, Tuple, Union

from bench import kernel_clock, priority

from ardee_bridge.nodes.settings import KINDS, Source
from ardee_bridge.wire import codec
from ardee_bridge.wire.pairing import Message
from ardee_bridge.wire.udp import BUFFER_BYTES, MAX_DATAGRAM, open_socket
from ardee_common.process import Ended, RosMaster, end_put_off, start_child

START_LIMIT_S = 30.0
# Time for the last messages to arrive.
SETTLE_S = 0.5
# After so long without a message, none is on its way, however busy the machine.
SILENCE_S = 3.0
# Larger datagrams are parts of frames; only their head is read.
SO_RCVBUFFORCE = 33  # Linux's number, which Python's socket module does not name
CHUNKED = (codec.ImageChunk, codec.PointCloudChunk)
KEPT_WHOLE_BYTES, KEPT_BYTES = 16384, 64

Key = Tuple[int, int]  # data type, component id


class Stream(NamedTuple):
    """Sensor stream: kind, topic, component id, rate, format of images."""

    kind: str
    topic: str
    component_id: int
    rate_hz: float
    format: str = ""

    @property
    def key(self) -> Key:
        return (int(KINDS[self.kind]), self.component_id)


def row_of(kind: str, format: str) -> str:
    """Returns the row in the table: kind of sensor, and the format of images."""
    return f"{format} {kind}" if format else kind


class Datagram(NamedTuple):
    """Received datagram, of a large one only its beginning; its size, and its arrival [ns]."""

    beginning: bytes
    size: int
    at_ns: int

    def data(self) -> bytes:
        """Returns all bytes; bytes that were not kept are zero."""
        return self.beginning.ljust(self.size, b"\0")


class Spread(NamedTuple):
    """Latencies [ms], and how many messages were sent and lost."""

    p50_ms: float
    p99_ms: float
    max_ms: float
    sent: int
    lost: int


def spread(latencies_ns: Sequence[int], sent: int) -> Spread:
    """Returns percentiles by the nearest rank."""
    ordered = sorted(latencies_ns)
    if not ordered:
        return Spread(math.nan, math.nan, math.nan, sent, sent)

    def at(share: float) -> float:
        return ordered[max(0, math.ceil(share * len(ordered)) - 1)] / 1e6

    return Spread(at(0.5), at(0.99), ordered[-1] / 1e6, sent, sent - len(ordered))


@contextlib.contextmanager
def own_master() -> Iterator[Dict[str, str]]:
    """Returns the environment of a ROS master of its own."""
    env = dict(os.environ, ROS_IP="127.0.0.1")
    env.pop("ROS_HOSTNAME", None)
    master = RosMaster(env)
    try:
        yield dict(env, ROS_MASTER_URI=master.uri)
    finally:
        master.stop()


@contextlib.contextmanager
def node(env: Dict[str, str], name: str, *parameters: str) -> Iterator[subprocess.Popen]:
    """Runs a node of this package during the block; prints what it complained of, if it failed."""
    command = ["rosrun", "ardee_bridge", name, *parameters]
    child = start_child(command, env, stderr=subprocess.PIPE, text=True)
    interrupted = False
    try:
        yield child
    except Ended:
        interrupted = True  # the node may be in its imports, where Ctrl-C is a failure
        raise
    finally:
        if child.poll() is None:
            os.killpg(child.pid, signal.SIGINT)
        _, complaints = child.communicate(timeout=START_LIMIT_S)
        if child.returncode != 0 and not interrupted:
            print(complaints)


def in_process(env: Dict[str, str], body: Callable[..., Any], *args: Any) -> Tuple[Any, Any]:
    """Starts body(pipe, *args) in a process of its own; returns the process and our end of the pipe."""
    context = get_context("spawn")
    ours, theirs = context.Pipe()
    process = context.Process(target=_enter, args=(env, body, theirs, args), daemon=True)
    with end_put_off():  # Ctrl-C would show as a traceback of the imports
        process.start()
    theirs.close()
    return process, ours


def _enter(env: Dict[str, str], body: Callable[..., Any], pipe: Any, args: Tuple[Any, ...]) -> None:
    os.environ.update(env)
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, [signal.SIGINT])
    try:
        body(pipe, *args)
    except EOFError:
        pass  # the benchmark has ended before this process
    except OSError as error:
        with contextlib.suppress(BrokenPipeError):  # as above
            pipe.send(error)


def hear(pipe: Any, limit_s: float) -> Any:
    """Returns a process's next report; raises the error that ended it."""
    if not pipe.poll(limit_s):
        raise TimeoutError(f"a process of the benchmark said nothing for {limit_s} s")
    said = pipe.recv()
    if isinstance(said, Exception):
        raise said
    return said


def answer(process: Any, pipe: Any, word: str, limit_s: float) -> Any:
    """Returns a process's last report, which this word requests."""
    with contextlib.suppress(BrokenPipeError):  # it has ended, and has reported why
        pipe.send(word)
    said = hear(pipe, limit_s)
    process.join(START_LIMIT_S)
    return said


def is_followed(message: Message) -> bool:
    """Returns whether it is a chunk other than its frame's last."""
    kind = codec.data_struct(message.header)
    if kind not in CHUNKED:
        return False
    chunk = kind.unpack(message.data[: kind.size]).chunk
    return chunk.index < chunk.count - 1


def receive_datagrams(pipe: Any) -> List[Datagram]:
    """Reports its port, and receives until told to end, at once or after the last message; reports arrivals [ns].

    The receiver stands for another computer, which takes no time of this one: if possible, it only looks from time to
    time, and never keeps a process of higher priority waiting. Waking it is work for the sender, up to 50 us a datagram
    on a virtual machine. Each datagram has the kernel's time of its arrival, however late it is read.
    """
    with open_socket("127.0.0.1", 0) as opened:
        only_looks = _make_room(opened) and priority.go_next()
        if not only_looks:
            priority.hurry()
        kernel_clock.use(opened)
        kernel_clock.wait()
        pipe.send(opened.getsockname()[1])
        room, kept, word = memoryview(bytearray(MAX_DATAGRAM)), [], ""
        while word != "at once":
            if pipe.poll():
                word = pipe.recv()
            if only_looks:
                time.sleep(kernel_clock.LOOK_S)
            limit_s = SILENCE_S if word else 0.0 if only_looks else 0.05
            if select.select([opened], [], [], limit_s)[0]:
                kept.extend(_arrived(opened, room))
            elif word:
                break
        return kept


def _make_room(opened: socket.socket) -> bool:
    """Enlarges the socket's buffer for several frames between two looks; returns whether it could."""
    with contextlib.suppress(PermissionError):
        opened.setsockopt(socket.SOL_SOCKET, SO_RCVBUFFORCE, BUFFER_BYTES)
    return opened.getsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF) >= BUFFER_BYTES


def _arrived(opened: socket.socket, room: memoryview) -> Iterator[Datagram]:
    """Yields the datagrams that have arrived; the buffer holds one."""
    with contextlib.suppress(BlockingIOError):
        while True:
            size, extras, _, _ = opened.recvmsg_into([room], 256, socket.MSG_DONTWAIT)
            beginning = bytes(room[: size if size <= KEPT_WHOLE_BYTES else KEPT_BYTES])
            yield Datagram(beginning, size, kernel_clock.arrival_ns(extras) or 0)


def server_arguments(peer: str, sources: Sequence[Union[Stream, Source]]) -> List[str]:
    """Returns parameters of a sensor server of these sources."""
    items = []
    for source in sources:
        values = dict(name=source.topic, kind=source.kind, topic=source.topic)
        values["component_id"] = source.component_id
        if source.format:
            values["format"] = source.format
        if isinstance(source, Source) and source.velocity_topic:
            values["velocity_topic"] = source.velocity_topic
        items.append(values)
    return [
        "_port:=0",
        f"_peers:=[{peer}]",
        f"_sources:={json.dumps(items)}",
    ]
