# SPDX-License-Identifier: MIT
"""Measures the floor of the bridge's latencies: the barest chain of its shape on this machine at the same time.

A process that sleeps between messages writes each to a TCP connection, as a simulator does; another one
reads it and sends it on as a datagram. There is no ROS and no work in between, so the floor is the
machine's: system calls, waking a process, and waiting for a processor.
"""
import contextlib
import socket
import struct
import time
from typing import Any, Callable, Dict, Iterator, Tuple

from bench import kernel_clock, latency, priority

from ardee_bridge.wire.udp import open_socket

NAME = "bare forwarder"
RATE_HZ = 100.0
HOST = "127.0.0.1"
MESSAGE = struct.Struct("<q")  # time of writing, by the clock of the kernel's time stamps [ns]

Arrivals = Dict[int, int]  # time of writing: time of the datagram's arrival [ns]; 0: none yet


def write(pipe: Any) -> None:
    """Writes, as the first process's body: reports its ports to read from and send to and, when told to end, arrivals.

    It receives too: a datagram's time is the kernel's, however late this process reads it.
    """
    priority.hurry()
    priority.keep_what_there_is()
    arrivals = {}  # type: Arrivals
    with socket.create_server((HOST, 0)) as listener, open_socket(HOST, 0) as receiver:
        kernel_clock.use(receiver)
        kernel_clock.wait()
        pipe.send((listener.getsockname()[1], receiver.getsockname()[1]))
        connection, _ = listener.accept()
        with connection:
            connection.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            due = time.monotonic()
            while not pipe.poll():
                due += 1.0 / RATE_HZ
                time.sleep(max(0.0, due - time.monotonic()))
                at_ns = time.time_ns()
                arrivals[at_ns] = 0
                connection.sendall(MESSAGE.pack(at_ns))
                _receive(receiver, arrivals)
            time.sleep(latency.SETTLE_S)
            _receive(receiver, arrivals)
    pipe.send(arrivals)


def _receive(receiver: socket.socket, arrivals: Arrivals) -> None:
    with contextlib.suppress(BlockingIOError):
        while True:
            data, extras, _, _ = receiver.recvmsg(MESSAGE.size, 256, socket.MSG_DONTWAIT)
            arrivals[MESSAGE.unpack(data)[0]] = kernel_clock.arrival_ns(extras) or 0


def forward(pipe: Any, source: int, target: int) -> None:
    """Forwards, as the body of the second process: reports its connection; then copies until the connection ends."""
    priority.keep_what_there_is()
    with socket.create_connection((HOST, source)) as opened, open_socket(HOST, 0) as sender:
        pipe.send("connected")
        data = opened.recv(MESSAGE.size)
        while data:
            sender.sendto(data, (HOST, target))
            data = opened.recv(MESSAGE.size)


@contextlib.contextmanager
def running() -> Iterator[Callable[[int, int], latency.Spread]]:
    """Runs the chain during the block. Yields a function that ends it and returns latencies between two times [ns]."""
    writer, from_writer = latency.in_process({}, write)
    processes = [writer]

    def took(begin_ns: int, end_ns: int) -> latency.Spread:
        arrivals = latency.answer(writer, from_writer, "end", latency.START_LIMIT_S)
        return spread_within(arrivals, begin_ns, end_ns)

    try:
        ports = latency.hear(from_writer, latency.START_LIMIT_S)  # type: Tuple[int, int]
        forwarder, from_forwarder = latency.in_process({}, forward, *ports)
        processes.append(forwarder)
        latency.hear(from_forwarder, latency.START_LIMIT_S)
        yield took
    finally:
        for process in processes:
            process.terminate()
            process.join()


def spread_within(arrivals: Arrivals, begin_ns: int, end_ns: int) -> latency.Spread:
    """Returns the spread of the messages that were written from one time to another."""
    within = {at_ns: arrived for at_ns, arrived in arrivals.items() if begin_ns <= at_ns <= end_ns}
    found = [arrived - at_ns for at_ns, arrived in within.items() if arrived]
    return latency.spread(found, len(within))
