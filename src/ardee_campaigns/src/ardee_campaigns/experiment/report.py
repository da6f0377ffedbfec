# SPDX-License-Identifier: MIT
"""Writes the report of an experiment: report.md with its table and figures, a CSV file a run, one of all runs."""
import math
import re
from pathlib import Path
from typing import Callable, Dict, List, NamedTuple, Sequence, Tuple

import pyarrow.csv

from ardee_campaigns import tables
from ardee_common.output import write_file

CAMPAIGN = "campaign"  # folder of the campaign in that of the report
Summary = Dict[str, float]
MEASURES = (
    "way_m",
    "lateral_rms_m",
    "lateral_max_m",
    "share_near",
    "heading_rms_rad",
    "heading_max_rad",
    "row_width_m",
    "row_width_sd_m",
    "left_error_m",
    "right_error_m",
    "interventions",
    "metres_per_intervention",
    "collisions",
    "plants_touched",
    "plants_knocked",
    "completed",
    "time_s",
)
_COUNTS = ("interventions", "collisions", "plants_touched", "plants_knocked", "completed")
_TABLE: Tuple[Tuple[str, Callable[[Summary], str]], ...] = (
    ("way [m]", lambda s: f"{s['way_m']:.1f}"),
    ("lateral RMS [cm]", lambda s: f"{100 * s['lateral_rms_m']:.1f}"),
    ("lateral max [cm]", lambda s: f"{100 * s['lateral_max_m']:.1f}"),
    ("within 10 cm [%]", lambda s: f"{100 * s['share_near']:.1f}"),
    ("heading RMS [deg]", lambda s: f"{math.degrees(s['heading_rms_rad']):.1f}"),
    ("heading max [deg]", lambda s: f"{math.degrees(s['heading_max_rad']):.1f}"),
    ("perceived width [m]", lambda s: f"{s['row_width_m']:.3f} ± {s['row_width_sd_m']:.3f}"),
    ("true width [m]", lambda s: f"{s['true_width_m']:.3f}"),
    (
        "left, right bias [cm]",
        lambda s: f"{100 * s['left_error_m']:+.1f}, {100 * s['right_error_m']:+.1f}",
    ),
    ("interventions", lambda s: f"{s['interventions']:.0f}"),
    (
        "m per intervention",
        lambda s: ("" if s["interventions"] else "> ") + f"{s['metres_per_intervention']:.1f}",
    ),
    ("collisions", lambda s: f"{s['collisions']:.0f}"),
    ("stalks touched", lambda s: f"{s['plants_touched']:.0f}"),
    ("plants knocked", lambda s: f"{s['plants_knocked']:.0f}"),
    ("time [s]", lambda s: f"{s['time_s']:.1f}"),
    ("real-time factor", lambda s: f"{s['time_s'] / s['wall_s']:.1f}"),
)
_NOTES = """Lateral and heading errors are those of the robot's middle from the middle between the two ideal row
lines of the field's truth file, weighted by the way, between the rows' first and last places. A person steps in
when the robot is more than 0.38 m off that line, has not moved for 2 s, or stops in the row; not in the row's last
0.5 m, where one that stands has ended. It is then set down in the middle of the lane and goes on. Plants are rigid
scenery to the simulator: they do not fall, and it reports no contacts. Collisions are counted by geometry: times
that a stalk comes within 1 cm of the robot's outline; a plant counts as knocked when its stalk is more than 2 cm
inside it. Perceived distances are those to the lines in use; leaves before the stalks make them short of the ideal
row lines. The real-time factor counts the sowing of the field in.
"""


class EndedRun(NamedTuple):
    """A run that has ended; a summary without any measure if it failed."""

    seed: int
    end: str
    summary: Summary
    step_ins: List[Tuple[float, str]]  # along the row [m], why
    latency_ms: List[float]  # with hardware in the loop
    unanswered: int  # scans to which no command came


