# SPDX-License-Identifier: MIT
"""Tests YAML files and bad input: one message with the place of the error, exit 2, the previous output untouched."""

import csv
import json
import math
import re
import shutil

import pytest
from PIL import Image

from ardee_world.generate_field import main, make_parser
from ardee_world.request import all_fields, configure, with_changes

BASE = ("--models", "corn_a", "corn_b", "--name", "field")


def _bytes(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


@pytest.fixture()
def plan(tmp_path):
    """Writes a YAML file with more lines; returns its path."""

    def write(*lines):
        path = tmp_path / "field.yaml"
        path.write_text(
            "\n".join(("name: field", "models: [corn_a, corn_b]", "output: out", *lines)) + "\n"
        )
        return path

    return write


def test_yaml_and_arguments_make_the_same_field(generate_field, tmp_path, plan):
    path = plan(
        "seed: 5",
        "rows_per_plot: 6",
        "noise_covariance_m2: [1e-4, 4e-4]",
        "stalks_per_row: 30",
        "gaps: 3",
    )
    assert generate_field(path) == (0, "")
    arguments = (
        "--seed",
        5,
        "--rows-per-plot",
        6,
        "--noise-covariance-m2",
        "1e-4",
        "4e-4",
        "--stalks-per-row",
        30,
        "--gaps",
        3,
    )
    assert generate_field(*BASE, *arguments, "--output", tmp_path / "b")[0] == 0
    assert _bytes(tmp_path / "out") == _bytes(tmp_path / "b")  # its output is relative to the file


def test_arguments_win_over_the_file(generate_field, tmp_path, plan):
    path = plan("seed: 5", "rows_per_plot: 6", "stalks_per_row: 30")
    assert generate_field(path, "--rows-per-plot", 2, "--row-length-m", "1.66")[0] == 0
    truth = json.loads((tmp_path / "out" / "field" / "truth.json").read_text())
    assert truth["planned"] == 2 * 11 and truth["seed"] == 5


def test_centres_listed_in_the_file(generate_field, tmp_path, plan):
    path = plan(
        "centers: [[1, 2], [3.5, 4]]",
        "noise_covariance_m2: [0, 0]",
        "emergence_min: 1",
        "emergence_max: 1",
    )
    assert generate_field(path)[0] == 0
    with (tmp_path / "out" / "field" / "truth.csv").open() as file:
        assert [(row["x_m"], row["y_m"]) for row in csv.DictReader(file)] == [
            ("1.0", "2.0"),
            ("3.5", "4.0"),
        ]


def test_rows_of_a_users_own_plan(generate_field, tmp_path):
    path = tmp_path / "plan.csv"
    path.write_text("x_m,y_m,row,plot\n0,0,0,0\n1,0,1,0\n0,-1,0,0\n1,-1,1,0\n")
    certain = ("--noise-covariance-m2", 0, 0, "--emergence-min", 1, "--emergence-max", 1)
    assert generate_field(*BASE, *certain, "--centers", path, "--output", tmp_path)[0] == 0
    truth = json.loads((tmp_path / "field" / "truth.json").read_text())
    assert [row["line_m"] for row in truth["rows"]] == [[[0, 0], [0, -1]], [[1, 0], [1, -1]]]
    assert truth["plants"]["place"] == [0, 0, 1, 1]


@pytest.mark.parametrize(
    "line, message",
    [
        ("row_spaceing_m: 1", "field.yaml:4: unknown key 'row_spaceing_m', nearest of "),
        (
            "row_spacing_m: wide",
            "field.yaml:4: row_spacing_m: found 'wide', expected 0.01 to 100000 m",
        ),
        ("rows_per_plot: 2.5", "field.yaml:4: rows_per_plot: found 2.5, expected a whole number"),
        ("rows_per_plot: true", "field.yaml:4: rows_per_plot: found True"),
        ("doubles: 1.5", "field.yaml:4: doubles: found 1.5, expected 0 to 1"),
        ("stalk_spacing_m: -0.1", "field.yaml:4: stalk_spacing_m: found -0.1"),
        ("row_shape: spiral", "field.yaml:4: row_shape: found 'spiral', expected one of straight"),
        ("name: again", "field.yaml:4: found key 'name' a second time, first in line 1"),
        ("models: [1]", "field.yaml:4: found key 'models' a second time"),
        ("noise_covariance_m2: 3", "field.yaml:4: noise_covariance_m2: found 3, expected a list"),
        ("centers: [[1, 2], [3]]", "centers: expected a list of 1 to"),
        ("centers: [[1, true]]", "centers: expected a list of 1 to"),
        ("centers: [[99999999999999999999, 0]]", "pairs [x, y] in m, from -100000 to 100000"),
        (
            "centers: [[0, 0], [1, 2], [0, 0.00001]]",
            "centers[2]: found (0, 1e-05), which is the place of field: centers[0] too",
        ),
        ("centers: [[.nan, 0]]", "centers: expected a list of 1 to"),
        ("doubles: 1" + 400 * "0", "expected 0 to 1"),
        ("world_pose: [1e6, 0, 0]", "world_pose: found [1000000.0, 0, 0], expected -100000 to"),
        ("world_pose: [0, 0]", "field.yaml:4: world_pose: found [0, 0], expected 3 values"),
        ("centers: [[0, 0]]\nrow_shape: sine", "row shape: found sine, expected none with"),
        ("a: [", "field.yaml:5: not valid YAML"),
        ("seed: -1", "field.yaml:4: seed: found -1"),
    ],
)
def test_bad_files_name_file_and_line(generate_field, tmp_path, plan, line, message):
    assert generate_field(plan())[0] == 0
    before = _bytes(tmp_path / "out")
    code, error = generate_field(plan(line))
    assert code == 2 and message in error and error.count("\n") == 1
    assert _bytes(tmp_path / "out") == before


@pytest.fixture()
def bad_files(tmp_path):
    """Writes files with wrong content."""
    (tmp_path / "not.png").write_text("no image")
    Image.new("L", (4, 4)).save(tmp_path / "black.png")
    (tmp_path / "broken.csv").write_text("x_m,y_m\n1,2\n3,4\n5;6\n7,8\n")
    (tmp_path / "file").write_text("")
    return tmp_path


@pytest.mark.parametrize(
    "arguments, message",
    [
        (("--stalk-spacing-m", "0"), "stalk spacing: found 0.0, expected 0.01 to 100000 m"),
        (("--stalk-spacing-m", "nan"), "stalk spacing: found nan"),
        (("--row-spacing-m", "-1"), "row spacing: found -1.0"),
        (("--emergence-min", "-0.1"), "emergence min: found -0.1, expected 0 to 1"),
        (("--lodging", "2"), "lodging: found 2.0, expected 0 to 1"),
        (("--doubles", "-1"), "doubles: found -1.0"),
        (("--rows-per-plot", "0"), "rows per plot: found 0"),
        (("--gaps", "5000"), "gaps: found 5000"),
        (("--centers", "{dir}/broken.csv"), "broken.csv: line 4: found"),
        (
            (
                "--weed-density-per-m2",
                "1",
                "--weed-models",
                "corn_a",
                "--weed-image",
                "{dir}/not.png",
            ),
            "not.png: not a readable image",
        ),
        (
            (
                "--weed-density-per-m2",
                "1",
                "--weed-models",
                "corn_a",
                "--weed-image",
                "{dir}/black.png",
            ),
            "found a black image",
        ),
        (
            (
                "--weed-density-per-m2",
                "1",
                "--weed-models",
                "corn_a",
                "--weed-image",
                "{dir}/none.png",
            ),
            "none.png: cannot be read",
        ),
        (("--weed-density-per-m2", "1", "--weed-models", "weed_z"), "model 'weed_z': not found"),
        (
            ("--weed-density-per-m2", "-1"),
            "weed density per m2: found -1.0|weed density: found -1.0",
        ),
        (("--output", ""), "output: found '', expected the name of a folder"),
        (
            ("--centers", "{dir}/broken.csv", "--cross-rows", "2"),
            "cross rows: found 2, expected none with centers",
        ),
        (
            ("--centers", "{dir}/broken.csv", "--stalks-per-row", "2"),
            "stalks per row: found 2, expected none with centers",
        ),
        (("--gap-length-m", "2"), "gap length: found 2.0, expected gaps too"),
        (("--weed-image", "{dir}/not.png"), "not.png, expected weed density too"),
        (("--output", "{dir}/file"), "file: cannot be written"),
        (("--row-length-m", "5", "--stalks-per-row", "7"), "expected one of them"),
        (("--row-shape", "expression", "--row-expression", "open('x')"), "row expression"),
        (("--unknown", "1"), "unknown argument '--unknown'"),
    ],
)
def test_bad_arguments_are_one_message_and_change_nothing(
    generate_field, bad_files, arguments, message
):
    out = bad_files / "out"
    assert generate_field(*BASE, "--output", out)[0] == 0
    before = _bytes(out)
    words = [str(a).format(dir=bad_files) for a in arguments]
    code, error = generate_field(*BASE, "--output", out, *words)
    assert code == 2 and error.count("\n") == 1
    assert any(part in error for part in message.split("|"))
    assert _bytes(out) == before


def test_each_flag_is_the_key_of_a_yaml_file():
    flags = set(make_parser()._option_string_actions) - {"-h", "--help"}
    keys = {"--" + key.replace("_", "-") for key in all_fields()}
    assert keys - flags == {
        "--origin-latitude-deg",
        "--origin-longitude-deg",
    }  # of --gps-origin-deg
    assert flags <= keys


def test_it_says_what_to_do_next_and_how_arguments_are_called_now(
    models, tmp_path, monkeypatch, capsys
):
    words = ["generate_field", "--models", "corn_a", "--name", "mine", "--rows", "2"]
    words += ["--output", str(tmp_path / "my own"), "--model-path", str(models)]
    monkeypatch.setattr("sys.argv", words)
    assert main() == 0
    field = tmp_path / "my own" / "mine" / "mine.urdf.xacro"
    assert field.is_file()
    where = f"GAZEBO_MODEL_PATH={models.resolve()}:$GAZEBO_MODEL_PATH"
    assert capsys.readouterr().err.splitlines() == [
        "generate_field: note: --rows is now --rows-per-plot",
        f"generate_field: to drive in it: {where} rosrun ardee_bringup run_custom_world '{field}' [TERRAIN]",
    ]


def test_help_gives_units(capsys):
    text = make_parser().format_help()
    for words in (
        "--row-spacing-m M",
        "[m]",
        "--lodging-direction-deg DEG",
        "[deg]",
        "[1/m^2]",
        "[m^2]",
        "--gps-origin-deg LAT LON",
    ):
        assert words in text


def test_a_length_as_a_change_wins_over_a_number_of_stalks():
    plan = {"stalks_per_row": 54, "models": ["a"], "name": "f"}
    assert configure(with_changes(plan, {"row_length_m": 4.0}))[1].plots.row_length_m == 4.0
    assert "stalks_per_row" in with_changes(plan, {"row_spacing_m": 0.7})


@pytest.mark.parametrize(
    "words, message",
    [
        (("--noise-covariance-m2", "0.004096", "0.001792", "0.0007840000000000001"), "covariance"),
        (("--origin-latitude", "5"), "did you mean '--gps-origin-deg'"),
    ],
)
def test_a_line_says_what_was_wrong(generate_field, tmp_path, words, message):
    code, said = generate_field("--models", "corn_a", "--name", "f", "--output", tmp_path, *words)
    assert code == 2 and message in said and said.count("\n") == 1


def test_an_empty_pool_and_texts_with_commas(generate_field, models, tmp_path):
    file = tmp_path / "f.yaml"
    file.write_text("models: [corn_a]\nname: f\nweed_density_per_m2: 1\nweed_models: []\n")
    code, said = generate_field(file, "--output", tmp_path)
    assert (code, "weed_models: found none, expected names" in said) == (2, True)
    shutil.copytree(models / "corn_a", tmp_path / "models" / "corn_x")
    metrics = tmp_path / "models/corn_x/metrics.json"
    data = json.loads(metrics.read_text())
    metrics.write_text(json.dumps({**data, "species": "Zea mays, L."}))
    field = ("--models", "corn_x", "--name", "g", "--model-path", tmp_path / "models")
    assert generate_field(*field, "--output", tmp_path)[0] == 0
    with (tmp_path / "g/truth.csv").open() as lines:
        assert {row["species"] for row in csv.DictReader(lines)} == {"Zea mays, L."}
    metrics.write_text(json.dumps({**data, "label": -3}))
    assert "found label -3, expected 0 to 65535" in generate_field(*field, "--output", tmp_path)[1]


def test_rows_that_are_listed_from_either_end_have_one_plot(generate_field, tmp_path):
    """Four rows of 10 m along x, every second one from its far end."""
    along, lines = [0.2 * k for k in range(51)], ["x_m,y_m,plot,row"]
    for row in range(4):
        lines += [f"{x:g},{0.75 * row:g},0,{row}" for x in along[:: 1 if row % 2 else -1]]
    (tmp_path / "rows.csv").write_text("\n".join(lines) + "\n")
    words = ("--centers", tmp_path / "rows.csv", "--world-pose", "0", "0", "0")
    field = ("--models", "corn_a", "--name", "f", "--output", tmp_path)
    assert generate_field(*field, *words)[0] == 0
    text = (tmp_path / "f/plots.xacro").read_text()
    numbers = [float(re.search(rf"<{tag}>([^<]+)", text)[1]) for tag in ("row_length", "rotation")]
    assert numbers[0] == pytest.approx(10.0, abs=0.1)
    assert abs(math.sin(numbers[1])) < 0.01
