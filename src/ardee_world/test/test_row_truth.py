# SPDX-License-Identifier: MIT
"""Tests truth files, lanes and deviations against closed forms."""
import json
import math
from pathlib import Path
from typing import List

import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_world.row_truth import Field, Polyline, Pose, Stalks, lane_of, read_field

NO_STALKS = Stalks(np.empty((0, 2)), np.empty(0))


def straight(y_m: float, backwards: bool = False) -> np.ndarray:
    row = np.array([[0.0, y_m], [10.0, y_m]])
    return row[::-1] if backwards else row


def test_lane_is_that_between_the_nearest_rows() -> None:
    rows = tuple(straight(y, backwards=y > 0) for y in (-1.143, -0.381, 0.381, 1.143))
    lane = lane_of(Field(rows, NO_STALKS), Pose(-1.0, 0.05, 0.1))
    seen = lane.deviation(Pose(4.0, 0.1, 0.2))
    assert seen.along_m == pytest.approx(4.0) and seen.lateral_m == pytest.approx(0.1)
    assert seen.heading_rad == pytest.approx(0.2)
    assert (seen.left_m, seen.right_m) == pytest.approx((0.281, 0.481))
    assert lane.centre.length_m == pytest.approx(10.0)


def test_the_same_lane_the_other_way() -> None:
    lane = lane_of(Field((straight(-0.4), straight(0.4)), NO_STALKS), Pose(11.0, 0.0, math.pi))
    seen = lane.deviation(Pose(7.0, 0.1, math.pi - 0.2))
    assert seen.along_m == pytest.approx(3.0) and seen.lateral_m == pytest.approx(-0.1)
    assert seen.heading_rad == pytest.approx(-0.2)
    assert (seen.left_m, seen.right_m) == pytest.approx((0.5, 0.3))


def test_before_and_behind_the_row_its_line_goes_on() -> None:
    lane = lane_of(Field((straight(-0.4), straight(0.4)), NO_STALKS), Pose(-1.0, 0.0, 0.0))
    assert lane.deviation(Pose(-1.0, 0.1, 0.0))[:2] == pytest.approx((-1.0, 0.1))
    assert lane.deviation(Pose(12.0, -0.1, 0.0))[:2] == pytest.approx((12.0, -0.1))


def test_rows_across_the_headland_are_no_lane() -> None:
    across = np.array([[-2.0, -5.0], [-2.0, 5.0]])
    field = Field((across, straight(-0.4), straight(0.4)), NO_STALKS)
    assert lane_of(field, Pose(-1.0, 0.0, 0.0)).deviation(Pose(1.0, 0.0, 0.0)).left_m == 0.4
    with pytest.raises(GeneratorError, match="found 1 rows on its left and 0 on its right"):
        lane_of(Field((straight(0.4),), NO_STALKS), Pose(-1.0, 0.0, 0.0))


def arc(radius_m: float) -> np.ndarray:
    angle = np.linspace(0.0, 1.5, 400)
    return np.column_stack(
        (radius_m * np.sin(angle), radius_m * (1.0 - np.cos(angle)) + 40 - radius_m)
    )


def test_lane_on_an_arc() -> None:
    """About the point (0, 40), half way is on radius 40, and the heading there is the angle travelled."""
    lane = lane_of(Field((arc(39.6), arc(40.4)), NO_STALKS), Pose(-1.0, 0.0, 0.0))
    angle, radius = 0.7, 39.9
    pose = Pose(radius * math.sin(angle), 40.0 - radius * math.cos(angle), angle + 0.1)
    seen = lane.deviation(pose)
    assert seen.along_m == pytest.approx(40.0 * angle, abs=0.02)
    assert seen.lateral_m == pytest.approx(0.1, abs=1e-3)
    assert seen.heading_rad == pytest.approx(0.1, abs=0.01)
    assert (seen.left_m, seen.right_m) == pytest.approx((0.3, 0.5), abs=1e-3)
    there = lane.centre.at(40.0 * angle)
    assert (there.x_m, there.yaw_rad) == pytest.approx((40 * math.sin(angle), angle), abs=0.01)


def test_projection_on_a_corner() -> None:
    line = Polyline(np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 2.0]]))
    assert line.project(1.0, 0.5) == pytest.approx((1.0, 0.5, 0.0))
    assert line.project(1.5, 1.2) == pytest.approx((3.2, 0.5, math.pi / 2))
    assert line.project(2.3, 1.0) == pytest.approx((3.0, -0.3, math.pi / 2))


def test_a_point_that_repeats_the_one_before_changes_nothing() -> None:
    line = Polyline(np.array([[0.0, 0.0], [0.0, 0.0], [2.0, 0.0], [2.0, 0.0], [2.0, 2.0]]))
    assert line.project(1.5, 1.2) == pytest.approx((3.2, 0.5, math.pi / 2))
    assert line.at(1.0) == pytest.approx((1.0, 0.0, 0.0)) and line.length_m == 4.0


def test_rows_of_one_plant_are_stalks_but_no_lane(tmp_path: Path) -> None:
    path = tmp_path / "truth.json"
    rows = [straight(0.4).tolist(), straight(-0.4).tolist(), [[5.0, 0.1]], [[5.0, 0.1]] * 2]
    path.write_text(_truth(rows))
    field = read_field(path)
    assert len(field.rows) == 2 and len(field.stalks.xy_m) == 1
    seen = lane_of(field, Pose(-1.0, 0.0, 0.0)).deviation(Pose(4.0, 0.1, 0.0))
    assert seen.lateral_m == pytest.approx(0.1)


def _truth(rows: List[list]) -> str:
    plants = {"world_x_m": [1.0], "world_y_m": [2.0], "stalk_diameter_m": [0.03]}
    return json.dumps({"rows": [{"world_line_m": row} for row in rows], "plants": plants})


def test_reads_a_truth_file(tmp_path: Path) -> None:
    path = tmp_path / "truth.json"
    path.write_text(_truth([[[0.0, 0.0], [1.0, 0.0]]]))
    field = read_field(path)
    assert len(field.rows) == 1 and field.stalks.radius_m.tolist() == [0.015]


@pytest.mark.parametrize("text", ["", "[]", "{}", '{"rows": 1}', _truth([[[0.0]]])])
def test_a_broken_truth_file_is_named(tmp_path: Path, text: str) -> None:
    path = tmp_path / "truth.json"
    path.write_text(text)
    with pytest.raises(GeneratorError, match="truth.json: "):
        read_field(path)
