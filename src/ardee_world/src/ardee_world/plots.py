# SPDX-License-Identifier: MIT
"""The plan: mean stalk centres of every plot, row by row, and the rows as lines."""

from dataclasses import dataclass
from typing import Iterator, List, Tuple

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_world.curves import Line, left_of
from ardee_world.field_config import MAX_PLANTS, Plots, RowShape

_VERTEX_SPACING_M = 0.25  # distance of vertices in the polylines of bent rows
_ARC_STEP_M = 0.02
_SHORTEST_STEP_M = 1e-9  # shortest step that defines a direction


@dataclass(frozen=True)
class Row:
    """One row as planned: `line_m` is a polyline in the field's frame."""

    plot: int
    row: int
    line_m: np.ndarray


@dataclass(frozen=True)
class Plan:
    """Mean centres (n, 2) in the field's frame; plot, row in the plot, place in the row, and direction of each."""

    centres_m: np.ndarray
    plot: np.ndarray
    row: np.ndarray
    place: np.ndarray
    along: np.ndarray  # (n, 2) unit vectors
    rows: Tuple[Row, ...]


def row_positions(plots: Plots) -> np.ndarray:
    """Offset of each row from the middle line, shape (plots_x, rows). A lane of the middle plot has offset 0."""
    width = (plots.rows_per_plot - 1) * plots.row_spacing_m
    pitch = width + plots.plot_spacing_x_m
    rows = np.arange(plots.rows_per_plot) * plots.row_spacing_m
    x = np.arange(plots.plots_x)[:, None] * pitch + rows[None, :]
    lane = (plots.rows_per_plot // 2 - 0.5) * plots.row_spacing_m
    return x - (plots.plots_x // 2 * pitch + lane)


def row_starts(plots: Plots) -> np.ndarray:
    """Distance along the rows of the first stalk of the plots one behind the other."""
    pitch = plots.row_length_m + plots.plot_spacing_y_m
    return plots.headland_m + np.arange(plots.plots_y) * pitch


def _bent_row(line: Line, start_m: float, d: float, plots: Plots) -> Tuple[np.ndarray, ...]:
    """Centres, directions and polyline of a row at equal distances along its own arc."""
    count = max(int(np.ceil(plots.row_length_m / _ARC_STEP_M)), 1)
    s = start_m + np.linspace(0.0, plots.row_length_m, count + 1)
    points = line.points(s, np.full_like(s, d))
    arc = np.concatenate(([0.0], np.cumsum(np.hypot(*np.diff(points, axis=0).T))))
    stalks = int(np.floor(arc[-1] / plots.stalk_spacing_m + 1e-6)) + 1
    at = np.minimum(np.arange(stalks) * plots.stalk_spacing_m, arc[-1])
    tangents = np.gradient(points, axis=0)
    lengths = np.linalg.norm(tangents, axis=1)[:, None]
    tangents = np.divide(tangents, lengths, out=line.tangents(s), where=lengths > _SHORTEST_STEP_M)

    def sample(where: np.ndarray, values: np.ndarray) -> np.ndarray:
        return np.column_stack([np.interp(where, arc, column) for column in values.T])

    along = sample(at, tangents)
    vertices = np.linspace(0.0, arc[-1], max(int(arc[-1] / _VERTEX_SPACING_M), 1) + 1)
    along /= np.linalg.norm(along, axis=1)[:, None]
    return sample(at, points), along, sample(vertices, points)


def _straight_row(line: Line, start_m: float, d: float, plots: Plots) -> Tuple[np.ndarray, ...]:
    """Centres, directions and polyline of a straight row, in closed form."""
    s = start_m + np.arange(plots.stalks_per_row()) * plots.stalk_spacing_m
    ends = start_m + np.array([0.0, plots.row_length_m])
    along = np.broadcast_to(line.forward, (len(s), 2))
    return line.points(s, np.full_like(s, d)), along, line.points(ends, np.full(2, d))


def _plot_rows(plots: Plots, line: Line) -> Iterator[Tuple[Row, np.ndarray, np.ndarray]]:
    make = _straight_row if line.straight else _bent_row
    for j, start in enumerate(row_starts(plots)):
        for i, positions in enumerate(row_positions(plots)):
            for row, d in enumerate(positions):
                centres, along, vertices = make(line, float(start), float(d), plots)
                yield Row(j * plots.plots_x + i, row, vertices), centres, along


def _cross_rows(
    plots: Plots, shape: RowShape, line: Line
) -> Iterator[Tuple[Row, np.ndarray, np.ndarray]]:
    """Rows across the headlands, as wide as the field; they are plots of their own after all others."""
    offsets = row_positions(plots)
    low, high = float(offsets.min()), float(offsets.max())
    count = int(np.floor((high - low) / plots.stalk_spacing_m + 1e-6)) + 1
    d = low + np.arange(count) * plots.stalk_spacing_m
    first, last = plots.headland_m, plots.length_m()
    for k, (where, edge, sign) in enumerate((("start", first, -1.0), ("end", last, 1.0))):
        if shape.cross_rows_at not in ("both", where):
            continue
        ahead = line.tangents(np.array([edge]))[0] * sign
        along = np.broadcast_to(left_of(ahead * sign), (count, 2))
        for row in range(shape.cross_rows):
            away = (shape.cross_row_clearance_m + row * plots.row_spacing_m) * ahead
            centres = line.points(np.full(count, edge), d) + away
            ends = line.points(np.full(2, edge), np.array([low, high])) + away
            yield Row(plots.plots_x * plots.plots_y + k, row, ends), centres, along


def plan_centres(plots: Plots, shape: RowShape = RowShape()) -> Plan:
    """Plans the default strategy: plots of rows along one line, and rows across the headlands."""
    line = Line(shape, plots.length_m())
    offsets = row_positions(plots)
    line.check_offsets(float(offsets.min()), float(offsets.max()))
    made: List[Tuple[Row, np.ndarray, np.ndarray]] = []
    total = 0
    for piece in (*_plot_rows(plots, line), *_cross_rows(plots, shape, line)):
        total += len(piece[1])
        if total > MAX_PLANTS:
            raise GeneratorError(f"planned plants: found more than {MAX_PLANTS}, expected fewer")
        made.append(piece)
    counts = [len(centres) for _, centres, _ in made]
    return Plan(
        centres_m=np.concatenate([centres for _, centres, _ in made]),
        plot=np.repeat([row.plot for row, _, _ in made], counts),
        row=np.repeat([row.row for row, _, _ in made], counts),
        place=np.concatenate([np.arange(count) for count in counts]),
        along=np.concatenate([along for _, _, along in made]),
        rows=tuple(row for row, _, _ in made),
    )
