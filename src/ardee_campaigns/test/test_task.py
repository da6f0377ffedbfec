# SPDX-License-Identifier: MIT
"""Tests when a person steps in and when a run is over, down a straight lane of 10 m."""
from typing import Iterable, List, Tuple

import numpy as np
import pytest

from ardee_campaigns.campaign_file import TaskKeys
from ardee_campaigns.task import END_OF_ROW, GIVEN_UP, OUT_OF_TIME, WENT_ON, Judge
from ardee_world.row_truth import Lane, Polyline, Pose

LANE = Lane(*(Polyline(np.array([[0.0, y], [10.0, y]])) for y in (0.5, -0.5, 0.0)))


def judged(xs: Iterable[float], *, finished_at_s: float = 1e9) -> Tuple[str, float, List[str]]:
    """Returns end and its time of a robot on the centre line, at one x after the other, and why a person stepped in."""
    judge, reasons = Judge(TaskKeys(most_interventions=3), LANE, limit_s=60.0), []
    for number, x_m in enumerate(xs):
        pose, time_s = Pose(x_m, 0.0, 0.0), number * 0.1
        why, _ = judge.look(time_s, pose, LANE.deviation(pose), time_s >= finished_at_s)
        reasons += [why] if why else []
        if judge.end:
            return judge.end, time_s, reasons
    raise AssertionError("the run did not end")


def until_m(stop_m: float) -> np.ndarray:
    """Returns places of a robot of 1 m/s that comes to x = 0 after 1 s, and stands from `stop_m` on."""
    return np.minimum(np.arange(-1.0, 99.0, 0.1), stop_m)


@pytest.mark.parametrize("stop_m", [9.6, 12.0])
def test_a_robot_that_stands_near_the_rows_end_has_ended(stop_m: float) -> None:
    """A program over UDP cannot say that it is finished."""
    end, time_s, reasons = judged(until_m(stop_m))
    assert (end, reasons) == (END_OF_ROW, [])
    assert time_s == pytest.approx(1.0 + stop_m + 2.0, abs=0.11)


def test_a_robot_that_says_so_has_ended_at_once() -> None:
    assert judged(until_m(9.6), finished_at_s=10.6) == (END_OF_ROW, pytest.approx(10.6), [])


def test_a_robot_that_stands_before_the_end_is_stuck_until_it_is_given_up() -> None:
    end, time_s, reasons = judged(until_m(5.0))
    assert (end, reasons) == (GIVEN_UP, ["stuck"] * 3)


def test_a_robot_that_goes_on_is_stopped_behind_the_row_or_at_the_limit() -> None:
    assert judged(until_m(99.0))[0] == WENT_ON
    assert judged(np.linspace(0.0, 9.0, 700))[0] == OUT_OF_TIME
