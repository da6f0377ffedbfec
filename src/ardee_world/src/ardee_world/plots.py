# SPDX-License-Identifier: MIT
"""The plan: mean stalk centres of every plot, row by row."""

from dataclasses import dataclass

import numpy as np

from ardee_world.config import Plots


@dataclass(frozen=True)
class Plan:
    """Mean centres (n, 2) in the field's frame with plot, row in the plot, and place in the row of each."""

    centres_m: np.ndarray
    plot: np.ndarray
    row: np.ndarray
    place: np.ndarray


def row_positions(plots: Plots) -> np.ndarray:
    """x of each row, shape (plots_x, rows). The middle lane of the middle plot lies on x = 0."""
    width = (plots.rows_per_plot - 1) * plots.row_spacing_m
    pitch = width + plots.plot_spacing_x_m
    rows = np.arange(plots.rows_per_plot) * plots.row_spacing_m
    x = np.arange(plots.plots_x)[:, None] * pitch + rows[None, :]
    lane = (plots.rows_per_plot // 2 - 0.5) * plots.row_spacing_m
    return x - (plots.plots_x // 2 * pitch + lane)


def row_starts(plots: Plots) -> np.ndarray:
    """y of the first stalk of the plots along y; rows run towards -y."""
    return -plots.headland_m - np.arange(plots.plots_y) * (
        plots.row_length_m + plots.plot_spacing_y_m
    )


def plan_centres(plots: Plots) -> Plan:
    """Every stalk of the default strategy: plots of straight rows."""
    places = np.arange(plots.stalks_per_row())
    shape = (plots.plots_y, plots.plots_x, plots.rows_per_plot, len(places))
    j, i, row, place = (axis.ravel() for axis in np.indices(shape))
    x = row_positions(plots)[i, row]
    y = row_starts(plots)[j] - place * plots.stalk_spacing_m
    return Plan(np.column_stack((x, y)), j * plots.plots_x + i, row, place)
