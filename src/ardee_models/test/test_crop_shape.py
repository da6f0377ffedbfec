# SPDX-License-Identifier: MIT
"""Tests the parts of a plant in closed form."""

import dataclasses

import numpy as np
import pytest

from ardee_models.plant.curve import Curve
from ardee_models.plant.cylinder import fit_cylinder, fit_stalk_among_leaves
from ardee_models.plant.lathe import Lathe, lathe_mesh
from ardee_models.plant.leaf import (
    WHOLE,
    Blade,
    Shred,
    blade_mesh,
    midrib,
    profile_area,
    width_profile,
)
from ardee_models.plant.leaf_sizes import full_sizes, length_to_width, relative_leaf_area
from ardee_models.plant.mesh import tube
from ardee_models.plant.plan import grow
from ardee_models.plant.species import load_params
from ardee_models.plant.stalk import StalkPlan, ligule_heights, stalk_mesh


def _blade(**changes) -> Blade:
    values = dict(
        rank=1,
        origin=np.array([0.0, 0.0, 1.0]),
        azimuth_rad=0.0,
        azimuth_drift_rad=0.0,
        insertion_rad=0.5 * np.pi,
        curvature_rad=0.0,
        buckle_rad=0.0,
        buckle_at=0.5,
        twist_rad=0.0,
        fold_extra_rad=0.0,
        length_m=0.8,
        width_m=0.08,
        wave_phase_rad=0.0,
        dryness=0.0,
        strip=0,
        strips=4,
    )
    return Blade(**{**values, **changes})


def _flat(species="corn"):
    shape = load_params(species, {"corn": "V8", "tobacco": "button"}[species]).architecture.leaves
    return dataclasses.replace(
        shape, fold_base_deg=0.0, fold_blade_deg=0.0, edge_droop_deg=0.0, wave_amplitude=0.0
    )


def test_ligules_are_geometric_and_end_at_the_stalks_top():
    heights = ligule_heights(9, 1.1, 0.7)
    steps = np.diff(np.concatenate(([0.0], heights)))
    np.testing.assert_allclose(steps[1:] / steps[:-1], 1.1)
    assert heights[-1] == pytest.approx(0.7)
    np.testing.assert_allclose(ligule_heights(4, 1.0, 0.8), [0.2, 0.4, 0.6, 0.8])


def test_leaf_area_is_largest_at_its_rank_and_equals_skew_one_unit_away():
    ranks = np.linspace(0.0, 1.0, 1001)
    area = relative_leaf_area(ranks, 0.67, 0.0005)
    assert ranks[area.argmax()] == pytest.approx(0.67)
    assert area.max() == pytest.approx(1.0)
    # at d = -1 the exponent is ln(skew) (2 - 1)
    assert relative_leaf_area(np.array([-0.33]), 0.67, 0.0005)[0] == pytest.approx(0.0005)


def test_leaf_sizes_follow_the_area_function_and_the_shape_by_rank():
    shape = dataclasses.replace(load_params("tobacco", "button").architecture.leaves, length_cv=0.0)
    sizes = [full_sizes(24, 24, shape, np.random.default_rng(s)) for s in range(200)]
    mean = np.mean([length * width for length, width in sizes], axis=0)
    expected = relative_leaf_area(np.arange(1, 25) / 24, shape.rank_of_largest, shape.area_skew)
    np.testing.assert_allclose(mean / mean.max(), expected / expected.max(), rtol=0.04)
    length, width = sizes[0]
    np.testing.assert_allclose(length / width, length_to_width(np.arange(1, 25) / 24, shape))
    assert length_to_width(np.array([0.0, 0.5, 1.0]), shape).tolist() == pytest.approx(
        [shape.length_to_width_ends, shape.length_to_width, shape.length_to_width_ends]
    )


def test_straight_midrib_is_a_line_and_bent_one_is_an_arc():
    points, _ = midrib(_blade(), 1.0, 10)
    np.testing.assert_allclose(points[-1], [0.8, 0.0, 1.0], atol=1e-12)
    # curvature proportional to s: a circle of radius L / curvature; a quarter turn from upright
    points, _ = midrib(_blade(insertion_rad=0.0, curvature_rad=0.5 * np.pi), 1.0, 20)
    radius = 0.8 / (0.5 * np.pi)
    np.testing.assert_allclose(points[-1], [radius, 0.0, 1.0 + radius], atol=1e-4)
    lengths = np.linalg.norm(np.diff(points, axis=0), axis=1)
    assert lengths.sum() == pytest.approx(0.8, rel=1e-3)


