# SPDX-License-Identifier: MIT
"""Rows of runs.parquet as columns, with what was varied and what was measured; some of them chosen by conditions."""
import contextlib
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Dict, List, Sequence

import numpy as np
import pyarrow as pa

from ardee_campaigns import tables
from ardee_common.errors import GeneratorError, known_names

NAMES = ("world", "robot", "controller")


@dataclass(frozen=True)
class Runs:
    """Runs of a campaign.

    columns : name to values, (n,), texts and truth values as objects
    factors : columns that were varied: world, robot, controller, factor_NAME
    measures : columns that were measured
    scales : factors that were drawn between a low and a high value
    """

    name: str  # of the campaign
    columns: Dict[str, np.ndarray]
    factors: List[str]
    measures: List[str]
    scales: Sequence[str] = ()

    def __len__(self) -> int:
        return len(self.columns["run_id"])

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]

    def where(self, chosen: np.ndarray) -> "Runs":
        """Returns the runs of a mask or of indices."""
        columns = {name: values[chosen] for name, values in self.columns.items()}
        return replace(self, columns=columns)

    def ok(self) -> "Runs":
        """Returns the runs that did not fail."""
        return self.where(self["status"] == tables.OK)

    def levels(self, factor: str) -> List[Any]:
        """Returns the different values of a factor, sorted."""
        return sorted(set(self[factor].tolist()), key=lambda value: (str(type(value)), value))

    def varied(self) -> List[str]:
        """Returns the factors that have more than one value."""
        return [name for name in self.factors if len(set(self[name].tolist())) > 1]


def read(folder: Path) -> Runs:
    """Reads runs.parquet of a campaign's folder."""
    table = tables.read_runs(folder)
    missing = [
        name for name in (*NAMES, "run_id", "status", "sim_s") if name not in table.schema.names
    ]
    if missing:
        found = f"found no column {missing[0]!r}"
        raise GeneratorError(f"{folder / tables.RUNS}: {found}, expected a campaign's table")
    if not len(table):
        raise GeneratorError(f"{folder / tables.RUNS}: found no run, expected at least one")
    factors = [*NAMES, *(f"factor_{name}" for name in tables.factors_of(table.schema))]
    columns = {name: _values(table.column(name)) for name in table.schema.names}
    name = (table.schema.metadata or {}).get(b"name", b"").decode() or folder.name
    scales = [f"factor_{name}" for name in tables.scales_of(table.schema)]
    return Runs(name, columns, factors, tables.measures_of(table.schema), scales)


def _values(column: pa.ChunkedArray) -> np.ndarray:
    if pa.types.is_floating(column.type) or pa.types.is_integer(column.type):
        return column.to_numpy()
    return np.array(column.to_pylist(), dtype=object)


def factor_named(runs: Runs, text: str, flag: str) -> str:
    """Returns the column of a factor by its name, with or without `factor_`."""
    for name in (text, f"factor_{text}"):
        if name in runs.factors:
            return name
    known = [short(name) for name in runs.factors]
    raise GeneratorError(f"{flag}: found {text!r}, {known_names(text, known)}")


def short(factor: str) -> str:
    """Returns the name of a factor as the campaign's file has it."""
    return factor[len("factor_") :] if factor.startswith("factor_") else factor


def shown(value: Any) -> str:
    """Returns a factor's value as it is shown."""
    return f"{value:g}" if isinstance(value, float) else str(value)


def level_named(text: str, levels: Sequence[Any], what: str) -> Any:
    """Returns the level that a text names: that very text or truth value, or exactly that number."""
    named = {_exact(level): level for level in levels}
    if text in named:
        return named[text]
    with contextlib.suppress(ValueError):
        if float(text) in [level for level in levels if isinstance(level, float)]:
            return float(text)
    raise GeneratorError(f"{what}: found {text!r}, {known_names(text, named)}")


def _exact(value: Any) -> str:
    """Returns a factor's value as it is shown, with all its digits."""
    text = shown(value)
    return repr(value) if isinstance(value, float) and float(text) != value else text


def chosen(runs: Runs, conditions: Sequence[str]) -> Runs:
    """Returns the runs that fulfil all conditions NAME=VALUE."""
    for text in conditions:
        name, is_there, value = text.partition("=")
        if not is_there:
            raise GeneratorError(f"--where: found {text!r}, expected NAME=VALUE")
        factor = factor_named(runs, name, "--where")
        level = level_named(value, runs.levels(factor), f"--where: {name}")
        runs = runs.where(np.array([one == level for one in runs[factor].tolist()]))
        if not len(runs):
            raise GeneratorError(f"--where: found no run with all of {', '.join(conditions)}")
    return runs
