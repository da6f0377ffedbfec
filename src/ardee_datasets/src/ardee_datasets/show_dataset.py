# SPDX-License-Identifier: MIT
"""The command `show_dataset`: contact sheets of a data set, on which each label lies over its picture."""

import argparse
import json
import os
import tempfile
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence

import numpy as np
from PIL import Image, ImageDraw

from ardee_common.cli import Parser, run, steps, whole_in
from ardee_common.errors import GeneratorError
from ardee_common.output import output_folder
from ardee_datasets.recipe import SPLITS
from ardee_datasets.sample import LAYERS

_PROG = "show_dataset"
_TILE_PX = 320
_ON_SHEET = 6  # samples
_TILES = 4  # of a sample
_LINE_PX = 14  # of text
_BOX = {1: "lime", 2: "orange", 3: "violet", 10: "red", 11: "white", 12: "cyan"}
_OWN = "gold"  # labels of the recipe's own
_ROW, _VANISHING, _FOOT, _HIDDEN = "yellow", "magenta", "red", "deepskyblue"
_LEGEND = (
    "boxes: corn lime, sorghum orange, tobacco violet, weed red, stone white, litter cyan, own labels gold;  "
    "rows yellow, vanishing point magenta;  feet red, hidden ones blue;  masks: a colour each"
    "\norgans: stalk red, leaf green, ear yellow, tassel orange, panicle magenta, flower white, root blue;  "
    "depth: red 0.1 m to blue 20 m, black nothing"
)
_ORGAN_RGB = np.array(
    [
        [0, 0, 0],
        [230, 30, 30],
        [40, 180, 40],
        [250, 240, 60],
        [250, 150, 30],
        [240, 60, 240],
        [255, 255, 255],
        [60, 80, 250],
    ]
)  # by the number of the organ
# Colours at equal steps of the logarithm of depth, 0.1 m to 20 m
_DEPTH_M = (0.1, 20.0)
_DEPTH_RGB = np.array([[180, 0, 0], [255, 160, 0], [240, 255, 60], [40, 190, 190], [20, 40, 140]])