def test_width_profile_starts_at_klig_and_peaks_at_s_wmax():
    s = np.array([0.0, 0.55, 1.0])
    np.testing.assert_allclose(width_profile(s, 0.6, 0.55, 1.6), [0.6, 1.0, 0.03])
    fine = np.linspace(0.0, 1.0, 20001)
    assert np.mean(width_profile(fine, 0.6, 0.55, 1.6)) == pytest.approx(
        profile_area(0.6, 0.55, 1.6), abs=1e-3
    )


@pytest.mark.parametrize(
    "species, stage, factor",
    [("corn", "V8", 0.75), ("sorghum", "6", 0.741), ("tobacco", "button", 0.6345)],
)
def test_outlines_have_the_area_factor_of_their_species(species, stage, factor):
    """See Montgomery; Shih et al. 1981; Suggs et al. 1960: area over length times width."""
    shape = load_params(species, stage).architecture.leaves
    area = profile_area(shape.blade_klig, shape.blade_s_wmax, shape.blade_tip_power)
    assert area == pytest.approx(factor, abs=0.015)


@pytest.mark.parametrize("species", ["corn", "tobacco"])
@pytest.mark.parametrize("columns", [2, 3, 5])
@pytest.mark.parametrize("segments", [4, 21])
def test_flat_blade_has_the_area_of_its_outline(species, columns, segments):
    shape = _flat(species)
    mesh = blade_mesh(_blade(), shape, segments, columns)
    outline = profile_area(shape.blade_klig, shape.blade_s_wmax, shape.blade_tip_power)
    assert mesh.area_m2() == pytest.approx(0.8 * 0.08 * outline)
    assert len(mesh.triangles) == 2 * segments * (columns - 1)
    up = np.tile([0.0, 0.0, 1.0], (len(mesh.normals), 1))
    np.testing.assert_allclose(mesh.normals, up, atol=1e-9)


def test_a_buckled_midrib_is_straight_before_and_behind_its_kink():
    blade = _blade(curvature_rad=0.0, insertion_rad=0.5, buckle_rad=0.8, buckle_at=0.5)
    _, tangents = midrib(blade, 1.5, 20)
    angles = np.arccos(tangents[:, 2])
    np.testing.assert_allclose(angles[:7], 0.5, atol=1e-3)
    np.testing.assert_allclose(angles[-7:], 1.3, atol=1e-3)


def test_dead_leaves_of_late_corn_hang_down_and_lie_on_the_ground():
    params = load_params("corn", "R5")
    for seed in range(10):
        shoot = grow(params, np.random.default_rng(seed)).main
        hanging = [b for b in shoot.blades if b.rank <= params.stage.lost_leaves]
        assert len(hanging) == params.stage.hanging_leaves
        for blade in hanging:
            points, _ = midrib(blade, 1.6, 400)
            low = max(points[0, 2] - 0.7 * blade.length_m, 0.01)
            assert 0.0 <= points[-1, 2] < low
            steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
            assert steps.sum() == pytest.approx(blade.length_m, rel=0.01)


def _torn(*edges, apart_from=0.5, ends_at=1.0, up_rad=0.0) -> tuple:
    return tuple(
        Shred(low, high, apart_from, ends_at, 0.0, 0.0 if low <= 0.0 <= high else up_rad)
        for low, high in zip(edges, edges[1:])
    )


def test_tears_alone_leave_the_blade_where_it_is():
    whole = blade_mesh(_blade(twist_rad=0.4, curvature_rad=1.0), _flat(), 10, 3)
    torn = blade_mesh(
        _blade(twist_rad=0.4, curvature_rad=1.0, shreds=_torn(-1.0, -0.3, 0.6, 1.0)), _flat(), 10, 3
    )
    assert torn.area_m2() == pytest.approx(whole.area_m2(), rel=2e-3)
    assert len(torn.triangles) == 2 * 10 * 4
    for corner in whole.vertices:
        assert np.linalg.norm(torn.vertices - corner, axis=1).min() < 1e-12


