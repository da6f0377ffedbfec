# SPDX-License-Identifier: MIT
"""Pictures of an overlay: raw and perceived distances (form of thesis 5.6 to 5.8), and distributions."""
from pathlib import Path
from typing import Sequence, Tuple

import numpy as np

from ardee_campaigns.overlay.look import Line, Looked
from ardee_campaigns.plots import pyplot, save

# Dark: raw returns, light: perceived distances; the thesis's green and blue
REAL, SIMULATED = ("#1f6b3b", "#5fc46f"), ("#1f3b73", "#4fa3e0")
BESIDE_M, WITHIN_M = 0.05, 1.0  # strip abeam of the lidar whose returns are drawn
_LARGEST_POINTS = 40_000


def _raw(run: Looked, end_s: float) -> Tuple[np.ndarray, np.ndarray]:
    """Returns times [s] and lateral distances [m] of the returns abeam of the lidar."""
    angles, ranges = run.scans.angles_rad, run.scans.ranges_m[run.time_s <= end_s]
    ranges = np.where(np.isfinite(ranges) & (ranges > 0.0), ranges, np.nan)  # those with a place
    ahead, lateral = ranges * np.cos(angles), ranges * np.sin(angles)
    scan, beam = np.nonzero((np.abs(ahead) < BESIDE_M) & (np.abs(lateral) < WITHIN_M))
    step = max(len(scan) // _LARGEST_POINTS, 1)
    return run.time_s[scan][::step], lateral[scan, beam][::step]


def _distances(
    axes: pyplot.Axes, run: Looked, end_s: float, colors: Tuple[str, str], what: str
) -> None:
    axes.plot(
        *_raw(run, end_s), ".", color=colors[0], markersize=1.5, alpha=0.5, label=f"{what}: raw"
    )
    gap = np.diff(run.time_s, prepend=run.time_s[0]) > 0.5  # no line across a pause
    for values, label in ((run.left_m, f"{what}: perceived"), (-run.right_m, None)):
        shown = np.where(gap, np.nan, values)
        axes.plot(run.time_s, shown, color=colors[1], linewidth=1.6, label=label)
    axes.axhline(0.0, color="grey", linewidth=0.5)
    axes.set_ylim(-WITHIN_M, WITHIN_M)
    axes.set_ylabel("from the lidar, left positive [m]")
    above = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "frameon": False}
    axes.legend(ncol=2, markerscale=4.0, fontsize="small", **above)


def distances(path: Path, real: Looked, run: Looked) -> None:
    """Draws lateral distances of a real and a simulated run, over time, as long as the shorter one."""
    end_s = min(real.time_s[-1], run.time_s[-1])
    figure, (top, bottom) = pyplot.subplots(2, 1, sharex=True, figsize=(10.0, 7.0))
    _distances(top, real, end_s, REAL, "real")
    _distances(bottom, run, end_s, SIMULATED, "simulated")
    top.set_title(real.name, loc="left", fontsize="medium")
    bottom.set_title(run.name, loc="left", fontsize="medium")
    bottom.set_xlim(0.0, end_s)
    bottom.set_xlabel("time since the first scan [s]")
    save(figure, path)


def _share(axes: pyplot.Axes, values: np.ndarray, color: str, label: str) -> None:
    """Draws the share of values that are at most so large, at 500 places at most."""
    if not len(values):
        return
    places = np.linspace(0.0, 1.0, min(len(values), 500))
    axes.plot(np.quantile(values, places), places, color=color, label=label, linewidth=1.5)


def distributions(path: Path, lines: Sequence[Line]) -> None:
    """Draws the cumulative distribution of each quantity, real and simulated."""
    columns = 3
    rows = -(-len(lines) // columns)
    size = (11.0, 2.9 * rows)
    figure, grid = pyplot.subplots(rows, columns, figsize=size, sharey=True, squeeze=False)
    for axes, line in zip(grid.flat, lines):
        scale = line.quantity.scale
        _share(axes, scale * line.real, REAL[0], "real")
        _share(axes, scale * line.simulated, SIMULATED[1], "simulated")
        both = np.concatenate((line.real, line.simulated)) * scale
        if len(both):
            low, high = np.quantile(both, (0.005, 0.995))
            rest = max(0.05 * (high - low), 1e-6 + 0.01 * abs(high))
            axes.set_xlim(low - rest, high + rest)
        axes.set_xlabel(line.quantity.text, fontsize="small")
        axes.grid(alpha=0.3)
    for axes in grid.flat[len(lines) :]:
        axes.axis("off")
    for axes in grid[:, 0]:
        axes.set_ylabel("share of the values", fontsize="small")
    grid.flat[0].legend(fontsize="small")
    save(figure, path)
