# SPDX-License-Identifier: MIT
"""Tests that answers of another process are found by the time of their scan, without a wait for lost ones."""
import threading
import time

import pytest

from ardee_navigation.evaluation.answers import Answers

FOREVER_S = 60.0


def answer(time_s: float) -> dict:
    return {"time_s": time_s, "state": "following"}


def test_each_scan_gets_its_answer_once() -> None:
    answers = Answers()
    answers.put(answer(1.025))
    answers.put(answer(1.05))
    assert answers.take(1.025, FOREVER_S) == answer(1.025)
    assert answers.take(1.0500000001, FOREVER_S) == answer(1.05)
    assert answers.take(1.05, 0.0) is None


def test_an_answer_is_waited_for() -> None:
    answers = Answers()
    thread = threading.Timer(0.05, answers.put, [answer(2.0)])
    thread.start()
    assert answers.take(2.0, FOREVER_S) == answer(2.0)
    thread.join()


def test_a_lost_scan_is_not_waited_for_when_a_later_one_is_answered() -> None:
    answers, began_s = Answers(), time.monotonic()
    answers.put(answer(3.05))
    assert answers.take(3.0, FOREVER_S) is None and answers.take(3.025, FOREVER_S) is None
    assert answers.take(3.05, FOREVER_S) == answer(3.05)
    assert time.monotonic() - began_s < FOREVER_S


def test_earlier_answers_are_forgotten() -> None:
    answers = Answers()
    for number in range(100):
        answers.put(answer(0.025 * number))
    assert answers.take(5.0, 0.0) is None
    assert answers.take(0.025, 0.0) is None


def test_waiting_ends_when_the_process_has_ended() -> None:
    def ended() -> None:
        raise RuntimeError("it has ended")

    with pytest.raises(RuntimeError, match="it has ended"):
        Answers().take(1.0, FOREVER_S, ended)
