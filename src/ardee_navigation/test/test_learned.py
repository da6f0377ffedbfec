# SPDX-License-Identifier: MIT
"""Tests the network that finds crop rows, in a picture of a simulated field on which it did not learn."""
import json
import math
from pathlib import Path

import cv2
import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_navigation.training.pictures import SIZE_PX, heat_of, varied
from ardee_navigation.vision import VisionFollower, VisionParameters
from ardee_navigation.vision.camera import Camera
from ardee_navigation.vision.learned import NETWORK, Learned, RowHeat

DATA = Path(__file__).parent / "data"
SAMPLE = {
    "width_px": 320,
    "height_px": 224,
    "rows": [{"line_px": [[160.0 + m, 50.0], [160.0 + 100.0 * m, 149.0]]} for m in (-1, 0, 1)],
    "vanishing_point_px": [160.0, 49.0],
}


def test_a_simulated_lane_is_found() -> None:
    known = json.loads((DATA / "lane.json").read_text())
    camera = Camera(320, 224, known["focal_px"], known["height_m"], known["pitch_rad"])
    picture = cv2.imread(str(DATA / "lane.png"))[:, :, ::-1]
    sight = Learned(camera, known["lane_width_m"]).look(picture)
    assert math.degrees(sight.heading_rad - known["heading_rad"]) == pytest.approx(0.0, abs=3.0)
    assert sight.lateral_offset_m == pytest.approx(known["lateral_offset_m"], abs=0.06)
    assert sight.confidence > VisionParameters().min_confidence


def test_the_parameter_chooses_and_bare_ground_shows_no_lane() -> None:
    soil = np.full((240, 320, 3), (110, 80, 60), np.uint8)
    follower = VisionFollower(VisionParameters(estimator="learned"))
    output = follower.update(soil, 0.0)
    assert not output.is_valid
    with pytest.raises(ValueError, match="estimator: found 'magic', expected classical or learned"):
        VisionParameters(estimator="magic")


@pytest.mark.parametrize("name", ["none.onnx", "cut.onnx"])
def test_a_bad_network_is_one_line(name: str, tmp_path: Path) -> None:
    (tmp_path / "cut.onnx").write_bytes(NETWORK.read_bytes()[:50_000])
    with pytest.raises(GeneratorError, match=f"{name}: found no network, expected"):
        RowHeat(tmp_path / name)


def test_the_heat_lies_on_the_rows_and_turns_with_the_picture() -> None:
    heat = heat_of(SAMPLE)
    assert heat.shape == SIZE_PX[::-1]
    assert heat[60, 79:81].min() > 0.9 and heat[60, 98] < 0.1
    assert np.isnan(heat[26]).all() and not heat[10].any()
    picture = np.repeat((255 * np.nan_to_num(heat)).astype(np.uint8)[..., None], 3, axis=2)
    seen, moved = varied(picture, heat, np.random.default_rng(3))
    bright, dark = (seen[..., 1][part].mean() for part in (moved > 0.8, moved < 0.1))
    assert bright > dark + 60
