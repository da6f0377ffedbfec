# SPDX-License-Identifier: MIT
"""Data sets of a small recipe: what is written agrees with the pictures."""

import dataclasses
import json
import math
import sys
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
import yaml
from small_sets import MOVING, generated, pixels, samples

from ardee_datasets import rle, show_dataset
from ardee_datasets.assemble import assemble, data_card
from ardee_datasets.generate_dataset import main
from ardee_datasets.light import LightKeys
from ardee_datasets.recipe import read_recipe
from ardee_datasets.rows import project
from ardee_datasets.sample import LAYERS, _picture_bytes
from ardee_world.row_truth import Polyline, read_field


@pytest.fixture(scope="module")
def moving(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return generated(tmp_path_factory.mktemp("moving"), MOVING)


def test_annotations_agree_with_the_pictures(made: Path) -> None:
    count = 0
    for split in ("train", "test"):
        coco = json.loads((made / split / "annotations.json").read_text())
        assert [image["id"] for image in coco["images"]] == list(range(1, len(coco["images"]) + 1))
        for image in coco["images"]:
            stem = Path(image["file_name"]).stem
            own = pixels(made / split / "instances" / f"{stem}.png")
            labels = pixels(made / split / "labels" / f"{stem}.png")
            found = [a for a in coco["annotations"] if a["image_id"] == image["id"]]
            assert len(found) == own.max() and np.array_equal(own > 0, labels > 0)
            for number, one in enumerate(found, 1):
                mask = own == number
                x, y, width, height = one["bbox"]
                assert one["area"] == mask.sum() == mask[y : y + height, x : x + width].sum()
                assert mask[y].any() and mask[:, x + width - 1].any()
                assert set(labels[mask]) == {one["category_id"]}
                assert one["segmentation"]["counts"] == rle.encode(mask)
            count += len(found)
    assert count > 20


def test_instances_lead_to_the_truth(made: Path) -> None:
    """A plant's nearest visible pixel, carried into the world by K, X_WC and its depth, lies at the plant's place."""
    checked = 0
    for path in sorted((made / "train" / "samples").glob("*.json")):
        sample = json.loads(path.read_text())
        truth = json.loads((made / "truth" / sample["scene"] / "truth.json").read_text())["plants"]
        place = dict(zip(truth["id"], zip(truth["world_x_m"], truth["world_y_m"])))
        own = pixels(made / "train" / "instances" / f"{path.stem}.png")
        depth_m = pixels(made / "train" / "depth" / f"{path.stem}.tiff")
        for number, truth_id in sample["instances"].items():
            if not truth_id.startswith("plant_"):
                continue
            v, u = np.argwhere(own == int(number)).T
            rays = np.linalg.inv(sample["K"]) @ np.stack((u, v, np.ones(len(u))))
            X_WC = np.array(sample["X_WC"])
            points = X_WC[:3, :3] @ (rays * depth_m[v, u]) + X_WC[:3, 3:]
            x, y = place[int(truth_id[len("plant_") :])]
            assert math.hypot(points[0].mean() - x, points[1].mean() - y) < 0.35
            checked += 1
    assert checked > 10


def test_organs_lie_where_a_plant_has_them(made: Path) -> None:
    """Every pixel of a plant has an organ; young corn has stalk and leaves, grown corn an ear and brace roots too."""
    names = {one["id"]: one["name"] for one in json.loads((made / "organs.json").read_text())}
    seen = {"train": set(), "test": set()}
    for sample in samples(made):
        split = made / sample["split"]
        organs = pixels(split / "organs" / f"{sample['id']}.png")
        labels = pixels(split / "labels" / f"{sample['id']}.png")
        assert np.array_equal(organs > 0, labels == 1)
        seen[sample["split"]] |= {names[number] for number in np.unique(organs[organs > 0])}
    assert seen == {"train": {"stalk", "leaf"}, "test": {"stalk", "leaf", "ear", "root"}}


def test_a_visible_foot_lies_in_the_mask_of_its_plant(made: Path) -> None:
    visible = 0
    for sample in samples(made):
        own = pixels(made / sample["split"] / "instances" / f"{sample['id']}.png")
        for number, one in enumerate(sample["annotations"], 1):
            assert ("keypoints" in one) == (one["kind"] == "plant")
            u, v, visibility = one.get("keypoints", (0, 0, 0))
            if visibility == 2:
                assert own[round(v), round(u)] == number
                visible += 1
    assert visible > 5


@pytest.mark.parametrize("which", ["made", "moving"])
def test_lines_of_rows_lie_on_the_rows_of_the_truth(
    which: str, request: pytest.FixtureRequest
) -> None:
    """Ground that a line crosses, by its depth in the world, is nearest to the row at a place within a pixel of it."""
    folder, checked, moved_px = request.getfixturevalue(which), 0, [0.0]
    for sample in samples(folder):
        rows = read_field(folder / "truth" / sample["scene"] / "truth.json").rows
        split, name, X_WC = folder / sample["split"], sample["id"], np.array(sample["X_WC"])
        labels = pixels(split / "labels" / f"{name}.png")
        depth_m = pixels(split / "depth" / f"{name}.tiff")
        for u, v in (point for piece in sample["rows"] for point in piece["line_px"]):
            z = depth_m[round(v), round(u)]
            if (
                labels[round(v), round(u)] or not 0 < z < 1.5
            ):  # farther away, a ridge may hide the row
                continue
            ray = np.linalg.inv(sample["K"]) @ (round(u), round(v), 1)
            then = X_WC.copy()  # when this row was exposed
            time_s = sample["motion"]["readout_time_s"] * (round(v) / sample["height_px"] - 0.5)
            then[:3, 3] += time_s * np.array(sample["motion"]["v_m_s"])
            ground = then[:3, :3] @ (ray * z) + then[:3, 3]
            lines = [Polyline(row) for row in rows]
            line = min(lines, key=lambda line: abs(line.project(*ground[:2]).left_m))
            nearest = (*line.at(line.project(*ground[:2]).along_m)[:2], ground[2])
            pixel, _ = project(np.array([nearest]), np.array(sample["K"]), then)
            assert np.hypot(*(pixel[0] - (round(u), round(v)))) < 1.0
            at_rest, _ = project(np.array([nearest]), np.array(sample["K"]), X_WC)
            moved_px.append(np.hypot(*(at_rest[0] - pixel[0])))
            checked += 1
    assert checked > 50
    assert (max(moved_px) > 5.0) == (which == "moving")


def test_annotations_tell_row_place_and_the_hidden_share(made: Path) -> None:
    hidden = []
    for sample in samples(made):
        truth = json.loads((made / "truth" / sample["scene"] / "truth.json").read_text())["plants"]
        places = dict(zip(truth["id"], zip(truth["plot"], truth["row"], truth["place"])))
        for one in sample["annotations"]:
            assert ("row" in one) == (one["kind"] == "plant")
            if one["kind"] == "plant":
                number = int(one["truth_id"].rpartition("_")[2])
                assert (one["plot"], one["row"], one["place"]) == tuple(places[number])
            hidden.append(one["occluded"])
    assert min(hidden) == 0.0 and 0.5 < max(hidden) < 1.0


def test_boxes_of_yolo_are_those_of_coco(made: Path) -> None:
    data = yaml.safe_load((made / "yolo" / "data.yaml").read_text())
    names = {c["id"]: c["name"] for c in json.loads((made / "categories.json").read_text())}
    for split in ("train", "test"):
        images = made / "yolo" / data[split]
        coco = json.loads((made / split / "annotations.json").read_text())
        assert len(list(images.iterdir())) == len(coco["images"])
        for image in coco["images"]:
            rgb = made / split / image["file_name"]
            assert (images / rgb.name).read_bytes() == rgb.read_bytes()
            lines = (made / "yolo" / "labels" / split / f"{rgb.stem}.txt").read_text().splitlines()
            found = [a for a in coco["annotations"] if a["image_id"] == image["id"]]
            assert len(lines) == len(found)
            for line, one in zip(lines, found):
                number, *box = line.split()
                u, v, width, height = np.array(box, dtype=float) * (96, 72, 96, 72)
                assert data["names"][int(number)] == names[one["category_id"]]
                expected = (u - width / 2, v - height / 2, width, height)
                assert np.allclose(one["bbox"], expected, atol=1e-3)


def test_sheets_show_every_sample(made: Path, capsys: pytest.CaptureFixture) -> None:
    assert show_dataset.main([str(made)]) == 0
    (sheet,) = (made.parent / "made_sheets").iterdir()
    assert capsys.readouterr().out.split() == [str(sheet.parent)]
    picture = pixels(sheet)
    assert picture.shape == (2 * 14 + 5 * (240 + 14), 4 * 320, 3)  # five samples, four tiles each
    tiles = [picture[42 + 254 * y :, 320 * x :][:240, :320] for y in range(5) for x in range(4)]
    assert all(tile.std() > 10 for tile in tiles)
    with pytest.raises(SystemExit):
        show_dataset.main([str(made.parent)])
    assert "found no dataset.yaml" in capsys.readouterr().err


def test_sheets_of_the_current_folder_replace_those_of_before(
    made: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sheets = made.parent / "made_sheets"
    sheets.mkdir(exist_ok=True)
    (sheets / "sheet_009.png").touch()
    (sheets / "notes.txt").touch()
    monkeypatch.chdir(made)
    assert show_dataset.main([".", "--samples", "1"]) == 0
    assert {path.name for path in sheets.iterdir()} == {"sheet_001.png", "notes.txt"}
    (sheets / "notes.txt").unlink()


def test_the_manifest_lists_every_file_that_was_written_and_no_other(made: Path) -> None:
    there = {str(path.relative_to(made)) for path in made.rglob("*") if path.is_file()}
    cache = made / "yolo" / "labels" / "train.cache"
    cache.touch()
    assemble(made, read_recipe(made / "dataset.yaml"))
    cache.unlink()
    assert set(json.loads((made / "manifest.json").read_text())) == there - {"manifest.json"}


def test_the_card_tells_of_the_light_and_of_what_yolo_lacks(made: Path, recipe: Path) -> None:
    read, lacking = (
        read_recipe(recipe),
        "Ultralytics trains with a train and a val split; the set has no val.",
    )
    text = (made / "README.md").read_text()
    assert "each picture has the same sun" in text and lacking in text
    sun = data_card("", dataclasses.replace(read, light=LightKeys()), {"train": [], "val": []})
    assert "the same sun" not in sun and "each field has its own sun" in sun
    assert "ltralytics" not in sun


def test_points_of_clouds_lead_to_the_truth(made: Path) -> None:
    """A plant's points lie about its place, on average, and points without an instance on the ground."""
    away_m = []
    for sample in samples(made):
        folder, one = made / sample["split"] / "clouds" / "top", sample["clouds"]["top"]
        points = np.fromfile(folder / "velodyne" / f"{sample['id']}.bin", "<f4").reshape(-1, 4)
        labels = np.fromfile(folder / "labels" / f"{sample['id']}.label", "<u4")
        assert len(points) == len(labels) > 1000
        X_WL, X_WC = np.array(one["X_WL"]), np.array(sample["X_WC"])
        assert np.allclose(X_WL[:3, 2:] - X_WC[:3, 3:] * (0, 1), [[0, 0], [0, 0], [1, 0.2]])
        world = points[:, :3] @ X_WL[:3, :3].T + X_WL[:3, 3]
        assert np.abs(world[labels == 0, 2]).max() < 0.2
        truth = json.loads((made / "truth" / sample["scene"] / "truth.json").read_text())["plants"]
        place = dict(zip(truth["id"], zip(truth["world_x_m"], truth["world_y_m"])))
        for number, truth_id in one["instances"].items():
            mine = labels >> 16 == int(number)
            kind, _, plant = truth_id.rpartition("_")
            assert set(labels[mine] & 0xFFFF) == {1 if kind == "plant" else 10}
            if kind == "plant" and mine.sum() > 10:
                x, y = place[int(plant)]
                away_m.append(math.hypot(*(world[mine, :2].mean(axis=0) - (x, y))))
    assert len(away_m) > 20 and max(away_m) < 0.6 and np.median(away_m) < 0.2


def test_pycocotools_reads_the_masks(made: Path) -> None:
    sys.path.append(str(Path(__file__).resolve().parents[3] / "pydeps_tests"))
    from pycocotools.coco import COCO

    coco = COCO(str(made / "train" / "annotations.json"))
    for image_id, image in coco.imgs.items():
        own = pixels(made / "train" / "instances" / f"{Path(image['file_name']).stem}.png")
        found = coco.loadAnns(coco.getAnnIds(imgIds=[image_id]))
        assert found
        for number, one in enumerate(found, 1):
            assert np.array_equal(coco.annToMask(one), own == number)


def test_a_depth_file_holds_nothing_that_lay_in_memory_before() -> None:
    depth = np.sqrt(np.random.default_rng(1).random((240, 320), dtype=np.float32))
    for rows in range(0, 200, 10):
        depth[:rows] = 0.0  # another length of the file, odd or even
        made = set()
        for dirt in (255, 85, 1):
            dirty = [np.full(size, dirt, np.uint8) for size in (65536, 131072, 262144, 1 << 20)]
            del dirty
            made.add(_picture_bytes(depth, "tiff"))
        assert len(made) == 1, rows


def test_the_encoding_of_a_known_mask() -> None:
    """Columns 0 1 1 | 1 0 0: runs 1, 3, 2."""
    assert rle.encode(np.array([[0, 1], [1, 0], [1, 0]])) == "132"


@pytest.mark.slow
def test_the_example_makes_twenty_samples(tmp_path: Path) -> None:
    recipe = Path(__file__).parents[1] / "src" / "ardee_datasets" / "examples" / "small.yaml"
    assert main([str(recipe), "--output", str(tmp_path / "set"), "--workers", "1"]) == 0
    manifest = json.loads((tmp_path / "set" / "manifest.json").read_text())
    folders = [f"{split}/{layer}" for split in ("train", "val") for layer in (*LAYERS, "samples")]
    folders += [
        f"yolo/{kind}/{split}" for kind in ("images", "labels") for split in ("train", "val")
    ]
    counts = Counter(str(Path(name).parent) for name in manifest)
    assert {folder: counts[folder] for folder in folders} == {
        folder: 12 if "train" in folder else 8 for folder in folders
    }
