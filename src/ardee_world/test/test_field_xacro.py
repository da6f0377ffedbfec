# SPDX-License-Identifier: MIT
"""Tests the thesis's field file: Listing A.22's commands on it, the plots of Listing A.7, and clutter's files."""

import csv
import json
import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest

from ardee_world.clutter_models import MODELS, write_clutter_model

BASE = ("--models", "corn_a", "corn_b", "--name", "field")
# The commands are lines 129-145 of the listing, without its temporary names and echoes.
LISTING = r"""
set -e
cp "$field" temp_plots
cp "$field" temp_plants
end=$(grep -n "123456789end123456789" temp_plots | grep -Eo '^[^:]+')
cmd="sed -e '1,${end}d' < temp_plots > temp_plots2"
eval "$cmd"
cmd="sed -e '$end,\$d' < temp_plants > temp_plants2"
eval "$cmd"
"""


def test_the_listings_commands_take_the_file_apart(generate_field, tmp_path):
    assert (
        generate_field(*BASE, "--plots-x", 2, "--terrain", "ground", "--output", tmp_path)[0] == 0
    )
    folder = tmp_path / "field"
    environment = {"field": str(folder / "field.urdf.xacro"), "PATH": "/usr/bin:/bin"}
    subprocess.run(["bash", "-c", LISTING], cwd=tmp_path, env=environment, check=True)
    assert (tmp_path / "temp_plants2").read_bytes() == (folder / "model.sdf").read_bytes()
    assert (tmp_path / "temp_plots2").read_bytes() == (folder / "plots.xacro").read_bytes()
    assert ElementTree.parse(tmp_path / "temp_plants2").getroot().tag == "sdf"
    assert ElementTree.parse(tmp_path / "temp_plots2").getroot().tag == "robot"


def test_plots_have_the_listings_elements_and_the_fields_numbers(generate_field, tmp_path):
    shape = (
        "--plots-x",
        2,
        "--plots-y",
        3,
        "--row-length-m",
        5,
        "--world-pose",
        2,
        1,
        np.pi / 2,
        "--terrain",
        "ground",
    )
    assert generate_field(*BASE, *shape, "--output", tmp_path)[0] == 0
    plots = ElementTree.parse(tmp_path / "field" / "plots.xacro").getroot().findall("plot")
    names = "plot_id plot_range_index plot_crossrange_index x y z rotation row_count row_width row_length"
    assert [e.tag for e in plots[0]] == [*names.split(), "average_height", "average_density"]
    truth = json.loads((tmp_path / "field" / "truth.json").read_text())
    plants = {name: np.array(values) for name, values in truth["plants"].items()}
    for number, plot in enumerate(plots):
        value = {e.tag: float(e.text) for e in plot}
        mine = plants["plot"] == number
        assert value["plot_id"] == number
        assert (value["plot_range_index"], value["plot_crossrange_index"]) == divmod(number, 2)
        assert (value["row_count"], value["row_width"], value["row_length"]) == (4, 0.762, 5)
        assert value["average_height"] == pytest.approx(plants["height_m"][mine].mean(), abs=1e-3)
        assert value["average_density"] == pytest.approx(mine.sum() / (4 * 0.762 * 5), rel=1e-3)
        # Its plants lie in it, and reach to its ends.
        c, s = np.cos(value["rotation"]), np.sin(value["rotation"])
        dx, dy = plants["world_x_m"][mine] - value["x"], plants["world_y_m"][mine] - value["y"]
        along, across = c * dx + s * dy, c * dy - s * dx
        assert 2.2 < np.abs(along).max() < 2.75 and 1.0 < np.abs(across).max() < 4 * 0.762 / 2
        assert value["z"] == pytest.approx(plants["z_m"][mine].mean(), abs=1e-3)


def test_a_plot_of_single_plants_is_as_long_as_they_stand_apart(generate_field, tmp_path):
    shape = (
        "--rows-per-plot",
        2,
        "--stalks-per-row",
        1,
        "--stalk-spacing-m",
        0.2,
        "--terrain",
        "ground",
    )
    assert generate_field(*BASE, *shape, "--output", tmp_path)[0] == 0
    plot = ElementTree.parse(tmp_path / "field" / "plots.xacro").getroot().find("plot")
    value = {e.tag: float(e.text) for e in plot}
    assert (value["row_count"], value["row_width"], value["row_length"]) == (2, 0.762, 0.2)
    plants = json.loads((tmp_path / "field" / "truth.json").read_text())["plants"]
    area_m2 = 2 * 0.762 * 0.2
    assert value["average_density"] == pytest.approx(len(plants["plot"]) / area_m2, rel=1e-3)


def test_clutter_reaches_model_and_truth(generate_field, models, tmp_path):
    for name in MODELS:
        write_clutter_model(name, tmp_path / "clutter")
    densities = (
        "--weed-density-per-m2",
        2,
        "--stone-density-per-m2",
        1,
        "--litter-density-per-m2",
        1,
    )
    path = ("--model-path", tmp_path / "clutter", "--terrain", "ground")
    assert generate_field(*BASE, *densities, *path, "--output", tmp_path)[0] == 0
    folder = tmp_path / "field"
    with (folder / "clutter.csv").open() as file:
        rows = list(csv.DictReader(file))
    root = ElementTree.parse(folder / "model.sdf").getroot()
    items = {i.findtext("name"): i for i in root.findall("model/include")}
    assert {row["label"] for row in rows} == {"10", "11", "12"} and len(rows) > 40
    for row in rows:
        item = items[f"{row['kind']}_{row['id']}"]
        assert item.findtext("uri") == f"model://{row['model']}"
        assert item.findtext("{urn:ardee:sdf}label") == row["label"]
        assert [float(v) for v in item.findtext("pose").split()[:3]] == [
            float(row[a]) for a in ("x_m", "y_m", "z_m")
        ]


@pytest.mark.parametrize("name", MODELS)
def test_clutter_models_are_whole_and_the_same_every_time(tmp_path, name):
    a, b = (write_clutter_model(name, tmp_path / place) for place in "ab")
    for path in a.rglob("*"):
        assert path.is_dir() or path.read_bytes() == (b / path.relative_to(a)).read_bytes()
    root = ElementTree.parse(a / "model.sdf").getroot()
    assert (root.find(".//collision") is not None) == MODELS[name].solid
    mesh = a.parent / root.findtext(".//visual//uri")[len("model://") :]
    count = int(np.frombuffer(mesh.read_bytes()[80:84], "<u4")[0])
    data = np.fromfile(
        mesh, dtype=np.dtype([("n", "<f4", 3), ("v", "<f4", (3, 3)), ("a", "<u2")]), offset=84
    )
    assert len(data) == count == json.loads((a / "metrics.json").read_text())["triangles"] <= 1500
    lengths = np.linalg.norm(data["n"], axis=1)
    assert np.isfinite(data["v"]).all() and ((np.abs(lengths - 1) < 1e-5) | (lengths < 1e-5)).all()
    if MODELS[name].solid:  # a closed surface seen from outside: its volume is positive
        volume = (
            np.einsum("ij,ij->i", data["v"][:, 0], np.cross(data["v"][:, 1], data["v"][:, 2])).sum()
            / 6
        )
        assert volume > 1e-5
    else:  # sheets have both sides
        key = np.sort(np.round(data["v"], 6).view("f4").reshape(count, 9), axis=1)
        assert len(np.unique(key, axis=0)) <= count // 2
