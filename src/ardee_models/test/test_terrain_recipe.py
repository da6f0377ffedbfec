# SPDX-License-Identifier: MIT
"""Tests recipes: every part against its closed form, seeds, files, bad input."""

import functools
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_models.terrain import generate_terrain
from ardee_models.terrain.features import follow
from ardee_models.terrain.ground import ground_model
from ardee_models.terrain.recipe import (
    Clods,
    Ditch,
    Headland,
    Look,
    Recipe,
    Ridges,
    Ruts,
    Slope,
    read_recipe,
)


def _at(recipe, x, y):
    """Returns heights above the height at the origin."""
    terrain = follow(recipe)
    x, y = np.asarray(x, float), np.asarray(y, float)
    return terrain.height_at(x, y) - terrain.height_at(np.zeros(1), np.zeros(1))[0]


def test_a_slope_rises_as_it_says():
    recipe = Recipe(slope=Slope(grade_percent=5.0, direction_deg=90.0))
    np.testing.assert_allclose(_at(recipe, [0, 3, 0], [10, 10, -10]), [0.5, 0.5, -0.5], atol=1e-9)


@pytest.mark.parametrize("direction", [0.0, 90.0])
def test_ridges_run_where_they_say(direction):
    recipe = Recipe(
        size_m=16.0,
        samples=1025,
        ridges=(Ridges(spacing_m=1.0, height_m=0.1, direction_deg=direction),),
    )
    along, across = np.array([-3.0, 0.0, 4.0]), np.full(3, 0.5)
    x, y = (along, across) if direction == 0.0 else (across, along)
    np.testing.assert_allclose(_at(recipe, x, y), 0.1, atol=1e-3)
    np.testing.assert_allclose(_at(recipe, np.rint(x), np.rint(y)), 0.0, atol=1e-3)


def test_headlands_have_no_ridges():
    ridges = (Ridges(spacing_m=1.0, height_m=0.1),)
    recipe = Recipe(samples=1025, ridges=ridges, headland=(Headland(along_m=8.0, fade_m=1.0),))
    np.testing.assert_allclose(
        _at(recipe, [0, 7.9, 9.1, -9.1], [0.5] * 4), [0.1, 0.1, 0, 0], atol=1e-3
    )


def test_ruts_are_as_deep_and_far_apart_as_they_say():
    ruts = Ruts(track_m=2.0, depth_m=0.1, width_m=0.5, lug_depth_m=0.0, offset_m=3.0)
    recipe = Recipe(samples=1025, ruts=(ruts,))
    np.testing.assert_allclose(
        _at(recipe, [0, 5, 0], [2.0, 4.0, 3.0]), [-0.1, -0.1, 0.0], atol=1e-9
    )
    berm = _at(recipe, np.zeros(1), [4.0 + 0.25 * 1.45])[0]
    assert berm == pytest.approx(0.035, abs=2e-3)
    lugs = Recipe(samples=4097, ruts=(Ruts(track_m=2.0, depth_m=0.1, lug_depth_m=0.02),))
    profile = _at(lugs, np.linspace(-2, 2, 801), np.full(801, 1.0))
    assert np.ptp(profile) == pytest.approx(0.02, abs=1e-3)


def test_a_ditch_is_as_deep_and_wide_as_it_says():
    ditch = Ditch(offset_m=-5.0, depth_m=0.5, bottom_width_m=1.0, bank_width_m=2.0)
    found = _at(Recipe(samples=1025, ditches=(ditch,)), [0] * 5, [-5, -5.4, -6.5, -7.6, -3.5])
    np.testing.assert_allclose(found, [-0.5, -0.5, -0.25, 0.0, -0.25], atol=2e-3)


@pytest.mark.parametrize("lumps", [False, True])
def test_clods_have_their_deviation_and_lumps_stand_on_level_ground(lumps):
    recipe = Recipe(samples=1025, seed=4, clods=(Clods(size_m=0.15, sd_m=0.01, lumps=lumps),))
    heights = follow(recipe).heights_m
    assert heights.std() == pytest.approx(0.01, rel=0.03)
    level = np.isclose(heights, heights.min(), atol=1e-12).mean()
    assert (0.75 < level < 0.82) if lumps else level < 1e-3