def test_a_shred_stands_off_beyond_its_tear_only_and_keeps_its_length():
    shreds = _torn(-1.0, -0.5, 1.0, apart_from=0.5, up_rad=np.radians(30.0))
    whole, mesh = blade_mesh(_blade(), _flat(), 10, 3), blade_mesh(
        _blade(shreds=shreds), _flat(), 10, 3
    )
    height = mesh.vertices[:, 2] - 1.0
    outer = np.arange(len(height)) < 2 * 11  # the first shred
    assert np.all(height[~outer] == 0.0)
    beyond = np.maximum(np.repeat(np.unique(np.round(whole.vertices[:, 0], 12)), 2) - 0.4, 0.0)
    np.testing.assert_allclose(height[outer], np.sin(np.radians(30.0)) * beyond, atol=1e-12)
    behind = mesh.vertices[outer, 0] - 0.4
    np.testing.assert_allclose(
        behind[beyond > 0.0], np.cos(np.radians(30.0)) * beyond[beyond > 0.0], atol=1e-12
    )


@pytest.mark.parametrize("species, stage", [("corn", "R5"), ("sorghum", "7")])
def test_no_shred_is_longer_than_its_blade(species, stage):
    params = load_params(species, stage)
    for seed in range(40):
        plan = grow(params, np.random.default_rng(seed))
        for blade in (b for shoot in (plan.main, *plan.tillers) for b in shoot.blades):
            mesh = blade_mesh(blade, params.architecture.leaves, 12, 3)
            away = np.linalg.norm(mesh.vertices - blade.origin, axis=1)
            assert away.max() < 1.02 * blade.length_m + blade.width_m


def test_a_broken_tip_is_gone():
    mesh = blade_mesh(_blade(shreds=_torn(-1.0, 1.0, ends_at=0.7)), _flat(), 10, 3)
    assert mesh.vertices[:, 0].max() == pytest.approx(0.7 * 0.8)


@pytest.mark.parametrize("species, stage", [("corn", "R5"), ("sorghum", "7")])
def test_old_and_dead_blades_are_torn_as_often_as_the_species_file_says(species, stage):
    params = load_params(species, stage)
    wear, dead, green = params.architecture.wear, [], []
    for seed in range(60):
        for blade in grow(params, np.random.default_rng(seed)).main.blades:
            tears = len(blade.shreds) - 1
            assert [s.low for s in blade.shreds[1:]] == [s.high for s in blade.shreds[:-1]]
            assert (blade.shreds[0].low, blade.shreds[-1].high) == (-1.0, 1.0)
            if blade.dryness > 0.98:
                dead.append(tears)
            elif blade.dryness < 0.02:
                green.append(tears)
    most = np.minimum(np.random.default_rng(1).poisson(wear.tears_dead, 100_000), 3)
    assert np.mean(dead) == pytest.approx(most.mean(), abs=5.0 * most.std() / len(dead) ** 0.5)
    assert 0.0 < np.mean(green) < wear.tears_green


def test_leaves_of_tobacco_do_not_tear():
    blades = grow(load_params("tobacco", "ripening"), np.random.default_rng(3)).main.blades
    assert all(blade.shreds == WHOLE for blade in blades)


def test_the_lower_leaves_of_tobacco_bend_down_and_the_upper_ones_do_not():
    params = load_params("tobacco", "flower")
    ends = []
    for seed in range(20):
        blades = grow(params, np.random.default_rng(seed)).main.blades
        for blade in (blades[2], blades[-3]):
            _, tangents = midrib(blade, params.architecture.leaves.curvature_power, 20)
            ends.append(np.degrees(np.arccos(tangents[-1, 2])))
    low, high = np.mean(ends[::2]), np.mean(ends[1::2])
    assert low > 150.0 and high < 110.0


def test_a_half_turn_of_twist_puts_the_tip_upside_down():
    mesh = blade_mesh(_blade(twist_rad=np.pi), _flat(), 40, 3)
    assert mesh.normals[1, 2] > 0.99 and mesh.normals[-2, 2] < -0.99


def test_texture_strips_do_not_overlap():
    spans = []
    for strip in range(4):
        u = blade_mesh(_blade(strip=strip), _flat(), 4, 3).texcoords[:, 0]
        spans.append((u.min(), u.max()))
    for strip, (low, high) in enumerate(spans):
        assert strip / 4 < low < high < (strip + 1) / 4


def test_tube_has_the_area_of_its_prism_and_outward_normals():
    centres = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.5], [0.0, 0.0, 1.0]])
    mesh = tube(centres, np.full(3, 0.1), np.array([0.0, 1.0, 0.0]), 6)
    assert mesh.area_m2() == pytest.approx(6 * 2 * 0.1 * np.sin(np.pi / 6) * 1.0)
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    faces = np.cross(b - a, c - a)
    outward = (a + b + c) / 3 * [1.0, 1.0, 0.0]
    assert (np.sum(faces * outward, axis=1) > 0).all()


