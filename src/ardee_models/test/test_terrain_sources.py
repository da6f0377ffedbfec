# SPDX-License-Identifier: MIT
"""Tests ground from a user's image, elevation model or mesh, against the surface of its source."""

import sys
import xml.etree.ElementTree as ElementTree

import collada
import numpy as np
import pytest
from PIL import Image, TiffImagePlugin

from ardee_models.terrain import generate_terrain
from ardee_models.terrain.ground import ground_model
from ardee_models.terrain.surface import MeshGround

PLACES = np.random.default_rng(5).uniform(-8.0, 8.0, (500, 2)).T


def _surface(x, y):
    return 0.4 * np.sin(0.3 * x) + 0.2 * np.cos(0.25 * y) - 0.2


@pytest.fixture()
def command(tmp_path, monkeypatch, capsys):
    """Runs generate_terrain on a source; returns exit code and standard error."""

    def call(*arguments):
        words = [
            "generate_terrain",
            *map(str, arguments),
            "--name",
            "g",
            "--output",
            str(tmp_path / "out"),
        ]
        monkeypatch.setattr(sys, "argv", words)
        try:
            code = generate_terrain.main()
        except SystemExit as exit_:
            code = exit_.code
        return code, capsys.readouterr().err

    return call


def _check(tmp_path, tolerance, places=PLACES):
    ground = ground_model("g", [tmp_path / "out"])
    expected = _surface(*places) - _surface(0.0, 0.0)
    np.testing.assert_allclose(ground.height_at(*places), expected, atol=tolerance)


def _grid(side, size_m):
    axis = np.linspace(-0.5, 0.5, side) * size_m
    x, y = np.meshgrid(axis, -axis)
    return _surface(x, y)


@pytest.mark.parametrize("dtype, tolerance", [(np.uint16, 2e-3), (np.uint8, 6e-3)])
def test_an_image_is_the_ground_and_eight_bits_are_told(command, tmp_path, dtype, tolerance):
    heights = _grid(200, 20.0)
    share = (heights - heights.min()) / np.ptp(heights)
    Image.fromarray(np.rint(share * np.iinfo(dtype).max).astype(dtype)).save(tmp_path / "i.png")
    code, error = command(
        "--image", tmp_path / "i.png", "--size", "20", "--image-height", np.ptp(heights)
    )
    assert code == 0
    step_mm = 1000 * np.ptp(heights) / 255
    assert (f"quantised into steps of {step_mm:.3g} mm" in error) == (dtype is np.uint8)
    _check(tmp_path, tolerance)
    with Image.open(tmp_path / "out/g/meshes/heightmaps/terrain.png") as image:
        assert image.size == (257, 257) and image.mode in ("I", "I;16")


def test_a_black_image_is_level_and_needs_no_warning(command, tmp_path):
    Image.new("L", (16, 16)).save(tmp_path / "b.png")
    assert command("--image", tmp_path / "b.png") == (0, "")
    assert not ground_model("g", [tmp_path / "out"]).heights_m.any()


def _write_asc(path, heights, cell, nodata=-9999):
    rows, columns = heights.shape
    header = f"ncols {columns}\nnrows {rows}\nxllcorner 0\nyllcorner 0\ncellsize {cell}\nNODATA_value {nodata}"
    np.savetxt(path, heights, fmt="%.4f", header=header, comments="")


def _write_tiff(path, heights, scale, keys=None, tie=(0, 0, 0, 10, 45, 0)):
    tags = TiffImagePlugin.ImageFileDirectory_v2()
    for number, kind, value in ((33550, 12, (*scale, 0.0)), (33922, 12, tie), (34735, 3, keys)):
        if value is not None:
            tags.tagtype[number] = kind
            tags[number] = tuple(map(int, value)) if kind == 3 else tuple(map(float, value))
    tags[42113] = "-9999"
    Image.fromarray(heights.astype(np.float32)).save(path, tiffinfo=tags)


def test_an_ascii_grid_is_the_ground(command, tmp_path):
    _write_asc(tmp_path / "d.asc", 120.0 + _grid(101, 20.0), 0.2)
    assert command("--dem", tmp_path / "d.asc") == (0, "")
    _check(tmp_path, 4e-3)


def test_a_geotiff_is_the_ground_its_middle_square(command, tmp_path):
    wide = np.hstack((np.full((101, 7), 50.0), 120.0 + _grid(101, 20.0), np.full((101, 7), 50.0)))
    _write_tiff(tmp_path / "d.tif", wide, (0.2, 0.2))
    assert command("--dem", tmp_path / "d.tif") == (0, "")
    _check(tmp_path, 4e-3)