def test_each_scale_has_its_own_stream():
    coarse, fine = Clods(size_m=1.0, sd_m=0.02), Clods(size_m=0.1, sd_m=0.004)
    one, both = (follow(Recipe(seed=5, clods=c)).heights_m for c in ((coarse,), (coarse, fine)))
    added = both - one
    assert added.std() == pytest.approx(0.004, rel=0.05)
    assert np.array_equal(one, follow(Recipe(seed=5, clods=(coarse,))).heights_m)
    assert not np.array_equal(one, follow(Recipe(seed=6, clods=(coarse,))).heights_m)


def test_nothing_stands_over_the_origin():
    recipe = Recipe(seed=1, clods=(Clods(sd_m=0.05, size_m=0.3),), slope=Slope(10.0, 45.0))
    x, y = np.meshgrid(np.linspace(-0.3, 0.3, 7), np.linspace(-0.3, 0.3, 7))
    assert follow(recipe).height_at(x, y).max() <= 1e-12


GOOD = """size_m: 20
samples: 257
seed: 3
ridges: {spacing_m: 0.9, height_m: 0.08}
ruts:
  - {offset_m: 2.7}
  - {offset_m: -2.7, depth_m: 0.04}
clods:
  - {size_m: 0.2, sd_m: 6e-3, lumps: true}
surface: {mu: 0.5, mu2: 0.4, kp: 2e5, kd: 5000}
look: {textures: [dirt, grass], blends: [{min_height_m: 0.05, fade_m: 0.1}]}
"""


def test_a_recipe_file_says_all_of_it(tmp_path):
    (tmp_path / "r.yaml").write_text(GOOD)
    recipe = read_recipe(tmp_path / "r.yaml")
    assert recipe.ridges[0].spacing_m == 0.9 and recipe.ruts[1].depth_m == 0.04
    assert recipe.clods[0].sd_m == 0.006 and recipe.clods[0].lumps
    assert recipe.surface.kp == 2e5 and recipe.look.textures == ("dirt", "grass")


@pytest.fixture()
def command(run_main):
    """Runs generate_terrain; returns exit code and standard error."""
    return functools.partial(run_main, generate_terrain.main)


def test_surface_and_look_reach_the_model(command, tmp_path, hash_of):
    (tmp_path / "r.yaml").write_text(GOOD)
    for place in "ab":
        code = command(
            tmp_path / "r.yaml",
            "--name",
            "g",
            "--output",
            tmp_path / place,
            "--mu2",
            "0.3",
        )
        assert code == (0, "")
    assert hash_of(tmp_path / "a") == hash_of(tmp_path / "b")
    root = ElementTree.parse(tmp_path / "a/g/model.sdf").getroot()
    found = [root.findtext(f".//surface//{tag}") for tag in ("mu", "mu2", "kp", "kd")]
    assert found == ["0.5", "0.3", "200000.0", "5000.0"]
    assert len(root.findall(".//texture")) == 2 and root.findtext(".//blend/min_height") == "0.05"
    assert (tmp_path / "a/g/map.png").is_file()


def test_a_recipe_of_form_mesh_is_the_same_ground_of_triangles(command, tmp_path):
    text = GOOD.replace("look:", "# ").replace("samples: 257", "samples: 65")
    text = text.replace("{size_m: 0.2", "{size_m: 0.7")
    (tmp_path / "r.yaml").write_text(text + "form: mesh\n")
    assert command(tmp_path / "r.yaml", "--name", "g", "--output", tmp_path) == (0, "")
    root = ElementTree.parse(tmp_path / "g/model.sdf").getroot()
    assert root.findtext(".//collision//mesh/uri") == "model://g/meshes/g.obj"
    assert root.findtext(".//surface//kp") == "200000.0" and root.find(".//heightmap") is None
    x, y = np.random.default_rng(0).uniform(-9.9, 9.9, (2, 200))
    expected = follow(read_recipe(tmp_path / "r.yaml")).height_at(x, y)
    found = ground_model("g", [tmp_path]).height_at(x, y)
    np.testing.assert_allclose(found, expected, atol=2e-6)  # six decimals in the file
    assert np.ptp(found) > 0.05


