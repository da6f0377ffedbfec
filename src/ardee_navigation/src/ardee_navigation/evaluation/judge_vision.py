# SPDX-License-Identifier: MIT
"""Judges what the row model of ardee_navigation.vision finds in pictures of crop rows whose true rows are known.

FOLDER holds NAME.jpg with NAME.crp, or .JPG and .CRP, in the form of the Crop Row Benchmark Dataset (Vidovic, Cupec and
Hocenski: Crop row detection by global energy minimization, Pattern Recognition 55, 2016): a line for each of the lowest
picture rows, with offset c and period d of the crop rows in pixels: row m passes at u = width / 2 + c + m d.
"""
import argparse
import math
import sys
from pathlib import Path
from typing import Dict, List, Optional, Sequence, Tuple

import cv2
import numpy as np
from PIL import Image

from ardee_common.cli import say
from ardee_common.errors import GeneratorError
from ardee_common.output import check_file, write_file
from ardee_navigation.evaluation.vision_sheet import Judged, Ways, sheet
from ardee_navigation.vision.camera import check_size
from ardee_navigation.vision.field_fit import FieldFitter, FieldRows
from ardee_navigation.vision.learned import RowHeat
from ardee_navigation.vision.vegetation import excess_green

_WIDTH_PX = 160  # to which pictures are shrunk
_TOLERANCE = 0.1  # of the period: an error that large counts nothing
_GREEN = 0.2  # excess green of a plant
_LEAST_PERIOD_PX = 1.0
_WORST = 12  # pictures of the sheet


def read_rows(path: Path, height_px: int) -> FieldRows:
    """Returns the rows of a .crp file, NaN in picture rows above its first. Raises GeneratorError."""
    try:
        lines = path.read_text(encoding="utf-8-sig").splitlines()
    except (OSError, ValueError) as error:
        raise GeneratorError(f"{path}: {error}") from None
    numbers = [_pair(line, f"{path}:{n}") for n, line in enumerate(lines, 1) if line.strip()]
    if not 0 < len(numbers) <= height_px:
        expected = f"1 to {height_px}, each with an offset and a period"
        raise GeneratorError(f"{path}: found {len(numbers)} lines, expected {expected}")
    filled = np.full((height_px, 2), np.nan)
    filled[-len(numbers) :] = numbers
    return FieldRows(filled[:, 0], filled[:, 1])


def _pair(line: str, where: str) -> Tuple[float, float]:
    """Returns offset and period of a line of a .crp file."""
    try:
        offset, period = (float(word) for word in line.split())
        if math.isfinite(offset) and math.isfinite(period) and period >= _LEAST_PERIOD_PX:
            return offset, period
    except ValueError:  # another count, or no numbers
        pass
    expected = f"an offset and a period of at least {_LEAST_PERIOD_PX:g}, in pixels"
    raise GeneratorError(f"{where}: found {line.strip()[:40]!r}, expected {expected}")


def _passes(rows: FieldRows, v: int, width_px: int) -> np.ndarray:
    """Returns where crop rows pass picture row v, in pixels from the picture's middle."""
    offset, period = rows.offset_px[v], rows.period_px[v]
    first, last = (np.array([-0.5, 0.5]) * width_px - offset) / period
    return offset + period * np.arange(np.ceil(first), np.floor(last) + 1)


def accuracy(found: FieldRows, true: FieldRows, width_px: int) -> float:
    """Returns the crop row detection accuracy (CRDA) of a picture, 0 to 1.

    The mean, over picture rows with truth and the crop rows in them, of max(1 - (error / (0.1 period))^2, 0), where the
    error is the distance to the nearest crop row found.
    """
    marks = []
    for v in np.flatnonzero(np.isfinite(true.period_px)):
        u, period = _passes(true, v, width_px), true.period_px[v]
        rows = np.round((u - found.offset_px[v]) / found.period_px[v])
        error = u - found.offset_px[v] - rows * found.period_px[v]
        marks.append(np.maximum(1.0 - (error / (_TOLERANCE * period)) ** 2, 0.0))
    return float(np.mean(np.concatenate(marks)))


def greenness(rgb: np.ndarray) -> np.ndarray:
    """Returns where a picture uint8[h, w, 3] shows plants, float32[h, w]: 0 to 1."""
    return np.clip(excess_green(rgb, _WIDTH_PX) / _GREEN, 0.0, 1.0)