def test_a_geographic_tiff_is_taken_for_metres(command, tmp_path):
    degree, latitude = 111_320.0, 45.0
    scale = (0.2 / (degree * np.cos(np.radians(latitude))), 0.2 / degree)
    keys = (1, 1, 0, 1, 1024, 0, 1, 2)
    _write_tiff(tmp_path / "d.tif", 9.0 + _grid(101, 20.0), scale, keys, (0, 0, 0, 10, latitude, 0))
    assert command("--dem", tmp_path / "d.tif") == (0, "")
    _check(tmp_path, 5e-3)


@pytest.mark.parametrize("kind", ["asc", "tif"])
def test_holes_are_refused_with_their_place_or_filled(command, tmp_path, kind):
    heights = 5.0 + _grid(101, 20.0)
    heights[30:34, 60:66] = -9999
    heights[0, 0] = -9999
    path = tmp_path / f"d.{kind}"
    if kind == "asc":
        _write_asc(path, heights, 0.2)
    else:
        _write_tiff(path, heights, (0.2, 0.2))
    code, error = command("--dem", path)
    assert code == 2 and "found 25 holes of 10201 cells, the first in row 1, column 1" in error
    assert error.count("\n") == 1 and not (tmp_path / "out").exists()
    code, error = command("--dem", path, "--fill-holes")
    assert code == 0 and "filled 25 holes" in error
    _check(tmp_path, 0.02)


OBJ_SIDE = 41


def _write_obj(path, up="z"):
    axis = np.linspace(-10.0, 10.0, OBJ_SIDE)
    x, y = (a.ravel() for a in np.meshgrid(axis, axis))
    points = np.column_stack((x, y, _surface(x, y)))
    if up == "y":
        points = np.column_stack((x, _surface(x, y), -y))
    lines = ["v %.6f %.6f %.6f" % tuple(p) for p in points + 3.0]
    for row in range(OBJ_SIDE - 1):
        for column in range(OBJ_SIDE - 1):
            a = row * OBJ_SIDE + column + 1
            lines.append(f"f {a} {a + 1} {a + OBJ_SIDE + 1} {a + OBJ_SIDE}")
    path.write_text("\n".join(lines) + "\n")


@pytest.mark.parametrize("up", ["z", "y"])
def test_a_mesh_is_the_ground_seen_and_felt(command, tmp_path, up):
    _write_obj(tmp_path / "m.obj", up)
    assert command("--mesh", tmp_path / "m.obj", "--mesh-up", up, "--friction", "0.6") == (0, "")
    _check(tmp_path, 8e-3)
    root = ElementTree.parse(tmp_path / "out/g/model.sdf").getroot()
    seen, felt = root.findtext(".//visual//uri"), root.findtext(".//collision//uri")
    assert seen != "" and felt == "model://g/meshes/g.obj" and root.findtext(".//mu2") == "0.6"
    assert (tmp_path / "out/g/materials/textures/g.png").is_file()


def test_an_obj_stands_as_blender_writes_it_and_one_that_lies_on_its_side_is_refused(
    command, tmp_path
):
    _write_obj(tmp_path / "m.obj", "y")
    code, error = command("--mesh", tmp_path / "m.obj")
    assert code == 0 and "m.obj: taken with its y axis upwards" in error
    _check(tmp_path, 8e-3)
    _write_obj(tmp_path / "z.obj", "z")
    for arguments in (("z.obj",), ("m.obj", "--mesh-up", "z"), ("m.obj", "--mesh-up", "x")):
        code, error = command("--mesh", tmp_path / arguments[0], *arguments[1:])
        assert code == 2 and "expected ground that lies; --mesh-up says which axis" in error
    _check(tmp_path, 8e-3)  # the earlier one is still there


def test_a_models_mesh_is_the_ground_as_the_simulator_has_it(tmp_path):
    """No axis is turned up, the file's unit and the model's scale count."""
    dae = collada.Collada()
    dae.assetInfo.upaxis = collada.asset.UP_AXIS.Y_UP
    dae.assetInfo.unitname, dae.assetInfo.unitmeter = "decimetre", 0.1
    corners = np.array([[0, 0, 1], [10, 0, 1], [0, 10, 3]], float)
    source = collada.source.FloatSource("v", corners.ravel(), ("X", "Y", "Z"))
    geometry = collada.geometry.Geometry(dae, "g", "g", [source])
    inputs = collada.source.InputList()
    inputs.addInput(0, "VERTEX", "#v")
    geometry.primitives.append(geometry.createTriangleSet(np.arange(3), inputs, "m"))
    dae.geometries.append(geometry)
    dae.scenes.append(
        collada.scene.Scene(
            "s", [collada.scene.Node("n", children=[collada.scene.GeometryNode(geometry)])]
        )
    )
    dae.scene = dae.scenes[0]
    (tmp_path / "m").mkdir()
    dae.write(str(tmp_path / "m" / "m.dae"))
    (tmp_path / "m" / "model.config").write_text("<model/>")
    mesh = "<mesh><uri>model://m/m.dae</uri><scale>1 1 2</scale></mesh>"
    (tmp_path / "m" / "model.sdf").write_text(
        f"<sdf><collision><geometry>{mesh}</geometry></collision></sdf>"
    )
    ground = ground_model("m", [tmp_path])
    # corners in metres: (0, 0, 0.2), (1, 0, 0.2), (0, 1, 0.6)
    np.testing.assert_allclose(ground.height_at(np.array([0.2]), np.array([0.5])), 0.4)


