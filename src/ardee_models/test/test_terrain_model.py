# SPDX-License-Identifier: MIT
"""Tests terrains: shape, the written image's convention, determinism."""

import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from PIL import Image

from ardee_common.errors import GeneratorError
from ardee_models.lookup import terrain_model
from ardee_models.terrain.height_map import Terrain, TerrainParams, generate_terrain, ridge_profile
from ardee_models.terrain.terrain_model import write_terrain


def _rng(seed=1):
    return np.random.default_rng(seed)


def test_ridges_stand_on_the_rows_and_lanes_are_level():
    params = TerrainParams()
    s = params.row_spacing_m
    np.testing.assert_allclose(ridge_profile(np.array([-1.5, -0.5, 0.5, 1.5]) * s, params), 0.05)
    np.testing.assert_allclose(
        ridge_profile(np.array([-s, 0.0, 0.1, 2 * s]), params), 0.0, atol=1e-12
    )
    # The place is half way down the raised cosine.
    assert ridge_profile(np.array([0.5 * s + 0.125]), params)[0] == pytest.approx(0.025)
    close = TerrainParams(row_spacing_m=0.3)  # with furrows as deep, if narrower
    np.testing.assert_allclose(ridge_profile(np.array([0.0, 0.15]), close), [0.0, 0.05], atol=1e-12)


def test_bumps_have_the_given_deviation_and_nothing_stands_over_the_origin():
    params = TerrainParams(ridge_height_m=0.0, bump_sd_m=0.02)
    terrain = generate_terrain(params, _rng())
    assert terrain.heights_m.std() == pytest.approx(0.02)
    x, y = np.meshgrid(np.linspace(-0.35, 0.35, 8), np.linspace(-0.11, 0.11, 8))
    assert terrain.height_at(x, y).max() <= 1e-12


def test_neighbouring_samples_follow_the_correlation_length():
    params = TerrainParams(ridge_height_m=0.0, bump_sd_m=1e-2, bump_length_m=0.5)
    h = generate_terrain(params, _rng()).heights_m
    h = h - h.mean()
    lag = 4
    distance = lag * params.size_m / (params.samples - 1)
    found = np.mean(h[:, lag:] * h[:, :-lag]) / h.var()
    assert found == pytest.approx(np.exp(-(distance**2) / (4 * 0.5**2)), abs=0.05)


def test_orientation_row_0_is_north_and_column_0_is_west():
    heights = np.zeros((17, 17))
    heights[0, 0] = 1.0
    terrain = Terrain(heights, 16.0)
    assert terrain.height_at(np.array([-8.0]), np.array([8.0]))[0] == 1.0
    assert terrain.height_at(np.array([-7.5]), np.array([8.0]))[0] == 0.5
    # The point is on the cut of the cell, which runs from its corner at -x -y to that at +x +y.
    assert terrain.height_at(np.array([-7.5]), np.array([7.5]))[0] == 0.0
    assert terrain.height_at(np.array([-7.75]), np.array([7.75]))[0] == 0.5
    assert terrain.height_at(np.array([-99.0, 8.0]), np.array([99.0, -8.0])).tolist() == [1.0, 0.0]


def test_a_cell_is_the_two_triangles_that_the_simulator_has():
    # Corners are at -x -y, +x -y, -x +y, +x +y of one cell of 1 m.
    near, right, left, far = 0.1, 0.7, -0.4, 1.3
    heights = np.zeros((17, 17))
    heights[8, 8], heights[8, 9], heights[7, 8], heights[7, 9] = near, right, left, far
    terrain = Terrain(heights, 16.0)
    u, v = (a.ravel() for a in np.meshgrid(np.linspace(0, 1, 9), np.linspace(0, 1, 9)))
    below = near + u * (right - near) + v * (far - right)
    above = near + v * (left - near) + u * (far - left)
    np.testing.assert_allclose(terrain.height_at(u, v), np.where(u >= v, below, above), atol=1e-12)


