# SPDX-License-Identifier: MIT
"""Recipes: which are refused, with file and line, before any field is sown."""

from pathlib import Path

import pytest
from small_sets import RECIPE

from ardee_common.errors import GeneratorError
from ardee_datasets.plan import scenes, shots
from ardee_datasets.recipe import read_recipe
from ardee_datasets.scenery import Scenery
from ardee_world.row_truth import Polyline, read_field


def read(folder: Path, old: str, new: str) -> object:
    """Reads the small recipe with a change."""
    assert old in RECIPE
    path = folder / "recipe.yaml"
    path.write_text(RECIPE.replace(old, new, 1))
    return read_recipe(path)


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("frames: 2", "framse: 2", "recipe.yaml:6: unknown key 'framse'.*frames"),
        ("row_length_m: 3.0,", "row_lenght_m: 3.0,", "recipe.yaml:7: unknown key.*row_length_m"),
        ("[0.7, 0.8]", "[0.8, 0.7]", "recipe.yaml:8: row_spacing_m: found.*least, most"),
        ("height_px: 72, ", "", "recipe.yaml:14: found neither sensor nor height_px"),
        ("width_px: 96", "sensor: reelsense_d435", "recipe.yaml:14: sensor: .*realsense_d435"),
        ("sensor: vlp16", "sensor: imu", "recipe.yaml:16: sensor: found 'imu'.*vlp16"),
        (
            "width_px: 96",
            "white_balance: 3000, width_px: 96",
            "14: white_balance: found 3000, expected off",
        ),
        ("width_px: 96", "lens: {dust: [2, 1]}, width_px: 96", "14: dust: found.*least, most"),
        (
            "lidars:",
            "robots: {r: {robot: tsv9}}\nlidars:",
            "15: robot: found no robot 'tsv9'.*tsv3",
        ),
        ("_variant_7", "_varient_7", "recipe.yaml:12: models: model 'corn_varient_7': not found"),
        ("split: test", "split: tst", "split: found 'tst', expected one of train, val, test"),
        (
            "row_length_m: 3.0,",
            "row_length_m: 18.0,",
            "corn: options: .*beside the terrain .x -15 to 15 m",
        ),
        ("row_length_m: 3.0,", "row_length_m: 3.0, gaps: 20,", "corn: options: gaps: found 20 of"),
        ("frames: 1", "cameras: [frnt]", "recipe.yaml:11: cameras: found 'frnt', known: front"),
    ],
)
def test_a_bad_recipe_is_refused(tmp_path: Path, old: str, new: str, message: str) -> None:
    with pytest.raises(GeneratorError, match=message):
        read(tmp_path, old, new)


def test_a_field_is_seen_by_its_own_cameras(tmp_path: Path) -> None:
    path = tmp_path / "recipe.yaml"
    two = RECIPE.replace(
        "lidars:", "  down: {width_px: 8, height_px: 8, horizontal_fov_deg: 60}\nlidars:"
    )
    path.write_text(two.replace("frames: 1", "frames: 1\n    cameras: [down]"))
    recipe = read_recipe(path)
    seen = {scene.name: [shot.camera for shot in shots(recipe, scene)] for scene in scenes(recipe)}
    assert seen["late_0000"] == ["down"] and seen["corn_0001"] == 2 * ["down"] + 2 * ["front"]


@pytest.mark.parametrize(
    "options, message",
    [
        ("terrain: heightmap_grund", "12: terrain: model 'heightmap_grund': not found.*_ground"),
        ("terrain: corn_variant_1", "12: terrain: found 'corn_variant_1', expected a .*heightmap"),
        ("weed_models: [weed_rosete]", "12: weed_models: model 'weed_rosete': not found"),
        ("stone_models: []", "12: stone_models: found none, expected names of models"),
        ("row_spacing_m: wide", "12: row_spacing_m: found 'wide', expected 0.01 to 100000 m"),
        ("emergence_min: 1.5", "12: emergence_min: found 1.5, expected 0 to 1"),
        ("emergence_min: 0.99", "9: late: emergence: found minimum 0.99 above maximum 0.98"),
        ("row_length_m: 0", "9: late: found rows of one plant, expected"),
        ("row_shape: curved, curve_radius_m: 0.5", "9: late: curve radius: found 0.5 m"),
        ("rows_per_plot: 1", "9: late: rows_per_plot: found 1, expected .*less than 2.5 m apart"),
        ("row_spacing_m: 2.5", "9: late: found row_spacing_m 2.5, expected a lane .*than 2.5 m"),
        ("seed: 3", "12: seed: found it, expected none: a recipe sets it itself"),
        ("centers: c.csv", "12: centers: found it, expected none"),
    ],
)
def test_options_that_make_no_field_are_refused(tmp_path: Path, options: str, message: str) -> None:
    with pytest.raises(GeneratorError, match=f"recipe.yaml:{message}"):
        one = "" if options.startswith("row_length_m") else ", row_length_m: 3.0"
        read(tmp_path, "_variant_7], row_length_m: 3.0", f"_variant_7]{one}, {options}")


