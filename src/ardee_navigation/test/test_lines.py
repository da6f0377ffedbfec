# SPDX-License-Identifier: MIT
"""Tests equations 5.1 and 5.2 and the numbers derived from a line."""
import math

import numpy as np
import pytest

from ardee_navigation.lane_following.line import Line
from ardee_navigation.lbirnt.lines import estimate, least_squares


def test_least_squares_by_hand() -> None:
    """The sums are n 3, sx 3, sy 6, sxx 5, sxy 9: m = (27 - 18) / (15 - 9) = 1.5, b = (30 - 27) / 6 = 0.5."""
    line = least_squares(np.array([[0.0, 1.0], [1.0, 1.0], [2.0, 4.0]]))
    assert line.slope == pytest.approx(1.5, abs=1e-12)
    assert line.offset_m == pytest.approx(0.5, abs=1e-12)


def test_points_on_a_line_give_the_line() -> None:
    x = np.linspace(-1.0, 2.0, 50)
    line = least_squares(np.column_stack((x, 0.1 * x - 0.38)))
    assert (line.slope, line.offset_m) == pytest.approx((0.1, -0.38), abs=1e-12)


@pytest.mark.parametrize("points", [[], [[1.0, 2.0]], [[1.0, 2.0], [1.0, 3.0]]])
def test_no_line_through_too_little(points: list) -> None:
    assert least_squares(np.array(points, dtype=float).reshape(-1, 2)) is None


def test_noise_moves_the_line_as_regression_theory_says() -> None:
    """In 2000 fits the standardised errors are N(0, 1): their variance lies in chi-square's 99.99 % interval."""
    rng, sigma, fits = np.random.default_rng(3), 0.02, 2000
    x = np.linspace(-1.0, 2.0, 60)
    slopes, offsets = [], []
    for _ in range(fits):
        y = 0.05 * x + 0.38 + sigma * rng.standard_normal(len(x))
        line = least_squares(np.column_stack((x, y)))
        slopes.append(line.slope - 0.05)
        offsets.append(line.offset_m - 0.38)
    sxx = ((x - x.mean()) ** 2).sum()
    sd_slope = sigma / math.sqrt(sxx)
    sd_offset = sigma * math.sqrt(1 / len(x) + x.mean() ** 2 / sxx)
    for errors, sd in ((slopes, sd_slope), (offsets, sd_offset)):
        z = np.array(errors) / sd
        assert abs(z.mean()) < 3.9 / math.sqrt(fits)
        assert abs(z.var() - 1.0) < 3.9 * math.sqrt(2.0 / fits)


def test_distance_is_orthogonal_and_signed() -> None:
    assert Line(0.75, -0.5).distance_m == pytest.approx(-0.4)  # 0.5 / sqrt(1 + 9/16)
    assert Line(0.75, 0.0).angle_rad == pytest.approx(math.atan(0.75))
    assert Line(0.75, -0.5).shifted(0.4).offset_m == pytest.approx(0.0)


def test_estimate_reads_all_of_a_line() -> None:
    """Uses a 3-4-5 line: x over 4 m, y over 3 m, 5 m long; residuals of +-0.1 m."""
    x = np.array([0.0, 0.0, 4.0, 4.0])
    y = 0.75 * x + 0.5 + np.array([0.1, -0.1, 0.1, -0.1])
    found = estimate(np.column_stack((x, y)), Line(0.0, 0.3))
    assert found.points == 4 and found.length_m == pytest.approx(5.0)
    assert found.deviation_m == pytest.approx(0.1)
    assert found.change_m == pytest.approx(0.4 - 0.3)
