# SPDX-License-Identifier: MIT
"""Tests when a person steps in and when a run is over, down a straight lane of 10 m."""
import math
from types import SimpleNamespace
from typing import Any, Iterable, List, Optional, Tuple

import numpy as np
import pytest
from ardee_sim import LidarReading

from ardee_campaigns.campaign_file import TaskKeys
from ardee_campaigns.outline import Contacts, rectangle
from ardee_campaigns.recorder import Recorder
from ardee_campaigns.task import END_OF_ROW, GIVEN_UP, OUT_OF_TIME, WENT_ON, Judge
from ardee_world.row_truth import Lane, Polyline, Pose, Stalks

LANE = Lane(*(Polyline(np.array([[0.0, y], [10.0, y]])) for y in (0.5, -0.5, 0.0)))


def judged(
    xs: Iterable[float], *, finished_at_s: Optional[float] = None, slowest_m_s: float = 0.0
) -> Tuple[str, float, List[str]]:
    """Returns end and its time of a robot on the centre line, at one x after the other, and why a person stepped in.

    finished_at_s : when the controller says that it is finished; None: never
    """
    keys = TaskKeys(most_interventions=3, slowest_m_s=slowest_m_s)
    judge, reasons = Judge(keys, LANE, limit_s=60.0), []
    for number, x_m in enumerate(xs):
        pose, time_s = Pose(x_m, 0.0, 0.0), number * 0.1
        is_finished = finished_at_s is not None and time_s >= finished_at_s
        why, _ = judge.look(time_s, pose, LANE.deviation(pose), is_finished)
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


def test_a_robot_that_would_say_so_but_stands_near_the_end_has_ended() -> None:
    """As one that a person set down where it finds no row any more."""
    assert judged(until_m(9.6), finished_at_s=1e9) == (END_OF_ROW, pytest.approx(12.6), [])


@pytest.mark.parametrize("period_s", [0.03, 0.033, 0.05, 0.7])
def test_a_robot_that_stands_is_noticed_at_any_period(period_s: float) -> None:
    """After 2 s, or at the first sample after them."""
    judge, pose = Judge(TaskKeys(), LANE, limit_s=60.0), Pose(5.0, 0.0, 0.0)
    stuck = (
        number * period_s
        for number in range(200)
        if judge.look(number * period_s, pose, LANE.deviation(pose), False)[0] == "stuck"
    )
    assert next(stuck) == pytest.approx(math.ceil(2.0 / period_s - 1e-6) * period_s)


def test_a_robot_that_is_off_the_lane_is_set_back_to_its_middle() -> None:
    judge = Judge(TaskKeys(), LANE, limit_s=60.0)
    for x_m, y_m, expected in ((4.0, 0.37, ""), (4.1, -0.39, "off the lane"), (9.6, 0.39, "")):
        pose = Pose(x_m, y_m, 0.1)
        why, back = judge.look(0.0, pose, LANE.deviation(pose), False)
        assert why == expected and bool(back) == bool(expected)
        assert not back or back == pytest.approx((4.1, 0.0, 0.0))
    stopped = judge.look(0.1, Pose(5.0, 0.1, 0.0), LANE.deviation(Pose(5.0, 0.1, 0.0)), True)
    assert stopped == ("stopped in the row", pytest.approx((5.5, 0.0, 0.0)))


def test_a_robot_that_stands_before_the_end_is_stuck_until_it_is_given_up() -> None:
    end, time_s, reasons = judged(until_m(5.0))
    assert (end, reasons) == (GIVEN_UP, ["stuck"] * 3)


def test_a_robot_that_goes_on_is_stopped_behind_the_row_or_at_the_limit() -> None:
    assert judged(until_m(99.0))[0] == WENT_ON
    slow = np.linspace(0.0, 9.0, 700)
    assert judged(slow)[:2] == (OUT_OF_TIME, pytest.approx(60.1))
    # 30 s, and 15 m at 1 m/s
    assert judged(slow, slowest_m_s=1.0)[:2] == (OUT_OF_TIME, pytest.approx(45.1))


def test_returns_are_kept_at_their_own_places() -> None:
    heading, pose = 0.1, Pose(4.0, 0.05, 0.1)
    robot: Any = SimpleNamespace(pace="scan", sensor_xyz_m=np.array([0.2, 0.0, 0.3]))
    stalks = Stalks(np.zeros((0, 2)), np.zeros(0))
    recorder = Recorder(LANE, robot, Contacts(rectangle(0.5, 0.4), stalks))
    lidar = np.array([4.0 + 0.2 * math.cos(heading), 0.05 + 0.2 * math.sin(heading)])
    x, y = (
        np.array([4.18, 0.40]) - lidar
    )  # a post nearly abeam of the lidar, unlike the second beam
    bearing, distance = math.atan2(y, x) - heading, math.hypot(x, y)
    ranges = np.array([distance, 0.4, math.inf], dtype=np.float32)
    scan = LidarReading(0, "", bearing, 0.0, 0.5, 0.0, 0.0, 0.0, 30.0, ranges, ranges)
    recorder.take(0, pose, LANE.deviation(pose), (0.5, 0.0), (0.4, 0.4), {"scan": scan})
    assert recorder.last("raw_along_m") == pytest.approx([4.18])
    assert recorder.last("raw_lateral_m") == pytest.approx([distance * math.sin(bearing)])
