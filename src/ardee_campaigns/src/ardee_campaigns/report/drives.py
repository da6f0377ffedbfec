# SPDX-License-Identifier: MIT
"""Figures of a run: raw lidar and perceived distances along the row (form of thesis 5.6-5.8), and errors."""
from pathlib import Path

import numpy as np

from ardee_campaigns import tables
from ardee_campaigns.measures import NEAR_M
from ardee_campaigns.plots import pyplot, save

RAW, SEEN, TRUE, STEP_IN = "#1f3b73", "#4fa3e0", "#d1495b", "#e09f3e"
LARGEST_POINTS = 40_000


class Drawn:
    """A run of a campaign as its figures want it."""

    def __init__(self, run: tables.RunFile, title: str) -> None:
        self._samples, self.title = run.samples, title
        self.length_m, self.lidar_ahead_m = run.about["length_m"], run.about["lidar_ahead_m"]
        events = self._samples["event"].to_pylist()
        along = self.column("along_m")
        self.interventions_m = [place for place, event in zip(along, events) if event]
        raw = (self._samples[name].combine_chunks().flatten() for name, _ in tables.RAW_FIELDS)
        self.raw = np.column_stack([values.to_numpy() for values in raw])

    def column(self, name: str) -> np.ndarray:
        """Returns a column of the samples."""
        return self._samples[name].to_numpy()


def _step_ins(axes: pyplot.Axes, record: Drawn, ahead_m: float = 0.0) -> None:
    for number, along_m in enumerate(record.interventions_m):
        label = "a person steps in" if number == 0 else None
        axes.axvline(along_m + ahead_m, color=STEP_IN, linewidth=1.0, label=label)


def perceived_distances(record: Drawn, path: Path) -> None:
    """Lateral distance from the lidar, left positive: returns abeam, lines in use, ideal rows."""
    figure, axes = pyplot.subplots(figsize=(10.0, 4.5))
    raw = record.raw[:: max(len(record.raw) // LARGEST_POINTS, 1)]
    along = record.column("along_m") + record.lidar_ahead_m
    axes.plot(raw[:, 0], raw[:, 1], ".", color=RAW, markersize=1.5, alpha=0.5, label="raw lidar")
    for side, sign in (("left", 1.0), ("right", -1.0)):
        seen, true = record.column(f"{side}_seen_m"), record.column(f"{side}_true_m")
        label = {"left": ("perceived distance", "true distance")}.get(side, (None, None))
        axes.plot(along, sign * seen, color=SEEN, linewidth=1.4, label=label[0])
        axes.plot(along, sign * true, "--", color=TRUE, linewidth=1.0, label=label[1])
    _step_ins(axes, record, record.lidar_ahead_m)
    axes.axhline(0.0, color="grey", linewidth=0.5)
    axes.set_ylim(-1.0, 1.0)
    axes.set_xlim(min(along[0], 0.0), max(along[-1], record.length_m))
    axes.set_xlabel("along the row [m]")
    axes.set_ylabel("lateral distance from the lidar [m]")
    axes.set_title(record.title, loc="left")
    above = {"loc": "lower right", "bbox_to_anchor": (1.0, 1.0), "frameon": False}
    axes.legend(ncol=4, markerscale=4.0, fontsize="small", **above)
    save(figure, path)


def errors(record: Drawn, path: Path) -> None:
    """Lateral offset and heading from the lane's centre line."""
    figure, (top, bottom) = pyplot.subplots(2, 1, sharex=True, figsize=(10.0, 4.5))
    along = record.column("along_m")
    top.plot(along, 100.0 * record.column("lateral_m"), color=RAW, linewidth=1.0)
    top.axhspan(-100.0 * NEAR_M, 100.0 * NEAR_M, color=SEEN, alpha=0.15)
    top.set_ylabel("lateral offset [cm]")
    bottom.plot(along, np.degrees(record.column("heading_rad")), color=RAW, linewidth=1.0)
    bottom.set_ylabel("heading [deg]")
    bottom.set_xlabel("along the row [m]")
    for axes in (top, bottom):
        axes.axhline(0.0, color="grey", linewidth=0.5)
        _step_ins(axes, record)
    top.set_title(record.title, loc="left")
    save(figure, path)
