# SPDX-License-Identifier: MIT
"""Puts the finished samples of a data set together: annotations, poses, card, manifest."""

import csv
import hashlib
import io
import json
import os
from pathlib import Path
from typing import Any, Collection, Dict, List, Optional, Sequence, Set

import yaml

from ardee_common.output import write_file
from ardee_datasets.categories import Category, categories
from ardee_datasets.recipe import SPLITS, Recipe
from ardee_datasets.sample import LAYERS, ORGANS, json_bytes

_POSE = ("x_m", "y_m", "z_m")
# Files of a data set; what others put there, such as ultralytics its *.cache, is not in the manifest
_WRITTEN = (
    *("dataset.yaml", "inputs.json", "README.md", "categories.json", "organs.json"),
    *("truth/*/truth.csv", "truth/*/truth.json", "truth/*/clutter.csv"),
    *("*/annotations.json", "*/poses.csv", "*/samples/*.json"),
    *(f"*/{layer}/*.{ending}" for layer, ending in LAYERS.items()),
    *("*/clouds/*/velodyne/*.bin", "*/clouds/*/labels/*.label"),
    *("yolo/data.yaml", "yolo/images/*/*.png", "yolo/labels/*/*.txt"),
)
_DRAWN_SUN = "each field has its own sun, which stands still"
_CARD = """# {name}

Labelled pictures of simulated crop fields, made by ARDEE from dataset.yaml (seed {seed}). Licence: {licence}.

| split | fields | pictures | annotated objects |
|---|---|---|---|
{rows}

| category | objects | pixels |
|---|---|---|
{categories}

Files of a split, by the id of a sample, SCENE_FRAME:
- rgb/*.png; labels/*.png, 16 bit: category ids; instances/*.png, 16 bit: 1 to n in each picture, in the order of its
  annotations; organs/*.png, 8 bit: parts of crop plants by organs.json; depth/*.tiff: float32, metres along the
  optical axis; 0 is nothing in each of the last four.
- samples/*.json: K (a pixel's centre lies at its whole number), X_WC (optical frame in the world: x right, y down, z
  ahead), seeds, the number in instances/ to the id in truth/SCENE; rows: lines of the crop rows on the ground, in
  pixels, clipped to the picture but not hidden by plants (a row that leaves and comes back has several);
  vanishing_point_px: where lines along the nearest row meet, also outside of the picture; null if they cross the view.
- clouds/LIDAR/velodyne/*.bin, labels/*.label: as SemanticKITTI has them: x, y, z [m], intensity, float32, in the
  lidar's frame X_WL of samples/*.json, which has the instances too; uint32, category id in the low 16 bits, instance
  above.
- annotations.json: COCO with compressed RLE; truth_id is the row of truth.csv (plant_ID) or clutter.csv; occluded is
  the share of its pixels that others hide, or the ground; row and place are those of truth.csv. The keypoint
  of a plant is its stalk's foot on the ground: 2 if it is in sight, 1 if hidden, 0 if outside of the picture.
- poses.csv: positions of the cameras.

yolo/ has the boxes in YOLO's form: data.yaml, labels/SPLIT/*.txt, images/SPLIT/*.png (the same files as rgb/*.png).
{yolo}
A field's pictures all belong to one split. manifest.json lists the sha256 of every file of it.
The pictures are simulated: nothing moves in the wind, and {sun}.
A camera in motion has X_WC in the middle of its exposure (key motion of samples/*.json).
"""


def _samples(folder: Path, split: str) -> List[Dict[str, Any]]:
    return [
        json.loads(path.read_text()) for path in sorted((folder / split / "samples").glob("*.json"))
    ]


def coco(samples: List[Dict[str, Any]], recipe: Recipe) -> Dict[str, Any]:
    """Returns a COCO data set of samples; images and annotations are numbered from 1."""
    images, annotations = [], []
    for image_id, sample in enumerate(samples, 1):
        images.append(
            {
                "id": image_id,
                "file_name": f"rgb/{sample['id']}.png",
                "width": sample["width_px"],
                "height": sample["height_px"],
                "license": 1,
            }
        )
        for made in sample["annotations"]:
            annotations.append({"id": len(annotations) + 1, "image_id": image_id, **made})
    return {
        "info": {"description": "simulated by ARDEE"},
        "licenses": [{"id": 1, "name": recipe.licence}],
        "images": images,
        "annotations": annotations,
        "categories": categories(recipe.labels),
    }