def _ended(run: tables.RunFile) -> EndedRun:
    row, about = run.row, run.about
    places = zip(run.samples["along_m"].to_pylist(), run.samples["event"].to_pylist())
    summary = dict(row.measures)
    if summary:
        summary.update(true_width_m=about["width_m"], wall_s=run.timing.wall_s)
    end = f"failed: {row.error}" if row.status == tables.FAILED else row.end_reason
    step_ins = [(along_m, why) for along_m, why in places if why]
    latency_ms, unanswered = about.get("latency_ms", []), about.get("unanswered", 0)
    return EndedRun(row.seed, end, summary, step_ins, latency_ms, unanswered)


def pooled(runs: Sequence[Summary]) -> Summary:
    """Returns the numbers of all samples of the runs together, each weighted by the way it stands for.

    A run that has no number, such as one in which nothing was perceived, does not count in it.
    """
    total = {name: float(sum(run[name] for run in runs)) for name in (*_COUNTS, "way_m", "time_s")}
    total["wall_s"] = sum(run["wall_s"] for run in runs)

    def mean(value: Callable[[Summary], float]) -> float:
        pairs = [(run["way_m"], value(run)) for run in runs if run["way_m"] > 0.0]
        known = [(weight, one) for weight, one in pairs if math.isfinite(one)]
        way_m = sum(weight for weight, _ in known)
        return sum(weight * one for weight, one in known) / way_m if known else math.nan

    for name in ("share_near", "row_width_m", "left_error_m", "right_error_m"):
        total[name] = mean(lambda run, name=name: run[name])
    for name in ("lateral_rms_m", "heading_rms_rad"):
        total[name] = math.sqrt(mean(lambda run, name=name: run[name] ** 2))
    for name in ("lateral_max_m", "heading_max_rad"):
        total[name] = max((r[name] for r in runs if math.isfinite(r[name])), default=math.nan)
    width_m = total["row_width_m"]
    variance = mean(lambda run: run["row_width_sd_m"] ** 2 + (run["row_width_m"] - width_m) ** 2)
    total["row_width_sd_m"] = math.sqrt(variance)
    total["true_width_m"] = sum(run["true_width_m"] for run in runs) / len(runs)
    total["metres_per_intervention"] = total["way_m"] / max(total["interventions"], 1.0)
    return total


def in_short(run: tables.RunFile) -> str:
    """Returns a run in one line, for a log."""
    seed, end, summary, step_ins, *_ = _ended(run)
    if not summary:
        return f"seed {seed}, {end}"
    way = f"{summary['way_m']:.1f} m, lateral RMS {100 * summary['lateral_rms_m']:.1f} cm"
    if summary["way_m"] == 0.0:
        way = "never between the rows"
    pace = summary["time_s"] / summary["wall_s"]
    return f"seed {seed}, {end}, {way}, {len(step_ins)} interventions, real-time factor {pace:.1f}"


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"


def _cells(summary: Summary) -> List[str]:
    """Returns the cells of a row; a missing figure is a dash."""
    texts = [cell(summary) for _, cell in _TABLE] if summary else ["-"] * len(_TABLE)
    return ["-" if "nan" in text else text for text in texts]


