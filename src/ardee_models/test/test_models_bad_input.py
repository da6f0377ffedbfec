# SPDX-License-Identifier: MIT
"""Tests that bad input gives one message with the place of the error, and changes nothing on disk."""

import sys

import pytest
import yaml

from ardee_common.errors import GeneratorError
from ardee_models.config_dir import config_dir
from ardee_models.lookup import crop_model, find_model, search_path, terrain_model
from ardee_models.plant import generate_crop
from ardee_models.plant.crops import make_crop
from ardee_models.prepare import prepare_crop
from ardee_models.terrain import generate_terrain


def _params_file(tmp_path, change):
    data = yaml.safe_load((config_dir() / "species" / "corn.yaml").read_text())
    change(data)
    path = tmp_path / "corn.yaml"
    path.write_text(yaml.safe_dump(data))
    return path


@pytest.mark.parametrize(
    "change, message",
    [
        (
            lambda d: d["architecture"]["leaves"].update(numbr=3),
            r"corn.yaml:\d+: unknown key 'numbr', .*; did you mean 'number'",
        ),
        (
            lambda d: d["architecture"]["leaves"].pop("curvature_deg"),
            r"corn.yaml:\d+: missing key 'curvature_deg'",
        ),
        (
            lambda d: d["architecture"]["leaves"].update(curvature_deg=999),
            r"curvature_deg: found 999, expected 0 to 180 deg",
        ),
        (
            lambda d: d["architecture"]["leaves"].update(number=3.5),
            r"corn.yaml:\d+: number: found 3.5, expected a whole number, 3 to 60",
        ),
        (
            lambda d: d["stages"]["V8"].update(season="spring"),
            "stages.V8.season: found 'spring', expected early mid late",
        ),
        (
            lambda d: d["architecture"].update(tassel=7),
            "tassel: found 7, expected a mapping",
        ),
        (
            lambda d: d["architecture"]["leaves"].update(venation="odd"),
            "venation: found 'odd', expected 'parallel' or 'pinnate'",
        ),
        (
            lambda d: d["stages"]["V8"].update(collared_leaves=19, lost_leaves=1),
            "stages.V8.collared_leaves: found 19, expected at most leaves.number, 18",
        ),
        (
            lambda d: d.update(counters=["V", "Q"]),
            r"expected rows, and counters among V L D, found",
        ),
        (
            lambda d: d["colours"].update(leaf=[1, 2]),
            r"colours.leaf: found \(1.0, 2.0\), expected red, green, blue",
        ),
        (
            lambda d: d["stages"]["V8"].update(stalk_height_m=float("nan")),
            "stalk_height_m: found nan",
        ),
        (lambda d: d["stages"]["V8"].update(lost_leaves=8), "lost_leaves: found 8"),
        (lambda d: d.update(stages=[]), r"stages: found \[\], expected a mapping"),
    ],
)
def test_bad_parameter_files_name_file_and_key(tmp_path, change, message):
    path = _params_file(tmp_path, change)
    with pytest.raises(GeneratorError, match=message) as error:
        make_crop("corn", "V8", 1, "x", tmp_path / "out", path)
    assert str(path) in str(error.value)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "arguments, message",
    [
        (
            ["--species", "wheat", "--stage", "V8"],
            "unknown species 'wheat', known: sorghum, tobacco, corn",
        ),
        (["--stage", "V99"], "unknown stage 'V99', known: V1 to V18 (collared leaves); VT R1"),
        (["--stage", "V8", "--params", "nowhere.yaml"], "nowhere.yaml: cannot be read"),
    ],
)
def test_command_answers_in_one_line(tmp_path, monkeypatch, capsys, arguments, message):
    base = ["generate_crop", "--name", "x", "--output", str(tmp_path / "out")]
    monkeypatch.setattr(sys, "argv", base + arguments)
    with pytest.raises(SystemExit) as exit_:
        generate_crop.main()
    error = capsys.readouterr().err
    assert exit_.value.code == 2 and message in error and error.count("\n") == 1
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "main, words",
    [
        (generate_crop.main, ["--stage", "V3"]),
        (generate_terrain.main, []),
        (prepare_crop.main, ["mesh.obj"]),
    ],
)
def test_an_empty_output_is_refused(capsys, main, words):
    with pytest.raises(SystemExit) as exit_:
        main([*words, "--name", "mine", "--output", ""])
    error = capsys.readouterr().err
    assert exit_.value.code == 2 and "--output: found '', expected the name of a folder" in error


