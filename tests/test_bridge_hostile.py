# SPDX-License-Identifier: MIT
"""Tests the UDP bridge under hostile traffic: it stays up, memory and counts are right; the robot obeys no garbage."""
import random
import socket
import time
from typing import Callable, Iterator, List, Tuple

import pytest
from bench import latency_controls, latency_sensors
from bridge_bench import Bench, resident_mb

from ardee_bridge.wire import codec
from ardee_common.ros_graph import RosGraph, wait_until

FLOOD_HZ = 10_000
FLOOD_S = 4.0


@pytest.fixture(scope="module")
def bench(shared_graph: RosGraph) -> Iterator[Bench]:
    """Yields simulator, robot, both nodes."""
    made = Bench(shared_graph)
    yield made
    made.close()


def random_bytes(rng: random.Random, count: int) -> bytes:
    """Returns this many random bytes."""
    return bytes(rng.choices(range(256), k=count))


def garbage(rng: random.Random) -> bytes:
    """Returns a datagram that is not part of a well-formed command."""
    motion_header, motion = codec.encode_motion(1.0, 1.0)
    choices = (
        lambda: random_bytes(rng, rng.randrange(0, 200)),
        lambda: random_bytes(rng, rng.randrange(1000, 60_000)) if rng.random() < 0.01 else b"",
        lambda: motion[: rng.randrange(0, len(motion))],
        lambda: motion_header[: rng.randrange(0, 20)],
        lambda: motion + random_bytes(rng, rng.randrange(1, 100)),
        lambda: codec.Header(msg_type=rng.choice((20, 99, -1, 2**31 - 1))).pack(),
        lambda: codec.Header(msg_type=6, data_type=rng.randrange(20, 99)).pack(),
        lambda: codec.encode_set_port([codec.DataType.ALL])[1],
    )
    return rng.choice(choices)()


def flood(
    make: Callable[[random.Random], bytes], ports: List[int], sender: str = "127.0.0.1"
) -> Tuple[int, float]:
    """Sends FLOOD_HZ datagrams a second to each port for FLOOD_S; returns the number to each, and the real rate."""
    rng, count, start = random.Random(4), 0, time.monotonic()
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        opened.bind((sender, 0))
        while count < FLOOD_HZ * FLOOD_S:
            datagram = make(rng)
            for port in ports:
                opened.sendto(datagram, ("127.0.0.1", port))
            count += 1
            if count % 100 == 0:
                time.sleep(max(0.0, start + count / FLOOD_HZ - time.monotonic()))
    return count, count / (time.monotonic() - start)


def dropped(bench: Bench, node: str) -> int:
    """Returns the number of all drops of a node so far."""
    return sum(n for name, n in bench.counters(node).items() if name.startswith("dropped: "))


def settled(bench: Bench, node: str) -> int:
    """Returns the same, once the node has processed its datagrams, and one datagram more.

    The system reports its drops for a full buffer with the next datagram that it delivers.
    """
    port = bench.server_port if node == "sensor_server_node" else bench.controls_port
    quiet(bench, node)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        opened.sendto(b"?", ("127.0.0.1", port))
    return quiet(bench, node)


def quiet(bench: Bench, node: str) -> int:
    """Returns a node's drops, once they grow no more."""
    counts = [-1, dropped(bench, node)]
    while counts[-1] != counts[-2]:
        counts.append(dropped(bench, node))
    return counts[-1]


def drives_by_command(bench: Bench) -> None:
    """Checks that the bridge still does its work."""
    client = bench.c_client("-v", "-0.3", "-t", "120")
    wait_until(lambda: bench.state().speed_m_s < -0.2, "it drives", 60.0)
    bench.interrupt_once_it_gets_scans(client)
    bench.standing_within(20.0)


