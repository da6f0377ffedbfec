# SPDX-License-Identifier: MIT
"""Arguments of the example clients, and how the C one counts; driving is tested with the whole bridge."""
import socket
import subprocess
import sys
import time

import pytest

from ardee_bridge.wire import chunks, codec


@pytest.fixture(scope="module")
def client(package, tmp_path_factory):
    """Returns the client, compiled as its own comment says."""
    program = tmp_path_factory.mktemp("client") / "ardee_client"
    source, include = package / "examples" / "ardee_client.c", package / "include"
    command = ["gcc", "-std=c11", "-O2", f"-I{include}", "-o", str(program), str(source)]
    subprocess.run(command, check=True)
    return program


@pytest.fixture(params=["C", "Python"])
def command(request, client, package):
    """Returns the command of either client."""
    is_c = request.param == "C"
    return [client] if is_c else [sys.executable, package / "examples" / "ardee_client.py"]


@pytest.mark.parametrize("option", ["-h", "--help"])
def test_help_lists_all_options_with_units_and_defaults(client, option):
    run = subprocess.run([str(client), option], capture_output=True, text=True)
    assert run.returncode == 0 and not run.stderr
    assert run.stdout.startswith("usage: ardee_client [--simulator ADDRESS] [--port PORT]")
    assert "--duration-s S       time until it ends (default 5)" in run.stdout


@pytest.mark.parametrize(
    "words, expected",
    [
        (["--sped", "1"], "unrecognized option '--sped'"),
        (["--port", "65536"], "ardee_client: found 65536, expected a port, 0 to 65535\n"),
        (["-t", "soon"], "ardee_client: found soon, expected a time in s, at least 0\n"),
        (["fast"], "ardee_client: found fast, expected an argument of --help\n"),
    ],
)
def test_a_word_without_meaning_is_refused_in_one_line(client, words, expected):
    run = subprocess.run([str(client), *words], capture_output=True, text=True)
    assert run.returncode == 2
    assert expected in run.stderr
    assert run.stderr.count("\n") == 1


@pytest.mark.parametrize(
    "words, expected",
    [
        ("--port 99999", "found 99999, expected a port, 0 to 65535"),
        ("--ask 99999", "found 99999, expected a port, 0 to 65535"),
        ("--controls 99999 --speed 0.1", "found 99999, expected a port, 0 to 65535"),
        ("--port 0", "--port: found 0, expected a port, or --ask too"),
        ("--duration-s nan", "found nan, expected a time in s, at least 0"),
        ("--duration-s=-1", "found -1, expected a time in s, at least 0"),
        ("--speed 1.5", "found 1.5, expected a share of the limit, -1 to 1"),
        ("--port 0 --ask 9 --simulator foo", "found foo, expected an IPv4 address"),
        ("--port 0 --ask 9 --group foo", "found foo, expected an IPv4 address"),
        ("--port 0 --ask 9 --group 10.0.0.1", "group"),
    ],
)
def test_a_bad_value_is_refused_in_one_line_by_both_clients(command, words, expected):
    run = subprocess.run([*command, *words.split()], capture_output=True, text=True)
    assert (run.returncode, run.stdout) == (2, "")
    assert run.stderr.startswith("ardee_client: ") and expected in run.stderr
    assert run.stderr.count("\n") == 1


def test_both_clients_understand_the_same_names(command):
    words = "--port 0 --ask 9 --controls 9 --speed 0.5 --duration-s 0"
    assert subprocess.run([*command, *words.split()]).returncode == 0


@pytest.mark.parametrize("option", ["-v", "-w"])
@pytest.mark.parametrize("share", ["1.01", "-1e9", "nan", "fast", ""])
def test_a_speed_that_is_no_share_of_the_limit_is_refused(client, option, share):
    """Multiplied by a million it would not fit the datagram's integer."""
    command = [str(client), "-p", "0", "-a", "9", "-c", "9", "-t", "0.1", option, share]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 2
    expected = f"ardee_client: found {share}, expected a share of the limit, -1 to 1\n"
    assert run.stderr == expected


@pytest.mark.parametrize("share", ["-1", "0", "1"])
def test_the_limits_themselves_are_allowed(client, share):
    command = [str(client), "-p", "0", "-a", "9", "-c", "9", "-t", "0.1", "-v", share]
    assert subprocess.run(command).returncode == 0


def test_an_image_counts_once_whatever_its_datagrams(client):
    """Two images of three datagrams each are two messages, as the Python client counts them."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    run = subprocess.Popen(
        [str(client), "-p", str(port), "-t", "2"], stdout=subprocess.PIPE, text=True
    )
    time.sleep(0.5)  # until it listens
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender:
        for sequence in (1, 2):
            head = codec.ImageChunk(chunk=codec.Chunk(sequence=sequence), width=10, height=30)
            for pair in chunks.split(codec.DataType.IMAGE, 4, head, bytes(900), 300):
                for datagram in pair:
                    sender.sendto(datagram, ("127.0.0.1", port))
    assert run.communicate()[0] == "image 4 count 2 width 10 height 30 bytes 900\n"
