# SPDX-License-Identifier: MIT
"""A planting strategy of the user's own (thesis Figure 4.4, centers_user): stalk centres in a CSV file or a list."""

import csv
import re
from pathlib import Path
from typing import Sequence

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_world.field_config import FAR_M, MAX_PLANTS
from ardee_world.field_layout import DECIMALS
from ardee_world.plots import Plan, Row

_MAX_PLOT = 100_000  # limit of plot and row numbers
_NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*", re.ASCII)
_WHOLE = re.compile(r"\s*\d{0,6}\s*", re.ASCII)
_VALUES = {"x_m": _NUMBER, "y_m": _NUMBER, "plot": _WHOLE, "row": _WHOLE}  # form of each column's
_COLUMNS = (
    f"numbers from -{FAR_M:g} to {FAR_M:g} in columns x_m, y_m"
    f" (optionally also whole numbers from 0 to {_MAX_PLOT} in plot, row)"
)


def _directions(points_m: np.ndarray) -> np.ndarray:
    """Returns the unit vectors of a row at its points, from each one's neighbours; -y for a row of one point."""
    if len(points_m) == 1:
        return np.array([[0.0, -1.0]])
    tangents = np.gradient(points_m, axis=0)
    return tangents / np.linalg.norm(tangents, axis=1)[:, None]


def _check_distinct(points_m: np.ndarray, places: Sequence[str]) -> None:
    """Raises GeneratorError for the first stalk that stands where an earlier one does, to 0.1 mm as in the files."""
    rounded = np.round(points_m, DECIMALS)
    _, first, inverse = np.unique(rounded, axis=0, return_index=True, return_inverse=True)
    again = np.flatnonzero(first[inverse.ravel()] != np.arange(len(points_m)))
    if len(again):
        x, y = points_m[again[0]]
        raise GeneratorError(
            f"{places[again[0]]}: found ({x:g}, {y:g}), which is the place of"
            f" {places[first[inverse.ravel()[again[0]]]]} too, expected each stalk once"
        )


def plan_of(points_m: np.ndarray, plot: np.ndarray, row: np.ndarray) -> Plan:
    """Plan of centres in the field's frame. Plants of one plot and row form a row, in the order given."""
    place = np.zeros(len(points_m), dtype=int)
    along = np.empty_like(points_m)
    pairs = np.column_stack((plot, row))
    _, inverse, counts = np.unique(pairs, axis=0, return_inverse=True, return_counts=True)
    rows = []
    for members in np.split(np.argsort(inverse.ravel(), kind="stable"), np.cumsum(counts)[:-1]):
        place[members] = np.arange(len(members))
        along[members] = _directions(points_m[members])
        rows.append(Row(int(plot[members[0]]), int(row[members[0]]), points_m[members]))
    return Plan(points_m, plot, row, place, along, tuple(rows))


def _line(path: Path, number: int, entry: dict) -> tuple:
    good = None not in entry and None not in entry.values()  # as many words as columns
    good = good and all(_VALUES[key].fullmatch(text) for key, text in entry.items())
    x, y = (float(entry[key]) if good else np.nan for key in ("x_m", "y_m"))
    plot, row = (int(entry.get(key, "").strip() or 0) if good else 0 for key in ("plot", "row"))
    near = abs(x) <= FAR_M and abs(y) <= FAR_M  # False for NaN
    if not near or max(plot, row) > _MAX_PLOT:
        found = {k: v for k, v in entry.items() if k is not None}
        raise GeneratorError(f"{path}: line {number}: found {found}, expected {_COLUMNS}")
    return x, y, plot, row


def read_centres(path: Path) -> Plan:
    """Reads columns x_m and y_m, in the field's frame; without columns plot and row, all stalks form one row."""
    lines, places = [], []
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.DictReader(file)
            header = [name.strip() for name in reader.fieldnames or []]
            reader.fieldnames = header
            if not {"x_m", "y_m"} <= set(header) <= set(_VALUES) or len(set(header)) < len(header):
                found = ",".join(header) or "nothing"
                raise GeneratorError(
                    f"{path}: line 1: found {found[:80]}, expected columns x_m,y_m, optionally plot,row"
                )
            for entry in reader:
                lines.append(_line(path, reader.line_num, entry))
                places.append(f"{path}: line {reader.line_num}")
                if len(lines) > MAX_PLANTS:
                    break
    except OSError as error:
        raise GeneratorError(f"{path}: cannot be read: {error.strerror}") from error
    except (UnicodeDecodeError, csv.Error) as error:
        raise GeneratorError(f"{path}: cannot be read: {error}") from error
    if not 1 <= len(lines) <= MAX_PLANTS:
        raise GeneratorError(
            f"{path}: found {len(lines)} stalk centres, expected 1 to {MAX_PLANTS}"
        )
    x, y, plot, row = zip(*lines)
    points = np.column_stack((x, y))
    _check_distinct(points, places)
    return plan_of(points, np.array(plot), np.array(row))


def listed_centres(points: Sequence, where: str) -> Plan:
    """Reads centres from a list of [x, y] in a YAML file."""
    good = isinstance(points, (list, tuple)) and all(
        isinstance(p, (list, tuple))
        and len(p) == 2
        and all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in p)
        and all(abs(v) <= FAR_M for v in p)
        for p in points
    )
    if not good or not 1 <= len(points) <= MAX_PLANTS:
        raise GeneratorError(
            f"{where}: centers: expected a list of 1 to {MAX_PLANTS} pairs [x, y] in m, from -{FAR_M:g} to {FAR_M:g}"
        )
    zeros, centres = np.zeros(len(points), dtype=int), np.array(points, dtype=float)
    _check_distinct(centres, [f"{where}: centers[{number}]" for number in range(len(points))])
    return plan_of(centres, zeros, zeros)
