# SPDX-License-Identifier: MIT
"""Tests that every model lies in the literature's ranges, and that the report says so, and names values outside."""

import csv
import json
import shutil

import numpy as np
import pytest
from PIL import Image

from ardee_common.errors import GeneratorError
from ardee_models.plant.variants import load_variants
from ardee_models.report import crop_report
from ardee_models.report.ranges import MARKS, check_metrics, load_ranges

ALWAYS = {"height_m", "leaf_number", "stalk_diameter_m", "leaf_area_index", "leaf_length_to_width"}


@pytest.mark.parametrize("name", list(load_variants()))
def test_every_metric_lies_in_the_literatures_range_for_its_stage(share, name):
    metrics = json.loads((share / "models" / name / "metrics.json").read_text())
    ranges, sources = load_ranges()
    checks = check_metrics(metrics, ranges)
    assert ALWAYS <= {check.metric for check in checks}
    assert [c for c in checks if not c.holds()] == []
    assert all(sources[check.source] for check in checks)


@pytest.mark.slow
def test_report_of_all_models(share, tmp_path, capsys):
    code = crop_report.main(
        ["--model-path", str(share / "models"), "--output", str(tmp_path / "r")]
    )
    assert code == 0 and "40 models, 0 values outside" in capsys.readouterr().out
    with open(tmp_path / "r" / "crop_report.csv", encoding="utf-8") as stream:
        rows = list(csv.DictReader(stream))
    assert {row["model"] for row in rows} == set(load_variants())
    assert {row["within"] for row in rows} == {"yes"}
    text = (tmp_path / "r" / "crop_report.md").read_text()
    assert all(f"## {name}:" in text for name in load_variants())
    marks = [row["mark"] for row in rows]
    assert ", ".join(f"{marks.count(mark)} {mark}" for mark in MARKS) in text
    with Image.open(tmp_path / "r" / "contact_sheet.png") as image:
        pixels = np.asarray(image.convert("RGB")).astype(int)
    drawn = np.abs(pixels - pixels[200, 10]).max(axis=2) > 40
    for i in range(40):  # a plant in every cell, above the scale bar, touching no side
        row, column = divmod(i, 8)
        cell = drawn[row * 462 + 45 : row * 462 + 425, column * 304 + 3 : column * 304 + 301]
        assert cell.sum() > 300 and not cell[:, :2].any() and not cell[:, -2:].any()
        foot = drawn[row * 462 + 456 : row * 462 + 460, column * 304 + 3 : column * 304 + 301]
        assert not foot.any()  # nothing is cut off below the scale bar


def _changed(share, tmp_path, **changes):
    model = tmp_path / "models" / "corn_variant_7"
    shutil.copytree(share / "models" / "corn_variant_7", model)
    metrics = json.loads((model / "metrics.json").read_text())
    (model / "metrics.json").write_text(json.dumps({**metrics, **changes}))
    return ["--model-path", str(tmp_path / "models"), "--output", str(tmp_path / "r"), model.name]


def test_a_value_outside_its_range_fails(share, tmp_path):
    arguments = _changed(share, tmp_path, height_m=3.4)
    with pytest.raises(SystemExit) as exit_:
        crop_report.main(arguments)
    assert exit_.value.code == 1
    assert (
        "| height_m | 3.4 | 2 to 2.8 | NO | nominal | notes |"
        in (tmp_path / "r" / "crop_report.md").read_text()
    )


@pytest.mark.parametrize(
    "changes, message",
    [({"stage": "V99"}, "no range in the literature for corn V99"), ({"stage": None}, "corn None")],
)
def test_a_stage_without_ranges_is_an_error(share, tmp_path, capsys, changes, message):
    with pytest.raises(SystemExit) as exit_:
        crop_report.main(_changed(share, tmp_path, **changes))
    assert exit_.value.code == 2 and message in capsys.readouterr().err
    assert not (tmp_path / "r").exists()


def test_a_missing_model_is_an_error(tmp_path, capsys, monkeypatch):
    monkeypatch.delenv("GAZEBO_MODEL_PATH", raising=False)
    with pytest.raises(SystemExit) as exit_:
        crop_report.main(["--output", str(tmp_path / "r")])
    assert exit_.value.code == 2 and "corn_variant_1" in capsys.readouterr().err


@pytest.mark.parametrize(
    "row, message",
    [
        ("stages: [V4], min: 2, max: 1, source: a, mark: read", "found 2 to 1 from 'a'"),
        ("stages: [V4], min: 0, max: 1, source: b, mark: read", "a source among a"),
        ("stages: [V4], min: 0, source: a, mark: read", "missing key 'max'"),
        ("stages: V4, min: 0, max: 1, source: a, mark: read", "expected a list"),
        (
            "stages: [V4], min: 0, max: 1, source: a, mark: told",
            "found mark 'told', expected one of read",
        ),
    ],
)
def test_bad_range_files(tmp_path, row, message):
    path = tmp_path / "ranges.yaml"
    path.write_text(f"sources: {{a: text}}\ncorn:\n  height_m:\n    - {{{row}, how: sum}}\n")
    with pytest.raises(GeneratorError, match=message):
        load_ranges(path)