def test_fuzzed_truncated_oversized_unknown(bench: Bench) -> None:
    drives_by_command(bench)
    nodes = {"sensor_server_node": bench.server, "controls_client_node": bench.controls}
    ports = [bench.server_port, bench.controls_port]
    flood(garbage, ports)  # caches and buffers reach their final size
    before = {name: settled(bench, name) for name in nodes}
    memory_mb = {name: resident_mb(node.pid) for name, node in nodes.items()}
    place = bench.state()
    obeyed = bench.counters("controls_client_node").get("motion commands obeyed", 0)
    sent, rate_hz = flood(garbage, ports)
    assert bench.alive()
    print(f"flood of {rate_hz:.0f} datagrams a second to each node")
    for name, node in nodes.items():
        fresh = settled(bench, name) - before[name] - 1
        # A header that waits for its data, before or after, does not count as dropped yet.
        assert abs(sent - fresh) <= 1, f"{name}: {fresh} of {sent} counted"
        assert resident_mb(node.pid) < memory_mb[name] + 5.0
    assert bench.counters("controls_client_node").get("motion commands obeyed", 0) == obeyed
    now = bench.state()
    assert abs(now.x_m - place.x_m) < 0.02 and abs(now.y_m - place.y_m) < 0.02
    drives_by_command(bench)


def test_wrong_peers_do_not_move_it_nor_hinder_the_right_one(bench: Bench) -> None:
    place = bench.state()
    commands = codec.encode_motion(1.0, 0.0)
    turn = iter(range(10**9))
    before = bench.counters("controls_client_node").get("dropped: sender is no peer", 0)
    port = bench.controls_port
    sent, _ = flood(lambda rng: commands[next(turn) % 2], [port], sender="127.0.0.66")
    settled(bench, "controls_client_node")
    counters = bench.counters("controls_client_node")
    overflowed = counters.get("dropped: receive buffer full", 0)
    assert sent - overflowed <= counters["dropped: sender is no peer"] - before <= sent
    now = bench.state()
    assert abs(now.x_m - place.x_m) < 0.02 and abs(now.y_m - place.y_m) < 0.02
    drives_by_command(bench)


def wait_for_answer(port: int) -> None:
    """Waits until a controls client has read all earlier datagrams; uses a port of its own and, with pairs, pairs."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        opened.settimeout(30.0)
        for datagram in codec.encode_control(codec.ControlCode.START):
            opened.sendto(datagram, ("127.0.0.1", port))
        opened.recv(64)


def test_shuffled_and_doubled_commands_are_obeyed_only_as_pairs(bench: Bench) -> None:
    rng = random.Random(6)
    before = bench.counters("controls_client_node").get("motion commands obeyed", 0)
    datagrams = [d for _ in range(500) for d in codec.encode_motion(0.0, 0.0)] * 2
    rng.shuffle(datagrams)
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as opened:
        for number, datagram in enumerate(datagrams):
            opened.sendto(datagram, ("127.0.0.1", bench.controls_port))
            if number % 100 == 99:
                wait_for_answer(bench.controls_port)
    settled(bench, "controls_client_node")
    # A pair is a header right before data: count them by this rule.
    is_header = [len(datagram) == codec.Header.size for datagram in datagrams]
    pairs = sum(first and not second for first, second in zip(is_header, is_header[1:]))
    counters = bench.counters("controls_client_node")
    assert counters["motion commands obeyed"] - before == pairs


def test_a_flood_of_good_commands_is_obeyed_and_memory_stays_flat(bench: Bench) -> None:
    commands = codec.encode_motion(0.0, 0.0)
    turn = iter(range(10**9))
    memory_mb = resident_mb(bench.controls.pid)
    flood(lambda rng: commands[next(turn) % 2], [bench.controls_port])
    settled(bench, "controls_client_node")
    assert bench.alive() and resident_mb(bench.controls.pid) < memory_mb + 5.0
    drives_by_command(bench)


def test_nothing_is_lost_at_full_rates() -> None:
    for kind, figures in latency_sensors.measure_sensors(seconds=5.0).items():
        assert figures.sent > 0 and figures.lost == 0, (kind, figures)
    figures = latency_controls.measure_controls(seconds=2.0)
    assert figures.sent == 200 and figures.lost == 0