def find_rows(rgb: np.ndarray, index: np.ndarray, fitter: FieldFitter) -> FieldRows:
    """Returns the crop rows in a picture uint8[h, w, 3] with an index of its plants or rows."""
    small = fitter.fit(index)
    scale, height_px = rgb.shape[1] / _WIDTH_PX, rgb.shape[0]
    v = (np.arange(height_px) + 0.5) / scale - 0.5
    known = np.arange(len(small.offset_px))
    offset, period = (np.interp(v, known, part) for part in (small.offset_px, small.period_px))
    return FieldRows(offset * scale, period * scale)


def read_picture(path: Path) -> np.ndarray:
    """Returns a picture uint8[h, w, 3] in red, green, blue. Raises GeneratorError."""
    try:
        with Image.open(path) as opened:
            check_size(*opened.size)
            opened.load()  # where a file is cut short, cv2 says nothing and fills up with grey
    except (GeneratorError, OSError, ValueError, Image.DecompressionBombError) as error:
        raise GeneratorError(f"{path}: {error}") from None
    bgr = cv2.imread(str(path))
    if bgr is None:
        raise GeneratorError(f"{path}: found no picture")
    return np.ascontiguousarray(bgr[:, :, ::-1])


def judged(
    path: Path, truth: Path, ways: Ways, fitters: Dict[Tuple[int, int], FieldFitter]
) -> Judged:
    """Returns what the ways find in a picture."""
    rgb = read_picture(path)
    height_px, width_px = rgb.shape[:2]
    size = _WIDTH_PX, round(height_px * _WIDTH_PX / width_px)
    if size not in fitters:
        fitters[size] = FieldFitter(*size)
    true = read_rows(truth, height_px)
    known = np.flatnonzero(np.isfinite(true.period_px))
    if not any(len(_passes(true, v, width_px)) for v in known):
        raise GeneratorError(f"{truth}: found no crop row in the picture, expected at least one")
    found = {way: find_rows(rgb, look(rgb), fitters[size]) for way, look in ways.items()}
    marks = {way: accuracy(rows, true, width_px) for way, rows in found.items()}
    return Judged(path.name, rgb, true, found, marks)


def _pairs(folder: Path) -> List[Tuple[Path, Path]]:
    """Returns the pictures of a folder, each with its truth; names in a warning what has no other half."""
    files = sorted(folder.glob("*"))
    pictures, truths = (
        {path.stem: path for path in files if path.suffix.lower() == suffix}
        for suffix in (".jpg", ".crp")
    )
    names = [name for name in pictures if name in truths]
    if not names:
        raise GeneratorError(f"{folder}: found no NAME.jpg with NAME.crp, expected at least one")
    for half, other, suffix in ((pictures, truths, "crp"), (truths, pictures, "jpg")):
        for name in [name for name in half if name not in other]:
            say("judge_vision", f"{half[name]}: left out, found no {name}.{suffix}")
    return [(pictures[name], truths[name]) for name in names]


def judge(args: argparse.Namespace) -> int:
    """Prints the accuracy of both ways in each picture of a folder, and their means; writes the sheet."""
    ways: Ways = {"classical": greenness, "learned": RowHeat().look}
    if args.output:
        check_file(args.output)
    fitters: Dict[Tuple[int, int], FieldFitter] = {}
    results = []
    for path, truth in _pairs(args.folder):
        results.append(judged(path, truth, ways, fitters))
        print(path.name, *(f"{mark:.3f}" for mark in results[-1].marks.values()))
    for way in ways:
        mean = np.mean([one.marks[way] for one in results])
        print(f"{way}: crop row detection accuracy {mean:.3f} in {len(results)} pictures")
    if args.output:
        worst = sorted(results, key=lambda one: one.marks["learned"])[:_WORST]
        made = cv2.imencode(".png", sheet(worst)[:, :, ::-1])[1]
        write_file(args.output, made.tobytes())
    return 0


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the command; returns the exit code, 2 for bad input."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, metavar="FOLDER", help="pictures with their rows")
    parser.add_argument(
        "--output",
        type=Path,
        metavar="SHEET.png",
        help=f"the {_WORST} pictures in which the learned way is worst, with the rows of both ways",
    )
    try:
        return judge(parser.parse_args(arguments))
    except (GeneratorError, OSError) as error:
        print(f"judge_vision: {error}", file=sys.stderr)
        return 2
