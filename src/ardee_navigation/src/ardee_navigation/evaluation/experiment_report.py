# SPDX-License-Identifier: MIT
"""Writes the report of an experiment: report.md with its table and figures, a CSV file a run, one of all runs."""
import re
from pathlib import Path
from typing import Callable, List, Sequence, Tuple

from ardee_common.errors import GeneratorError
from ardee_navigation.evaluation import figures
from ardee_navigation.evaluation.comparison import read_runs
from ardee_navigation.evaluation.record import Record, write_csv
from ardee_navigation.evaluation.run_metrics import Summary, summarize

Cell = Tuple[str, Callable[[Summary], str]]
_TABLE: Tuple[Cell, ...] = (
    ("way [m]", lambda s: f"{s.way_m:.1f}"),
    ("lateral RMS [cm]", lambda s: f"{100 * s.lateral_rms_m:.1f}"),
    ("lateral max [cm]", lambda s: f"{100 * s.lateral_max_m:.1f}"),
    ("within 10 cm [%]", lambda s: f"{100 * s.share_near:.1f}"),
    ("heading RMS [deg]", lambda s: f"{57.29578 * s.heading_rms_rad:.1f}"),
    ("heading max [deg]", lambda s: f"{57.29578 * s.heading_max_rad:.1f}"),
    ("perceived width [m]", lambda s: f"{s.width_m:.3f} ± {s.width_sd_m:.3f}"),
    ("true width [m]", lambda s: f"{s.width_true_m:.3f}"),
    (
        "left, right bias [cm]",
        lambda s: f"{100 * s.left_error_m:+.1f}, {100 * s.right_error_m:+.1f}",
    ),
    ("interventions", lambda s: str(s.interventions)),
    (
        "m per intervention",
        lambda s: ("" if s.interventions else "> ") + f"{s.metres_per_intervention:.1f}",
    ),
    ("collisions", lambda s: str(s.collisions)),
    ("stalks touched", lambda s: str(s.touched)),
    ("plants knocked", lambda s: str(s.knocked)),
    ("time [s]", lambda s: f"{s.time_s:.1f}"),
    ("real-time factor", lambda s: f"{s.real_time_factor:.1f}"),
)
_NOTES = """Lateral and heading errors are those of the robot's middle from the middle between the two ideal row
lines of the field's truth file, weighted by the way, between the rows' first and last places. A person steps in
when the robot is more than 0.38 m off that line, has not moved for 2 s, or stops in the row; not in the row's last
0.5 m, where the follower may end. It is then set down in the middle of the lane and goes on. Plants are rigid
scenery to the simulator: they do not fall, and it reports no contacts. Collisions are counted by geometry: times
that a stalk comes within 1 cm of the robot's outline; a plant counts as knocked when its stalk is more than 2 cm
inside it. Perceived distances are those to the lines in use; leaves before the stalks make them short of the ideal
row lines.
"""


def _title(scenario: str) -> str:
    return f"# Row following: {scenario}"


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(cells) + " |\n"


def _latency(records: Sequence[Record]) -> str:
    times = sorted(ms for record in records for ms in record.latency_ms)
    if not times:
        return ""
    unanswered = sum(record.unanswered for record in records)
    p50, p99 = (times[min(int(q * len(times)), len(times) - 1)] for q in (0.5, 0.99))
    return (
        f"\nHardware in the loop: from scan message to `cmd_vel` message {p50:.1f} ms median, {p99:.1f} ms p99,"
        f" {times[-1]:.1f} ms at most, over {len(times)} commands; {unanswered} scans got no answer.\n"
    )


def _cells(summary: Summary) -> List[str]:
    """Returns the cells of a row; a missing figure is a dash."""
    texts = (cell(summary) for _, cell in _TABLE)
    return ["-" if "nan" in text else text for text in texts]


def _never_there(records: Sequence[Record]) -> str:
    numbers = [str(record.number) for record in records if summarize([record]).way_m == 0.0]
    if len(numbers) == len(records):
        return "\nNo run came between the rows: nothing was measured there.\n"
    if numbers:
        return f"\nNever between the rows, so not measured there: run {', '.join(numbers)}.\n"
    return ""