def test_a_suggested_command_quotes_its_paths(tmp_path, capsys):
    generate_crop.main(["--stage", "V3", "--name", "mine", "--output", str(tmp_path / "my own")])
    assert f" --model-path '{tmp_path}/my own' --name my_field" in capsys.readouterr().err


def test_default_output_is_where_the_model_is_found(tmp_path, monkeypatch, capsys):
    monkeypatch.setenv("GAZEBO_MODEL_PATH", f"/nowhere:{tmp_path}")
    assert generate_crop.main(["--stage", "V3", "--name", "mine"]) == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "mine")
    assert crop_model("mine", [tmp_path]).label == 1


def test_default_output_is_no_folder_that_a_build_makes(tmp_path, monkeypatch, capsys):
    built = tmp_path / "devel" / "share" / "ardee_models" / "models"
    built.mkdir(parents=True)
    (tmp_path / "devel" / ".catkin").write_text("/src")
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(built))
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    own = tmp_path / "home" / ".gazebo" / "models"
    for _ in range(2):  # the folder is made once
        assert generate_crop.main(["--stage", "V3", "--name", "mine"]) == 0
        assert capsys.readouterr().out.strip() == str(own / "mine")
    assert not list(built.iterdir())
    assert crop_model("mine", search_path()).label == 1


def _model(tmp_path, sdf=None, metrics=None):
    folder = tmp_path / "m"
    folder.mkdir()
    (folder / "model.config").write_text("<model/>")
    if sdf is not None:
        (folder / "model.sdf").write_text(sdf)
    if metrics is not None:
        (folder / "metrics.json").write_text(metrics)


@pytest.mark.parametrize(
    "sdf, metrics, message",
    [
        (None, None, "model.sdf: cannot be read"),
        ("<sdf>", None, "not valid XML"),
        ("<sdf/>", None, "neither metrics.json nor a collision cylinder"),
        (None, "{", "metrics.json"),
        (None, '{"height_m": 1}', "stalk_radius_m"),
        (None, '{"height_m": -1, "stalk_radius_m": 0.01, "label": 1}', "found height -1.0 m"),
    ],
)
def test_models_that_do_not_tell_their_height(tmp_path, sdf, metrics, message):
    _model(tmp_path, sdf, metrics)
    with pytest.raises(GeneratorError, match=message):
        crop_model("m", [tmp_path])


def test_a_users_model_is_as_tall_as_its_cylinder(tmp_path):
    cylinder = "<cylinder><length>0.5</length><radius>0.0075</radius></cylinder>"
    _model(tmp_path, f"<sdf><collision><geometry>{cylinder}</geometry></collision></sdf>")
    found = crop_model("m", [tmp_path])
    assert found.height_m == 0.5 and found.label == 0  # whatever it is, it is not corn


@pytest.mark.parametrize("name", ["..", "../m", "m/", "/m"])
def test_a_models_name_is_no_path(tmp_path, name):
    _model(tmp_path)
    with pytest.raises(GeneratorError, match="expected the name of a folder, not a path"):
        find_model(name, [tmp_path / "m", tmp_path])


def test_unreadable_terrain(tmp_path):
    heightmap = "<uri>file://m/h.png</uri><size>4 4 1</size><pos>0 0 0</pos>"
    _model(
        tmp_path,
        f"<sdf><collision><geometry><heightmap>{heightmap}</heightmap></geometry></collision></sdf>",
    )
    with pytest.raises(GeneratorError, match="h.png: not a readable image"):
        terrain_model("m", [tmp_path])
    (tmp_path / "m" / "h.png").write_bytes(b"\x89PNG\r\n\x1a\n truncated")
    with pytest.raises(GeneratorError, match="h.png: not a readable image"):
        terrain_model("m", [tmp_path])
