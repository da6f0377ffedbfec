# SPDX-License-Identifier: MIT
"""The model directories that are written: consistent with themselves, the same bytes for the same seed."""

import json
import re
import xml.etree.ElementTree as ElementTree

import collada
import numpy as np
import pytest
from PIL import Image

from ardee_models.crops import make_crop
from ardee_models.lookup import crop_model

VARIANTS = [f"corn_variant_{k}" for k in range(1, 9)]


def _dae(model):
    return collada.Collada(str(model / "meshes" / f"{model.name}.dae"))


def _node_vertices(model):
    return {
        node.id: node.children[0].geometry.primitives[0].vertex for node in _dae(model).scene.nodes
    }


@pytest.mark.parametrize("name", VARIANTS)
def test_metrics_are_those_of_the_mesh(share, name):
    model = share / "models" / name
    metrics = json.loads((model / "metrics.json").read_text())
    vertices = np.concatenate(list(_node_vertices(model).values()))
    assert vertices[:, 2].max() == pytest.approx(metrics["height_m"], abs=2e-5)
    np.testing.assert_allclose([vertices.min(0), vertices.max(0)], metrics["bounds_m"], atol=2e-5)
    triangles = sum(
        len(node.children[0].geometry.primitives[0]) for node in _dae(model).scene.nodes
    )
    assert triangles == metrics["triangles"]
    assert crop_model(name, [share / "models"]).height_m == metrics["height_m"]


@pytest.mark.parametrize("name", VARIANTS)
def test_collision_cylinder_is_the_stalk(share, name):
    model = share / "models" / name
    collision = ElementTree.parse(model / "model.sdf").find(".//collision")
    length = float(collision.findtext("geometry/cylinder/length"))
    radius = float(collision.findtext("geometry/cylinder/radius"))
    pose = [float(v) for v in collision.findtext("pose").split()]
    stem = _node_vertices(model)["Stem"]
    radii = np.linalg.norm(stem[:, :2], axis=1)
    assert pose == pytest.approx([0, 0, length / 2, 0, 0, 0])
    assert length == pytest.approx(stem[:, 2].max(), abs=2e-5)
    # mean of a linear taper from the foot to the top
    assert radius == pytest.approx(
        (radii[stem[:, 2] == 0].mean() + radii[stem[:, 2].argmax()]) / 2, abs=2e-5
    )
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
        assert re.search(rf"^material {material}$", script, re.MULTILINE)
        for uri in visual.findall("material/script/uri"):
            assert (model.parent / uri.text[len("model://") :]).is_dir()
    assert script.count("cull_hardware none") == script.count("cull_software none") == len(visuals)
    for texture in re.findall(r"texture (\S+\.png)", script):
        with Image.open(model / "materials/textures" / texture) as image:
            image.load()
            assert np.array(image).std() > 3.0


@pytest.mark.parametrize("name", VARIANTS)
def test_collada_header_and_texture_references(share, name):
    model = share / "models" / name
    doc = _dae(model)
    assert doc.assetInfo.upaxis == "Z_UP" and doc.assetInfo.unitmeter == 1.0
    assert doc.images
    for image in doc.images:
        assert (model / "meshes" / image.path).is_file()


def test_variants_differ_in_height_and_bytes(share, hash_of):
    models = [share / "models" / name for name in VARIANTS]
    heights = [json.loads((m / "metrics.json").read_text())["height_m"] for m in models]
    assert len({hash_of(m / "meshes") for m in models}) == len(set(heights)) == 8
    assert min(heights) < 0.5 and max(heights) > 2.0


def test_same_seed_same_bytes_other_seed_other_bytes(tmp_path, hash_of):
    folders = []
    for place, seed in (("a", 7), ("b", 7), ("c", 8)):
        folders.append(make_crop("corn", "V8", seed, "my_corn", tmp_path / place))
    a, b, c = map(hash_of, folders)
    assert a == b != c


def test_large_seeds_are_kept_apart(tmp_path, hash_of):
    a = make_crop("corn", "V4", 2**40, "x", tmp_path / "a")
    b = make_crop("corn", "V4", 2**40 + 1, "x", tmp_path / "b")
    assert hash_of(a / "meshes") != hash_of(b / "meshes")