def _poses(samples: List[Dict[str, Any]]) -> str:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    names = [f"r{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
    writer.writerow(("id", "camera", *_POSE, *names))
    for sample in samples:
        X_WC = sample["X_WC"]
        rotation = [value for row in X_WC[:3] for value in row[:3]]
        writer.writerow((sample["id"], sample["camera"], *(row[3] for row in X_WC[:3]), *rotation))
    return text.getvalue()


def data_card(name: str, recipe: Recipe, by_split: Dict[str, List[Dict[str, Any]]]) -> str:
    """Returns the text of README.md."""
    rows, objects, pixels = [], {}, {}
    for split, samples in by_split.items():
        fields = len({sample["scene"] for sample in samples})
        made = [one for sample in samples for one in sample["annotations"]]
        rows.append(f"| {split} | {fields} | {len(samples)} | {len(made)} |")
        for one in made:
            category = one["category_id"]
            objects[category] = objects.get(category, 0) + 1
            pixels[category] = pixels.get(category, 0) + one["area"]
    counts = [
        f"| {c['name']} | {objects[c['id']]} | {pixels[c['id']]} |"
        for c in categories(recipe.labels)
        if c["id"] in objects
    ]
    lack = yolo_lack(by_split)
    return _CARD.format(
        name=name,
        seed=recipe.seed,
        licence=recipe.licence,
        sun=_DRAWN_SUN if recipe.light else "each picture has the same sun",
        yolo="" if lack is None else f"{lack[0].upper()}{lack[1:]}.\n",
        rows="\n".join(rows),
        categories="\n".join(counts),
    )


def yolo_lack(splits: Collection[str]) -> Optional[str]:
    """Returns in words why ultralytics refuses to train on a data set of these splits, if it does."""
    missing = [split for split in ("train", "val") if split not in splits]
    if not missing:
        return None
    return f"ultralytics trains with a train and a val split; the set has no {' and no '.join(missing)}"


def _manifest(folder: Path) -> Dict[str, str]:
    files = sorted(path for pattern in _WRITTEN for path in folder.glob(pattern))
    return {
        str(path.relative_to(folder)): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in files
        if not path.name.startswith(".")
    }


def yolo_text(sample: Dict[str, Any], known: Sequence[Category]) -> str:
    """Returns the boxes of a sample in YOLO's form: class, middle and size in parts of the picture."""
    class_of = {category["id"]: number for number, category in enumerate(known)}
    lines = []
    for one in sample["annotations"]:
        x, y, width, height = one["bbox"]
        box = (x + width / 2, y + height / 2, width, height)
        size = (sample["width_px"], sample["height_px"]) * 2
        parts = " ".join(f"{value / all_px:.6f}" for value, all_px in zip(box, size))
        lines.append(f"{class_of[one['category_id']]} {parts}\n")
    return "".join(lines)


def _write_yolo(
    folder: Path, by_split: Dict[str, List[Dict[str, Any]]], known: Sequence[Category]
) -> None:
    """Writes yolo/: labels, data.yaml, and links to the pictures, which ultralytics expects in images/."""
    data: Dict[str, Any] = {split: f"images/{split}" for split in by_split}
    data["names"] = {number: category["name"] for number, category in enumerate(known)}
    for split, samples in by_split.items():
        images = folder / "yolo" / "images" / split
        images.mkdir(parents=True, exist_ok=True)
        for sample in samples:
            name = f"{sample['id']}.png"
            _link(folder / split / "rgb" / name, images / name)
            text = yolo_text(sample, known)
            write_file(folder / "yolo" / "labels" / split / f"{sample['id']}.txt", text.encode())
    write_file(folder / "yolo" / "data.yaml", yaml.safe_dump(data, sort_keys=False).encode())


def _link(source: Path, target: Path) -> None:
    if target.exists() and target.samefile(source):
        return
    target.unlink(missing_ok=True)
    try:
        os.link(source, target)
    except OSError:  # a file system without links
        write_file(target, source.read_bytes())


def damaged(folder: Path) -> Set[str]:
    """Returns the files of a finished data set that are not as its manifest has them."""
    file = folder / "manifest.json"
    try:
        before = json.loads(file.read_bytes()) if file.is_file() else {}
    except ValueError:
        return set()  # it is written anew
    now = _manifest(folder)
    return {name for name, digest in before.items() if now.get(name) != digest}


def assemble(folder: Path, recipe: Recipe) -> None:
    """Writes all that needs every sample; manifest.json is last."""
    by_split = {split: samples for split in SPLITS if (samples := _samples(folder, split))}
    for split, samples in by_split.items():
        annotations = json.dumps(coco(samples, recipe), sort_keys=True)
        write_file(folder / split / "annotations.json", annotations.encode())
        write_file(folder / split / "poses.csv", _poses(samples).encode())
    known = categories(recipe.labels)
    _write_yolo(folder, by_split, known)
    write_file(folder / "categories.json", json_bytes(known))
    organs = [{"id": number, "name": name} for number, name in ORGANS.items()]
    write_file(folder / "organs.json", json_bytes(organs))
    write_file(folder / "README.md", data_card("Data set", recipe, by_split).encode())
    write_file(folder / "manifest.json", json_bytes(_manifest(folder)))
