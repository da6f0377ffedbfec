# SPDX-License-Identifier: MIT
"""Closed-form checks of the parts a plant is made of."""

import numpy as np
import pytest

from ardee_models.grass import generate, ligule_heights, relative_leaf_area
from ardee_models.leaf import Blade, blade_mesh, midrib, width_profile
from ardee_models.mesh import tube
from ardee_models.params import load_params

STAGES = ("V4", "V6", "V8", "V10", "V12", "VT", "R2")


def _blade(**changes) -> Blade:
    values = dict(
        origin=np.array([0.0, 0.0, 1.0]),
        azimuth_rad=0.0,
        azimuth_drift_rad=0.0,
        insertion_rad=0.5 * np.pi,
        curvature_rad=0.0,
        length_m=0.8,
        width_m=0.08,
        wave_phase_rad=0.0,
    )
    return Blade(**{**values, **changes})


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
    np.testing.assert_allclose(width_profile(s, 0.6, 0.55), [0.6, 1.0, 0.03])


def test_flat_blade_has_the_area_of_its_outline():
    shape = load_params("corn", "V8").architecture
    flat = type(shape)(
        **{**vars(shape), "fold_base_deg": 0.0, "fold_blade_deg": 0.0, "wave_amplitude": 0.0}
    )
    mesh = blade_mesh(_blade(), flat, 40)
    s = np.linspace(0.0, 1.0, 41)
    width = 0.08 * width_profile(s, shape.blade_klig, shape.blade_s_wmax)
    assert mesh.area_m2() == pytest.approx(0.8 * np.sum((width[1:] + width[:-1]) / 2) / 40)
    np.testing.assert_allclose(
        mesh.normals, np.tile([0.0, 0.0, 1.0], (len(mesh.normals), 1)), atol=1e-9
    )


def test_tube_has_the_area_of_its_prism_and_outward_normals():
    centres = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.5], [0.0, 0.0, 1.0]])
    mesh = tube(centres, np.full(3, 0.1), np.array([0.0, 1.0, 0.0]), 6)
    assert mesh.area_m2() == pytest.approx(6 * 2 * 0.1 * np.sin(np.pi / 6) * 1.0)
    a, b, c = (mesh.vertices[mesh.triangles[:, i]] for i in range(3))
    faces = np.cross(b - a, c - a)
    outward = (a + b + c) / 3 * [1.0, 1.0, 0.0]
    assert (np.sum(faces * outward, axis=1) > 0).all()


@pytest.mark.parametrize("stage", STAGES)
@pytest.mark.parametrize("seed", range(3))
def test_every_stage_makes_a_sound_plant(stage, seed):
    plant = generate(load_params("corn", stage), np.random.default_rng(seed))
    assert 700 <= plant.triangle_count() <= 1500
    assert plant.leaf_area_m2() > 0.01
    for organ in plant.organs:
        mesh = organ.mesh
        assert np.isfinite(mesh.vertices).all()
        assert mesh.vertices[:, 2].min() >= 0.0
        assert mesh.triangles.max() == len(mesh.vertices) - 1
        np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=1e-9)
        assert mesh.texcoords.min() >= 0.0 and mesh.texcoords.max() <= 1.0


def test_plants_grow_with_the_stage_and_leaves_stand_in_two_ranks():
    plants = [generate(load_params("corn", stage), np.random.default_rng(5)) for stage in STAGES]
    heights = [plant.height_m() for plant in plants]
    assert heights[:6] == sorted(heights[:6])
    assert 0.35 < heights[0] < 0.6 and 1.9 < heights[-1] < 2.4
    # distichous: blades lie near one vertical plane, so the ground plan is much longer than wide
    points = np.concatenate([o.mesh.vertices for o in plants[5].organs if o.name == "LeavesMid"])
    spread = np.sqrt(np.linalg.eigvalsh(np.cov(points[:, :2].T)))
    assert spread[1] > 1.5 * spread[0]
