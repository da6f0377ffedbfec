# SPDX-License-Identifier: MIT
"""Tests validity checks, line grade (equation 5.3) and update heuristics."""
import dataclasses
import math

import pytest

from ardee_navigation.lane_following.line import Line, turned
from ardee_navigation.lbirnt import Parameters
from ardee_navigation.lbirnt.lane import Lane, straight_lane, update_lane
from ardee_navigation.lbirnt.lines import Estimate
from ardee_navigation.lbirnt.validity import is_acceptable, leading_side, line_grade, valid_sides

P = Parameters(lane_width_m=0.76, blend=0.5, lane_width_tolerance_m=0.15)
LEFT = Estimate(Line(0.0, 0.38), 30, 2.0, 0.02, 0.0)
RIGHT = Estimate(Line(0.0, -0.38), 10, 1.0, 0.06, 0.03)
BEFORE = (Line(0.0, 0.38), Line(0.0, -0.38))


def changed(one: Estimate, **fields: object) -> Estimate:
    return dataclasses.replace(one, **fields)


def test_line_grade_by_hand() -> None:
    """The grade is 30/40 + 2/3 + (1 - 0.02/0.08) + (1 - 0/0.03) = 0.75 + 0.6667 + 0.75 + 1."""
    assert line_grade(LEFT, RIGHT) == pytest.approx(0.75 + 2 / 3 + 0.75 + 1.0)
    assert line_grade(LEFT, RIGHT) + line_grade(RIGHT, LEFT) == pytest.approx(4.0)


def test_grade_of_equal_perfect_lines_is_even() -> None:
    perfect = changed(LEFT, deviation_m=0.0, change_m=0.0)
    assert line_grade(perfect, perfect) == 2.0


@pytest.mark.parametrize(
    "fault",
    [
        {"points": P.min_points - 1},
        {"length_m": P.min_length_m - 0.01},
        {"line": Line(0.0, P.lateral_max_m + 0.01)},
        {"line": Line(0.0, P.lateral_min_m - 0.01)},
        {"line": Line(P.max_angle_rad + 0.1, 0.38)},
        {"line": Line(P.max_angle_change_rad + 0.01, 0.38)},
        {"change_m": P.max_change_m + 0.01},
    ],
)
def test_each_single_check_can_fail(fault: dict) -> None:
    assert is_acceptable(LEFT, BEFORE[0], P)
    assert not is_acceptable(changed(LEFT, **fault), BEFORE[0], P)


def test_without_a_line_before_any_angle_is_near_enough() -> None:
    steep = changed(LEFT, line=Line(P.max_angle_change_rad + 0.05, 0.38))
    assert not is_acceptable(steep, BEFORE[0], P) and is_acceptable(steep, None, P)


def test_of_two_lines_that_do_not_fit_the_better_graded_stays() -> None:
    near = changed(RIGHT, line=Line(0.0, -0.2))  # 0.58 m from the left one
    assert valid_sides(LEFT, RIGHT, BEFORE, P) == (True, True)
    assert valid_sides(LEFT, near, BEFORE, P) == (True, False)
    better = changed(near, points=90, length_m=3.0, deviation_m=0.001, change_m=0.0)
    assert valid_sides(changed(LEFT, change_m=0.1), better, BEFORE, P) == (False, True)
    crooked = changed(RIGHT, line=Line(0.15, -0.38))
    strict = dataclasses.replace(P, max_angle_between_rad=0.1)
    assert valid_sides(LEFT, crooked, BEFORE, strict) == (True, False)
    assert valid_sides(None, None, BEFORE, P) == (False, False)


def test_the_better_graded_leads_unless_the_other_led_by_less_than_the_bonus() -> None:
    assert leading_side(LEFT, RIGHT, 1, P) == 0 and leading_side(RIGHT, LEFT, 0, P) == 1
    grade = line_grade(LEFT, changed(LEFT, points=33))  # 0.5 - 30/63: 0.02 below the other's
    assert 4.0 - 2.0 * grade < P.lead_bonus
    for led in (0, 1):
        assert leading_side(LEFT, changed(LEFT, points=33), led, P) == led


def test_both_valid_keep_their_distances_and_take_the_direction_of_the_one_that_leads() -> None:
    tilted = changed(LEFT, line=Line(0.1, 0.40))
    lane = update_lane(Lane(*BEFORE), tilted, RIGHT, 0, P)  # half way to both lines of slope 0.1
    assert (lane.left.slope, lane.left.offset_m) == pytest.approx((0.05, 0.39))
    assert lane.right.slope == pytest.approx(0.05)
    assert lane.right.offset_m == pytest.approx((-0.38 - 0.38 * math.hypot(1.0, 0.1)) / 2)
    whole = dataclasses.replace(P, blend=1.0)
    lane = update_lane(Lane(*BEFORE), tilted, RIGHT, 1, whole)
    assert lane.left == Line(0.0, tilted.line.distance_m) and lane.right == BEFORE[1]


def test_one_valid_lays_the_other_a_lane_away() -> None:
    half = dataclasses.replace(P, blend=1.0)
    lane = update_lane(Lane(*BEFORE), changed(LEFT, line=Line(0.0, 0.30)), None, 0, half)
    assert lane.right.offset_m == pytest.approx(0.30 - 0.76)
    lane = update_lane(Lane(*BEFORE), None, changed(RIGHT, line=Line(0.0, -0.30)), 1, half)
    assert lane.left.offset_m == pytest.approx(-0.30 + 0.76)
    assert lane.width_m == pytest.approx(0.76)


def test_none_valid_keeps_the_lane() -> None:
    before = Lane(Line(0.1, 0.3), Line(0.1, -0.4))
    assert update_lane(before, None, None, 0, P) == before
    assert straight_lane(P).centre == Line(0.0, 0.0)


def test_centre_is_half_way() -> None:
    centre = Lane(Line(0.1, 0.5), Line(-0.02, -0.3)).centre
    assert (centre.slope, centre.offset_m) == pytest.approx((0.04, 0.1))


def test_a_turn_moves_a_line_as_geometry_says() -> None:
    """The lidar is 0.2 m ahead of the turning centre; a turn of 0.01 rad brings the line 2 mm nearer."""
    line = turned(Line(0.0, 0.38), 0.01, 0.5, 0.2)
    assert (line.slope, line.offset_m) == pytest.approx((-0.01, 0.378))
    assert turned(Line(0.1, 0.38), 0.0, 0.5, 0.2).offset_m == pytest.approx(0.43)
