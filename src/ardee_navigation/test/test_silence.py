# SPDX-License-Identifier: MIT
"""Tests that a stop of the scans is detected by two clocks, either of which may stand still or run fast."""
from ardee_navigation.nodes.silence import Silence


def answered(simulated_s: float = 10.0, wall_s: float = 100.0) -> Silence:
    silence = Silence(0.5)
    silence.end(simulated_s, wall_s)
    return silence


def test_it_begins_once_and_anew_after_a_scan() -> None:
    silence = answered()
    assert not silence.begins(10.5, 100.5)
    assert [silence.begins(10.6 + i, 100.6 + i) for i in range(3)] == [True, False, False]
    silence.end(20.0, 110.0)
    assert not silence.begins(20.1, 110.1)
    assert silence.begins(20.6, 110.6)


def test_none_before_the_first_scan() -> None:
    assert not Silence(0.5).begins(1e9, 1e9)


def test_none_while_the_simulation_is_paused_or_slow() -> None:
    silence = answered()
    assert not silence.begins(10.0, 5000.0) and not silence.begins(10.3, 9000.0)


def test_none_while_a_scan_of_a_fast_simulation_is_on_its_way() -> None:
    assert not answered().begins(15.0, 100.3)


def test_a_clock_that_was_set_back_counts_from_there() -> None:
    silence = answered(simulated_s=1000.0)
    assert not silence.begins(0.2, 101.0) and not silence.begins(0.6, 101.4)
    assert silence.begins(0.8, 101.6)
