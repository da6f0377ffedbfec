# SPDX-License-Identifier: MIT
"""Tests the technique on scans of rows in known places, and by driving a robot of unicycle kinematics."""
import math
from typing import List, Tuple

import numpy as np
import pytest
from scans import ANGLE_MIN_RAD, INCREMENT_RAD, lane_walls, scan_of

from ardee_navigation.lbirnt import Output, Parameters, RowFollower, State

P = Parameters()
DT_S = 0.025


def settle(ranges: np.ndarray, scans: int = 250, parameters: Parameters = P) -> Output:
    """Returns the output after a robot has stood before the same scene for a while (speed 0: nothing is predicted)."""
    still = RowFollower(Parameters(**{**vars(parameters), "speed_m_s": 0.0, "kp": 0.0, "kd": 0.0}))
    outputs = [still.update(ranges, ANGLE_MIN_RAD, INCREMENT_RAD, DT_S * i) for i in range(scans)]
    return outputs[-1]


@pytest.mark.parametrize(
    "lateral_m, heading_rad", [(0.0, 0.0), (0.08, 0.0), (-0.1, 0.0), (0.0, 0.12), (0.05, -0.15)]
)
def test_two_perfect_rows_are_found_where_they_are(lateral_m: float, heading_rad: float) -> None:
    output = settle(scan_of(*lane_walls(lateral_m, heading_rad)))
    assert output.valid == (True, True)
    assert output.lane.left.distance_m == pytest.approx(0.381 - lateral_m, abs=1e-6)
    assert output.lane.right.distance_m == pytest.approx(-0.381 - lateral_m, abs=1e-6)
    assert output.lane.centre.angle_rad == pytest.approx(-heading_rad, abs=1e-6)


@pytest.mark.parametrize("missing", [0, 1])
def test_one_row_missing_the_other_gives_the_lane(missing: int) -> None:
    walls = list(lane_walls(0.06, 0.05))
    del walls[missing]
    output = settle(scan_of(*walls))
    assert output.valid == (missing == 1, missing == 0)
    assert output.lane.centre.distance_m == pytest.approx(-0.06, abs=1e-6)
    assert output.lane.width_m == pytest.approx(0.762, abs=1e-6)


def test_noise_hardly_moves_the_centre() -> None:
    """With a range noise of 1 cm SD, 200 independent fits of the middle err by less than 5 mm RMS, none by 2 cm."""
    rng, errors = np.random.default_rng(11), []
    for _ in range(200):
        ranges = scan_of(*lane_walls(0.05, 0.0), noise=(rng, 0.01))
        one = RowFollower(Parameters(blend=1.0)).update(ranges, ANGLE_MIN_RAD, INCREMENT_RAD, 0.0)
        errors.append(one.lane.centre.distance_m + 0.05)
    assert math.sqrt(np.mean(np.square(errors))) < 0.005 and np.abs(errors).max() < 0.02


def test_leaves_before_the_stalks_are_left_out_by_the_histogram() -> None:
    """A quarter of the returns is at half the range: the bins beside the fullest do not hold them."""
    rng = np.random.default_rng(5)
    ranges = scan_of(*lane_walls(0.0, 0.0))
    ranges[rng.random(ranges.size) < 0.25] *= 0.5
    output = settle(ranges)
    assert output.lane.left.distance_m == pytest.approx(0.381, abs=0.01)
    assert output.lane.right.distance_m == pytest.approx(-0.381, abs=0.01)


def test_waits_until_it_sees_a_row() -> None:
    follower = RowFollower(P)
    nothing = np.full(1081, np.inf)
    for i in range(200):
        output = follower.update(nothing, ANGLE_MIN_RAD, INCREMENT_RAD, DT_S * i)
    assert output.state is State.WAITING and (output.speed_m_s, output.turn_rad_s) == (0.0, 0.0)
    output = follower.update(scan_of(*lane_walls(0.0, 0.0)), ANGLE_MIN_RAD, INCREMENT_RAD, 6.0)
    assert output.state is State.FOLLOWING and output.speed_m_s == P.speed_m_s


def test_ends_when_both_rows_are_gone_for_long_enough() -> None:
    follower, now_s = RowFollower(P), 0.0
    rows, nothing = scan_of(*lane_walls(0.0, 0.0)), np.full(1081, np.inf)

    def look(ranges: np.ndarray, duration_s: float) -> Output:
        nonlocal now_s
        for _ in range(round(duration_s / DT_S)):
            now_s += DT_S
            output = follower.update(ranges, ANGLE_MIN_RAD, INCREMENT_RAD, now_s)
        return output

    assert look(rows, 1.0).state is State.FOLLOWING
    assert look(nothing, P.end_after_s - 2 * DT_S).state is State.FOLLOWING
    assert look(rows, 0.1).state is State.FOLLOWING  # it was a gap
    end = look(nothing, P.end_after_s + 2 * DT_S)
    assert end.state is State.FINISHED and (end.speed_m_s, end.turn_rad_s) == (0.0, 0.0)
    assert look(rows, 1.0).state is State.FINISHED  # for good, until it is reset