def test_scale_of_a_mesh(command, tmp_path):
    _write_obj(tmp_path / "m.obj")
    words = ("--mesh-up", "z", "--mesh-scale", "0.01")
    assert command("--mesh", tmp_path / "m.obj", *words) == (0, "")
    ground = ground_model("g", [tmp_path / "out"])
    np.testing.assert_allclose(np.ptp(ground.vertices_m[:, :2], axis=0), 0.2, atol=1e-5)


def test_the_highest_of_overlapping_triangles_counts_and_beside_it_the_nearest():
    corners = np.array([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 2], [4, 0, 2], [0, 4, 3]], float)
    ground = MeshGround(corners, np.array([[0, 1, 2], [3, 4, 5]]))
    found = ground.height_at(np.array([1.0, 0.0, 9.0]), np.array([1.0, 4.0, -1.0]))
    np.testing.assert_allclose(found[:2], [2.25, 3.0])
    assert found[2] in (0.0, 2.0)  # two vertices are equally near


BAD = {
    "text.png": b"no image",
    "half.png": b"\x89PNG\r\n\x1a\n\0\0\0",
    "empty.asc": b"",
    "short.asc": b"ncols 2\nnrows 3\ncellsize 1\n1 2\n3 4\n",
    "word.asc": b"ncols 2\nnrows 2\ncellsize 1\n1 2\n3 four\n",
    "all.asc": b"ncols 2\nnrows 2\ncellsize 1\nNODATA_value 0\n0 0\n0 0\n",
    "high.asc": b"ncols 2\nnrows 2\ncellsize 1\n1 2\n3 99999\n",
    "huge.asc": b"ncols 1e9\nnrows 2\ncellsize 1\n1 2\n",
    "plain.tif": b"II*\0\x08\0\0\0",
    "bad.obj": b"v 0 0 0\nf 1 2 3\n",
    "bad.dae": b"<COLLADA>",
    "line.obj": b"v 0 0 0\nv 1 0 0\nv 2 0 1\nf 1 2 3\n",
}


@pytest.mark.parametrize(
    "source, message",
    [
        (("--image", "text.png"), "text.png: not a readable image"),
        (("--image", "half.png"), "half.png: not a readable image"),
        (("--dem", "empty.asc"), "empty.asc: found no 'ncols'"),
        (("--dem", "short.asc"), "short.asc: found 2 rows, expected 3"),
        (("--dem", "word.asc"), "word.asc:5: expected 2 numbers, found '3 four'"),
        (("--dem", "all.asc"), "all.asc: found no height at all"),
        (("--dem", "high.asc"), "high.asc: found a height of 99999 m"),
        (("--dem", "huge.asc"), "huge.asc: found 1000000000 x 2 cells"),
        (("--dem", "plain.tif"), "plain.tif: not a readable GeoTIFF"),
        (("--dem", "text.png"), "text.png: not a readable GeoTIFF"),
        (("--mesh", "bad.dae"), "bad.dae: not a readable COLLADA file"),
        (("--mesh", "bad.obj"), "bad.obj: cannot be read: "),
        (("--mesh", "line.obj", "--mesh-up", "z"), "line.obj: found no area seen from above"),
    ],
)
def test_bad_files_are_one_message_and_change_nothing(command, tmp_path, hash_of, source, message):
    for name, data in BAD.items():
        (tmp_path / name).write_bytes(data)
    assert command()[0] == 0
    before = hash_of(tmp_path / "out")
    code, error = command(source[0], tmp_path / source[1], *source[2:])
    assert code == 2 and message in error and error.count("\n") == 1
    assert hash_of(tmp_path / "out") == before


def test_a_tiff_without_a_scale_is_no_elevation_model(command, tmp_path):
    Image.fromarray(np.zeros((4, 4), np.float32)).save(tmp_path / "p.tif")
    assert "found no pixel scale" in command("--dem", tmp_path / "p.tif")[1]


def test_an_image_must_be_square(command, tmp_path):
    Image.new("L", (16, 17)).save(tmp_path / "b.png")
    assert "found 16 x 17 pixels" in command("--image", tmp_path / "b.png")[1]
