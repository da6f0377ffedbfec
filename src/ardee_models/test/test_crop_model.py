# SPDX-License-Identifier: MIT
"""Tests that written model directories are consistent, and that the same seed gives the same bytes."""

import functools
import json
import re
import xml.etree.ElementTree as ElementTree

import collada
import numpy as np
import pytest
from PIL import Image

from ardee_models.lookup import crop_model
from ardee_models.plant.crops import make_crop
from ardee_models.plant.variants import build_crops, load_variants

VARIANTS = list(load_variants())


@functools.lru_cache(maxsize=None)
def _dae(model, suffix=""):
    return collada.Collada(str(model / "meshes" / f"{model.name}{suffix}.dae"))


def _primitives(model, suffix=""):
    nodes = _dae(model, suffix).scene.nodes
    return {node.id: node.children[0].geometry.primitives[0] for node in nodes}


def _metrics(model):
    return json.loads((model / "metrics.json").read_text())


def _area(primitive):
    a, b, c = (primitive.vertex[primitive.vertex_index[:, k]].astype(float) for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def test_there_are_the_thesis_models():
    names = [
        f"{s}_variant_{i}"
        for s, n in (("corn", 22), ("sorghum", 9), ("tobacco", 9))
        for i in range(1, n + 1)
    ]
    assert VARIANTS == names


@pytest.mark.slow
def test_every_species_has_early_mid_and_late_season(share):
    seasons = {}
    for name in VARIANTS:
        data = _metrics(share / "models" / name)
        assert name.startswith(data["species"])
        assert data["label"] == {"corn": 1, "sorghum": 2, "tobacco": 3}[data["species"]]
        seasons.setdefault(data["species"], set()).add(data["season"])
    assert all(found == {"early", "mid", "late"} for found in seasons.values())


@pytest.mark.parametrize("name", VARIANTS)
def test_metrics_are_those_of_the_mesh(share, name):
    model = share / "models" / name
    metrics, primitives = _metrics(model), _primitives(model)
    vertices = np.concatenate([p.vertex for p in primitives.values()])
    assert vertices[:, 2].max() == pytest.approx(metrics["height_m"], abs=2e-5)
    np.testing.assert_allclose([vertices.min(0), vertices.max(0)], metrics["bounds_m"], atol=2e-5)
    assert np.linalg.norm(vertices[:, :2], axis=1).max() == pytest.approx(
        metrics["lateral_extent_m"], abs=2e-5
    )
    assert sum(map(len, primitives.values())) == metrics["triangles"]
    leaves = sum(_area(p) for n, p in primitives.items() if n.startswith("Leaves"))
    assert leaves == pytest.approx(metrics["leaf_area_m2"], rel=2e-3)
    assert metrics["leaf_area_index"] == pytest.approx(
        metrics["leaf_area_m2"] * metrics["density_per_m2"], abs=1e-3
    )
    assert 0.0 <= metrics["green_leaf_area_m2"] <= metrics["leaf_area_m2"]
    found = crop_model(name, [share / "models"])
    assert (found.height_m, found.label) == (metrics["height_m"], metrics["label"])


@pytest.mark.parametrize("name", VARIANTS)
def test_levels_of_detail(share, name):
    model = share / "models" / name
    full, coarse = _primitives(model), _primitives(model, "_lod1")
    assert 700 <= sum(map(len, full.values())) <= 2200
    assert 60 <= sum(map(len, coarse.values())) <= 320
    assert full.keys() == coarse.keys()
    leaves = [
        sum(_area(p) for n, p in level.items() if n.startswith("Leaves"))
        for level in (full, coarse)
    ]
    assert leaves[1] == pytest.approx(leaves[0], rel=0.12)
    tops = [max(p.vertex[:, 2].max() for p in level.values()) for level in (full, coarse)]
    assert tops[1] == pytest.approx(tops[0], rel=0.08)
    assert _metrics(model)["triangles_lod1"] == sum(map(len, coarse.values()))


@pytest.mark.parametrize("name", VARIANTS)
def test_collision_cylinder_lies_on_the_stalk(share, name):
    model = share / "models" / name
    collision = ElementTree.parse(model / "model.sdf").find(".//collision")
    length = float(collision.findtext("geometry/cylinder/length"))
    radius = float(collision.findtext("geometry/cylinder/radius"))
    x, y, z, roll, pitch, yaw = map(float, collision.findtext("pose").split())
    # SDF rotates about x by roll, then about y by pitch.
    axis = [np.sin(pitch) * np.cos(roll), -np.sin(roll), np.cos(pitch) * np.cos(roll)]
    offsets = _primitives(model)["Stem"].vertex - [x, y, z]
    along = offsets @ axis
    radii = np.linalg.norm(offsets - along[:, None] * axis, axis=1)
    assert yaw == 0.0
    assert radius == pytest.approx(radii.mean(), abs=5e-5)
    # Taper and sheaths bound the distance of vertices from the cylinder.
    assert np.abs(radii - radius).max() < 0.75 * radius
    assert along.max() == pytest.approx(length / 2, abs=1e-4)
    assert along.min() == pytest.approx(-length / 2, abs=1e-4)
    assert collision.findtext("max_contacts") == "10"


@pytest.mark.parametrize("name", VARIANTS)
def test_every_name_in_the_sdf_leads_to_something(share, name):
    model = share / "models" / name
    root = ElementTree.parse(model / "model.sdf").getroot()
    assert root.find("model").get("name") == name
    nodes = {node.id: node.xmlnode.get("name") for node in _dae(model).scene.nodes}
    script = (model / "materials/scripts" / f"{name}.material").read_text()
    visuals = root.findall(".//visual")
    submeshes = [visual.findtext("geometry/mesh/submesh/name") for visual in visuals]
    assert sorted(submeshes) == sorted(nodes.values())
    assert {"stem", "leavesb", "leavesm", "leavest"} <= {visual.get("name") for visual in visuals}
    for visual in visuals:
        assert visual.findtext("geometry/mesh/uri") == f"model://{name}/meshes/{name}.dae"
        material = visual.findtext("material/script/name")
        assert material.startswith(f"{name}/")
        assert re.search(rf"^material {material}$", script, re.MULTILINE)
        for uri in visual.findall("material/script/uri"):
            assert (model.parent / uri.text[len("model://") :]).is_dir()
    assert script.count("cull_hardware none") == script.count("cull_software none") == len(visuals)
    for texture in re.findall(r"texture (\S+\.png)", script):
        with Image.open(model / "materials/textures" / texture) as image:
            image.load()
            assert np.array(image).std() > 3.0


def test_material_and_texture_names_are_each_models_own(share):
    """Gazebo keeps one table of materials and one of textures for all models."""
    found = []
    for name in VARIANTS:
        script = (share / "models" / name / "materials/scripts" / f"{name}.material").read_text()
        found += re.findall(r"^material (\S+)$", script, re.MULTILINE)
        found += set(re.findall(r"texture (\S+\.png)", script))
    assert len(found) == len(set(found))


@pytest.mark.parametrize("suffix", ["", "_lod1"])
@pytest.mark.parametrize("name", ["corn_variant_8", "sorghum_variant_9", "tobacco_variant_7"])
def test_collada_header_and_texture_references(share, name, suffix):
    model = share / "models" / name
    doc = _dae(model, suffix)
    assert doc.assetInfo.upaxis == "Z_UP" and doc.assetInfo.unitmeter == 1.0
    assert doc.images
    for image in doc.images:
        assert (model / "meshes" / image.path).is_file()


def test_organs_of_each_species_appear_with_their_stage(share):
    organs = {name: set(_primitives(share / "models" / name)) for name in VARIANTS}
    assert not {"Tassel", "Ears"} & organs["corn_variant_3"]
    assert {"Tassel", "Ears", "Roots"} <= organs["corn_variant_8"]
    assert "Panicle" not in organs["sorghum_variant_6"]
    assert {"Panicle", "Tillers"} <= organs["sorghum_variant_9"]
    assert "Flowers" in organs["tobacco_variant_7"]
    assert "Flowers" not in organs["tobacco_variant_8"]  # this variant is topped


def test_variants_of_a_stage_differ(share, hash_of):
    meshes = {hash_of(share / "models" / name / "meshes") for name in VARIANTS}
    heights = {_metrics(share / "models" / name)["height_m"] for name in VARIANTS}
    assert len(meshes) == len(heights) == len(VARIANTS)


def test_any_number_of_processes_writes_the_same(share, tmp_path, hash_of):
    names = VARIANTS[::8]
    build_crops(tmp_path, processes=1, names=names)
    for name in names:
        assert hash_of(tmp_path / name) == hash_of(share / "models" / name)


@pytest.mark.parametrize("species, stage", [("corn", "V8"), ("sorghum", "6"), ("tobacco", "D45")])
def test_same_seed_same_bytes_other_seed_other_bytes(tmp_path, hash_of, species, stage):
    folders = []
    for place, seed in (("a", 7), ("b", 7), ("c", 8)):
        folders.append(make_crop(species, stage, seed, "my_crop", tmp_path / place))
    a, b, c = map(hash_of, folders)
    assert a == b != c


def test_large_seeds_are_kept_apart(tmp_path, hash_of):
    a = make_crop("corn", "V4", 2**40, "x", tmp_path / "a")
    b = make_crop("corn", "V4", 2**40 + 1, "x", tmp_path / "b")
    assert hash_of(a / "meshes") != hash_of(b / "meshes")
