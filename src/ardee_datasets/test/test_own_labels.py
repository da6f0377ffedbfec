# SPDX-License-Identifier: MIT
"""A crop model of a user's own, with a label of its own, among the categories of a data set."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest
import yaml
from small_sets import generated, pixels, samples

from ardee_common.errors import GeneratorError
from ardee_datasets import inputs, show_dataset
from ardee_datasets.generate_dataset import main
from ardee_datasets.recipe import read_recipe
from ardee_models.lookup import find_model, search_path
from ardee_models.plant.plant_metrics import METRICS_FILE

WEED = "{models: [corn_variant_1], row_length_m: 3.0, weed_models: [soybean], weed_density_per_m2: 3.0}"
LABEL = 20
RECIPE = """
fields:
  mixed: {frames: 2, options: {models: [soybean, corn_variant_1], row_length_m: 3.0}}
cameras:
  front: {width_px: 96, height_px: 72, horizontal_fov_deg: 70, height_m: [0.4, 0.6], pitch_deg: [10, 30]}
"""


@pytest.fixture(autouse=True)
def own_models(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Puts a model `soybean` on the models' path."""
    models = tmp_path / "models"
    shutil.copytree(find_model("corn_variant_2", search_path()), models / "soybean")
    label_soybean(tmp_path, LABEL)
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(models), prepend=":")


def label_soybean(folder: Path, label: int) -> None:
    """Gives the model another label."""
    file = folder / "models" / "soybean" / METRICS_FILE
    file.write_text(json.dumps({**json.loads(file.read_text()), "label": label}))


def test_a_named_label_is_a_category_of_a_set_with_its_model(
    tmp_path: Path, capsys: pytest.CaptureFixture, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = generated(tmp_path, f"{RECIPE}labels: {{soybean: {LABEL}}}\n")
    assert json.loads((made / "categories.json").read_text())[-1]["name"] == "soybean"
    coco = json.loads((made / "train" / "annotations.json").read_text())
    assert {"id": LABEL, "name": "soybean"}.items() <= coco["categories"][-1].items()
    assert {one["category_id"] for one in coco["annotations"]} == {1, LABEL}
    for sample in samples(made):
        labels = pixels(made / "train" / "labels" / f"{sample['id']}.png")
        own = sum(one["area"] for one in sample["annotations"] if one["category_id"] == LABEL)
        assert np.count_nonzero(labels == LABEL) == own
    names = yaml.safe_load((made / "yolo" / "data.yaml").read_text())["names"]
    classes = {line.split()[0] for path in made.glob("yolo/labels/train/*") for line in path.open()}
    assert {names[int(number)] for number in classes} == {"corn", "soybean"}
    assert "| soybean |" in (made / "README.md").read_text()
    assert show_dataset.main([str(made)]) == 0
    (tmp_path / "weeds").mkdir()
    of_weeds = RECIPE.replace("{models: [soybean, corn_variant_1], row_length_m: 3.0}", WEED)
    weedy = generated(tmp_path / "weeds", f"{of_weeds}labels: {{soybean: {LABEL}}}\n")
    drawn = [one for sample in samples(weedy) for one in sample["annotations"]]
    weeds = [one for one in drawn if one["kind"] == "weed"]
    assert {one["category_id"] for one in weeds} == {LABEL}
    assert all((one["keypoints"], one["num_keypoints"]) == ([0, 0, 0], 0) for one in weeds)
    with monkeypatch.context() as other, pytest.raises(SystemExit):
        other.setattr(inputs, "engine_digest", lambda: "of another build")
        main([str(tmp_path / "recipe.yaml"), "--output", str(made)])
    assert "of another version of the program than there is now" in capsys.readouterr().err
    (tmp_path / "models" / "soybean" / "notes.txt").touch()
    with pytest.raises(SystemExit):
        main([str(tmp_path / "recipe.yaml"), "--output", str(made)])
    assert "of another model soybean than there is now" in capsys.readouterr().err


@pytest.mark.parametrize(
    "label, instead", [(LABEL, "labels: {NAME: 20}"), (5, "13 to 65535"), (0, "13 to 65535")]
)
def test_a_label_without_a_name_is_refused(tmp_path: Path, label: int, instead: str) -> None:
    label_soybean(tmp_path, label)
    path = tmp_path / "recipe.yaml"
    path.write_text(RECIPE)
    message = f"recipe.yaml:3: models: found soybean with label {label}, expected .*{instead}"
    with pytest.raises(GeneratorError, match=message):
        read_recipe(path)
