# SPDX-License-Identifier: MIT
"""Tests the command and the files that it writes."""

import csv
import json
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
from PIL import Image

EXTENSION = "{urn:ardee:sdf}"
BASE = ("--models", "corn_a", "corn_b", "--name", "field")


def _bytes(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in folder.rglob("*") if p.is_file()}


def _truth(folder):
    with (folder / "truth.csv").open() as file:
        return list(csv.DictReader(file))


def test_no_plant_is_lost_between_sdf_truth_and_plan(generate_field, tmp_path):
    heights = ("--stalk-height-min-m", "0.5", "--stalk-height-max-m", "0.9")
    code, error = generate_field(
        *BASE, *heights, "--terrain", "ground", "--seed", "5", "--output", tmp_path
    )
    assert (code, error) == (0, "")
    folder = tmp_path / "field"
    truth = _truth(folder)
    root = ElementTree.parse(folder / "model.sdf").getroot()
    assert root.find("model").get("name") == "field"
    includes = root.findall("model/include")
    data = json.loads((folder / "truth.json").read_text())
    assert len(includes) == len(truth) == data["emerged"] == len(data["plants"]["id"])
    assert data["planned"] == 200 and 160 < data["emerged"] < 200
    assert len({include.findtext("name") for include in includes}) == len(includes)
    for include, row in zip(includes, truth):
        assert (row["species"], row["stage"]) == (
            "corn",
            {"corn_a": "V6", "corn_b": "V8"}[row["model"]],
        )
        assert include.findtext("name") == f"plant_{row['id']}"
        assert include.findtext("uri") == f"model://{row['model']}"
        pose = [float(v) for v in include.findtext("pose").split()]
        assert pose == [
            float(row["x_m"]),
            float(row["y_m"]),
            float(row["z_m"]),
            0,
            0,
            float(row["yaw_rad"]),
        ]
        assert float(include.findtext(f"{EXTENSION}scale", "1")) == float(row["scale"])
        assert include.findtext(f"{EXTENSION}label") == "1"
        assert include.findtext("static") == "true"


def test_scale_is_left_out_where_it_is_one(generate_field, tmp_path):
    generate_field(*BASE, "--output", tmp_path)
    text = (tmp_path / "field" / "model.sdf").read_text()
    assert "ardee:scale" not in text and "ardee:label" in text


def test_truth_tells_rows_and_world_positions(generate_field, tmp_path):
    pose = ("--world-pose", "0", "0", str(-np.pi / 2))
    generate_field(*BASE, *pose, "--gps-origin-deg", "40.1", "-88.2", "--output", tmp_path)
    folder = tmp_path / "field"
    data = json.loads((folder / "truth.json").read_text())
    assert [row["start_m"] for row in data["rows"]] == [
        [x, -1.0] for x in (-1.143, -0.381, 0.381, 1.143)
    ]
    for row in _truth(folder):
        assert float(row["world_x_m"]) == pytest.approx(float(row["y_m"]), abs=2e-4)
        assert float(row["world_y_m"]) == pytest.approx(-float(row["x_m"]), abs=2e-4)
        assert abs(float(row["latitude_deg"]) - 40.1) < 1e-4 and float(row["longitude_deg"]) < -88.2


def _count_of(image, colour):
    return sum(count for count, found in image.getcolors(1 << 24) if found == colour)


def test_map_shows_planned_places_and_plants(generate_field, tmp_path):
    generate_field(*BASE, "--output", tmp_path)
    with Image.open(tmp_path / "field" / "map.png") as image:
        assert _count_of(image, (200, 20, 20)) > 190 * 4
        assert _count_of(image, (110, 200, 110)) > 190 * 8
        assert _count_of(image, (0, 0, 0)) > 0


def test_map_explains_only_what_it_shows(generate_field, tmp_path):
    colours = ((60, 110, 220), (225, 140, 20))  # gaps, leaning plants
    for name, flags in (("bare", ()), ("full", ("--gaps", 2, "--lodging", 0.1))):
        generate_field(*BASE, *flags, "--output", tmp_path / name)
        with Image.open(tmp_path / name / "field" / "map.png") as image:
            legend = image.crop((image.width - 170, 0, image.width, image.height))
            for colour in colours:
                assert (_count_of(legend, colour) == 100) == (name == "full")


def test_same_seed_same_bytes_other_seed_other_bytes(generate_field, tmp_path):
    for place, seed in (("a", 1), ("b", 1), ("c", 2)):
        assert generate_field(*BASE, "--seed", seed, "--output", tmp_path / place)[0] == 0
    a, b, c = (_bytes(tmp_path / place / "field") for place in "abc")
    assert a == b
    assert all(a[name] != c[name] for name in ("model.sdf", "truth.csv", "truth.json", "map.png"))


