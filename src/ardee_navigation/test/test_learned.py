# SPDX-License-Identifier: MIT
"""Tests the network that finds crop rows, in a picture of a simulated field on which it did not learn."""
import json
import math
from pathlib import Path

import cv2
import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_navigation.training.pictures import HEAT_PX, SIZE_PX, Picture, heat_of
from ardee_navigation.training.variation import varied
from ardee_navigation.vision import VisionFollower, VisionParameters
from ardee_navigation.vision.camera import Camera
from ardee_navigation.vision.learned import NETWORK, Learned, RowHeat

DATA = Path(__file__).parent / "data"
# Three rows that meet at (80, 25), pixels of HEAT_PX; they lie 0.5 (v - 25) apart
ROWS = [np.array([[80.0 + 0.5 * m, 26.0], [80.0 + 43.0 * m, 111.0]]) for m in (-1, 0, 1)]


def test_a_simulated_lane_is_found() -> None:
    known = json.loads((DATA / "lane.json").read_text())
    camera = Camera(320, 224, known["focal_px"], known["height_m"], known["pitch_rad"])
    picture = cv2.imread(str(DATA / "lane.png"))[:, :, ::-1]
    sight = Learned(camera, known["lane_width_m"]).look(picture)
    assert math.degrees(sight.heading_rad - known["heading_rad"]) == pytest.approx(0.0, abs=3.0)
    assert sight.lateral_offset_m == pytest.approx(known["lateral_offset_m"], abs=0.06)
    assert sight.confidence > VisionParameters().min_confidence


def test_bare_ground_shows_no_lane() -> None:
    soil = np.full((240, 320, 3), (110, 80, 60), np.uint8)
    follower = VisionFollower()
    output = follower.update(soil, 0.0)
    assert not output.is_valid
    with pytest.raises(ValueError, match="estimator: found 'magic', expected classical or learned"):
        VisionParameters(estimator="magic")


def test_the_horizon_in_low_sun_is_no_lane() -> None:
    follower, picture = VisionFollower(), cv2.imread(str(DATA / "past_the_row.png"))[:, :, ::-1]
    output = follower.update(picture, 0.0)
    assert not output.is_valid and output.sight.confidence < VisionParameters().end_confidence


def test_the_network_stays_small_enough_to_be_committed() -> None:
    assert NETWORK.stat().st_size <= 2_000_000


@pytest.mark.parametrize("name", ["none.onnx", "cut.onnx"])
def test_a_bad_network_is_one_line(name: str, tmp_path: Path) -> None:
    (tmp_path / "cut.onnx").write_bytes(NETWORK.read_bytes()[:50_000])
    with pytest.raises(GeneratorError, match=f"{name}: found no network, expected"):
        RowHeat(tmp_path / name)


def test_the_heat_lies_on_the_rows() -> None:
    heat = heat_of(ROWS)
    assert heat.shape == HEAT_PX[::-1]
    assert heat[90, 79:81].min() > 0.9 and heat[90, 96] < 0.1  # in the lane, 16 of 33 pixels off
    sigma = 0.14 * 0.5 * (90.5 - 25.0)
    assert heat[90, 84] == pytest.approx(math.exp(-0.5 * (4.5 / sigma) ** 2), rel=0.02)
    assert np.isnan(heat[31]).all() and not heat[10].any()  # rows 3 pixels apart; above the horizon
    assert not heat_of([]).any()
    assert np.isnan(heat_of(ROWS[:1])).all()  # a row alone does not tell how wide it is


def test_the_heat_turns_with_the_picture() -> None:
    heat = cv2.resize(heat_of(ROWS), SIZE_PX)
    grey = np.repeat((255 * np.nan_to_num(heat)).astype(np.uint8)[..., None], 3, axis=2)
    rows = [2.0 * line for line in ROWS]
    picture = Picture(grey, (heat > 0.5).astype(np.uint8), rows, np.array([160.0, 50.0]))
    rng = np.random.default_rng(3)
    for _ in range(20):
        seen, moved = varied(picture, rng)
        assert seen.shape == (*SIZE_PX[::-1], 3) and moved.shape == HEAT_PX[::-1]
        small = cv2.resize(seen, HEAT_PX, interpolation=cv2.INTER_AREA).mean(axis=2)
        bright, dark = (small[part].mean() for part in (moved > 0.8, moved < 0.1))
        assert bright > dark + 10
