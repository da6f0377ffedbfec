# SPDX-License-Identifier: MIT
"""Tests that a user's meshes are split, recentred, and get a fitted cylinder and textures; bad ones are refused."""

import json
import re
import xml.etree.ElementTree as ElementTree

import collada
import numpy as np
import pytest
from PIL import Image

from ardee_models.lookup import crop_model
from ardee_models.mesh_file import load_trimesh
from ardee_models.prepare import prepare_crop

trimesh = load_trimesh()
RADIUS, HEIGHTS = 0.012, (0.6, 0.9, 0.75)
FEET = ((0.0, 0.0), (0.4, 0.05), (0.8, -0.1))


def _stalk(foot, height):
    stalk = trimesh.creation.cylinder(RADIUS, height, sections=16)
    stalk.apply_translation([*foot, height / 2])
    return stalk


def _leaf(foot, height, angle, radius_m=RADIUS):
    """Returns a strip that touches the stalk at its base and hangs with its tip on the ground."""
    side, out = np.array([-np.sin(angle), np.cos(angle), 0]), np.array(
        [np.cos(angle), np.sin(angle), 0]
    )
    s = np.linspace(0.0, 1.0, 6)[:, None]
    middle = np.array([*foot, 0.6 * height]) + radius_m * out + 0.16 * s * out
    middle = middle - 0.6 * height * s**3 * np.array([0, 0, 1.0])
    vertices = np.concatenate((middle - 0.02 * side, middle + 0.02 * side))
    faces = [f for i in range(5) for f in ((i, i + 6, i + 1), (i + 1, i + 6, i + 7))]
    return trimesh.Trimesh(vertices, faces, process=False)


@pytest.fixture(scope="module")
def scene():
    """Returns three plants, each a stalk and three leaves, in one scene of two textured parts."""
    stalks = trimesh.util.concatenate([_stalk(f, h) for f, h in zip(FEET, HEIGHTS)])
    leaves = trimesh.util.concatenate(
        [_leaf(f, h, a) for f, h in zip(FEET, HEIGHTS) for a in (1.2, 3.3, 5.4)]
    )
    image = Image.fromarray(np.full((8, 8, 3), (60, 120, 40), np.uint8))
    uv = np.random.default_rng(1).random((len(leaves.vertices), 2))
    leaves.visual = trimesh.visual.TextureVisuals(uv=uv, image=image)
    return trimesh.Scene({"Body": stalks, "Leaf blades": leaves})


def _save(scene, path, kind):
    data = scene.export(file_type=kind) if kind == "glb" else scene.to_mesh().export(file_type=kind)
    path.write_bytes(data)
    return path


def _run(capsys, *arguments):
    code = prepare_crop.main([str(a) for a in arguments])
    return code, capsys.readouterr().out.split()


@pytest.mark.parametrize("kind", ["glb", "stl"])
def test_stalks_become_models_of_their_own(scene, tmp_path, capsys, kind):
    mesh = _save(scene, tmp_path / f"field.{kind}", kind)
    out = tmp_path / "out"
    code, written = _run(
        capsys, mesh, "--mesh-up", "z", "--name", "mine", "--output", out, "--species", "tobacco"
    )
    assert code == 0 and [p.rsplit("/", 1)[1] for p in written] == ["mine_1", "mine_2", "mine_3"]
    for name, height in zip(("mine_1", "mine_2", "mine_3"), HEIGHTS):
        found = crop_model(name, [out])
        assert found.height_m == pytest.approx(height, abs=1e-4) and found.label == 3
        assert found.stalk_radius_m == pytest.approx(RADIUS, rel=0.03)
        metrics = json.loads((out / name / "metrics.json").read_text())
        assert metrics["triangles"] == 64 + 3 * 10
        assert np.abs(metrics["bounds_m"]).max(axis=0)[:2].max() < 0.21
        assert metrics["bounds_m"][0][2] == 0.0
        collision = ElementTree.parse(out / name / "model.sdf").find(".//collision")
        pose = [float(v) for v in collision.findtext("pose").split()]
        assert pose == pytest.approx([0, 0, height / 2, 0, 0, 0], abs=2e-3)
        assert float(collision.findtext(".//length")) == pytest.approx(height, rel=0.01)


