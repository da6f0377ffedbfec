# SPDX-License-Identifier: MIT
"""Tests that the benchmark's receiver misses nothing and has the right arrival times in each way of waiting."""
import multiprocessing
import socket
import threading
import time
from typing import List

import pytest
from bench import latency

FRAME_BYTES = 65_000


@pytest.mark.parametrize("only_looks", [True, False])
@pytest.mark.parametrize("word", ["at once", "when nothing comes any more"])
def test_everything_is_received_with_its_time(
    only_looks: bool, word: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(latency, "SILENCE_S", 0.2)
    # Several datagrams wait for each look.
    monkeypatch.setattr(latency.kernel_clock, "LOOK_S", 0.05)
    # The receiver is a thread of the test, whose priority stays unchanged.
    monkeypatch.setattr(latency.priority, "go_next", lambda: only_looks)
    monkeypatch.setattr(latency.priority, "hurry", lambda: None)
    monkeypatch.setattr(latency, "_make_room", lambda opened: True)
    ours, theirs = multiprocessing.Pipe()
    kept = []  # type: List[latency.Datagram]
    receiver = threading.Thread(
        target=lambda: kept.extend(latency.receive_datagrams(theirs)), daemon=True
    )
    receiver.start()
    peer = ("127.0.0.1", latency.hear(ours, 10.0))
    sent_ns = []
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for number in range(10):
            sent_ns.append(time.time_ns())
            sender.sendto(bytes([number]) * (FRAME_BYTES if number % 2 else 20), peer)
            time.sleep(0.01)
    ours.send(word)
    receiver.join(10.0)
    assert not receiver.is_alive()
    assert [datagram.size for datagram in kept] == [20, FRAME_BYTES] * 5
    assert [datagram.beginning[0] for datagram in kept] == list(range(10))
    assert len(kept[1].beginning) == latency.KEPT_BYTES and len(kept[1].data()) == FRAME_BYTES
    # The kernel's times are in order, each before the next was sent.
    for datagram, before_ns, next_ns in zip(kept, sent_ns, sent_ns[1:] + [time.time_ns()]):
        assert before_ns <= datagram.at_ns <= next_ns


def test_a_socket_with_room_holds_several_frames() -> None:
    with latency.open_socket("127.0.0.1", 0) as opened:
        if not latency._make_room(opened):
            pytest.skip("this system allows no such buffer")
        opened.settimeout(5.0)
        with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
            chunks = 40
            for number in range(chunks):
                sender.sendto(bytes([number]) * FRAME_BYTES, opened.getsockname())
        assert [opened.recv(FRAME_BYTES)[0] for _ in range(chunks)] == list(range(chunks))
