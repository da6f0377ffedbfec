# SPDX-License-Identifier: MIT
"""Arguments that the C client refuses; driving with it is tested with the whole bridge."""
import subprocess

import pytest


@pytest.fixture(scope="module")
def client(package, tmp_path_factory):
    """Returns the client, compiled as its own comment says."""
    program = tmp_path_factory.mktemp("client") / "ardee_client"
    source, include = package / "examples" / "ardee_client.c", package / "include"
    command = ["gcc", "-std=c11", "-O2", f"-I{include}", "-o", str(program), str(source)]
    subprocess.run(command, check=True)
    return program


def test_an_option_that_it_does_not_have_gets_those_it_has(client):
    run = subprocess.run([str(client), "-h"], capture_output=True, text=True)
    assert run.returncode == 2
    assert "usage: ardee_client [-i SIMULATOR] [-p PORT]" in run.stderr


@pytest.mark.parametrize("option", ["-v", "-w"])
@pytest.mark.parametrize("share", ["1.01", "-1e9", "nan", "fast", ""])
def test_a_speed_that_is_no_share_of_the_limit_is_refused(client, option, share):
    """Multiplied by a million it would not fit the datagram's integer."""
    command = [str(client), "-p", "0", "-c", "9", "-t", "0.1", option, share]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 2
    expected = f"ardee_client: found {share}, expected a share of the limit, -1 to 1\n"
    assert run.stderr == expected


@pytest.mark.parametrize("share", ["-1", "0", "1"])
def test_the_limits_themselves_are_allowed(client, share):
    command = [str(client), "-p", "0", "-c", "9", "-t", "0.1", "-v", share]
    assert subprocess.run(command).returncode == 0