class Report:
    """The report of an experiment in a folder, written anew with each run that has ended."""

    def __init__(self, folder: Path, title: str, command: str) -> None:
        self._folder, self._title, self._command = folder, title, command
        self._runs: Dict[int, EndedRun] = {}
        self.path = folder / "report.md"

    def __len__(self) -> int:
        return len(self._runs)

    @property
    def has_failed(self) -> bool:
        """Returns whether a run failed."""
        return not all(run.summary for run in self._runs.values())

    def begin(self, kept: Sequence[int]) -> None:
        """Removes what an earlier experiment left of runs in the folder that are not kept."""
        stems = {_stem(number) for number in kept}
        for path in self._folder.glob("run_*"):
            named = re.fullmatch(r"(run_\d{2,})(\.csv|_lidar\.png|_errors\.png)", path.name)
            if named and named[1] not in stems:
                path.unlink()

    def add(self, number: int, run: tables.RunFile) -> None:
        """Adds a run: its figures and samples, unless they are there, and the tables of all."""
        from ardee_campaigns.report import drives

        stem, samples = _stem(number), run.samples
        csv = self._folder / f"{stem}.csv"
        if len(samples) > 1 and not csv.is_file():
            drawn = drives.Drawn(run, f"{run.row.world}, run {number}, seed {run.row.seed}")
            drives.perceived_distances(drawn, self._folder / f"{stem}_lidar.png")
            drives.errors(drawn, self._folder / f"{stem}_errors.png")
            columns = samples.select([name for name, _ in tables.SAMPLE_FIELDS])
            pyarrow.csv.write_csv(columns, csv)
        self._runs[number] = _ended(run)
        self._runs = dict(sorted(self._runs.items()))
        write_file(self._folder / "runs.csv", self._csv().encode())
        write_file(self.path, self._text().encode())

    def _csv(self) -> str:
        names = [*MEASURES, "true_width_m"]
        lines = [",".join(["run", "seed", "end", *names])]
        for number, run in self._runs.items():
            values = [f"{run.summary.get(name, math.nan):.6g}" for name in names]
            end = run.end if run.summary else "failed"
            lines.append(",".join([str(number), str(run.seed), end, *values]))
        return "\n".join(lines) + "\n"

    def table(self) -> str:
        """Returns Markdown: a line a run, one of all, and the runs that never came between the rows."""
        text = _line(["run", "seed", "end", *(name for name, _ in _TABLE)])
        text += "|" + "---|" * (3 + len(_TABLE)) + "\n"
        for number, run in self._runs.items():
            text += _line([str(number), str(run.seed), run.end, *_cells(run.summary)])
        driven = [run.summary for run in self._runs.values() if run.summary]
        everything = pooled(driven) if driven else {}
        ends = f"{everything.get('completed', 0):.0f} of {len(self._runs)} at the end of the row"
        return text + _line(["all", "", ends, *_cells(everything)]) + self._never_there()

    def _never_there(self) -> str:
        numbers = [n for n, run in self._runs.items() if run.summary.get("way_m", 0.0) == 0.0]
        if len(numbers) == len(self._runs):
            return "\nNo run came between the rows: nothing was measured there.\n"
        named = ", ".join(map(str, numbers))
        what = "Never between the rows, so not measured there"
        return f"\n{what}: run {named}.\n" if numbers else ""

    def _latency(self) -> str:
        times = sorted(ms for run in self._runs.values() for ms in run.latency_ms)
        if not times:
            return ""
        unanswered = sum(run.unanswered for run in self._runs.values())
        p50, p99 = (times[min(int(q * len(times)), len(times) - 1)] for q in (0.5, 0.99))
        return (
            f"\nHardware in the loop: from a scan's datagrams to its command's {p50:.1f} ms median, {p99:.1f} ms p99,"
            f" {times[-1]:.1f} ms at most, over {len(times)} commands; {unanswered} scans got no answer in time.\n"
        )

    def _text(self) -> str:
        """Returns report.md."""
        text = f"# {self._title}\n\n`{self._command}`\n\n{_NOTES}\n{self.table()}{self._latency()}"
        step_ins = [
            f"- run {number}, {along_m:.1f} m along: {why}\n"
            for number, run in self._runs.items()
            for along_m, why in run.step_ins
        ]
        text += "\n## Interventions\n\n" + "".join(step_ins) if step_ins else ""
        text += "\n## Runs\n"
        for number in self._runs:
            stem = _stem(number)
            if (self._folder / f"{stem}.csv").is_file():
                what = f"\n![Run {number}: lidar and perceived distances]({stem}_lidar.png)\n"
                text += f"{what}\n![Run {number}: errors]({stem}_errors.png)\n"
        return text


def _stem(number: int) -> str:
    return f"run_{number:02d}"
