# SPDX-License-Identifier: MIT
"""The floor of the benchmark's latencies: a chain of processes without ROS."""
import multiprocessing
import socket
import time

import pytest
from bench import latency, latency_floor


def test_only_the_messages_of_the_window_count() -> None:
    ms = 1_000_000
    arrivals = {10 * ms: 11 * ms, 20 * ms: 22 * ms, 30 * ms: 0, 40 * ms: 44 * ms, 50 * ms: 59 * ms}
    found = latency_floor.spread_within(arrivals, 20 * ms, 40 * ms)
    assert found == latency.Spread(p50_ms=2.0, p99_ms=4.0, max_ms=4.0, sent=3, lost=1)


def test_a_forwarders_delay_and_losses_are_found() -> None:
    """Uses the test itself as the forwarder: it holds each message for 5 ms, and drops every fourth."""
    writer, pipe = latency.in_process({}, latency_floor.write)
    source, target = latency.hear(pipe, 30.0)
    begin_ns, count = time.time_ns(), 40
    with socket.create_connection(("127.0.0.1", source)) as opened:
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            for number in range(count):
                data = opened.recv(latency_floor.MESSAGE.size)
                time.sleep(0.005)
                if number % 4:
                    sender.sendto(data, ("127.0.0.1", target))
            end_ns = latency_floor.MESSAGE.unpack(data)[0]
            arrivals = latency.answer(writer, pipe, "end", 30.0)
    found = latency_floor.spread_within(arrivals, begin_ns, end_ns)
    assert (found.sent, found.lost) == (count, count // 4)
    assert 5.0 <= found.p50_ms <= found.p99_ms <= found.max_ms


def test_the_chain_loses_nothing_and_ends() -> None:
    with latency_floor.running() as took:
        begin_ns = time.time_ns()
        time.sleep(0.5)
        found = took(begin_ns, time.time_ns())
    assert found.sent > 0 and found.lost == 0 and 0.0 < found.p50_ms <= found.max_ms
    assert multiprocessing.active_children() == []


def test_the_chain_ends_with_what_fails_beside_it() -> None:
    with pytest.raises(KeyboardInterrupt), latency_floor.running():
        raise KeyboardInterrupt
    assert multiprocessing.active_children() == []
