# SPDX-License-Identifier: MIT
"""Tests ground from a user's image, elevation model or mesh, against the surface of its source."""

import xml.etree.ElementTree as ElementTree

import collada
import numpy as np
import pytest
import rasterio
from PIL import Image

from ardee_models.terrain import generate_terrain
from ardee_models.terrain.ground import ground_model
from ardee_models.terrain.surface import MeshGround

PLACES = np.random.default_rng(5).uniform(-8.0, 8.0, (500, 2)).T


def _surface(x, y):
    return 0.4 * np.sin(0.3 * x) + 0.2 * np.cos(0.25 * y) - 0.2


@pytest.fixture()
def command(tmp_path, run_main):
    """Runs generate_terrain on a source; returns exit code and standard error."""

    def call(*arguments):
        output = ("--name", "g", "--output", tmp_path / "out")
        return run_main(generate_terrain.main, *arguments, *output)

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
        "--image", tmp_path / "i.png", "--size-m", "20", "--image-height-m", np.ptp(heights)
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


def _write_tiff(path, heights, cell, crs="EPSG:32616", transform=None, **more):
    """A GeoTIFF with cells of that size (x, or x and y) in the unit of its reference system, by default UTM's."""
    cell_x, cell_y = cell if isinstance(cell, tuple) else (cell, cell)
    profile = {"height": heights.shape[0], "width": heights.shape[1], "count": 1, "nodata": -9999}
    transform = transform or rasterio.transform.from_origin(10.0, 45.0, cell_x, cell_y)
    profile.update(driver="GTiff", dtype="float32", crs=crs, transform=transform)
    with rasterio.open(path, "w", **profile) as file:
        file.write(heights.astype(np.float32), 1)
        for name, value in more.items():
            setattr(file, name, (value,))


def test_an_ascii_grid_is_the_ground_and_its_unit_is_told(command, tmp_path):
    _write_asc(tmp_path / "d.asc", 120.0 + _grid(101, 20.0), 0.2)
    code, error = command("--dem", tmp_path / "d.asc")
    assert code == 0 and error.count("\n") == 1
    assert "d.asc: has no coordinate reference system, so its cells are taken for metres" in error
    _check(tmp_path, 4e-3)


def test_a_geotiff_is_the_ground_its_middle_square(command, tmp_path):
    wide = np.hstack((np.full((101, 7), 50.0), 120.0 + _grid(101, 20.0), np.full((101, 7), 50.0)))
    _write_tiff(tmp_path / "d.tif", wide, 0.2)
    assert command("--dem", tmp_path / "d.tif") == (0, "")
    _check(tmp_path, 4e-3)


def test_rows_from_the_south_are_turned(command, tmp_path):
    upwards = rasterio.Affine(0.2, 0.0, 10.0, 0.0, 0.2, 45.0)
    _write_tiff(tmp_path / "d.tif", (120.0 + _grid(101, 20.0))[::-1], 0.2, transform=upwards)
    assert command("--dem", tmp_path / "d.tif") == (0, "")
    _check(tmp_path, 4e-3)


FOOT_M = 1200.0 / 3937.0  # US survey foot


@pytest.mark.parametrize(
    "crs, unit, arguments",
    [
        (
            "EPSG:2264",
            "US survey foot",
            (),
        ),  # North Carolina's grid in feet, GDAL's name of the unit
        ("EPSG:2264", None, ("--dem-unit", "us-ft")),
        ("EPSG:2264+6360", None, ()),  # with heights above NAVD 88 in feet
    ],
)
def test_feet_are_taken_for_feet(command, tmp_path, crs, unit, arguments):
    units = {"units": unit} if unit else {}
    _write_tiff(tmp_path / "d.tif", (120.0 + _grid(101, 20.0)) / FOOT_M, 0.2 / FOOT_M, crs, **units)
    assert command("--dem", tmp_path / "d.tif", *arguments) == (0, "")
    _check(tmp_path, 4e-3)


def test_cells_in_feet_and_heights_in_centimetres(command, tmp_path):
    heights = 1000.0 + 100.0 * _grid(101, 20.0)
    _write_tiff(tmp_path / "d.tif", heights, 0.2 / FOOT_M, "EPSG:2264", units="m", scales=0.01)
    assert command("--dem", tmp_path / "d.tif") == (0, "")
    _check(tmp_path, 4e-3)