@pytest.mark.parametrize(
    "options",
    ["rows_per_plot: 1, plots_x: 2", "row_spacing_m: 3.0, plots_x: 2, terrain: ground_plane"],
)
def test_plots_side_by_side_have_a_lane(tmp_path: Path, options: str) -> None:
    read(tmp_path, "_variant_7],", f"_variant_7], {options},")


def test_ranges_are_checked_in_all_fields(tmp_path: Path) -> None:
    """The two fields draw 2.46 and 2.55 m."""
    with pytest.raises(GeneratorError, match="recipe.yaml:4: corn: found row_spacing_m 2.549"):
        read(tmp_path, "[0.7, 0.8]", "[2.3, 2.55]")
    with pytest.raises(GeneratorError, match="8: row_spacing_m: found 0.7, expected .*least, most"):
        read(tmp_path, "[0.7, 0.8]", "0.7")


def test_a_camera_that_is_named_twice_is_refused(tmp_path: Path) -> None:
    with pytest.raises(GeneratorError, match="12: cameras: found 'front' twice, expected it once"):
        read(tmp_path, "frames: 1", "frames: 1\n    cameras: [front, front]")


ROBOT = "robots: {%s: {robot: tsv3_default}}\nlidars:"


@pytest.mark.parametrize(
    "old, new, message",
    [
        ("  top:", "  field:", "16: lidars: found 'field', the name of the field too; expected"),
        ("lidars:", ROBOT % "field", "15: robots: found 'field', the name of the field too"),
        ("lidars:", ROBOT % "top", "15: robots: found 'top', the name of a lidar too"),
        (
            "lidars:",
            "  r_camera_front_sensor: {sensor: realsense_d435}\n"
            "robots: {r: {robot: tsv3_default}}\nlidars:",
            "16: robots: found another camera r_camera_front_sensor than camera camera_front_sensor of",
        ),
        ("lidars:", ROBOT % "front", "15: robots: found 'front', the name of a camera too"),
    ],
)
def test_names_that_mean_two_things_are_refused(
    tmp_path: Path, old: str, new: str, message: str
) -> None:
    with pytest.raises(GeneratorError, match=message):
        read(tmp_path, old, new)


@pytest.mark.parametrize(
    "key, message",
    [
        ("height_m: 0.5", "14: height_m: found 0.5, expected .least, most."),
        ("lens: {dust: 3}", "14: dust: found 3, expected .least, most."),
        ("exposure: bright", "14: exposure: found 'bright', expected auto or a number, 0.001 to"),
    ],
)
def test_values_of_cameras_are_refused(tmp_path: Path, key: str, message: str) -> None:
    with pytest.raises(GeneratorError, match=message):
        read(tmp_path, "height_m: [0.4, 0.6]", key)


def test_an_exposure_may_be_automatic(tmp_path: Path) -> None:
    recipe = read(tmp_path, "width_px", "exposure: auto, width_px")
    assert recipe.cameras["front"].exposure is None
    assert read(tmp_path, "width_px", "exposure: 2, width_px").cameras["front"].exposure == 2.0


@pytest.mark.parametrize(
    "labels, message",
    [
        ("{soybean: 12}", "recipe.yaml:15: labels: soybean: found 12, expected .* 13 and 65535"),
        ("{soybean: true}", "soybean: found True, expected a whole number"),
        ("{corn: 13}", "found corn: 13, of which one stands for another category"),
        ("{soybean: 20, pea: 20}", "found pea: 20, of which one"),
        ("{a|b: 20}", r"labels 'a\|b': expected letters"),
        ("[20]", "labels: found \\[20\\]"),
    ],
)
def test_own_labels_that_cannot_be_are_refused(tmp_path: Path, labels: str, message: str) -> None:
    with pytest.raises(GeneratorError, match=message):
        read(tmp_path, "lidars:\n", f"labels: {labels}\nlidars:\n")


def test_cameras_stand_between_rows_of_one_plot(tmp_path: Path) -> None:
    """Half a row's spacing from those of their lane, 0.38 m, less what rows of seedlings wander."""
    plots = "options: {models: [corn_variant_1], row_length_m: 2.0, rows_per_plot: 3, plots_y: 2}"
    (tmp_path / "recipe.yaml").write_text(
        f"fields: {{corn: {{{plots}}}}}\ncameras: {{front: {{sensor: realsense_d435}}}}\n"
    )
    recipe = read_recipe(tmp_path / "recipe.yaml")
    (scene,) = scenes(recipe)
    scenery = Scenery(scene, tmp_path)
    rows = [Polyline(row) for row in read_field(scenery.folder / "truth.json").rows]
    for seed in range(40):
        x_m, y_m, _ = scenery.draw_pose(recipe.cameras["front"], seed).xyz_m
        seen = [(row, row.project(x_m, y_m)) for row in rows]
        beside_m = [abs(at.left_m) for row, at in seen if 0 <= at.along_m <= row.length_m]
        assert min(beside_m) > 0.3, seed
