# SPDX-License-Identifier: MIT
"""A planting strategy of the user's own: a CSV file of mean stalk centres (thesis Figure 4.4, centers_user)."""

import csv
from pathlib import Path

import numpy as np

from ardee_models.errors import GeneratorError
from ardee_world.config import MAX_PLANTS
from ardee_world.plots import Plan


def read_centres(path: Path) -> Plan:
    """Columns x_m and y_m, in the field's frame; all in one plot, one row."""
    try:
        with path.open(newline="", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise GeneratorError(f"{path}: cannot be read: {error}") from error
    if not 1 <= len(rows) <= MAX_PLANTS:
        raise GeneratorError(f"{path}: found {len(rows)} stalk centres, expected 1 to {MAX_PLANTS}")
    points = np.empty((len(rows), 2))
    for i, row in enumerate(rows):
        try:
            points[i] = float(row["x_m"]), float(row["y_m"])
        except (KeyError, TypeError, ValueError):
            points[i] = np.nan
        if not np.isfinite(points[i]).all():
            raise GeneratorError(
                f"{path}: line {i + 2}: found {row}, expected finite numbers in columns x_m, y_m"
            )
    zeros = np.zeros(len(rows), dtype=int)
    return Plan(points, zeros, zeros, np.arange(len(rows)))