def table(records: Sequence[Record]) -> str:
    """Returns Markdown: a line a run, one of all, and the runs that never came between the rows."""
    text = _line(["run", "seed", "end", *(name for name, _ in _TABLE)])
    text += "|" + "---|" * (3 + len(_TABLE)) + "\n"
    for record in records:
        summary = summarize([record])
        cells = [str(record.number), str(record.seed), record.end]
        text += _line([*cells, *_cells(summary)])
    summary = summarize(records)
    ends = f"{summary.completed} of {len(records)} at the end of the row"
    return text + _line(["all", "", ends, *_cells(summary)]) + _never_there(records)


def in_short(record: Record) -> str:
    """Returns a run in one line, for a log."""
    summary = summarize([record])
    way = f"{summary.way_m:.1f} m, lateral RMS {100 * summary.lateral_rms_m:.1f} cm"
    if summary.way_m == 0.0:
        way = "never between the rows"
    return (
        f"seed {record.seed}, {record.end}, {way},"
        f" {summary.interventions} interventions, real-time factor {summary.real_time_factor:.1f}"
    )


def _summary_csv(records: Sequence[Record], path: Path) -> None:
    names = list(Summary.__annotations__)
    with path.open("w") as file:
        file.write(",".join(["run", "seed", "end", *names]) + "\n")
        for record in records:
            summary = summarize([record])
            values = (f"{getattr(summary, name):.6g}" for name in names)
            file.write(",".join([str(record.number), str(record.seed), record.end, *values]) + "\n")


def _interventions(records: Sequence[Record]) -> str:
    lines = [
        f"- run {record.number}, {step_in.along_m:.1f} m along: {step_in.why}\n"
        for record in records
        for step_in in record.interventions
    ]
    return "\n## Interventions\n\n" + "".join(lines) if lines else ""


def _stem(record: Record) -> str:
    return f"run_{record.number:02d}"


def write_run(record: Record, folder: Path) -> None:
    """Writes the CSV file and the figures of a run into a folder."""
    stem = _stem(record)
    write_csv(record, folder / f"{stem}.csv")
    figures.perceived_distances(record, folder / f"{stem}_lidar.png")
    figures.errors(record, folder / f"{stem}_errors.png")


def check_folder(folder: Path, scenario: str, seeds: Sequence[int]) -> None:
    """Raises GeneratorError if a folder holds a report that an experiment over these seeds would erase."""
    report = folder / "report.md"
    if not report.is_file():
        return
    title, others = report.read_text().split("\n")[0], set(read_runs(folder)) - set(seeds)
    if title != _title(scenario) or others:
        what = f"of seed {min(others)}" if others else f"called {title!r}"
        raise GeneratorError(
            f"{folder}: found the report of an experiment {what}, which would be erased;"
            " expected an empty folder, or a report of the same scenario and no other seeds"
        )


def _drop_other_runs(records: Sequence[Record], folder: Path) -> None:
    """Removes runs that an earlier experiment left in the same folder."""
    stems = {_stem(record) for record in records}
    for path in folder.glob("run_*"):
        named = re.fullmatch(r"(run_\d{2,})(\.csv|_lidar\.png|_errors\.png)", path.name)
        if named and named[1] not in stems:
            path.unlink()


def write_report(records: Sequence[Record], command: str, folder: Path) -> Path:
    """Writes the report of all runs into the folder of `write_run`, without others' runs; returns report.md's path."""
    _drop_other_runs(records, folder)
    pictures = ""
    for record in records:
        stem = _stem(record)
        pictures += f"\n![Run {record.number}: lidar and perceived distances]({stem}_lidar.png)\n"
        pictures += f"\n![Run {record.number}: errors]({stem}_errors.png)\n"
    _summary_csv(records, folder / "runs.csv")
    text = f"{_title(records[0].scenario)}\n\n`{command}`\n\n{_NOTES}\n{table(records)}"
    text += _latency(records) + _interventions(records) + "\n## Runs\n" + pictures
    path = folder / "report.md"
    path.write_text(text)
    return path
