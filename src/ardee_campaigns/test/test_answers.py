# SPDX-License-Identifier: MIT
"""Tests which command of a node answers a reading, and how processes and bags that are lost are told of."""
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any, Callable, List

import pytest
import small_campaign
from geometry_msgs.msg import Twist

from ardee_campaigns.campaign_file import read_campaign
from ardee_campaigns.plan import Planner
from ardee_campaigns.ros import answers, process
from ardee_campaigns.ros.answers import Answers, NeverQuiet
from ardee_campaigns.run_campaign import main

PERIOD_S = 0.005


@pytest.fixture
def made(monkeypatch: pytest.MonkeyPatch) -> Answers:
    """Returns answers of a node that is silent after 0.2 s."""
    monkeypatch.setattr(answers, "ANSWER_WITHIN_S", 0.2)
    monkeypatch.setattr(answers, "CATCH_UP_WITHIN_S", 2.0)
    return Answers(lambda: None)


def command(speed_m_s: float) -> Twist:
    twist = Twist()
    twist.linear.x = speed_m_s
    return twist


def node(made: Answers, readings: List[int], is_over: Callable[[], bool]) -> threading.Thread:
    """Starts a node that answers each reading by its number, the first one late."""

    def answer() -> None:
        done = 0
        while not is_over():
            if done < len(readings):
                time.sleep(0.01 if done else 0.4)
                made.put(command(readings[done]))
                done += 1
            time.sleep(0.001)

    thread = threading.Thread(target=answer, daemon=True)
    thread.start()
    return thread


def test_after_a_silence_a_command_answers_its_own_reading(made: Answers) -> None:
    readings: List[int] = []
    is_over = threading.Event()
    thread = node(made, readings, is_over.is_set)
    answered = []
    for number in range(1, 60):
        readings.append(number)
        made.take_answer(PERIOD_S)
        answered.append(made.latest[0])
    is_over.set()
    thread.join()
    late = [n for n, answer in enumerate(answered, 1) if answer != n]
    assert late == list(range(1, len(late) + 1)) and 5 < len(late) < 50


def test_a_node_that_commands_without_a_reading_is_told_of(made: Answers) -> None:
    made.take_answer(PERIOD_S)
    is_over = threading.Event()

    def publish() -> None:
        while not is_over.wait(0.02):
            made.put(command(1.0))

    thread = threading.Thread(target=publish, daemon=True)
    thread.start()
    with pytest.raises(NeverQuiet):
        for _ in range(20):
            made.take_answer(PERIOD_S)
    is_over.set()
    thread.join()


def test_a_process_that_is_killed_while_it_writes_is_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    def cut_short(_words: Any, *, preexec_fn: Any, **pipes: Any) -> Any:
        return subprocess.Popen(["head", "-c", "10"], start_new_session=True, **pipes)

    monkeypatch.setattr(process, "start_child", cut_short)
    with pytest.raises(process.Lost, match="exit code 0"):
        process.apart(print, "x" * 100)


@pytest.mark.slow
def test_a_bag_that_cannot_be_written_is_told_in_a_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    file = small_campaign.write(tmp_path, limit_sim_s=0.1)
    folder = tmp_path / "out"
    words = [str(file), "--output", str(folder), "--replay"]
    planned = Planner(read_campaign(file))
    run_id = planned.job(planned.cells[0], 0, folder).run_id

    def lost(*_: Any) -> None:
        raise process.Lost("its process ended with exit code -9")

    monkeypatch.setattr(process, "apart", lost)
    folder.mkdir()
    assert main([*words, run_id, "--bag"]) == 1
    assert (
        capsys.readouterr()
        .err.splitlines()[-1]
        .endswith("--bag: its process ended with exit code -9")
    )
    monkeypatch.setitem(sys.modules, "ardee_campaigns.ros.bag", None)
    assert main([*words, run_id, "--bag"]) == 2
    (line,) = capsys.readouterr().err.splitlines()  # refused before the replay
    assert line.startswith("run_campaign: --bag: found ") and "expected ROS" in line
