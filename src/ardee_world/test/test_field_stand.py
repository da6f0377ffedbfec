# SPDX-License-Identifier: MIT
"""Tests gaps, doubles, lodging and clutter against their distributions; bounds hold with probability 1 - 1e-6."""

import dataclasses

import numpy as np
import pytest
from PIL import Image
from scipy import stats
from scipy.spatial.transform import Rotation

from ardee_common.errors import GeneratorError
from ardee_models.lookup import CropModel
from ardee_world.centres import read_centres
from ardee_world.field_config import Clutter, FieldConfig, Plots, RowShape, Stand
from ardee_world.field_layout import generate

RISK = 1e-6
LARGE = Plots(rows_per_plot=10, plots_x=4, row_length_m=0.166 * 499)  # 20,000 places
CERTAIN = {"emergence_min": 1, "emergence_max": 1}
WEEDS = {"weed": (CropModel("weed_a", 0.1, 0.1, 10), CropModel("weed_b", 0.2, 0.1, 10))}


def _field(pool, seed=1, plots=LARGE, clutter_pools=None, **changes):
    return generate(FieldConfig(plots=plots, **changes), pool, seed, clutter_pools=clutter_pools)


def _bound(count, probability):
    return stats.binom.ppf([RISK / 2, 1 - RISK / 2], count, probability)


def test_gaps_are_as_many_and_as_long_as_asked(pool):
    layout = _field(pool, stand=Stand(gaps=200, gap_length_m=1.0), **CERTAIN)
    stands = np.zeros(20_000, bool)
    stands[layout.index] = True
    rows = stands.reshape(40, 500)
    assert rows[:, 0].all() and rows[:, -1].all()
    edges = np.diff(rows.astype(int), axis=1)
    starts, ends = np.argwhere(edges == -1), np.argwhere(edges == 1)
    assert len(starts) == len(ends) == len(layout.gaps) == 200
    assert (ends[:, 1] - starts[:, 1] == round(1.0 / 0.166)).all()
    # Any row is as likely as another, and any place in it.
    assert stats.chisquare(np.bincount(starts[:, 0], minlength=40)).pvalue > RISK
    assert stats.kstest(starts[:, 1] / 493.0, "uniform").pvalue > RISK


def test_more_gaps_than_there_is_room_for_are_refused(pool):
    with pytest.raises(GeneratorError, match="gaps: found 40 of 1 m, expected at most about"):
        _field(pool, plots=Plots(), stand=Stand(gaps=40))


def test_doubles_stand_beside_their_places_as_often_as_asked(pool):
    layout = _field(pool, stand=Stand(doubles=0.1, double_spacing_m=0.04), **CERTAIN)
    twins = layout.number >= 20_000
    low, high = _bound(20_000, 0.1)
    assert low <= twins.sum() <= high and (~twins).sum() == 20_000
    first = layout.position_m[layout.number[twins] - 20_000]
    np.testing.assert_allclose(
        layout.position_m[twins] - first, np.tile([0, -0.04, 0], (twins.sum(), 1)), atol=1e-12
    )
    assert (
        abs(np.corrcoef(layout.yaw_rad[twins], layout.yaw_rad[layout.number[twins] - 20_000])[0, 1])
        < 0.15
    )


def test_lodging_leans_as_many_plants_as_far_and_where_as_asked(pool):
    stand = Stand(
        lodging=0.5,
        lodging_angle_min_deg=30,
        lodging_angle_max_deg=60,
        lodging_direction_deg=40,
        lodging_direction_sd_deg=10,
    )
    layout = _field(pool, stand=stand, **CERTAIN)
    # The plant's own axis has this direction, by the angles in the file.
    top = Rotation.from_euler("xyz", layout.angles_rad).apply([0.0, 0.0, 1.0])
    tilt = np.degrees(np.arccos(top[:, 2].clip(-1, 1)))
    leans = tilt > 1.0
    low, high = _bound(20_000, 0.5)
    assert low <= leans.sum() <= high and (layout.angles_rad[~leans, :2] == 0.0).all()
    assert stats.kstest((tilt[leans] - 30.0) / 30.0, "uniform").pvalue > RISK
    towards = np.degrees(np.arctan2(top[leans, 1], top[leans, 0]))
    assert stats.kstest((towards - 40.0) / 10.0, "norm").pvalue > RISK
    np.testing.assert_allclose(tilt, np.degrees(layout.lean.tilt_rad), atol=1e-5)


def test_a_leaning_plant_is_turned_about_its_own_axis_by_its_yaw(pool):
    upright = _field(pool, **CERTAIN)
    leaning = _field(pool, stand=Stand(lodging=1.0), **CERTAIN)
    # Tilting back by the lean leaves the turn about the vertical.
    axis = np.column_stack(
        (-np.sin(leaning.lean.direction_rad), np.cos(leaning.lean.direction_rad), np.zeros(20_000))
    )
    back = Rotation.from_rotvec(-axis * leaning.lean.tilt_rad[:, None])
    rest = (back * Rotation.from_euler("xyz", leaning.angles_rad)).as_euler("xyz")
    error = (rest[:, 2] - upright.yaw_rad + np.pi) % (2 * np.pi) - np.pi
    np.testing.assert_allclose(error, 0.0, atol=1e-7)
    towards = (leaning.lean.direction_rad + np.pi) / (2 * np.pi)
    assert stats.kstest(towards, "uniform").pvalue > RISK