def test_a_file_named_after_its_stalk_is_searched_for_it(tmp_path, capsys):
    """Without parts of their own, leaves would count as stalk; a mesh that is there twice has two names."""
    plant = trimesh.util.concatenate([_stalk(FEET[0], 0.6), _leaf(FEET[0], 0.6, 1.2)])
    one = _save(trimesh.Scene({"plant": plant}), tmp_path / "corn_stalk.stl", "stl")
    assert _run(capsys, one, "--mesh-up", "z", "--name", "a", "--output", tmp_path / "out")[0] == 0
    assert crop_model("a", [tmp_path / "out"]).stalk_radius_m == pytest.approx(RADIUS, rel=0.03)
    scene = trimesh.Scene({"stem": _stalk(FEET[0], 0.6), "stem_2": _leaf(FEET[0], 0.6, 1.2)})
    turned = trimesh.transformations.rotation_matrix(2.0, [0, 0, 1])
    scene.graph.update(frame_to="again", matrix=turned, geometry="stem")
    two = _save(scene, tmp_path / "twice.glb", "glb")
    assert _run(capsys, two, "--mesh-up", "z", "--name", "b", "--output", tmp_path / "out")[0] == 0
    names = ElementTree.parse(tmp_path / "out/b/model.sdf").findall(".//submesh/name")
    assert sorted(node.text for node in names) == ["stem", "stem_2", "stem_3"]


def test_model_is_drawn_from_both_sides_with_its_textures(scene, tmp_path, capsys):
    mesh = _save(scene, tmp_path / "field.glb", "glb")
    _run(capsys, mesh, "--mesh-up", "z", "--name", "mine", "--output", tmp_path / "out")
    model = tmp_path / "out" / "mine_2"
    script = (model / "materials/scripts/mine_2.material").read_text()
    assert script.count("cull_hardware none") == script.count("cull_software none") == 2
    assert script.count("alpha_rejection greater 128") == 2
    (texture,) = re.findall(r"texture (\S+)", script.replace("texture_unit", ""))
    with Image.open(model / "materials/textures" / texture) as image:
        assert np.asarray(image.convert("RGB"))[0, 0].tolist() == [60, 120, 40]
    nodes = {
        n.id: n.children[0].geometry.primitives[0]
        for n in collada.Collada(str(model / "meshes/mine_2.dae")).scene.nodes
    }
    visuals = ElementTree.parse(model / "model.sdf").findall(".//visual")
    assert {v.findtext(".//submesh/name") for v in visuals} == set(nodes) == {"Body", "Leaf_blades"}
    assert nodes["Leaf_blades"].texcoordset[0].std() > 0.1


def test_whole_keeps_one_model_and_units_and_axes_are_obeyed(scene, tmp_path, capsys):
    lying = scene.copy()
    lying.apply_transform(trimesh.transformations.rotation_matrix(-np.pi / 2, [1, 0, 0]))
    lying.apply_scale(100.0)  # centimetres, y up
    mesh = _save(lying, tmp_path / "field.stl", "stl")
    arguments = (mesh, "--whole", "--mesh-up", "y", "--mesh-scale", "0.01", "--name", "all")
    _, written = _run(capsys, *arguments, "--output", tmp_path / "out")
    assert [p.rsplit("/", 1)[1] for p in written] == ["all"]
    assert crop_model("all", [tmp_path / "out"]).height_m == pytest.approx(max(HEIGHTS), abs=1e-4)


@pytest.mark.parametrize("radius_m, sections", [(0.005, 6), (0.02, 24), (0.06, 12)])
def test_thin_and_thick_stalks_in_one_piece_with_their_leaves_are_found(
    tmp_path, capsys, radius_m, sections
):
    stalk = trimesh.creation.cylinder(radius_m, 0.9, sections=sections)
    stalk.apply_translation([1.0, 1.0, 0.45])
    leaves = [_leaf((1.0, 1.0), 0.9, angle, radius_m) for angle in (1.2, 4.0)]
    plant = trimesh.util.concatenate([stalk, *leaves])
    plant.export(tmp_path / "plant.stl")
    _run(capsys, tmp_path / "plant.stl", "--name", "mine", "--output", tmp_path)
    metrics = json.loads((tmp_path / "mine" / "metrics.json").read_text())
    assert metrics["stalk_radius_m"] == pytest.approx(radius_m, rel=0.1)
    assert metrics["stalk_height_m"] == pytest.approx(0.9, rel=0.02)


