# SPDX-License-Identifier: MIT
"""Growth stages: the named rows of a species' file, and counts (leaves, days) that lie between rows."""

import dataclasses
import re
from dataclasses import dataclass
from typing import Dict, Optional, Sequence

import numpy as np

from ardee_common.config import Mapping, build_group
from ardee_common.errors import GeneratorError
from ardee_common.options import bounded

SEASONS = ("early", "mid", "late")


@dataclass(frozen=True)
class Stage:
    """State of a mean plant; `inflorescence`, `ears` and `maturity` run from 0 to 1.

    `hanging_leaves` of the lost ones, the topmost, have died and broken at the collar but hang there yet.
    `leaf_scale` is the present over the final size of leaves that still grow when the next leaves appear.
    """

    season: str
    collared_leaves: int = bounded(1, 60)
    stalk_height_m: float = bounded(0.005, 6)
    base_diameter_m: float = bounded(0.001, 0.2)
    top_diameter_m: float = bounded(0.001, 0.2)
    leaf_scale: float = bounded(0.05, 1, 1.0)
    young_leaves: int = bounded(0, 30, 0)
    lost_leaves: int = bounded(0, 59, 0)
    hanging_leaves: int = bounded(0, 59, 0)
    dry_leaves: float = bounded(0, 60, 0.0)
    tillers: float = bounded(0, 10, 0.0)
    inflorescence: float = bounded(0, 1, 0.0)
    ears: float = bounded(0, 1, 0.0)
    maturity: float = bounded(0, 1, 0.0)
    days: Optional[float] = bounded(0, 1000, None)


# The quantity that the letter before a number counts
_COUNTERS = {
    "V": ("collared leaves", lambda row: row.collared_leaves),
    "L": ("visible leaves", lambda row: row.collared_leaves + row.young_leaves),
    "D": ("days after planting", lambda row: row.days),
}


def _rows(data: Mapping, where: str) -> Dict[str, Stage]:
    rows = {}
    for name in data:
        row = rows[name] = build_group(Stage, data, name)
        if row.season not in SEASONS:
            raise GeneratorError(
                f"{where}.{name}.season: found {row.season!r}, expected {' '.join(SEASONS)}"
            )
        if row.lost_leaves >= row.collared_leaves:
            raise GeneratorError(
                f"{where}.{name}.lost_leaves: found {row.lost_leaves},"
                " expected less than collared_leaves"
            )
    return rows


def _ladder(rows: Dict[str, Stage], letter: str) -> list:
    """(count, row) of the rows in which the count rises from row to row."""
    count_of = _COUNTERS[letter][1]
    ladder: list = []
    for row in rows.values():
        count = count_of(row)
        if count is not None and (not ladder or count > ladder[-1][0]):
            ladder.append((float(count), row))
    return ladder


def _between(ladder: list, count: float) -> Stage:
    counts = [step[0] for step in ladder]
    nearest = ladder[int(np.argmin(np.abs(np.array(counts) - count)))][1]
    values = {}
    for field in dataclasses.fields(Stage):
        column = [getattr(row, field.name) for _, row in ladder]
        if field.name == "season" or any(value is None for value in column):
            values[field.name] = getattr(nearest, field.name)
            continue
        value = float(np.interp(count, counts, column))
        values[field.name] = int(round(value)) if isinstance(column[0], int) else value
    return Stage(**values)


def describe_stages(data: dict, counters: Sequence[str], where: str) -> str:
    """Line that lists the known stages."""
    rows = _rows(data, where)
    counted = []
    for letter in counters:
        ladder = _ladder(rows, letter)
        low, high = ladder[0][0], ladder[-1][0]
        counted.append(f"{letter}{low:g} to {letter}{high:g} ({_COUNTERS[letter][0]})")
    others = [name for name in rows if not re.fullmatch("[VLD][0-9]+", name)]
    return "; ".join((", ".join(counted), " ".join(others)))


def resolve_stage(data: dict, counters: Sequence[str], name: str, where: str) -> Stage:
    """The row called `name`, or one interpolated for a count such as V9, L12, D45."""
    if not data or set(counters) - _COUNTERS.keys():
        raise GeneratorError(
            f"{where}: expected rows, and counters among {' '.join(_COUNTERS)}, found {counters}"
        )
    rows = _rows(data, where)
    if name in rows:
        return rows[name]
    match = re.fullmatch("([A-Z])([0-9]{1,4})", name)
    if match and match[1] in counters:
        ladder = _ladder(rows, match[1])
        if ladder[0][0] <= float(match[2]) <= ladder[-1][0]:
            return _between(ladder, float(match[2]))
    raise GeneratorError(
        f"{where}: unknown stage {name!r}, known: {describe_stages(data, counters, where)}"
    )
