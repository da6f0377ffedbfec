# SPDX-License-Identifier: MIT
"""Tests the steps from a scan to the points that a line is fitted to."""
import numpy as np
import pytest

from ardee_navigation.lbirnt import Parameters
from ardee_navigation.lbirnt.preprocess import (
    choose_subset,
    fullest_bin,
    keep_rectangle,
    split_sides,
    to_cartesian,
)


def test_polar_to_cartesian_drops_what_is_no_range() -> None:
    ranges = [1.0, np.inf, 2.0, np.nan, -np.inf, 0.0, 4.0]
    points = to_cartesian(np.array(ranges), 0.0, np.pi / 4)
    expected = [[1.0, 0.0], [0.0, 2.0], [0.0, -4.0]]  # beams at 0, 90 and 270 degrees
    assert points == pytest.approx(np.array(expected), abs=1e-12)


def test_left_and_right_of_the_robot() -> None:
    points = np.array([[1.0, 0.2], [1.0, -0.2], [-1.0, 0.1]])
    left, right = split_sides(points, 0.0, 0.0)
    assert left.tolist() == [[1.0, 0.2], [-1.0, 0.1]] and right.tolist() == [[1.0, -0.2]]


def test_left_and_right_of_a_slanted_line() -> None:
    left, right = split_sides(np.array([[2.0, 0.9], [2.0, 1.1]]), 0.5, 0.0)
    assert left.tolist() == [[2.0, 1.1]] and right.tolist() == [[2.0, 0.9]]


def test_rectangle_keeps_its_edges_and_nothing_beyond() -> None:
    p = Parameters(behind_m=1.0, ahead_m=2.0, beside_min_m=0.1, beside_max_m=0.5)
    inside = [[-1.0, 0.3], [2.0, -0.5], [0.0, 0.1]]
    outside = [[-1.01, 0.3], [2.01, 0.3], [0.0, 0.09], [0.0, -0.51]]
    assert keep_rectangle(np.array(inside + outside), p, 0.0).tolist() == inside


def test_rectangle_turns_with_the_rows() -> None:
    p = Parameters(beside_max_m=0.5)
    ahead_left = np.array([[1.5, 0.6]])  # 0.6 - 0.2 x 1.5 = 0.3 across a row of slope 0.2
    assert len(keep_rectangle(ahead_left, p, 0.0)) == 0
    assert len(keep_rectangle(ahead_left, p, 0.2)) == 1


def test_fullest_bin_by_hand() -> None:
    assert fullest_bin(np.array([0.05, 0.31, 0.39, 0.45]), 0.1) == 3
    assert fullest_bin(np.array([0.3]), 0.1) == 3  # 0.3 / 0.1 is 2.999... in floating point
    assert fullest_bin(np.array([0.15, 0.25]), 0.1) == 1  # a tie: the nearer


def test_subset_is_the_fullest_bin_and_its_neighbours() -> None:
    y = np.array([0.12, 0.25, 0.35, 0.36, 0.37, 0.45, 0.55])
    points = np.column_stack((np.zeros(7), -y))
    kept = choose_subset(points, Parameters(bin_m=0.1, keep_beside_m=0.1), 0.0)
    assert (-kept[:, 1]).tolist() == [0.25, 0.35, 0.36, 0.37, 0.45]
    alone = choose_subset(points, Parameters(bin_m=0.1, keep_beside_m=0.0), 0.0)
    assert (-alone[:, 1]).tolist() == [0.35, 0.36, 0.37]
    assert len(choose_subset(np.empty((0, 2)), Parameters(), 0.0)) == 0