def test_picture_of_a_plant_without_a_stalk_gets_a_thin_one_of_its_height(tmp_path, capsys):
    (tmp_path / "board.obj").write_text("v -0.3 0 0\nv 0.3 0 0\nv 0.3 2 0\nv -0.3 2 0\nf 1 2 3 4\n")
    _run(capsys, tmp_path / "board.obj", "--name", "mine", "--output", tmp_path)
    metrics = json.loads((tmp_path / "mine" / "metrics.json").read_text())
    assert metrics["stalk_radius_m"] == pytest.approx(0.02)
    assert metrics["stalk_height_m"] == pytest.approx(2.0)


OBJ = """# Blender 3.6.0
mtllib leaf.mtl
o Leaf
v 0 0 0
v 0.1 0 0
v 0.1 1 0
v 0 1 0
v 0 2 0.3
v 0.1 2 0.3
vt 0 0
vt 1 0
vt 1 0.5
vt 0 0.5
vt 0 1
vt 1 1
usemtl Green
"""
# faces as Blender writes them, counted backwards, over two lines, and with tabs behind a vertex that no face has
FACES = (
    "f 1/1 2/2 3/3 4/4\nf 4/4 3/3 6/6 5/5\n",
    "f -6/-6 -5/-5 -4/-4 -3/-3\nf -3/-3 -4/-4 -1/-1 -2/-2\n",
    "f 1/1 2/2 \\\n3/3 4/4\nf 4/4 3/3 6/6 5/5\n",
    "v\t9 9 9\nf\t1/1\t2/2\t3/3\t4/4\nf 4/4 3/3 -2/6 5/5\n",
)


@pytest.mark.parametrize("faces", FACES)
def test_quads_of_blender_keep_their_texture_and_stand(tmp_path, capsys, faces):
    Image.new("RGB", (4, 4), (60, 120, 40)).save(tmp_path / "leaf.png")
    (tmp_path / "leaf.mtl").write_text("newmtl Green\nKd 1 1 1\nmap_Kd leaf.png\n")
    (tmp_path / "leaf.obj").write_text(OBJ + faces)
    arguments = [tmp_path / "leaf.obj", "--name", "leaf", "--output", tmp_path / "out"]
    assert prepare_crop.main([str(a) for a in arguments]) == 0
    assert "leaf.obj: taken with its y axis upwards" in capsys.readouterr().err
    model = tmp_path / "out" / "leaf"
    (texture,) = (model / "materials/textures").iterdir()
    with Image.open(texture) as image:
        assert image.convert("RGB").getpixel((0, 0)) == (60, 120, 40)
    (node,) = collada.Collada(str(model / "meshes/leaf.dae")).scene.nodes
    triangles = node.children[0].geometry.primitives[0]
    corners = triangles.vertex[triangles.vertex_index].reshape(-1, 3)
    uv = triangles.texcoordset[0][triangles.texcoord_indexset[0]].reshape(-1, 2)
    assert len(corners) == 4 * 3 and np.ptp(corners, axis=0) == pytest.approx([0.1, 0.3, 2.0])
    # v runs with the height, u with the width
    np.testing.assert_allclose(uv[:, 1], corners[:, 2] / 2.0, atol=1e-5)
    left = corners[:, 0].min()
    np.testing.assert_allclose(uv[:, 0], (corners[:, 0] - left) / 0.1, atol=1e-4)


