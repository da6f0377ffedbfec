# SPDX-License-Identifier: MIT
"""Pictures of a report: distributions, effects of factors, differences, and runs in the form of thesis 5.6 to 5.8."""
from pathlib import Path
from typing import Any, Dict, List, Sequence

import numpy as np

from ardee_campaigns.plots import pyplot, save
from ardee_campaigns.report import statistics
from ardee_campaigns.report.runs import Runs, short, shown
from ardee_campaigns.report.statistics import Difference

COLORS = ("#1f3b73", "#d1495b", "#1f6b3b", "#e09f3e", "#6b4fa0", "#4fa3e0", "#8c564b", "#5fc46f")
_COLUMNS = 4


def _grid(count: int, height: float = 2.6) -> Any:
    columns = min(_COLUMNS, count)
    rows = -(-count // columns)
    size = (max(3.0 * columns, 5.0), height * rows + 0.4)
    figure, grid = pyplot.subplots(rows, columns, figsize=size, squeeze=False)
    for axes in grid.flat[count:]:
        axes.axis("off")
    return figure, list(grid.flat[:count])


def _color(number: int) -> str:
    return COLORS[number % len(COLORS)]


def distributions(path: Path, runs: Runs, by: str) -> None:
    """Draws the share of runs that are at most so large, for each measure and each level of a factor."""
    figure, grid = _grid(len(runs.measures))
    for axes, measure in zip(grid, runs.measures):
        for number, level in enumerate(runs.levels(by)):
            values = np.sort(runs[measure][runs[by] == level])
            values = values[np.isfinite(values)]
            if len(values):
                places = np.arange(len(values) + 1) / len(values)
                steps = np.concatenate((values[:1], values))
                axes.step(steps, places, where="post", color=_color(number), label=shown(level))
        axes.set_xlabel(measure, fontsize="small")
        axes.tick_params(labelsize="small")
        axes.grid(alpha=0.3)
    grid[0].set_ylabel("share of the runs", fontsize="small")
    grid[0].legend(fontsize="x-small", title=short(by), title_fontsize="x-small")
    save(figure, path)


OFFSET_BINS_M = np.linspace(-0.5, 0.5, 201)


def offsets(path: Path, counts: Dict[Any, np.ndarray], by: str) -> None:
    """Draws the distribution of the lateral offset of all samples; counts of OFFSET_BINS_M by level."""
    figure, axes = pyplot.subplots(figsize=(9.0, 3.2))
    middle = (OFFSET_BINS_M[1:] + OFFSET_BINS_M[:-1]) / 2.0
    for number, (level, count) in enumerate(counts.items()):
        share = 100.0 * count / max(count.sum(), 1)
        axes.plot(100.0 * middle, share, color=_color(number), label=shown(level), linewidth=1.2)
    axes.set_xlabel("offset from the lane's centre line, left positive [cm]")
    axes.set_ylabel("share of the samples [%]")
    axes.grid(alpha=0.3)
    axes.legend(fontsize="small", title=short(by), title_fontsize="small")
    save(figure, path)


def effects(path: Path, runs: Runs, factors: Sequence[str], measures: Sequence[str]) -> None:
    """Draws the mean of each measure and its interval over the levels of each factor."""
    size = (3.2 * len(factors) + 0.8, 1.8 * len(measures) + 0.4)
    form = {"figsize": size, "squeeze": False, "sharey": "row"}
    figure, grid = pyplot.subplots(len(measures), len(factors), **form)
    for line, measure in zip(grid, measures):
        for axes, factor in zip(line, factors):
            _effect(axes, runs, factor, measure)
            axes.grid(alpha=0.3)
            axes.tick_params(labelsize="small")
        line[0].set_ylabel(measure, fontsize="small")
    for axes, factor in zip(grid[-1], factors):
        axes.set_xlabel(short(factor), fontsize="small")
    save(figure, path)


def _effect(axes: pyplot.Axes, runs: Runs, factor: str, measure: str) -> None:
    levels = runs.levels(factor)
    if statistics.is_scale(runs, factor):
        axes.plot(runs[factor].astype(float), runs[measure], ".", color=COLORS[5], markersize=3.0)
        finite = np.isfinite(runs[measure])
        x, y = runs[factor][finite].astype(float), runs[measure][finite]
        if len(x) > 2:
            ends = np.array([x.min(), x.max()])
            axes.plot(ends, np.polyval(np.polyfit(x, y, 1), ends), color=COLORS[0])
        return
    for number, level in enumerate(levels):
        found = statistics.field_mean(runs.where(runs[factor] == level), measure)
        axes.plot([number], [found.estimate], "o", color=COLORS[0], markersize=4.0)
        axes.plot([number] * 2, [found.low, found.high], color=COLORS[0], linewidth=1.5)
    axes.set_xlim(-0.5, len(levels) - 0.5)
    turn = 30 if max(len(shown(level)) for level in levels) * len(levels) > 24 else 0
    side = "right" if turn else "center"
    axes.set_xticks(range(len(levels)), [shown(level) for level in levels], rotation=turn, ha=side)


def differences(path: Path, found: Sequence[Difference], factor: str, base: Any) -> None:
    """Draws the difference of each level from the base level and its interval, a panel a measure."""
    measures = list(dict.fromkeys(one.measure for one in found))
    levels = list(dict.fromkeys(one.level for one in found))
    figure, grid = _grid(len(measures), 1.1 + 0.32 * len(levels))
    for axes, measure in zip(grid, measures):
        _differences(axes, [one for one in found if one.measure == measure])
        axes.set_title(measure, fontsize="small", loc="left")
    figure.supxlabel(f"difference from {short(factor)} {shown(base)}, 95 % interval", fontsize=9)
    save(figure, path)


def _differences(axes: pyplot.Axes, found: List[Difference]) -> None:
    for number, one in enumerate(found):
        axes.plot([one.found.low, one.found.high], [number] * 2, color=COLORS[0], linewidth=1.5)
        axes.plot([one.found.estimate], [number], "o", color=COLORS[0], markersize=4.0)
    axes.axvline(0.0, color=COLORS[1], linewidth=1.0)
    axes.set_ylim(len(found) - 0.5, -0.5)
    axes.set_yticks(range(len(found)), [shown(one.level) for one in found])
    axes.tick_params(labelsize="small")
    axes.grid(alpha=0.3, axis="x")
