# SPDX-License-Identifier: MIT
"""Tests that children start without input, write to their log, and end when told to."""
import signal
import subprocess
from pathlib import Path

from ardee_common.process import heed_ctrl_c, start_child, stop_child


def test_both_outputs_are_in_the_log(tmp_path: Path) -> None:
    child = start_child(["sh", "-c", "echo one; echo two >&2; exit 3"], log=tmp_path / "log")
    assert child.wait(10.0) == 3
    assert (tmp_path / "log").read_text() == "one\ntwo\n"


def test_a_child_ends_with_what_it_waits_for() -> None:
    options = dict(stdout=subprocess.PIPE, text=True, preexec_fn=heed_ctrl_c)
    child = start_child(["sh", "-c", "echo ready; sleep 60; true"], **options)
    assert child.stdout.readline() == "ready\n"
    stop_child(child)
    assert child.returncode == -signal.SIGINT
    assert child.communicate(timeout=10.0)[0] == ""  # no process holds the other end any more


def test_a_child_that_has_ended_is_left_alone() -> None:
    child = start_child(["true"])
    child.wait(10.0)
    stop_child(child)
    assert child.returncode == 0
