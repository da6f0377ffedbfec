# SPDX-License-Identifier: MIT
"""Tests what age and wind do to the leaves of a grown plant."""

import numpy as np
import pytest

from ardee_models.plant.leaf import midrib
from ardee_models.plant.plan import grow
from ardee_models.plant.species import load_params
from ardee_models.plant.wear import wear

SEEDS = 40


def _grown(species, stage):
    """Pairs of shoots before and after wear, and the parameters."""
    params = load_params(species, stage)
    pairs = []
    for seed in range(SEEDS):
        plan = grow(params, np.random.default_rng(seed))
        worn = wear(params, plan, np.random.default_rng(SEEDS + seed))
        pairs += zip((plan.main, *plan.tillers), (worn.main, *worn.tillers))
    return params, pairs


@pytest.mark.parametrize("species, stage", [("corn", "V4"), ("sorghum", "1"), ("tobacco", "L9")])
def test_a_green_plant_is_not_worn(species, stage):
    for before, after in _grown(species, stage)[1]:
        assert after.blades == before.blades and after.sheaths == ()


def test_dead_blades_shrivel_roll_up_and_lose_tips_as_often_as_asked():
    params, pairs = _grown("corn", "R5")
    shape = params.architecture.wear
    blades = [pair for b, a in pairs for pair in zip(b.blades, a.blades) if pair[0].dryness > 0.99]
    assert len(blades) > 100
    for before, after in blades:
        assert after.shrunk == pytest.approx(shape.dead_width, rel=0.02)
        assert after.fold_extra_rad >= before.fold_extra_rad
        assert shape.kept_min <= after.kept <= 1.0 and after.length_m == before.length_m
    lost = np.mean([after.kept < 1.0 for _, after in blades])
    assert lost == pytest.approx(shape.tip_loss, abs=4.0 * np.sqrt(0.25 / len(blades)))


@pytest.mark.parametrize("species, stage", [("corn", "R5"), ("sorghum", "9")])
def test_as_many_green_leaves_as_the_stage_has_hang_from_a_broken_midrib(species, stage):
    params, pairs = _grown(species, stage)
    counts = []
    for before, after in pairs:
        broken = [a for b, a in zip(before.blades, after.blades) if a.buckle_rad > b.buckle_rad]
        counts.append(len(broken))
        for blade in broken:
            assert blade.dryness < 0.6
            points, tangents = midrib(blade, params.architecture.leaves.curvature_power, 40)
            hangs = tangents[-1, 2] < np.cos(np.radians(110.0))
            assert hangs or points[-1, 2] < 0.01  # or it lies on the ground
    mean = params.stage.broken_leaves
    assert np.mean(counts) == pytest.approx(mean, abs=4.0 * np.sqrt(mean / len(counts)))


@pytest.mark.parametrize("species, stage", [("corn", "R5"), ("sorghum", "9")])
def test_a_peeled_sheath_stands_on_its_node_and_holds_its_blade(species, stage):
    params, pairs = _grown(species, stage)
    power, found = params.architecture.leaves.curvature_power, 0
    for _, after in pairs:
        blades = {blade.rank: blade for blade in after.blades}
        for sheath in after.sheaths:
            points, _ = midrib(sheath, power, 20)
            np.testing.assert_allclose(points[-1], blades[sheath.rank].origin, atol=1e-6)
            node_m = after.stalk.collars_m[sheath.rank - 2] if sheath.rank > 1 else 0.0
            foot = after.stalk.curve.points(np.array([node_m]))[0]
            assert np.linalg.norm(points[0] - foot) < 1.5 * after.stalk.base_radius_m
            assert not after.stalk.sheathed[sheath.rank - 1]
            found += 1
    assert found > 20