def test_a_plan_of_the_users_own(generate_field, tmp_path):
    plan = tmp_path / "plan.csv"
    plan.write_text("x_m,y_m\n1,2\n3,4\n")
    certain = ("--noise-covariance-m2", "0", "0", "--emergence-min", "1", "--emergence-max", "1")
    assert generate_field(*BASE, *certain, "--centers", plan, "--output", tmp_path)[0] == 0
    positions = [(float(row["x_m"]), float(row["y_m"])) for row in _truth(tmp_path / "field")]
    assert positions == [(1.0, 2.0), (3.0, 4.0)]


@pytest.mark.slow
def test_many_plants(generate_field, tmp_path):
    shape = ("--plots-x", "10", "--plots-y", "5", "--stalks-per-row", "1000")
    place = ("--format", "sdf", "--output", tmp_path)
    assert generate_field(*BASE, *shape, *place)[0] == 0
    text = (tmp_path / "field" / "model.sdf").read_text()
    assert (
        text.count("<include>")
        == text.count("</include>")
        == len(_truth(tmp_path / "field"))
        > 180_000
    )


@pytest.mark.parametrize(
    "arguments, message",
    [
        (("--rows-per-plot", "-1"), "rows per plot: found -1"),
        (("--models", "corn_z"), "model 'corn_z': not found, known: corn_a, corn_b"),
        (("--models", "ground"), "neither metrics.json nor a collision cylinder"),
        (("--terrain", "moon"), "model 'moon': not found"),
        (("--terrain", "corn_a"), "no <heightmap>"),
        (("--emergence-max", "1.01"), "emergence max: found 1.01, expected 0 to 1"),
        (("--noise-covariance-m2", "1", "2", "1"), "positive definite"),
        (("--noise-covariance-m2", "1"), "found 1 numbers"),
        (("--stalks-per-row", "0"), "stalks per row: found 0"),
        (("--seed", "-3"), "--seed: found '-3', expected a whole number from 0"),
        (("--emergence-min", "0", "--emergence-max", "0"), "found no plant that emerged of"),
        (("--rows-per-plot", "four"), "--rows-per-plot: invalid int value"),
        (("--centers", "nowhere.csv"), "nowhere.csv: cannot be read"),
        (("--name", "../field"), "name '../field'"),
    ],
)
def test_bad_input_writes_nothing_and_keeps_the_earlier_field(
    generate_field, tmp_path, arguments, message
):
    assert generate_field(*BASE, "--output", tmp_path)[0] == 0
    before = _bytes(tmp_path)
    code, error = generate_field(*BASE, "--output", tmp_path, *arguments)
    assert code == 2 and message in error
    assert _bytes(tmp_path) == before


@pytest.mark.parametrize(
    "text",
    [
        "",
        "x_m,y_m\n",
        "x_m,y_m\n1,two\n",
        "x,y\n1,2\n",
        "x_m,y_m\n1,inf\n",
        "x_m,y_m\n1,nan\n",
        "x_m,y_m\n1\n",
        "x_m,y_m\n0,0\n5e10,0\n",
        "x_m,y_m,plot\n0,0,99999999999999999999\n",
        "x_m,y_m,row\n0,0,9007199254740993\n",
        "x_m,y_m,row\n0,0,-1\n",
        "x_m,y_m\n1_0,2\n",
        "x_m,y_m\n\u0663,2\n",
        "x_m,y_m,Row\n1,2,0\n",
        "x_m,y_m,x_m\n1,2,3\n",
        "x_m,y_m,row\n0,0,0\n1,0,0\n0,0,1\n",
    ],
)
def test_bad_plans_name_the_file(generate_field, tmp_path, text):
    plan = tmp_path / "plan.csv"
    plan.write_text(text)
    code, error = generate_field(*BASE, "--centers", plan, "--output", tmp_path)
    assert code == 2 and str(plan) in error and not (tmp_path / "field").exists()


def test_a_plan_of_the_largest_numbers_is_drawn_and_one_of_a_spreadsheet_read(
    generate_field, tmp_path
):
    plan = tmp_path / "plan.csv"
    plan.write_text("\ufeffx_m,y_m, plot, row\n0,0,0,0\n100000,-100000,100000,100000\n")
    certain = ("--noise-covariance-m2", 0, 0, "--emergence-min", 1, "--emergence-max", 1)
    assert generate_field(*BASE, *certain, "--centers", plan, "--output", tmp_path)[0] == 0
    truth = json.loads((tmp_path / "field" / "truth.json").read_text())
    assert truth["plants"]["row"] == [0, 100_000] and truth["plants"]["y_m"] == [0.0, -1e5]