@pytest.mark.parametrize(
    "cell, crs, more, message",
    [
        (0.7, "EPSG:2264", {}, "found cells in US survey foot and heights without a unit"),
        (0.2, "EPSG:32616", {"units": "furlong"}, "found heights in 'furlong', expected metres"),
        (0.1, "EPSG:4326", {}, "degrees, expected at most 0.5, or a projected coordinate"),
        (0.2, "EPSG:32616", {"transform": rasterio.Affine.rotation(9.0)}, "found the transform"),
    ],
)
def test_elevation_of_unknown_place_or_unit_is_refused(command, tmp_path, cell, crs, more, message):
    _write_tiff(tmp_path / "d.tif", 120.0 + _grid(101, 20.0), cell, crs, **more)
    code, error = command("--dem", tmp_path / "d.tif")
    assert code == 2 and message in error and error.count("\n") == 1


def test_degrees_become_metres_and_that_is_told(command, tmp_path):
    # WGS-84's degrees at 45 degrees north, from the published tables: 111,132 m and 78,847 m
    cell = (0.2 / 78_847.0, 0.2 / 111_132.0)
    _write_tiff(tmp_path / "d.tif", 9.0 + _grid(101, 20.0), cell, "EPSG:4326")
    code, error = command("--dem", tmp_path / "d.tif")
    assert code == 0 and "d.tif: is in degrees; its cells are 0.2" in error
    _check(tmp_path, 5e-3)


def test_cells_of_a_web_map_are_as_large_as_on_the_ground_and_that_is_told(command, tmp_path):
    # at 45 degrees north, by the radii of WGS-84's ellipsoid in the two directions
    cell = (0.2 / 0.7083, 0.2 / 0.7059)
    middle = rasterio.transform.from_origin(-9_818_379.0, 5_621_521.0, *cell)
    _write_tiff(tmp_path / "d.tif", 9.0 + _grid(101, 20.0), cell, "EPSG:3857", middle)
    code, error = command("--dem", tmp_path / "d.tif")
    assert code == 0 and "m at its middle, 0.7083 times what they say" in error
    _check(tmp_path, 5e-3)


@pytest.mark.parametrize("kind", ["asc", "tif"])
def test_holes_are_refused_with_their_place_or_filled(command, tmp_path, kind):
    heights = 5.0 + _grid(101, 20.0)
    heights[30:34, 60:66] = -9999
    heights[0, 0] = -9999
    path = tmp_path / f"d.{kind}"
    (_write_asc if kind == "asc" else _write_tiff)(path, heights, 0.2)
    code, error = command("--dem", path)
    assert code == 2 and "found 25 holes of 10201 cells, the first in row 1, column 1" in error
    assert not (tmp_path / "out").exists()
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
    assert command("--mesh", tmp_path / "m.obj", "--mesh-up", up, "--mu", "0.6") == (0, "")
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


CELLS = b"xllcorner 0\nyllcorner 0\ncellsize 1\n"
BAD = {
    "text.png": b"no image",
    "half.png": b"\x89PNG\r\n\x1a\n\0\0\0",
    "empty.asc": b"",
    "short.asc": b"ncols 2\nnrows 3\n" + CELLS + b"1 2\n3 4\n",
    "long.asc": b"ncols 2\nnrows 2\n" + CELLS + b"1 2\n3 4 5\n",
    "under.asc": b"ncols 2\nnrows 2\n" + CELLS + b"1 2\n3 1_0\n",
    "nan.asc": b"ncols 2\nnrows 2\n" + CELLS + b"1 nan\n3 4\n",
    "word.asc": b"ncols 2\nnrows 2\n" + CELLS + b"1 2\n3 four\n",
    "all.asc": b"ncols 2\nnrows 2\n" + CELLS + b"NODATA_value 0\n0 0\n0 0\n",
    "high.asc": b"ncols 2\nnrows 2\n" + CELLS + b"1 2\n3 99999\n",
    "huge.asc": b"ncols 20000\nnrows 2\n" + CELLS + 40000 * b"0 ",
    "float.asc": b"ncols 2.5\nnrows 2\n" + CELLS + b"1 2\n",
    "plain.tif": b"II*\0\x08\0\0\0",
    "bad.obj": b"v 0 0 0\nf 1 2 3\n",
    "flat.obj": b"v 0 0\nv 1 0\nv 0 1\nf 1 2 3\n",
    "zero.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
    "back.obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 -2 -1\n",
    "bad.dae": b"<COLLADA>",
    "line.obj": b"v 0 0 0\nv 1 0 0\nv 2 0 1\nf 1 2 3\n",
}


