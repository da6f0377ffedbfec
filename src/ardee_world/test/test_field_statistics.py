# SPDX-License-Identifier: MIT
"""Tests the randomness of a field against its distributions. Bounds hold with probability 1 - 1e-6; seeds are fixed."""

import dataclasses

import numpy as np
import pytest
from scipy import stats

from ardee_common.errors import GeneratorError
from ardee_models.lookup import terrain_model
from ardee_world.field_config import FieldConfig, Plots, Stand
from ardee_world.field_layout import generate, to_world

RISK = 1e-6
LARGE = Plots(rows_per_plot=10, plots_x=4, row_length_m=0.166 * 499)
COVARIANCE = (4e-4, 3e-4, 9e-4)


def _field(pool, seed=1, **changes):
    return generate(FieldConfig(plots=LARGE, **changes), pool, seed)


def _offsets(layout):
    return layout.position_m[:, :2] - layout.planned.centres_m[layout.index]


def test_placement_noise_has_the_given_covariance(pool):
    offsets = _offsets(
        _field(pool, noise_covariance_m2=COVARIANCE, emergence_min=1, emergence_max=1)
    )
    n = len(offsets)
    assert n == 20_000
    covariance = np.array([[4e-4, 3e-4], [3e-4, 9e-4]])
    # whitened offsets: mean n|m|^2 ~ chi2(2); n variances ~ chi2(n); correlation by Fisher's z
    white = offsets @ np.linalg.inv(np.linalg.cholesky(covariance)).T
    assert n * (white.mean(0) ** 2).sum() < stats.chi2.ppf(1 - RISK, 2)
    low, high = stats.chi2.ppf([RISK / 2, 1 - RISK / 2], n)
    assert ((low < (white**2).sum(0)) & ((white**2).sum(0) < high)).all()
    assert abs(np.arctanh(np.corrcoef(white.T)[0, 1])) * np.sqrt(n - 3) < stats.norm.ppf(
        1 - RISK / 2
    )
    for axis in white.T:
        assert stats.kstest(axis, "norm").pvalue > RISK


def test_spacing_along_the_row_has_twice_the_variance_of_the_noise(pool):
    layout = _field(pool, emergence_min=1, emergence_max=1)
    y = layout.position_m[:, 1].reshape(-1, 500)
    spacing = y[:, :-1] - y[:, 1:]
    # Differences of neighbours are correlated by -1/2; every second one is independent.
    independent = spacing[:, ::2].ravel()
    n, variance = len(independent), 0.05**2
    error = stats.norm.ppf(1 - RISK / 2) * np.sqrt(variance / n)
    assert independent.mean() == pytest.approx(0.166, abs=error)
    low, high = stats.chi2.ppf([RISK / 2, 1 - RISK / 2], n)
    assert low < ((independent - 0.166) ** 2).sum() / variance < high


@pytest.mark.parametrize("bounds", [(0.9, 0.98), (0.2, 0.4), (0.5, 0.5)])
def test_emergence_is_binomial_with_the_mean_probability(pool, bounds):
    layout = _field(pool, emergence_min=bounds[0], emergence_max=bounds[1])
    low, high = stats.binom.ppf([RISK / 2, 1 - RISK / 2], 20_000, sum(bounds) / 2)
    assert low <= layout.count() <= high
    # Emergence does not depend on the place: runs test over places.
    stands = np.zeros(20_000, bool)
    stands[layout.index] = True
    p = stands.mean()
    runs = np.count_nonzero(np.diff(stands))
    error = stats.norm.ppf(1 - RISK / 2) * np.sqrt(2 * 20_000 * p * (1 - p))
    assert runs == pytest.approx(2 * 20_000 * p * (1 - p), abs=error)


def test_certain_and_impossible_emergence(pool):
    assert _field(pool, emergence_min=1, emergence_max=1).count() == 20_000
    assert _field(pool, emergence_min=0, emergence_max=0).count() == 0


def test_sizes_have_the_given_spread_and_late_plants_are_smaller(pool):
    def size(**stand):
        layout = _field(pool, stand=Stand(**stand))
        return layout.height_m / np.array([model.height_m for model in pool])[layout.model]

    spread = np.log(size(size_cv=0.08))
    assert (size() == 1.0).all()
    assert stats.kstest(spread / 0.08, "norm").pvalue > RISK  # the cut is far out
    late = size(late_emergence=0.1, late_size=0.6)
    small = late[late < 1.0]
    low, high = stats.binom.ppf([RISK / 2, 1 - RISK / 2], len(late), 0.1)
    assert low <= len(small) <= high
    assert stats.kstest(small, "uniform", args=(0.6, 0.4)).pvalue > RISK


