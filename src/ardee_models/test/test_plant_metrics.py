# SPDX-License-Identifier: MIT
"""Tests figures of metrics.json against sums that are known."""

import numpy as np
import pytest

from ardee_models.plant.crops import generate_crop
from ardee_models.plant.plant_metrics import LANE_M, mid_lane_share
from ardee_models.plant.species import load_params


def test_the_share_of_azimuths_that_bring_a_point_into_the_middle_of_the_lane():
    assert mid_lane_share(np.array([0.0, LANE_M / 3.0])) == pytest.approx([0.0, 0.0])
    # 30 degrees from the row's direction at twice the nearer edge; there the farther edge is just reached.
    assert mid_lane_share(np.array([2.0 * LANE_M / 3.0])) == pytest.approx(2.0 / 3.0)
    azimuths = np.random.default_rng(1).uniform(0.0, 2.0 * np.pi, 200_000)
    across = np.abs(0.4 * np.sin(azimuths))
    expected = np.mean((across > LANE_M / 3.0) & (across < 2.0 * LANE_M / 3.0))
    assert mid_lane_share(np.array([0.4])) == pytest.approx(expected, abs=0.005)


def test_ageing_corn_has_more_of_its_leaves_near_the_ground():
    metrics = [generate_crop(load_params("corn", stage), 3).metrics for stage in ("VT", "R3", "R5")]
    low = [float(m["leaf_area_low_m2"]) / float(m["leaf_area_m2"]) for m in metrics]
    mean = [float(m["leaf_height_mean_m"]) for m in metrics]
    assert low[0] < low[1] < low[2] and mean[0] > mean[1] > mean[2]


def test_all_leaves_of_a_seedling_are_low():
    metrics = generate_crop(load_params("corn", "V3"), 3).metrics
    assert metrics["leaf_area_low_m2"] == metrics["leaf_area_m2"]