def test_one_row_in_sight_is_not_the_end() -> None:
    follower = RowFollower(P)
    left = scan_of(lane_walls(0.0, 0.0)[0])
    states = [
        follower.update(left, ANGLE_MIN_RAD, INCREMENT_RAD, DT_S * i).state for i in range(400)
    ]
    assert set(states) == {State.FOLLOWING}


def look_once(follower: RowFollower, ranges: np.ndarray, time_s: float) -> Output:
    return follower.update(ranges, ANGLE_MIN_RAD, INCREMENT_RAD, time_s)


def turning_follower() -> Tuple[RowFollower, Output]:
    """Returns a follower that has turned right for a second, and its last output, of 1 s."""
    follower, rows = RowFollower(P), scan_of(*lane_walls(0.06, 0.05))
    outputs = [look_once(follower, rows, DT_S * i) for i in range(41)]
    assert outputs[-1].turn_rad_s < -0.05
    return follower, outputs[-1]


def test_through_a_short_gap_the_lane_is_moved_as_commanded() -> None:
    follower, before = turning_follower()
    after = look_once(follower, np.full(1081, np.inf), 1.0 + P.max_gap_s)
    turned_rad = before.turn_rad_s * P.max_gap_s
    assert after.lane.centre.slope == pytest.approx(before.lane.centre.slope - turned_rad)
    assert after.state is State.FOLLOWING and after.speed_m_s == P.speed_m_s


@pytest.mark.parametrize("gap_s", [P.max_gap_s + DT_S, 8.0, 600.0])
def test_after_a_long_gap_the_rows_are_found_as_at_the_start(gap_s: float) -> None:
    follower, fresh = turning_follower()[0], RowFollower(P)
    for i in range(20):
        rows, now_s = scan_of(*lane_walls(-0.05, 0.1 - 0.005 * i)), 1.0 + gap_s + DT_S * i
        after, anew = look_once(follower, rows, now_s), look_once(fresh, rows, now_s)
        assert (after.lane, after.valid) == (anew.lane, anew.valid)
        assert (after.speed_m_s, after.turn_rad_s) == (anew.speed_m_s, anew.turn_rad_s)


def test_after_a_long_gap_it_stands_until_it_sees_a_row_or_the_end() -> None:
    nothing, rows = np.full(1081, np.inf), scan_of(*lane_walls(0.0, 0.0))
    follower, _ = turning_follower()
    for i in range(10):
        after = look_once(follower, nothing, 3.0 + DT_S * i)
        assert after.state is State.FOLLOWING and (after.speed_m_s, after.turn_rad_s) == (0.0, 0.0)
    assert look_once(follower, rows, 3.25).speed_m_s == P.speed_m_s
    for i in range(30):  # does not count any more after the next gap
        assert look_once(follower, nothing, 3.275 + DT_S * i).state is State.FOLLOWING
    states = [look_once(follower, nothing, 6.0 + DT_S * i).state for i in range(45)]
    assert states.index(State.FINISHED) == pytest.approx(P.end_after_s / DT_S, abs=1)
    assert look_once(follower, rows, 60.0).state is State.FINISHED  # for good, gap or not


def drive(lateral_m: float, heading_rad: float, length_m: float = 12.0) -> List[List[float]]:
    """Drives a robot without slip from x = 0 to the length; returns x, lateral, heading after each scan."""
    follower, track = RowFollower(P), []
    x, y, yaw = -1.0, lateral_m, heading_rad
    for i in range(4000):
        lidar_x = x + P.lidar_ahead_m * math.cos(yaw)
        lidar_y = y + P.lidar_ahead_m * math.sin(yaw)
        walls = lane_walls(lidar_y, yaw, 0.762, -lidar_x, length_m - lidar_x)
        output = follower.update(scan_of(*walls), ANGLE_MIN_RAD, INCREMENT_RAD, DT_S * i)
        track.append([x, y, yaw])
        if output.state is State.FINISHED:
            break
        yaw += output.turn_rad_s * DT_S
        x += output.speed_m_s * DT_S * math.cos(yaw)
        y += output.speed_m_s * DT_S * math.sin(yaw)
    return track


@pytest.mark.parametrize("lateral_m, heading_rad", [(0.0, 0.0), (0.08, 0.05), (-0.1, -0.1)])
def test_drives_down_a_lane_and_stops_behind_it(lateral_m: float, heading_rad: float) -> None:
    track = np.array(drive(lateral_m, heading_rad))
    settled = track[(track[:, 0] > 4.0) & (track[:, 0] < 12.0)]
    assert np.abs(settled[:, 1]).max() < 0.01 and np.abs(settled[:, 2]).max() < 0.02
    gone_m = 12.0 - P.lidar_ahead_m + P.speed_m_s * P.end_after_s
    assert track[-1, 0] == pytest.approx(gone_m, abs=0.15)


def test_same_scans_same_commands() -> None:
    assert drive(0.05, 0.03) == drive(0.05, 0.03)