def test_models_and_yaws_are_uniform(pool):
    layout = _field(pool)
    low, high = stats.binom.ppf([RISK / 2, 1 - RISK / 2], layout.count(), 0.5)
    assert low <= (layout.model == 0).sum() <= high
    assert stats.kstest((layout.yaw_rad + np.pi) / (2 * np.pi), "uniform").pvalue > RISK


def test_scaled_heights_lie_within_the_bounds(pool):
    layout = _field(pool, stalk_height_min_m=0.7, stalk_height_max_m=1.1)
    height = layout.scale * np.array([0.8, 1.2])[layout.model]
    np.testing.assert_allclose(height, layout.height_m)
    assert 0.7 <= height.min() and height.max() <= 1.1
    assert stats.kstest((height - 0.7) / 0.4, "uniform").pvalue > RISK


def test_without_a_height_models_keep_their_own(pool):
    layout = _field(pool)
    assert (layout.scale == 1.0).all()
    np.testing.assert_array_equal(layout.height_m, np.array([0.8, 1.2])[layout.model])


def test_streams_are_independent_of_each_other(pool):
    every = _field(pool, emergence_min=1, emergence_max=1)
    some = _field(pool, emergence_min=0.5, emergence_max=0.5, noise_covariance_m2=(0.0, 0.0, 0.0))
    np.testing.assert_array_equal(every.yaw_rad[some.index], some.yaw_rad)
    np.testing.assert_array_equal(every.model[some.index], some.model)
    np.testing.assert_array_equal(_offsets(some), 0.0)


def test_plants_stand_on_the_terrain(pool, models):
    terrain = terrain_model("ground", [models])
    config = FieldConfig()
    layout = generate(config, pool, 3, terrain)
    world = to_world(np.round(layout.position_m[:, :2], 4), config.world_pose)
    np.testing.assert_array_equal(
        layout.position_m[:, 2], terrain.height_at(world[:, 0], world[:, 1])
    )
    # Rows stand on their ridges: higher than the lane between them by most of a ridge.
    lane = terrain.height_at(world[:, 0], np.round(world[:, 1] / 0.762) * 0.762)
    assert 0.02 < np.mean(layout.position_m[:, 2] - lane) < 0.05


@pytest.mark.parametrize(
    "change, message",
    [
        ({"noise_covariance_m2": (1e-4, 2e-4, 1e-4)}, "noise covariance: .* positive definite"),
        ({"noise_covariance_m2": (-1e-4, 0.0, 1e-4)}, "noise covariance"),
        ({"noise_covariance_m2": (1e-4, 0.0, float("nan"))}, "noise covariance"),
        ({"emergence_max": 1.2}, "emergence max: found 1.2"),
        ({"emergence_min": 0.99}, "minimum 0.99 above maximum 0.98"),
        ({"stalk_height_min_m": 1.0}, "stalk height"),
        (
            {"stalk_height_min_m": 2.0, "stalk_height_max_m": 1.0},
            "stalk height: found minimum 2.0 above maximum 1.0 m",
        ),
        ({"origin_latitude_deg": 91.0, "origin_longitude_deg": 0.0}, "latitude: found 91.0"),
        ({"world_pose": (0.0, float("inf"), 0.0)}, "world pose"),
        ({"plots": Plots(rows_per_plot=-4)}, "rows per plot: found -4"),
        ({"plots": Plots(stalk_spacing_m=0.0)}, "stalk spacing: found 0.0"),
        ({"plots": Plots(row_length_m=float("nan"))}, "row length: found nan"),
        ({"plots": Plots(rows_per_plot=90_000, row_length_m=90_000.0)}, "planned plants"),
    ],
)
def test_bad_configurations_are_refused(pool, change, message):
    with pytest.raises(GeneratorError, match=message):
        generate(dataclasses.replace(FieldConfig(), **change), pool, 1)


def test_an_empty_pool_is_refused():
    with pytest.raises(GeneratorError, match="model pool"):
        generate(FieldConfig(), (), 1)