def test_cone_has_its_area_and_no_empty_triangles():
    curve = Curve(np.zeros(3), 0.3, 0.0, 0.0, 0.4)
    mesh = lathe_mesh(Lathe(curve, (0.0, 1.0), (0.3, 0.0)), 60, 4)
    assert len(mesh.triangles) == 60
    assert mesh.area_m2() == pytest.approx(np.pi * 0.3 * 0.5, rel=2e-3)  # slant height 0.5


def test_curve_is_an_arc_of_its_length():
    curve = Curve(np.zeros(3), 0.5 * np.pi, 0.0, np.pi, 1.0)  # half a circle of radius 1 / pi
    end = curve.points(np.array([1.0]))[0]
    np.testing.assert_allclose(end, [0.0, 2.0 / np.pi, 0.0], atol=2e-3)
    bent = Curve(np.zeros(3), 0.0, 0.5, 0.1, 1.0, bend_m=0.2)
    assert bent.angle(np.array([0.2]))[0] == pytest.approx(0.1 + 0.4 / np.e)


def test_stalk_tapers_and_its_sheaths_stand_out():
    curve = Curve(np.zeros(3), 0.0, 0.0, 0.0, 1.0)
    plan = StalkPlan(curve, (0.5, 1.0), (True, False), 0.02, 0.01, 1.0, 0.001)
    mesh = stalk_mesh(plan, 6, 100)
    radii = np.linalg.norm(mesh.vertices[:, :2], axis=1)
    at = {round(z, 4): r for z, r in zip(mesh.vertices[:, 2], radii)}
    assert at[0.0] == pytest.approx(0.02) and at[1.0] == pytest.approx(0.01)
    assert at[0.49] == pytest.approx(0.0151 + 0.001) and at[0.5] == pytest.approx(0.015)


@pytest.mark.parametrize("lean", [(0.0, 0.0), (0.05, -0.03)])
def test_fitted_cylinder_is_the_one_the_points_were_taken_from(lean):
    axis = np.array([*lean, 1.0]) / np.linalg.norm([*lean, 1.0])
    side = np.cross(axis, [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    turn = np.linspace(0.0, 2.0 * np.pi, 12, endpoint=False)
    ring = 0.02 * (np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * np.cross(axis, side))
    points = np.concatenate([ring + z * axis + [0.1, 0.2, 0.0] for z in np.linspace(0, 1.5, 9)])
    fitted = fit_cylinder(points)
    assert fitted.radius_m == pytest.approx(0.02, rel=2e-3)
    assert fitted.length_m == pytest.approx(1.5, rel=2e-3)
    np.testing.assert_allclose(fitted.axis, axis, atol=5e-5)
    np.testing.assert_allclose(fitted.centre, [0.1, 0.2, 0.0] + 0.75 * axis, atol=1e-4)
    roll, pitch = fitted.roll_pitch()
    turned = [np.sin(pitch) * np.cos(roll), -np.sin(roll), np.cos(pitch) * np.cos(roll)]
    np.testing.assert_allclose(turned, fitted.axis, atol=1e-12)
    # Leaves round it do not shift it.
    leaves = np.random.default_rng(1).uniform([-0.4, -0.3, 0.3], [0.6, 0.7, 1.4], (200, 3))
    found = fit_stalk_among_leaves(np.concatenate((points, leaves)), 0.015)
    assert found.radius_m == pytest.approx(0.02, rel=0.1)
    assert found.length_m == pytest.approx(1.5, rel=0.02)


def test_corn_leaves_stand_in_two_ranks_and_tobacco_leaves_in_a_three_eighths_spiral():
    for species, stage, turn in (("corn", "VT", 180.0), ("tobacco", "flower", 135.0)):
        params = load_params(species, stage)
        steps = np.concatenate(
            [
                np.degrees(
                    np.diff(
                        [b.azimuth_rad for b in grow(params, np.random.default_rng(s)).main.blades]
                    )
                )
                for s in range(30)
            ]
        )
        # a leaf's own scatter enters the step before it and the step after it
        own = params.architecture.leaves.azimuth_sd_deg
        spread = np.hypot(params.architecture.phyllotaxy.sd_deg, np.sqrt(2.0) * own)
        assert steps.mean() == pytest.approx(turn, abs=4.0 * spread / np.sqrt(len(steps)))
        assert steps.std() == pytest.approx(spread, rel=0.15)
