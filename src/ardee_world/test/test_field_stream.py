# SPDX-License-Identifier: MIT
"""Tests a field whose plants are a table beside model.sdf, against the same field as includes."""

import csv
import xml.etree.ElementTree as ElementTree

import pytest

from ardee_models.terrain.ground import ground_model
from ardee_world import assemble_world
from ardee_world.field_config import FieldConfig, Plots
from ardee_world.field_layout import generate
from ardee_world.request import LARGEST_SDF
from ardee_world.writers.field import is_stream
from ardee_world.writers.instances import HEADER

EXTENSION = "{urn:ardee:sdf}"
BASE = ("--models", "corn_a", "corn_b", "--name", "field")
VARIED = (
    *("--stalk-height-min-m", "0.5", "--stalk-height-max-m", "0.9", "--lodging", "0.2"),
    *("--doubles", "0.1", "--terrain", "ground"),
)


def _rows(path):
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def _of_include(include):
    pose = [float(v) for v in include.findtext("pose").split()]
    scale = float(include.findtext(f"{EXTENSION}scale", "1"))
    label = int(include.findtext(f"{EXTENSION}label"))
    return include.findtext("uri"), include.findtext("name"), pose, scale, label


def _of_row(row):
    pose = [float(row[c]) for c in HEADER.split(",")[2:8]]
    return row["model"], row["name"], pose, float(row["scale"]), int(row["label"])


def test_both_forms_hold_the_same_plants(generate_field, tmp_path):
    for form in ("sdf", "stream"):
        place = ("--format", form, "--output", tmp_path / form)
        assert generate_field(*BASE, *VARIED, *place) == (0, "")
    model = ElementTree.parse(tmp_path / "stream/field/model.sdf").getroot().find("model")
    assert model.find("include") is None and model.findtext("static") == "true"
    assert model.findtext(f"{EXTENSION}instances") == "plants.csv"
    table = tmp_path / "stream/field/plants.csv"
    text = table.read_text()
    assert text.startswith(HEADER) and text.endswith("\n")
    root = ElementTree.parse(tmp_path / "sdf/field/model.sdf").getroot()
    includes = [_of_include(include) for include in root.iter("include")]
    assert [_of_row(row) for row in _rows(table)] == includes and len(includes) > 150
    assert not (tmp_path / "sdf/field/plants.csv").exists()
    for name in ("truth.csv", "truth.json", "plots.xacro", "map.png", "model.config"):
        one, other = (tmp_path / form / "field" / name for form in ("sdf", "stream"))
        assert one.read_bytes() == other.read_bytes()


def test_large_fields_are_streams_unless_asked_otherwise(pool):
    def field(plants):
        plots = Plots(rows_per_plot=1, row_length_m=0.2 * (plants - 1), stalk_spacing_m=0.2)
        return generate(FieldConfig(plots, emergence_min=1.0, emergence_max=1.0), pool, 0)

    small, large = field(LARGEST_SDF), field(LARGEST_SDF + 1)
    assert (small.count(), large.count()) == (LARGEST_SDF, LARGEST_SDF + 1)
    assert not is_stream("auto", small) and is_stream("auto", large)
    assert is_stream("stream", small) and not is_stream("sdf", large)


def test_a_form_that_is_none_is_refused(generate_field, tmp_path):
    code, error = generate_field(*BASE, "--format", "xml", "--output", tmp_path)
    assert code == 2 and "--format: invalid choice: 'xml'" in error
    plan = tmp_path / "plan.yaml"
    plan.write_text("format: xml\n")
    code, error = generate_field(plan, *BASE, "--output", tmp_path)
    assert code == 2 and "plan.yaml:1: format: found" in error and not (tmp_path / "field").exists()


@pytest.fixture()
def put_together(models, generate_field, tmp_path, monkeypatch):
    """Returns a streamed field, and a function that sets it on the terrain `ground`."""
    world = ("--world-pose", "0", "0", "0", "--format", "stream")
    assert generate_field(*BASE, *world, "--output", tmp_path / "models")[0] == 0
    (tmp_path / "my.geofence").write_text("<robot/>\n")
    field = str(tmp_path / "models/field/field.urdf.xacro")
    fixed = [field, str(models / "ground"), str(tmp_path / "my.geofence")]

    def call(*more):
        words = [*fixed, "--output", str(tmp_path / "out"), *more]
        return assemble_world.assemble(assemble_world.make_parser().parse_args(words))

    return call


def test_a_world_put_together_takes_the_table_along(put_together, tmp_path, models):
    put_together("--keep-heights")
    before, after = (
        tmp_path / p for p in ("models/field/plants.csv", "out/models/custom_field/plants.csv")
    )
    assert before.read_bytes() == after.read_bytes()
    put_together()
    ground = ground_model("ground", [models])
    old, new = _rows(before), _rows(after)
    assert len(old) == len(new) > 150
    for one, other in zip(old, new):
        x, y = float(one["x_m"]), float(one["y_m"])
        assert float(other["z_m"]) == pytest.approx(float(ground.height_at(x, y)), abs=5.1e-5)
        assert {**one, "z_m": ""} == {**other, "z_m": ""}
    assert len({row["z_m"] for row in new}) > 100


@pytest.mark.parametrize(
    "text, message",
    [
        (None, "plants.csv: cannot be read"),
        ("", "plants.csv:1: found '', expected the header 'model,name,x_m"),
        (HEADER + "m,p,1,2,3,0,0,0,1,1\nm,p,1,2\n", "plants.csv:3: found 'm,p,1,2', expected"),
        (HEADER + "m,p,one,2,3,0,0,0,1,1\n", "plants.csv:2: found 'm,p,one,2,3"),
    ],
)
def test_a_broken_table_is_said_with_its_line(put_together, tmp_path, text, message):
    table = tmp_path / "models/field/plants.csv"
    table.unlink()
    if text is not None:
        table.write_text(text)
    with pytest.raises(assemble_world.GeneratorError, match=message):
        put_together()
    assert not (tmp_path / "out/models/custom_field").exists()
