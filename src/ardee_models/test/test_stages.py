# SPDX-License-Identifier: MIT
"""Tests growth stages: every stage makes a sound plant; counts lie between their rows."""

import re

import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_models.plant.detail import LEVELS
from ardee_models.plant.generate_crop import stages_help
from ardee_models.plant.organ_meshes import assemble
from ardee_models.plant.plan import grow
from ardee_models.plant.species import known_species, load_params, load_species

STAGES = [(s, str(name)) for s in known_species() for name in load_species(s)[0].stages] + [
    ("corn", "V5"),
    ("corn", "V18"),
    ("sorghum", "V1"),
    ("sorghum", "V9"),
    ("tobacco", "L5"),
    ("tobacco", "L13"),
    ("tobacco", "D0"),
    ("tobacco", "D72"),
]


@pytest.mark.parametrize("species, stage", STAGES)
def test_every_stage_makes_a_sound_plant(species, stage):
    params = load_params(species, stage)
    for seed in range(2):
        plan = grow(params, np.random.default_rng(seed))
        for detail in LEVELS:
            plant = assemble(params, plan, detail)
            assert 30 <= plant.triangle_count() <= (2200 if detail is LEVELS[0] else 420)
            for organ in plant.organs:
                mesh = organ.mesh
                assert np.isfinite(mesh.vertices).all()
                assert mesh.vertices[:, 2].min() >= -0.005
                assert mesh.triangles.max() == len(mesh.vertices) - 1
                np.testing.assert_allclose(np.linalg.norm(mesh.normals, axis=1), 1.0, atol=1e-9)
                assert mesh.texcoords.min() >= 0.0 and mesh.texcoords.max() <= 1.0


def test_a_count_between_two_rows_lies_between_them():
    low, mid, high = (load_params("corn", stage).stage for stage in ("V8", "V9", "V10"))
    assert (low.collared_leaves, mid.collared_leaves, high.collared_leaves) == (8, 9, 10)
    assert mid.stalk_height_m == pytest.approx((low.stalk_height_m + high.stalk_height_m) / 2)
    day = load_params("tobacco", "D33").stage
    assert load_params("tobacco", "rosette").stage.stalk_height_m < day.stalk_height_m
    assert day.stalk_height_m < load_params("tobacco", "knee_high").stage.stalk_height_m


def test_visible_leaves_are_those_asked_for():
    for count in (6, 9, 12, 17, 22):
        stage = load_params("tobacco", f"L{count}").stage
        assert abs(stage.collared_leaves + stage.young_leaves - count) <= 1


def test_plants_grow_with_the_stage():
    for species, names in (
        ("corn", ("V2", "V4", "V6", "V8", "V10", "V12", "V15", "VT")),
        ("sorghum", ("0", "1", "2", "3", "4", "5", "6")),
        ("tobacco", ("transplant", "establishment", "rosette", "knee_high", "button", "flower")),
    ):
        heights = []
        for name in names:
            params = load_params(species, name)
            plan = grow(params, np.random.default_rng(3))
            heights.append(assemble(params, plan, LEVELS[0]).vertices()[:, 2].max())
        assert heights == sorted(heights)


def test_lower_leaves_die_first():
    for species, stage in (("corn", "R4"), ("sorghum", "8"), ("tobacco", "ripening")):
        blades = grow(load_params(species, stage), np.random.default_rng(1)).main.blades
        dryness = [blade.dryness for blade in blades]
        assert dryness == sorted(dryness, reverse=True)
        assert dryness[0] > 0.6 and dryness[-1] < 0.2
        assert blades[0].strip > blades[-1].strip


def test_help_lists_every_species_and_stage():
    text = stages_help()
    for species, stage in STAGES:
        line = re.search(rf"^  {species}: (.*)$", text, re.MULTILINE)[1]
        assert re.search(rf"\b{stage}\b", line) or re.fullmatch("[VLD][0-9]+", stage)
    assert "V1 to V18 (collared leaves)" in text


@pytest.mark.parametrize("stage", ["V0", "V19", "L8", "V", "", "v8", "R7", "V8.5", "D10"])
def test_unknown_stages_are_told_the_known_ones(stage):
    with pytest.raises(GeneratorError, match=r"unknown stage .* known: V1 to V18 .*VT R1 R2"):
        load_params("corn", stage)