def _over_picture(sample: Dict[str, Any], rgb: np.ndarray) -> Image.Image:
    """Returns the picture with boxes, lines of rows, vanishing point and feet."""
    picture = Image.fromarray(rgb)
    draw = ImageDraw.Draw(picture)
    for one in sample["annotations"]:
        x, y, width, height = one["bbox"]
        draw.rectangle(
            (x, y, x + width - 1, y + height - 1), outline=_BOX.get(one["category_id"], _OWN)
        )
    for row in sample["rows"]:
        draw.line([tuple(point) for point in row["line_px"]], fill=_ROW, width=2)
    radius = max(sample["width_px"] // 130, 1)

    def dot(u: float, v: float, colour: str) -> None:
        draw.ellipse((u - radius, v - radius, u + radius, v + radius), fill=colour)

    for one in sample["annotations"]:
        u, v, visibility = one.get("keypoints", (0, 0, 0))
        if visibility:
            dot(u, v, _FOOT if visibility == 2 else _HIDDEN)
    if sample["vanishing_point_px"]:
        dot(*sample["vanishing_point_px"], _VANISHING)
    return picture


def _by_number(numbers: np.ndarray) -> np.ndarray:
    """Returns colours of which those of neighbouring numbers differ much."""
    return 128 + 127 * np.sin(numbers[..., None] * (2.4, 3.7, 5.1))


def _coloured(
    numbers: np.ndarray, rgb: np.ndarray, colours: Callable[[np.ndarray], np.ndarray]
) -> Image.Image:
    """Returns the picture in grey under the colours of its numbers from 1."""
    grey = np.repeat(rgb.mean(axis=2, keepdims=True), 3, axis=2)
    mixed = np.where(numbers[..., None] > 0, 0.3 * grey + 0.7 * colours(numbers), grey)
    return Image.fromarray(mixed.astype(np.uint8))


def _depth(depth_m: np.ndarray) -> Image.Image:
    place = np.log(np.maximum(depth_m, _DEPTH_M[0]))
    at = np.linspace(*np.log(_DEPTH_M), len(_DEPTH_RGB))
    colours = np.stack([np.interp(place, at, channel) for channel in _DEPTH_RGB.T], axis=-1)
    return Image.fromarray(np.where(depth_m[..., None] > 0, colours, 0).astype(np.uint8))


def _tiles(folder: Path, sample: Dict[str, Any]) -> List[Image.Image]:
    """Returns the tiles of a sample, of one size: boxes, rows and feet; masks; organs; depth."""

    def layer(name: str) -> np.ndarray:
        path = folder / sample["split"] / name / f"{sample['id']}.{LAYERS[name]}"
        try:
            return np.asarray(Image.open(path))
        except OSError as error:  # PIL's own, too
            raise GeneratorError(f"{path}: cannot be read: {error}") from None

    rgb = layer("rgb")
    tiles = (
        _over_picture(sample, rgb),
        _coloured(layer("instances"), rgb, _by_number),
        _coloured(layer("organs"), rgb, _ORGAN_RGB.__getitem__),
        _depth(layer("depth")),
    )
    size = _TILE_PX, max(1, round(_TILE_PX * sample["height_px"] / sample["width_px"]))
    return [tile.resize(size, Image.Resampling.LANCZOS) for tile in tiles]


def contact_sheet(folder: Path, samples: Sequence[Dict[str, Any]]) -> Image.Image:
    """Returns a sheet of some samples of a data set, one below another."""
    made = [_tiles(folder, sample) for sample in samples]
    legend_px = _LINE_PX * len(_LEGEND.splitlines())
    height = legend_px + sum(_LINE_PX + tiles[0].height for tiles in made)
    sheet = Image.new("RGB", (_TILES * _TILE_PX, height))
    draw = ImageDraw.Draw(sheet)
    draw.text((2, 1), _LEGEND)
    y = legend_px
    for sample, tiles in zip(samples, made):
        draw.text((2, y + 1), f"{sample['split']} {sample['id']} {sample['camera']}")
        for k, tile in enumerate(tiles):
            sheet.paste(tile, (k * _TILE_PX, y + _LINE_PX))
        y += _LINE_PX + tiles[0].height
    return sheet


def _spread(paths: List[Path], count: int) -> List[Path]:
    """Returns some of the paths at equal distances, the first and the last among them."""
    return [paths[i] for i in np.unique(np.linspace(0, len(paths) - 1, count).astype(int))]


def show(args: argparse.Namespace) -> str:
    """Writes the contact sheets that the arguments ask for; returns their folder."""
    folder = Path(os.path.abspath(args.dataset))  # '.' has no name
    if not (folder / "dataset.yaml").is_file():
        raise GeneratorError(f"{folder}: found no dataset.yaml, expected a data set")
    found = [p for split in SPLITS for p in sorted((folder / split / "samples").glob("*.json"))]
    if not found:
        raise GeneratorError(f"{folder}: found no samples, expected those of generate_dataset")
    samples = [json.loads(path.read_text()) for path in _spread(found, args.samples)]
    starts = range(0, len(samples), _ON_SHEET)
    target = args.output or folder.with_name(f"{folder.name}_sheets")
    with output_folder(target) as output, tempfile.TemporaryDirectory(dir=output) as new:
        for start in steps(_PROG, starts):
            sheet = contact_sheet(folder, samples[start : start + _ON_SHEET])
            sheet.save(Path(new) / f"sheet_{start // _ON_SHEET + 1:03d}.png")
        for old in output.glob("sheet_*.png"):  # of a run before, which may have made more
            old.unlink()
        for made in Path(new).iterdir():
            made.rename(output / made.name)
    return str(output)


def make_parser() -> argparse.ArgumentParser:
    """Makes the parser of show_dataset."""
    parser = Parser(
        prog=_PROG,
        description="Write contact sheets of a data set: pictures with boxes, rows and feet; masks; organs; depth.",
    )
    parser.add_argument("dataset", type=Path, metavar="DIR", help="folder of generate_dataset")
    parser.add_argument(
        "--output", type=Path, metavar="DIR", help="folder for the sheets (default: DIR_sheets)"
    )
    parser.add_argument(
        "--samples",
        type=whole_in(1, 10_000),
        default=24,
        metavar="N",
        help="samples to show, spread over the data set",
    )
    return parser


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs `show_dataset DIR`."""
    return run(make_parser(), show, arguments)
