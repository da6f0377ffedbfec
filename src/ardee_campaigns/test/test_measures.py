# SPDX-License-Identifier: MIT
"""Tests measures of a run down a straight lane against closed forms."""
import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from ardee_campaigns import measures
from ardee_campaigns.campaign_file import TaskKeys
from ardee_campaigns.outline import Contacts, rectangle
from ardee_common.errors import GeneratorError
from ardee_world.row_truth import Field, Lane, Polyline, Pose, Stalks

ROWS = tuple(np.array([[0.0, y], [10.0, y]]) for y in (-1.5, -0.5, 0.5, 1.5))
STALKS = Stalks(np.array([[5.0, 0.5], [8.0, -0.5]]), np.array([0.01, 0.01]))
TRUTH: Any = SimpleNamespace(field=Field(ROWS, STALKS))
LANE = Lane(Polyline(ROWS[2]), Polyline(ROWS[1]), Polyline((ROWS[1] + ROWS[2]) / 2))


def recorded(y_m: Any, x_m: Any = None, **changes: Any) -> measures.Recorded:
    """Returns a run along x from -1 to 12 m in steps of 5 cm, 10 of them a second."""
    x = np.arange(-1.0, 12.0, 0.05) if x_m is None else np.asarray(x_m)
    y = np.broadcast_to(y_m, x.shape).astype(float)
    contacts = Contacts(rectangle(0.5, 0.4), STALKS)
    for place in zip(x, y):
        contacts.update(Pose(*place, 0.0))
    columns = {
        "time_ns": (np.arange(len(x)) * 100_000_000),
        "x_m": x,
        "y_m": y,
        "along_m": x,
        "lateral_m": y,
        "heading_rad": np.full(len(x), -0.1),
        "left_true_m": 0.5 - y,
        "right_true_m": 0.5 + y,
        "left_seen_m": 0.52 - y,
        "right_seen_m": 0.49 + y + np.where(np.arange(len(x)) % 2, 0.01, -0.01),
        "event": np.full(len(x), ""),
        "energy_j": np.linspace(0.0, 500.0, len(x)),
        **changes,
    }
    return measures.Recorded(columns, LANE, 1.0, contacts, TaskKeys(), "end of the row")


def value(name: str, run: measures.Recorded) -> float:
    return float(measures.find(name)(run, TRUTH))


@pytest.mark.parametrize(
    "name, expected",
    [
        ("way_m", 10.0),
        ("distance_m", 12.95),
        ("lateral_rms_m", 0.05),
        ("lateral_max_m", 0.05),
        ("share_near", 1.0),
        ("heading_rms_rad", 0.1),
        ("heading_max_rad", 0.1),
        ("row_width_m", 1.01),
        ("row_width_sd_m", 0.01),
        ("row_width_error_m", 0.01),
        ("left_error_m", 0.02),
        ("right_error_m", -0.01),
        ("interventions", 0.0),
        ("metres_per_intervention", 10.0),
        ("collisions", 0.0),
        ("completed", 1.0),
        ("time_s", 25.9),
        ("energy_j", 500.0),
        ("row_coverage", 1.0 / 3.0),
        ("fre_score_m", 10.0),
    ],
)
def test_a_straight_run_measures(name: str, expected: float) -> None:
    assert value(name, recorded(0.05)) == pytest.approx(expected, abs=0.011 * max(expected, 0.01))


def test_a_robot_beside_the_lane_touches_a_plant_and_pays_for_it() -> None:
    run = recorded(0.295)
    names = ("collisions", "plants_touched", "plants_knocked", "share_near")
    assert [value(name, run) for name in names] == [1, 1, 0, 0]
    assert value("fre_score_m", run) == pytest.approx(value("way_m", run) - 1.0)
    assert value("plants_knocked", recorded(0.33)) == 1


def test_a_robot_that_was_carried_did_not_drive_that_way() -> None:
    x = np.concatenate((np.arange(0.0, 4.0, 0.05), np.arange(6.0, 8.0, 0.05)))
    events = np.full(len(x), "", dtype="<U16")
    events[79] = "stuck"
    run = recorded(0.0, x, event=events)
    assert value("way_m", run) == pytest.approx(5.9)
    assert value("metres_per_intervention", run) == pytest.approx(5.9)


def test_a_way_is_driven_or_carried_whatever_its_length() -> None:
    fast = recorded(0.0, np.arange(-0.1, 12.0, 0.25))
    assert value("way_m", fast) == pytest.approx(10.0)
    assert value("distance_m", fast) == pytest.approx(12.0)
    events = np.full(81, "", dtype="<U16")
    events[40] = "off the lane"  # and carried for 5 cm, from 2 m on
    carried = recorded(0.0, np.linspace(0.0, 4.0, 81), event=events)
    assert value("way_m", carried) == pytest.approx(3.95)
    assert value("distance_m", carried) == pytest.approx(3.95)


def test_headlands_are_covered_by_a_robot_that_goes_there() -> None:
    assert value("headland_coverage", recorded(0.0, np.arange(3.0, 7.0, 0.05))) == 0.0
    across = np.concatenate([np.full(61, x) for x in np.arange(-2.0, 0.3, 0.25)])
    up_and_down = np.concatenate(
        [np.linspace(-1.5, 1.5, 61)[:: 1 - 2 * (k % 2)] for k in range(10)]
    )
    assert value("headland_coverage", recorded(up_and_down, across)) == pytest.approx(0.5)


def test_without_perception_or_way_there_is_no_number() -> None:
    blind = recorded(0.0, left_seen_m=np.full(260, math.nan))
    assert math.isnan(value("row_width_m", blind)) and math.isnan(value("row_width_sd_m", blind))
    assert math.isnan(value("lateral_rms_m", recorded(0.0, np.arange(-2.0, -1.0, 0.05))))


def test_a_measure_of_ones_own_is_found_by_module_and_function() -> None:
    assert measures.find("misbehaving:samples")({"time_ns": [1, 2]}, None) == 2
    assert measures.column("misbehaving:samples") == "samples"
    with pytest.raises(GeneratorError, match="did you mean 'lateral_rms_m'"):
        measures.find("lateral_rms")