def test_what_is_read_back_is_what_was_written(tmp_path):
    terrain = generate_terrain(TerrainParams(samples=65), _rng(3))
    model = write_terrain(terrain, 0.8, "ground", "rows", tmp_path)
    again = terrain_model("ground", [tmp_path])
    span = np.ptp(terrain.heights_m)
    np.testing.assert_allclose(again.heights_m, terrain.heights_m, atol=span / 65535 + 1e-6)
    with Image.open(model / "meshes/heightmaps/rows.png") as image:
        assert image.size == (65, 65) and image.mode in ("I", "I;16")


@pytest.mark.parametrize(
    "pixels, heights_m",
    [
        (np.array([[0, 60], [120, 30]], np.uint8), [[0, 1.5], [3, 0.75]]),
        (np.array([[0, 51], [255, 1]], np.uint8), [[0, 0.6], [3, 3 / 255]]),
        (np.array([[0, 1], [1, 0]], np.uint8), [[0, 3 / 255], [3 / 255, 0]]),
        (np.zeros((2, 2), np.uint8), [[0, 0], [0, 0]]),
        (np.array([[0, 13107], [257, 0]], np.uint16), [[0, 0.6], [3 / 255, 0]]),
        (np.array([[7.5, 9.5], [8.5, 7.5]], np.float32), [[0, 3], [1.5, 0]]),
    ],
)
def test_images_are_read_as_the_simulator_reads_them(tmp_path, pixels, heights_m):
    model = write_terrain(Terrain(np.zeros((2, 2)), 1.0), 0.8, "ground", "rows", tmp_path)
    sdf = (model / "model.sdf").read_text()
    size = "<size>1 1 1</size>"
    assert size in sdf
    (model / "model.sdf").write_text(
        sdf.replace(size, "<size>1 1 3</size>").replace("rows.png", "rows.tif")
    )
    Image.fromarray(pixels).save(model / "meshes/heightmaps/rows.tif")
    np.testing.assert_allclose(terrain_model("ground", [tmp_path]).heights_m, heights_m, atol=1e-6)


@pytest.mark.parametrize("name", ["heightmap_ground", "heightmap_flat"])
def test_shipped_terrain_shows_what_it_collides_with(share, name):
    root = ElementTree.parse(share / "models" / name / "model.sdf").getroot()
    maps = root.findall(".//heightmap")
    assert len(maps) == 2
    for tag in ("uri", "size", "pos"):
        assert maps[0].findtext(tag) == maps[1].findtext(tag)
    assert maps[0].findtext("size").split()[:2] == ["30", "30"]
    assert float(maps[0].findtext("size").split()[2]) > 0
    assert root.find(".//surface/friction/ode/mu") is not None
    assert root.find(".//surface/contact/ode/kp").text == "100000.0"
    for element in maps[1].iter():
        if element.tag in ("diffuse", "normal"):
            with Image.open(share / element.text[len("file://") :]) as image:
                image.load()


def test_flat_terrain_is_level(share):
    assert not terrain_model("heightmap_flat", [share / "models"]).heights_m.any()


def test_same_seed_same_bytes_other_seed_other_bytes(tmp_path, hash_of):
    folders = [
        write_terrain(
            generate_terrain(TerrainParams(), _rng(seed)), 1.0, "t", "t", tmp_path / place
        )
        for place, seed in (("a", 1), ("b", 1), ("c", 2))
    ]
    a, b, c = map(hash_of, folders)
    assert a == b != c


@pytest.mark.parametrize(
    "change",
    [{"samples": 100}, {"size_m": -1.0}, {"friction_mu": 0.0}, {"bump_sd_m": float("nan")}],
)
def test_bad_parameters_are_refused(change):
    with pytest.raises(GeneratorError, match="found .* expected"):
        generate_terrain(TerrainParams(**change), _rng())