def test_weeds_are_poisson_and_even(pool):
    clutter = Clutter(weed_density_per_m2=5.0, weed_models=("weed_a", "weed_b"))
    layout = _field(pool, clutter=clutter, clutter_pools=WEEDS)
    items, heights = layout.clutter[0]
    low, high = (
        layout.planned.centres_m.min(axis=0) - 0.5,
        layout.planned.centres_m.max(axis=0) + 0.5,
    )
    mean = 5.0 * np.prod(high - low)
    assert len(heights) > 10_000
    bounds = stats.poisson.ppf([RISK / 2, 1 - RISK / 2], mean)
    assert bounds[0] <= len(heights) <= bounds[1]
    for share in ((items.xy_m - low) / (high - low)).T:
        assert stats.kstest(share, "uniform").pvalue > RISK
    assert stats.kstest((items.yaw_rad + np.pi) / (2 * np.pi), "uniform").pvalue > RISK
    some = _bound(len(heights), 0.5)
    assert some[0] <= items.model.sum() <= some[1]


@pytest.mark.parametrize("direction_deg", [-90.0, 30.0])
def test_an_edges_weeds_stand_beside_the_outer_rows(pool, direction_deg):
    clutter = Clutter(edge_weed_density_per_m2=20.0, clutter_margin_m=2.0, weed_models=("a",))
    shape = RowShape(row_direction_deg=direction_deg)
    layout = _field(pool, clutter=clutter, shape=shape, clutter_pools=WEEDS)
    forwards = layout.planned.along[0]
    axes = np.stack((forwards, [-forwards[1], forwards[0]]), axis=1)
    rows, weeds = layout.planned.centres_m @ axes, layout.clutter[0][0].xy_m @ axes
    low, high = rows.min(axis=0), rows.max(axis=0)
    count = stats.poisson.ppf([RISK / 2, 1 - RISK / 2], 20.0 * 4.0 * (high - low)[0])
    assert count[0] <= len(weeds) <= count[1]
    share = (weeds[:, 0] - low[0]) / (high - low)[0]
    right, left = low[1] - weeds[:, 1], weeds[:, 1] - high[1]
    beyond = np.maximum(right, left) / 2.0
    for values in (share, beyond):
        assert stats.kstest(values, "uniform").pvalue > RISK
    some = _bound(len(weeds), 0.5)
    assert some[0] <= np.sum(left > 0.0) <= some[1]


def test_an_image_says_where_weeds_grow(pool, tmp_path):
    pixels = np.zeros((4, 8), np.uint8)
    pixels[0, 7], pixels[3, 0] = 255, 51  # top right, bottom left
    Image.fromarray(pixels).save(tmp_path / "w.png")
    clutter = Clutter(
        weed_density_per_m2=50.0, weed_models=("a",), weed_image=str(tmp_path / "w.png")
    )
    layout = _field(pool, clutter=clutter, clutter_pools=WEEDS)
    xy = layout.clutter[0][0].xy_m
    low, high = (
        layout.planned.centres_m.min(axis=0) - 0.5,
        layout.planned.centres_m.max(axis=0) + 0.5,
    )
    share = (xy - low) / (high - low)
    bright = (share[:, 0] >= 7 / 8) & (share[:, 1] >= 3 / 4)
    dim = (share[:, 0] <= 1 / 8) & (share[:, 1] <= 1 / 4)
    assert (bright | dim).all()
    bounds = _bound(len(xy), 5 / 6)
    assert bounds[0] <= bright.sum() <= bounds[1]


CHANGES = {
    "lodging": {"stand": Stand(lodging=0.3)},
    "gaps": {"stand": Stand(gaps=10)},
    "doubles": {"stand": Stand(doubles=0.2)},
    "weeds": {"clutter": Clutter(weed_density_per_m2=1.0, weed_models=("a",))},
    "edge": {"clutter": Clutter(edge_weed_density_per_m2=1.0, weed_models=("a",))},
    "emergence": {"emergence_min": 0.5, "emergence_max": 0.6},
    "sizes": {"stand": Stand(size_cv=0.1, late_emergence=0.1)},
    "heights": {"stalk_height_min_m": 0.5, "stalk_height_max_m": 0.7},
    "noise": {"noise_covariance_m2": (1e-4, 0.0, 1e-4)},
}


