# SPDX-License-Identifier: MIT
"""Tests the controls client's terminal lines about its commands (thesis 4.6.1)."""
from ardee_bridge.nodes.controls import STANDSTILL, Motion, what_was_obeyed


def test_counts_since_the_last_line_and_the_latest_motion():
    before = {"motion commands obeyed": 5, "PAUSE obeyed": 1}
    done = {"motion commands obeyed": 25, "PAUSE obeyed": 1, "watchdog stops": 1}
    line = what_was_obeyed(done, before, Motion(0.48, -0.315))
    assert line == (
        "motion commands obeyed: 20, watchdog stops: 1; last told 0.480 m/s, -0.315 rad/s"
    )


def test_nothing_new_is_not_said():
    done = {"motion commands obeyed": 5}
    assert what_was_obeyed(done, dict(done), STANDSTILL) == ""
    assert what_was_obeyed({}, {}, STANDSTILL) == ""
