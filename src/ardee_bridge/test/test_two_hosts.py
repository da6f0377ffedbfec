# SPDX-License-Identifier: MIT
"""Tests traffic from one host to another: two network namespaces with a cable, and no default route."""
import contextlib
import ctypes
import os
import socket
import subprocess
import sys

import pytest
from sensor_msgs.msg import Image, Imu

from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.sensor_server import SensorServer
from ardee_bridge.nodes.settings import ServerSettings
from ardee_bridge.wire.udp import open_socket
from ardee_common.config import from_values

CLONE_NEWNET = 0x40000000  # <sched.h>
PORT, GROUP = 30000, "239.7.7.7"
SIMULATOR, TARGET, BROADCAST = "10.77.0.1", "10.77.0.2", "10.77.0.255"
NOBODY = "10.77.0.3"
EVERYBODY = "255.255.255.255"


def ip(*arguments):
    """Runs ip(8); skips the tests with its message if it fails."""
    try:
        done = subprocess.run(["ip", *arguments], capture_output=True, text=True, check=False)
    except FileNotFoundError:
        pytest.skip("no network namespaces: ip (iproute2) is not installed")
    if done.returncode:
        pytest.skip(f"no network namespaces (they need root): {done.stderr.strip()}")


@pytest.fixture(scope="module")
def hosts():
    """Yields names of two namespaces, the simulator's and the target's."""
    names = [f"ardee_{os.getpid()}_{role}" for role in ("simulator", "target")]
    made = []
    try:
        for name in names:
            ip("netns", "add", name)
            made.append(name)
        ends = [("netns", name, "name", "cable") for name in names]
        ip("link", "add", *ends[0][2:], *ends[0][:2], "type", "veth", "peer", *ends[1])
        for name, address in zip(names, (SIMULATOR, TARGET)):
            ip(
                "-n",
                name,
                "address",
                "add",
                f"{address}/24",
                "broadcast",
                BROADCAST,
                "dev",
                "cable",
            )
            ip("-n", name, "link", "set", "cable", "up")
        yield names
    finally:
        for name in made:
            ip("netns", "delete", name)


@contextlib.contextmanager
def inside(host):
    """Opens sockets of this thread in the host during the block."""
    libc = ctypes.CDLL(None, use_errno=True)
    with open("/proc/thread-self/ns/net") as home, open(f"/run/netns/{host}") as there:
        assert libc.setns(there.fileno(), CLONE_NEWNET) == 0, os.strerror(ctypes.get_errno())
        try:
            yield
        finally:
            assert libc.setns(home.fileno(), CLONE_NEWNET) == 0


@pytest.fixture(scope="module")
def clients(package, tmp_path_factory):
    """Returns commands of the two example clients for a second, with and without a group to join."""
    compiled = tmp_path_factory.mktemp("client") / "ardee_client"
    source, include = package / "examples" / "ardee_client.c", package / "include"
    subprocess.run(["cc", "-std=c11", "-I", include, "-o", compiled, source], check=True)
    python = (sys.executable, package / "examples" / "ardee_client.py")
    return {
        "C": (compiled, "-t", "1", "-i", SIMULATOR, "-g"),
        "Python": (*python, "--duration-s", "1", "--simulator", SIMULATOR, "--group"),
    }


def settings_for(peer, source):
    """Returns settings of a server that sends to this peer from this source."""
    values = dict(bind_address=SIMULATOR, port=0, allowed_clients=[TARGET], max_clients=0)
    values.update(client_lease_s=30.0, multicast_ttl=1)
    peers = [dict(address=peer, port=PORT, data_types=[source["kind"]])]
    return from_values(ServerSettings, dict(values, peers=peers, sources=[source]))


def sent_to(peer, hosts, command):
    """Returns the output of a client on the target while the server sends IMU messages to a peer, and its drops."""
    settings = settings_for(peer, dict(name="imu", kind="imu", topic="imu"))
    counters = Counters(lambda text: None)
    with inside(hosts[0]):
        opened = open_socket(SIMULATOR, 0)
    with opened:
        server = SensorServer(settings, opened, counters, lambda: None)
        entered = ["ip", "netns", "exec", hosts[1], *map(str, command)]
        with subprocess.Popen(entered, stdout=subprocess.PIPE, text=True) as client:
            while client.poll() is None:
                server.publish(settings.sources[0], Imu())
                server.receive(0.02)
            return client.stdout.read(), counters.dropped()


@pytest.mark.parametrize("language", ["C", "Python"])
def test_a_target_on_another_host_gets_what_is_sent_to_many(hosts, clients, language):
    joining = (*clients[language], GROUP)
    for peer, command in (
        (GROUP, joining),
        (BROADCAST, clients[language][:-1]),
        (EVERYBODY, clients[language][:-1]),
    ):
        said, dropped = sent_to(peer, hosts, command)
        assert said.startswith("imu 0 count ") and not dropped, (peer, said, dropped)


def test_who_has_not_joined_gets_nothing(hosts, clients):
    assert sent_to(GROUP, hosts, clients["C"][:-1]) == ("", {})


@pytest.mark.parametrize("language, options", [("C", "-i -v"), ("Python", "--simulator --speed")])
def test_a_client_without_a_way_to_the_simulator_says_so_and_goes_on(
    hosts, clients, language, options
):
    simulator, speed = options.split()
    command = (*clients[language][:-1], simulator, "203.0.113.1", speed, "0.1")
    entered = ["ip", "netns", "exec", hosts[1], *map(str, command)]
    run = subprocess.run(entered, stderr=subprocess.PIPE, text=True)
    said = run.stderr.splitlines()
    assert run.returncode == 0 and len(said) > 3
    for line in said:
        assert line.startswith("ardee_client: send") and line.endswith("Network is unreachable")


def test_what_a_full_send_buffer_does_not_take_is_counted(hosts):
    camera = dict(name="camera", kind="image", topic="camera", format="raw", chunk_bytes=1000)
    settings, counters = settings_for(NOBODY, camera), Counters(lambda text: None)
    with inside(hosts[0]):
        opened = open_socket(SIMULATOR, 0)
    image = Image(encoding="mono8", width=1000, height=1000, step=1000, data=bytes(1_000_000))
    with opened:
        opened.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, 50_000)
        server = SensorServer(settings, opened, counters, lambda: None)
        counts = []
        for _ in range(2):
            server.publish(settings.sources[0], image)
            counts.append(sum(counters.dropped().values()))
    assert list(counters.dropped()) == ["messages to a full send buffer"]
    # The system keeps the first ones until it is sure of no answer.
    assert 900 < counts[0] < 1000 and counts[1] == counts[0] + 1000