@pytest.mark.parametrize("name", CHANGES)
def test_a_changed_argument_changes_only_what_it_names(pool, name):
    before = _field(pool)
    after = _field(pool, clutter_pools=WEEDS, **CHANGES[name])
    both, i, j = np.intersect1d(before.number, after.number, return_indices=True)
    assert len(both) > 9000
    same = {
        "positions": np.array_equal(before.position_m[i], after.position_m[j]),
        "angles": np.array_equal(before.angles_rad[i], after.angles_rad[j]),
        "heights": np.array_equal(before.height_m[i], after.height_m[j]),
        "models": np.array_equal(before.model[i], after.model[j]),
        "numbers": np.array_equal(before.number, after.number),
    }
    changed = {what for what, equal in same.items() if not equal}
    expected = {
        "lodging": {"angles"},
        "heights": {"heights"},
        "sizes": {"heights"},
        "noise": {"positions"},
        "weeds": set(),
        "edge": set(),
    }
    assert changed == expected.get(name, {"numbers"})


def test_more_weeds_leave_the_first_ones(pool):
    few, many = (
        _field(
            pool, clutter=Clutter(weed_density_per_m2=d, weed_models=("a",)), clutter_pools=WEEDS
        ).clutter[0][0]
        for d in (1.0, 2.0)
    )
    n = len(few.xy_m)
    np.testing.assert_array_equal(few.xy_m, many.xy_m[:n])
    np.testing.assert_array_equal(few.yaw_rad, many.yaw_rad[:n])


def test_noise_follows_bent_rows(pool):
    shape = RowShape(row_shape="curved", curve_radius_m=60.0)
    layout = _field(pool, shape=shape, noise_covariance_m2=(1e-6, 0.0, 4e-4), **CERTAIN)
    offsets = layout.position_m[:, :2] - layout.planned.centres_m[layout.index]
    along = np.einsum("ij,ij->i", offsets, layout.planned.along[layout.index])
    across = np.linalg.norm(offsets - along[:, None] * layout.planned.along[layout.index], axis=1)
    n = len(offsets)
    low, high = stats.chi2.ppf([RISK / 2, 1 - RISK / 2], n)
    assert low < (along**2).sum() / 4e-4 < high and low < (across**2).sum() / 1e-6 < high


def test_an_empty_clutter_costs_no_model(pool):
    config = dataclasses.replace(FieldConfig(), clutter=Clutter(weed_density_per_m2=0.0))
    assert generate(config, pool, 1).clutter == ()


def _own_rows(tmp_path, direction, plants=2000):
    """A plan of two rows that the file interleaves, in a direction of their own."""
    along, left = np.array(direction), np.array([-direction[1], direction[0]])
    lines = ["x_m,y_m,row"]
    for place in range(plants):
        for row in range(2):
            x, y = 0.2 * place * along + 0.8 * row * left
            lines.append(f"{x:.4f},{y:.4f},{row}")
    path = tmp_path / "own.csv"
    path.write_text("\n".join(lines) + "\n")
    return read_centres(path)


def test_gaps_of_interleaved_rows_are_whole_and_within_one_row(pool, tmp_path):
    plan = _own_rows(tmp_path, (0.0, -1.0), plants=50)
    config = FieldConfig(stand=Stand(gaps=4, gap_length_m=0.8), **CERTAIN)
    layout = generate(config, pool, 1, centres=plan)
    missing = np.setdiff1d(np.arange(100), layout.index)
    by_row = [plan.place[missing[plan.row[missing] == row]] for row in range(2)]
    runs = [
        run
        for places in by_row
        for run in np.split(places, np.flatnonzero(np.diff(places) > 1) + 1)
    ]
    # 0.8 m at these rows' own spacing of 0.2 m are 4 plants
    assert [len(run) for run in runs if len(run)] == [4, 4, 4, 4] and len(layout.gaps) == 4
    assert sorted(i for gap in layout.gaps for i in gap.places) == missing.tolist()


@pytest.mark.parametrize("direction", [(1.0, 0.0), (0.6, -0.8)])
def test_doubles_and_placement_noise_of_own_rows_turn_with_them(pool, tmp_path, direction):
    plan = _own_rows(tmp_path, direction)
    stand = Stand(doubles=0.5, double_spacing_m=0.03)
    noise = {"noise_covariance_m2": (1e-4, 0.0, 9e-4)}  # across, and three times as far along
    layout = generate(FieldConfig(stand=stand, **noise, **CERTAIN), pool, 1, centres=plan)
    twins = layout.number >= 4000
    beside = layout.position_m[twins] - layout.position_m[layout.number[twins] - 4000]
    expected = 0.03 * np.array([*direction, 0.0])
    np.testing.assert_allclose(beside, np.tile(expected, (twins.sum(), 1)), atol=1e-12)
    offsets = layout.position_m[~twins, :2] - plan.centres_m
    along = offsets @ direction
    across = offsets @ (-direction[1], direction[0])
    assert stats.kstest(along / 0.03, "norm").pvalue > RISK
    assert stats.kstest(across / 0.01, "norm").pvalue > RISK
