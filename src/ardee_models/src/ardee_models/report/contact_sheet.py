# SPDX-License-Identifier: MIT
"""A picture of crop models side by side, read back from their meshes and textures."""

import argparse
import io
import json
from pathlib import Path
from typing import List, Optional, Sequence

import matplotlib
import numpy as np
from PIL import Image, ImageDraw, ImageFont

from ardee_common.cli import Parser, run, steps
from ardee_common.errors import GeneratorError
from ardee_common.output import write_file
from ardee_models.plant.plant_metrics import METRICS_FILE
from ardee_models.report.splat import Part, draw, read_dae

_CELL = (300, 420)  # pixels, without the caption
_CAPTION = 38
_FINER = 2  # factor by which cells are drawn larger, then scaled down
_BACKGROUND = (236, 240, 244)
_INK = (40, 44, 48)
_ELEVATION_RAD = np.radians(14.0)
_OFF_RAD = np.radians(38.0)  # angle off the view square to the widest side of a plant


def _font(size: int) -> ImageFont.FreeTypeFont:
    return ImageFont.truetype(
        str(Path(matplotlib.get_data_path()) / "fonts/ttf/DejaVuSans.ttf"), size
    )


def _extent(parts: List[Part]) -> tuple:
    """Largest half width over all sides, and height."""
    corners = np.concatenate([part.corners.reshape(-1, 3) for part in parts])
    return float(np.linalg.norm(corners[:, :2], axis=1).max()), float(corners[:, 2].max())


def _azimuth(parts: List[Part]) -> float:
    """Direction of view: nearly across the vertical plane that most of the plant lies near."""
    plan = np.concatenate([part.corners.reshape(-1, 3)[:, :2] for part in parts])
    widest = np.linalg.eigh(np.cov(plan.T))[1][:, 1]
    return float(np.arctan2(widest[1], widest[0])) - 0.5 * np.pi + _OFF_RAD


def _round_length(pixels_per_m: float) -> float:
    """The longest of 1, 0.5, 0.2, 0.1 ... m that takes at most a third of a cell."""
    for power in (0, -1, -2):
        for digit in (1.0, 0.5, 0.2):
            if digit * 10.0**power * pixels_per_m <= _CELL[0] / 3:
                return digit * 10.0**power
    return 0.005


def _caption(model: Path) -> str:
    path = model / METRICS_FILE
    if not path.is_file():
        return ""
    try:
        data = json.loads(path.read_text(encoding="utf-8"))
        leaves = f"   {data['leaf_count']} leaves" if "leaf_count" in data else ""
        return f"{data['stage']}   {data['height_m']:.2f} m{leaves}"
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise GeneratorError(f"{path}: expected stage and height_m: {error!r}") from error


def _cell(model: Path, suffix: str) -> Image.Image:
    """One model with its name and a scale bar, drawn to fill the cell."""
    dae = model / "meshes" / f"{model.name}{suffix}.dae"
    if not dae.is_file():
        raise GeneratorError(f"{dae}: no such file")
    parts = read_dae(dae)
    half, tall = _extent(parts)
    width, height = _CELL
    scale = min(0.46 * width / half, 0.90 * height / (tall + 0.25 * half))
    size = (width * _FINER, height * _FINER)
    pixels = draw(parts, size, scale * _FINER, _azimuth(parts), _ELEVATION_RAD, _BACKGROUND)
    cell = Image.new("RGB", (width, height + _CAPTION), _BACKGROUND)
    cell.paste(Image.fromarray(pixels).resize(_CELL, Image.LANCZOS), (0, _CAPTION))
    pen = ImageDraw.Draw(cell)
    pen.text((8, 4), model.name, _INK, _font(14))
    pen.text((8, 21), _caption(model), _INK, _font(12))
    bar = _round_length(scale)
    left, low = width - 12 - bar * scale, height + _CAPTION - 8
    pen.line((left, low, width - 12, low), _INK, 2)
    pen.text((left, low - 17), f"{bar:g} m", _INK, _font(11))
    return cell


def draw_contact_sheet(
    models: Sequence[Path], output: Path, columns: int = 8, suffix: str = ""
) -> None:
    """Draws model directories in rows of `columns`, each filling its cell, with a scale bar."""
    columns = min(columns, len(models))
    rows = -(-len(models) // columns)
    width, height = _CELL[0] + 4, _CELL[1] + _CAPTION + 4
    sheet = Image.new("RGB", (columns * width, rows * height), (255, 255, 255))
    for i, model in enumerate(steps("contact sheet", models)):
        sheet.paste(_cell(model, suffix), (i % columns * width + 2, i // columns * height + 2))
    picture = io.BytesIO()
    sheet.save(picture, format="PNG")
    try:
        write_file(output, picture.getvalue())
    except OSError as error:
        raise GeneratorError(f"{output}: cannot be written: {error}") from error


def _draw(args: argparse.Namespace) -> None:
    suffix = "_lod1" if args.lod1 else ""
    draw_contact_sheet(args.models, args.output, max(args.columns, 1), suffix)


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the command `crop_contact_sheet`."""
    parser = Parser(prog="crop_contact_sheet", description=__doc__)
    parser.add_argument("models", nargs="+", type=Path, help="crop model directories")
    parser.add_argument("--output", type=Path, required=True, help="PNG file to write")
    parser.add_argument(
        "--columns", type=int, default=8, help="number of models in a row (default 8)"
    )
    parser.add_argument(
        "--lod1", action="store_true", help="draw the coarse level of detail instead"
    )
    return run(parser, _draw, arguments)