def test_missing_materials_and_pictures_of_an_obj_are_told(tmp_path, capsys):
    (tmp_path / "leaf.obj").write_text(OBJ + FACES[0])
    words = [str(tmp_path / "leaf.obj"), "--name", "leaf", "--output", str(tmp_path / "out")]
    assert prepare_crop.main(words) == 0
    assert "leaf.obj: warning: unable to load materials from: leaf.mtl" in capsys.readouterr().err
    (tmp_path / "leaf.mtl").write_text("newmtl Green\nmap_Kd leaf.png\n")
    assert prepare_crop.main(words) == 0
    error = capsys.readouterr().err
    assert "leaf.obj: warning: failed to load image: " in error and "leaf.png" in error


def test_own_models_come_back_as_they_were(share, tmp_path, capsys):
    source = share / "models" / "corn_variant_8"
    mesh = source / "meshes" / "corn_variant_8.dae"
    _run(capsys, mesh, "--name", "again", "--output", tmp_path, "--species", "corn")
    before, after = (
        json.loads((m / "metrics.json").read_text()) for m in (source, tmp_path / "again")
    )
    assert after["triangles"] == before["triangles"] and after["label"] == before["label"]
    for key in ("height_m", "stalk_radius_m"):
        assert after[key] == pytest.approx(before[key], abs=1e-3)


def test_same_mesh_same_bytes(scene, tmp_path, capsys, hash_of):
    mesh = _save(scene, tmp_path / "field.glb", "glb")
    for place in ("a", "b"):
        _run(capsys, mesh, "--mesh-up", "z", "--name", "mine", "--output", tmp_path / place)
    assert hash_of(tmp_path / "a") == hash_of(tmp_path / "b")


@pytest.mark.parametrize(
    "name, data, arguments, message",
    [
        ("none.stl", None, [], "cannot be read: no such file"),
        ("notes.txt", b"text", [], "expected a file of .3mf .dae"),
        ("broken.dae", b"<COLLADA>", [], "not a readable COLLADA file"),
        ("empty.stl", b"", [], "empty.stl: "),
        ("broken.glb", b"glTF\x02\0\0\0garbage", [], "broken.glb: cannot be read"),
        ("flat.obj", b"v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n", [], "found a height of 0 m"),
        ("huge.obj", b"v 0 0 0\nv 1 900 0\nv 0 0 1\nf 1 2 3\n", [], "give --mesh-scale"),
        ("nan.obj", b"v 0 0 nan\nv 1 1 0\nv 0 0 1\nf 1 2 3\n", [], "not finite"),
        ("ok.obj", b"v 0 0 0\nv 0.1 1 0\nv 0 0 0.1\nf 1 2 3\n", ["--stem", "Stem"], "no such part"),
        ("ok.obj", b"v 0 0 0\nv 0.1 1 0\nv 0 0 0.1\nf 1 2 3\n", ["--label", "-1"], "0 to 65535"),
        ("ok.obj", b"v 0 0 0\nv 0.1 1 0\nv 0 0 0.1\nf 1 2 3\n", ["--name", "../x"], "name '../x'"),
    ],
)
def test_bad_meshes_are_refused_in_one_line(tmp_path, capsys, name, data, arguments, message):
    if data is not None:
        (tmp_path / name).write_bytes(data)
    out = tmp_path / "out"
    with pytest.raises(SystemExit) as exit_:
        words = ["--mesh-up", "y", "--name", "x", "--output", str(out), *arguments]
        prepare_crop.main([str(tmp_path / name), *words])
    error = capsys.readouterr().err
    assert exit_.value.code == 2 and message in error and error.count("\n") == 1
    assert not out.exists()


def test_an_error_in_the_last_model_leaves_none(scene, tmp_path, capsys):
    mesh = _save(scene, tmp_path / "field.glb", "glb")
    out = tmp_path / "out"
    (out / "mine_3").mkdir(parents=True)  # not a model: must not be overwritten
    (out / "mine_3" / "notes.txt").write_text("mine")
    with pytest.raises(SystemExit) as exit_:
        prepare_crop.main([str(mesh), "--mesh-up", "z", "--name", "mine", "--output", str(out)])
    assert exit_.value.code == 2 and "not a model directory" in capsys.readouterr().err
    assert [p.name for p in out.iterdir()] == ["mine_3"]
