# SPDX-License-Identifier: MIT
"""Sections of a campaign's report."""
import shlex
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence

import numpy as np
import pyarrow.parquet as pq

from ardee_campaigns import tables
from ardee_campaigns.replay import Replayer, noted_file
from ardee_campaigns.report import comparison, drives, figures, statistics, strips
from ardee_campaigns.report.comparison import three, with_interval
from ardee_campaigns.report.page import Page
from ardee_campaigns.report.runs import NAMES, Runs, short, shown
from ardee_common.errors import GeneratorError

FIGURED = 6  # measures in the figure of effects
_MOST_ROWS = 200  # of a table of combinations


class Report:
    """The report of a campaign's folder, section by section; pictures lie in a folder below.

    by : factor by which runs are told apart: the controller if there is more than one, else what varies first
    """

    def __init__(self, page: Page, folder: Path, pictures: Path, all_runs: Runs) -> None:
        self.page, self._folder, self._pictures = page, folder, pictures
        self.all_runs, self.runs = all_runs, all_runs.ok()
        varied = self.runs.varied()
        levelled = [name for name in varied if not statistics.is_scale(self.runs, name)]
        self.by = next((n for n in ("controller", *levelled) if n in levelled), "controller")

    def overview(self) -> None:
        """Adds counts, times, and failed runs by name."""
        runs, failed = self.all_runs, self.all_runs.where(self.all_runs["status"] != tables.OK)
        varied = [f"{short(name)} ({len(runs.levels(name))})" for name in runs.varied()]
        words = [f"{len(runs)} runs, {len(failed)} of them failed."]
        words.append(f"Varied: {', '.join(varied) or 'nothing but the seed'}.")
        sim_s = float(np.nansum(runs["sim_s"]))
        words.append(f"{sim_s / 3600.0:.2f} h of simulated time.")
        timings = self._folder / tables.TIMINGS
        if timings.is_file():
            table = tables.read_timings(self._folder)
            wall_s = np.nansum(table["wall_s"].to_numpy())
            lost = int(table["attempts"].to_numpy().sum()) - len(table)
            hosts = len(set(table["host"].to_pylist()))
            words.append(f"{wall_s / 3600.0:.2f} h of workers' time. Hosts: {hosts}.")
            words.append(f"Attempts lost with their workers: {lost}.")
        self.page.text(" ".join(words))
        if len(failed):
            self.page.heading("Failed runs")
            names = [name for name in runs.factors if name in NAMES or name in runs.varied()]
            heads = ["run", *map(short, names), "replicate", "error"]
            rows = zip(
                *(failed[name].tolist() for name in ("run_id", *names, "replicate", "error"))
            )
            self.page.table(heads, [[shown(cell) for cell in row] for row in rows])

    def means(self) -> None:
        """Adds the mean of each measure, for each combination that is not a scale, and of all runs together."""
        self.page.heading("Means")
        self.page.text(
            "Mean of the fields' means, and its 95 % interval (Student, over the fields); SI units."
        )
        names = [name for name in (*NAMES, *self.runs.varied()) if name in self.runs.varied()]
        names = [n for n in dict.fromkeys(names) if not statistics.is_scale(self.runs, n)]
        names = names or [self.by]
        keys = list(zip(*(self.runs[name].tolist() for name in names)))
        groups: Dict[Any, List[int]] = {}
        for number, key in enumerate(keys):
            groups.setdefault(key, []).append(number)
        rows = [self._mean_row(key, groups[key]) for key in sorted(groups, key=str)[:_MOST_ROWS]]
        if len(groups) > _MOST_ROWS:
            self.page.text(f"The first {_MOST_ROWS} of {len(groups)} combinations:")
        self.page.table([*map(short, names), "runs", *self.runs.measures], rows)
        comparison.rates(self.page, self.runs, self.by)

    def _mean_row(self, key: Sequence[Any], numbers: List[int]) -> List[str]:
        part = self.runs.where(np.array(numbers))
        cells = [with_interval(statistics.field_mean(part, name)) for name in self.runs.measures]
        return [*map(shown, key), str(len(part)), *cells]

    def middle_halves(self) -> None:
        """Adds interquartile means."""
        self.page.heading("Interquartile means")
        self.page.text(
            "Mean of the middle half of the runs, which a few bad ones do not move, and its 95 % interval: bootstrap of"
            f" {statistics.DRAWS} draws within the worlds, seed 0."
        )
        levels = self.runs.levels(self.by)
        rows = []
        for measure in self.runs.measures:
            cells = [measure]
            for level in levels:
                part = self.runs.where(self.runs[self.by] == level)
                worlds = part["world"].tolist()
                cells.append(with_interval(statistics.iqm(part[measure], worlds)))
            rows.append(cells)
        self.page.table([short(self.by), *map(shown, levels)], rows)

    def distributions(self) -> None:
        """Adds distributions of all measures, and of the lateral offset over all samples."""
        self.page.heading("Distributions")
        path = self._pictures / "distributions.png"
        figures.distributions(path, self.runs, self.by)
        self.page.picture(path, "Share of the runs whose measure is at most so large")
        counts = self._offset_counts()
        if counts:
            figures.offsets(self._pictures / "offsets.png", counts, self.by)
            words = "Offset from the lane's centre line, all samples of all runs"
            self.page.picture(self._pictures / "offsets.png", words)

    def _offset_counts(self) -> Dict[Any, np.ndarray]:
        """Returns counts of the samples' lateral offset by level, read a run at a time."""
        path = self._folder / tables.SAMPLES
        if not path.is_file():
            return {}
        level_of = dict(zip(self.runs["run_id"].tolist(), self.runs[self.by].tolist()))
        bins = figures.OFFSET_BINS_M
        counts = {level: np.zeros(len(bins) - 1) for level in self.runs.levels(self.by)}
        with pq.ParquetFile(path) as file:
            for number in range(file.num_row_groups):
                group = file.read_row_group(number, columns=["run_id", "lateral_m"])
                run_id = group["run_id"][0].as_py() if len(group) else ""
                if run_id in level_of:
                    values = group["lateral_m"].to_numpy()
                    found, _ = np.histogram(values[np.isfinite(values)], bins)
                    counts[level_of[run_id]] += found
        return counts if any(count.any() for count in counts.values()) else {}

    def effects(self) -> None:
        """Adds the share of variance that each factor explains, and comparisons of the levels of each."""
        varied = self.runs.varied()
        if not varied:
            return
        self.page.heading("Effects")
        self.page.text(
            "Share of a measure's variance that each factor explains by itself [%]: of its levels' means, or of a line"
            " along a scale."
        )
        rows = []
        for measure in self.runs.measures:
            shares = (statistics.share_of_variance(self.runs, name, measure) for name in varied)
            rows.append([measure, *(three(100.0 * share) for share in shares)])
        self.page.table(["", *map(short, varied)], rows)
        path = self._pictures / "effects.png"
        figures.effects(path, self.runs, varied, self.runs.measures[:FIGURED])
        self.page.picture(path, "Means and their 95 % intervals over each factor")
        for factor in varied:
            if factor == "world":  # their fields differ by intent
                continue
            self.page.heading(f"By {short(factor)}", 3)
            base, picture = self.runs.levels(factor)[0], f"by_{short(factor)}.png"
            comparison.compare(self.page, self.runs, factor, base, self._pictures / picture)

    def drives(self, worst: int, by: Optional[str], file: Optional[Path]) -> None:
        """Adds the run in the middle and the worst ones: distances, errors, pictures, and how to see them again."""
        order = statistics.order_by(self.runs, by)
        there = [n for n in order.tolist() if self._has_samples(self.runs["run_id"][n])]
        if not there:
            return
        self.page.heading("A usual run")
        self._drive(self.runs["run_id"][there[len(there) // 2]], "usual")
        if not worst:
            return
        self.page.heading("The worst runs")
        replayer, why = self._replayer(file)
        if why:
            self.page.text(f"Without pictures: {why}.")
        for place, number in enumerate(there[:worst], 1):
            run_id = self.runs["run_id"][number]
            columns = (*NAMES, *(f for f in self.runs.varied() if f not in NAMES), "replicate")
            names = [f"{short(name)} {shown(self.runs[name][number])}" for name in columns]
            values = [f"{name} {three(self.runs[name][number])}" for name in self.runs.measures]
            self.page.heading(f"{place}. {run_id}", 3)
            self.page.text(f"{', '.join(names)}; {self.runs['end_reason'][number]}.")
            self.page.text(", ".join(values))
            self._drive(run_id, f"worst_{place}", replayer)
            self.page.command(self._command(run_id))

    def _has_samples(self, run_id: str) -> bool:
        path = tables.run_path(self._folder, run_id)
        return path.is_file() and pq.read_metadata(path).num_rows > 1

    def _replayer(self, file: Optional[Path]) -> Any:
        try:
            return Replayer(self._folder, file), ""
        except GeneratorError as error:
            return None, str(error)

    def _drive(self, run_id: str, name: str, replayer: Optional[Replayer] = None) -> None:
        run = tables.read_run(self._folder, run_id)
        if replayer:
            self._strip(run, replayer, name)
        drawn = drives.Drawn(run, run_id)
        for draw, what, words in (
            (drives.perceived_distances, "distances", "Raw lidar and perceived distances"),
            (drives.errors, "errors", "Offset and heading from the lane's centre line"),
        ):
            path = self._pictures / f"{name}_{what}.png"
            draw(drawn, path)
            self.page.picture(path, words)

    def _strip(self, run: tables.RunFile, replayer: Replayer, name: str) -> None:
        chosen, path = strips.moments(run), self._pictures / f"{name}_pictures.png"
        try:
            strips.draw(path, replayer.job(run.row.run_id), run, chosen)
        except (GeneratorError, ValueError) as error:
            self.page.text(f"Without pictures: {error}.")
            return
        self.page.picture(path, "; ".join(moment.text for moment in chosen))

    def _command(self, run_id: str) -> str:
        file = str(noted_file(self._folder) or "CAMPAIGN.yaml")
        words = ["python3", "-m", "ardee_campaigns", "run_campaign", file]
        return shlex.join([*words, "--output", str(self._folder.resolve()), "--replay", run_id])