@pytest.mark.parametrize(
    "line, message",
    [
        ("slop: {}", "r.yaml:12: unknown key 'slop', nearest of 12: slope, "),
        ("ditches: [{depht_m: 1}]", "r.yaml:12: unknown key 'depht_m'"),
        ("ditches: [{depth_m: deep}]", "r.yaml:12: depth_m: found 'deep', expected 0 to 10 m"),
        ("ditches: {depth_m: 1}", "r.yaml:12: ditches: found"),
        ("slope: 3", "r.yaml:12: slope: found 3, expected a mapping"),
        ("slope: {grade_percent: .nan}", "r.yaml:12: grade_percent: found nan"),
        ("form: mush", "r.yaml:12: form: found 'mush', expected one of heightmap, mesh"),
        ("form: mesh", "terrain look: found one with form mesh"),
        ("size_m: 30", "r.yaml:12: found key 'size_m' a second time"),
    ],
)
def test_bad_recipes_name_file_and_line(command, tmp_path, hash_of, line, message):
    (tmp_path / "r.yaml").write_text(GOOD)
    assert command(tmp_path / "r.yaml", "--name", "g", "--output", tmp_path / "out")[0] == 0
    before = hash_of(tmp_path / "out")
    (tmp_path / "r.yaml").write_text(f"{GOOD}{line}\n")
    code, error = command(tmp_path / "r.yaml", "--name", "g", "--output", tmp_path / "out")
    assert code == 2 and message in error and error.count("\n") == 1
    assert hash_of(tmp_path / "out") == before


def test_the_second_friction_of_a_recipe_is_by_default_its_first(tmp_path):
    (tmp_path / "r.yaml").write_text("surface: {mu: 0.3}\n")
    assert read_recipe(tmp_path / "r.yaml").surface.mu2 == 0.3


def test_parts_too_fine_for_the_pixels_are_told(command, tmp_path):
    text = "ridges: {spacing_m: 1.5}\nclods: [{size_m: 0.2}, {size_m: 1.9}]\n"
    (tmp_path / "r.yaml").write_text(text)
    words = (tmp_path / "r.yaml", "--name", "g", "--output", tmp_path)
    code, error = command(*words, "--size-m", 16, "--samples", 17)
    assert code == 0 and error.splitlines() == [
        f"generate_terrain: warning: terrain {part}, expected at least two pixels of 1 m, or more samples"
        for part in (
            "ridges spacing: found 1.5 m",
            "clods size: found 0.2 m",
            "clods size: found 1.9 m",
        )
    ]
    assert command(*words, "--size-m", 16, "--samples", 257) == (0, "")


@pytest.mark.parametrize(
    "change",
    [
        {"samples": 500},
        {"size_m": -1.0},
        {"seed": -1},
        {"ridges": (Ridges(spacing_m=0.0),)},
        {"ridges": (Ridges(spacing_m=0.3, half_width_m=0.16),)},
    ],
)
def test_bad_recipes_are_refused(change):
    with pytest.raises(GeneratorError, match="terrain .*found .* expected"):
        follow(Recipe(**change))


@pytest.mark.parametrize(
    "arguments, message",
    [
        (("--size-m", "-3"), "terrain size: found -3.0"),
        (("--samples", "100"), "terrain samples: found 100"),
        (("--mu", "0"), "terrain surface mu: found 0.0"),
        (("--kp", "nan"), "terrain surface kp: found nan"),
        (("none.yaml",), "none.yaml: cannot be read"),
        (("--image", "none.png"), "none.png: cannot be read"),
        (("--dem", "none.asc"), "none.asc: cannot be read"),
        (("--mesh", "none.obj"), "none.obj: cannot be read"),
        (("--image", "a.png", "--mesh", "b.obj"), "not allowed with"),
        (("--mesh", "b.obj", "--size-m", "3"), "found --size-m with --mesh"),
        (("--image-name", "../../../evil"), "name '../../../evil': expected letters, digits"),
        (("--image-name", "a b&c"), "name 'a b&c': expected letters, digits"),
    ],
)
def test_bad_arguments_are_one_message(command, tmp_path, arguments, message):
    code, error = command("--name", "g", "--output", tmp_path / "out", *arguments)
    assert code == 2 and message in error and error.count("\n") == 1
    assert not list(tmp_path.iterdir())


def test_a_recipes_texture_is_a_name_not_a_path():
    with pytest.raises(GeneratorError, match="name '../evil': expected letters, digits"):
        Recipe(look=Look(textures=("dirt", "../evil"))).validate()
