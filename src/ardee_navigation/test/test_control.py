# SPDX-License-Identifier: MIT
"""Tests the PID against values computed by hand, the error, the turn command."""
import pytest

from ardee_navigation.lane_following.control import Pid, centre_error_m, turn_rate_rad_s
from ardee_navigation.lane_following.line import Line
from ardee_navigation.lbirnt import Parameters


def test_pid_by_hand() -> None:
    """Uses kp 25, ki 10, kd 5, dt 0.1: errors 0.1, 0.2, 0.2."""
    pid = Pid(25.0, 10.0, 5.0, 50.0)
    assert pid.update(0.1, 0.1) == pytest.approx(2.5 + 0.1)
    assert pid.update(0.2, 0.1) == pytest.approx(5.0 + 0.3 + 5.0)
    assert pid.update(0.2, 0.1) == pytest.approx(5.0 + 0.5 + 0.0)


def test_derivative_passes_a_low_pass() -> None:
    """Uses dt 0.1 and time constant 0.3: a quarter of each new slope passes."""
    pid = Pid(0.0, 0.0, 1.0, 50.0, 0.3)
    assert pid.update(0.0, 0.1) == 0.0
    assert pid.update(0.1, 0.1) == pytest.approx(0.25)
    assert pid.update(0.2, 0.1) == pytest.approx(0.25 + 0.25 * 0.75)


def test_output_and_integral_stop_at_the_limit() -> None:
    pid = Pid(25.0, 10.0, 0.0, 50.0)
    for _ in range(100):
        assert pid.update(10.0, 0.1) == 50.0
    assert pid.update(0.0, 0.1) == 0.0  # nothing was wound up
    assert pid.update(-10.0, 0.1) == -50.0


def test_error_is_where_the_centre_line_lies_ahead() -> None:
    assert centre_error_m(Line(0.1, 0.05), Parameters(target_ahead_m=0.8)) == pytest.approx(0.13)


def test_full_turn_is_full_speed_on_the_smallest_radius() -> None:
    p = Parameters()
    assert turn_rate_rad_s(50.0, p) == pytest.approx(1.2 / 0.381)
    assert turn_rate_rad_s(-25.0, p) == pytest.approx(-0.6 / 0.381)
