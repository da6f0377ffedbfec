# SPDX-License-Identifier: MIT
"""Tests that children start without input, write to their log, and end when told to."""
import signal
import subprocess
from pathlib import Path

import pytest

from ardee_common.process import HEED_CTRL_C, start_child, stop_child


def test_both_outputs_are_in_the_log(tmp_path: Path) -> None:
    child = start_child(["sh", "-c", "echo one; echo two >&2; exit 3"], log=tmp_path / "log")
    assert child.wait(10.0) == 3
    assert (tmp_path / "log").read_text() == "one\ntwo\n"


def test_a_child_ends_with_what_it_waits_for() -> None:
    command = ["sh", "-c", "sh -c 'echo ready; exec sleep 60'; true"]
    ignored = signal.signal(signal.SIGINT, signal.SIG_IGN)  # as in a background job
    child = start_child([*HEED_CTRL_C, *command], stdout=subprocess.PIPE, text=True)
    signal.signal(signal.SIGINT, ignored)
    assert child.stdout.readline() == "ready\n"
    stop_child(child)
    assert child.returncode == -signal.SIGINT
    assert child.communicate(timeout=10.0)[0] == ""  # no process holds the other end any more


def test_a_child_that_has_ended_is_left_alone() -> None:
    child = start_child(["true"])
    child.wait(10.0)
    stop_child(child)
    assert child.returncode == 0


PROGRAM = """import time
from ardee_common.process import end_by_signals, end_if_told, ignore_end_signals
end_by_signals()
try:
    end_if_told()
    print("ready", flush=True)
    try:
        time.sleep(60.0)
    except:
        pass  # as a library does that knows no signals
    end_if_told()
finally:
    ignore_end_signals()
    print("cleaned", flush=True)
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_a_signal_ends_a_program_through_its_clean_up(number: signal.Signals) -> None:
    env = {"PYTHONPATH": str(Path(__file__).resolve().parents[1] / "src")}
    # whoever runs the tests may have had nohup's
    command = ["/usr/bin/env", "--default-signal", "/usr/bin/python3", "-c", PROGRAM]
    child = start_child(command, env, stdout=subprocess.PIPE, text=True)
    assert child.stdout.readline() == "ready\n"
    child.send_signal(number)
    assert child.communicate(timeout=60.0)[0] == "cleaned\n"
    assert child.returncode == 128 + number