@pytest.mark.parametrize(
    "source, message",
    [
        (("--image", "text.png"), "text.png: not a readable image"),
        (("--image", "half.png"), "half.png: not a readable image"),
        (("--dem", "empty.asc"), "empty.asc: not a readable elevation model"),
        (("--dem", "short.asc"), "short.asc: found 4 values, expected 2 x 3 = 6"),
        (("--dem", "long.asc"), "long.asc: found 5 values, expected 2 x 2 = 4"),
        (("--dem", "under.asc"), "under.asc:7: found '3 1_0', expected numbers"),
        (("--dem", "nan.asc"), "nan.asc: found 1 holes of 4 cells, the first in row 1, column 2"),
        (("--dem", "word.asc"), "word.asc:7: found '3 four', expected numbers"),
        (("--dem", "all.asc"), "all.asc: found no height at all"),
        (("--dem", "high.asc"), "high.asc: found a height of 99999 m"),
        (("--dem", "huge.asc"), "huge.asc: found 20000 x 2 cells"),
        (("--dem", "float.asc"), "float.asc:1: found 'ncols 2.5', expected numbers"),
        (("--dem", "plain.tif"), "plain.tif: not a readable elevation model"),
        (("--dem", "text.png"), "text.png: not a readable elevation model"),
        (("--mesh", "bad.dae"), "bad.dae: not a readable COLLADA file"),
        (("--mesh", "bad.obj"), "bad.obj: cannot be read: "),
        (("--mesh", "flat.obj"), "flat.obj: flat.obj: found vertices of 2 numbers, expected x, y"),
        (("--mesh", "zero.obj"), "found a face of index 0, expected 1 to 3 or -3 to -1"),
        (("--mesh", "back.obj"), "found a face of index -4, expected 1 to 3 or -3 to -1"),
        (("--mesh", "line.obj", "--mesh-up", "z"), "line.obj: found no area seen from above"),
    ],
)
def test_bad_files_are_one_message_and_change_nothing(command, tmp_path, hash_of, source, message):
    for name, data in BAD.items():
        (tmp_path / name).write_bytes(data)
    assert command()[0] == 0
    before = hash_of(tmp_path / "out")
    code, error = command(source[0], tmp_path / source[1], *source[2:])
    assert code == 2 and message in error.splitlines()[-1]
    assert all(line.startswith("generate_terrain: ") for line in error.splitlines())
    assert hash_of(tmp_path / "out") == before


def test_a_tiff_without_a_scale_is_no_elevation_model(command, tmp_path):
    Image.fromarray(np.zeros((4, 4), np.float32)).save(tmp_path / "p.tif")
    assert "found the transform (1.0, 0.0, 0.0," in command("--dem", tmp_path / "p.tif")[1]


def test_floats_of_an_image_are_shares_from_0_to_1(command, tmp_path):
    heights = _grid(257, 20.0)
    shares = ((heights - heights.min()) / np.ptp(heights)).astype(np.float32)
    words = ("--image", tmp_path / "f.tif", "--size-m", "20", "--image-height-m", np.ptp(heights))
    Image.fromarray(shares).save(tmp_path / "f.tif")
    assert command(*words) == (0, "")
    _check(tmp_path, 2e-3)
    for factor, found in ((2.0, "0 to 2"), (np.nan, "nan to nan")):
        Image.fromarray(shares * np.float32(factor)).save(tmp_path / "f.tif")
        code, error = command(*words)
        assert code == 2 and f"f.tif: found floats from {found}, expected 0 to 1 (" in error


def test_an_image_must_be_square(command, tmp_path):
    Image.new("L", (16, 17)).save(tmp_path / "b.png")
    assert "found 16 x 17 pixels" in command("--image", tmp_path / "b.png")[1]
