# SPDX-License-Identifier: MIT
"""Command `run_campaign`: works off a campaign's file, goes on where it stopped, writes tables."""
import argparse
import contextlib
import csv
import math
import os
import sys
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence, Set

import numpy as np

from ardee_campaigns import measures, tables
from ardee_campaigns.campaign_file import Campaign, read_campaign
from ardee_campaigns.page_view import Page
from ardee_campaigns.plan import Cell, Job, Planner, about
from ardee_campaigns.replay import ROBOTS, ScanLog, in_lane, note_file, noted_file
from ardee_common.cli import Parser, say, whole_in
from ardee_common.config import read_yaml_lines
from ardee_common.errors import GeneratorError, WorkersError, known_names
from ardee_common.output import locked
from ardee_common.process import Ended, end_by_signals

PROG = "run_campaign"
_PACE = 20.0  # simulated seconds a second, for an estimate before the first run (estimate)


def _arguments(argv: Optional[Sequence[str]]) -> argparse.Namespace:
    parser = Parser(
        prog=PROG,
        description="Do the runs of a campaign's file that are not done yet, and write tables of all. Ctrl-C ends it; "
        "the same command goes on.",
    )
    parser.add_argument(
        "file",
        type=Path,
        metavar="CAMPAIGN.yaml",
        help="file of the campaign, or the name of a shipped one: " + ", ".join(_shipped()),
    )
    parser.add_argument(
        "--output", type=Path, help="folder of the tables (default: campaign_output/NAME)"
    )
    parser.add_argument(
        "--list",
        action="store_true",
        help="print the plan and how long it may take; run nothing",
    )
    parser.add_argument(
        "--scheduler",
        metavar="tcp://HOST:PORT",
        help="dask scheduler whose workers do the runs; the output folder has the same path on all of them",
    )
    parser.add_argument(
        "--retry-failed", action="store_true", help="do the runs again that failed before"
    )
    parser.add_argument(
        "--csv", action="store_true", help="write runs.csv and timings.csv beside the tables"
    )
    parser.add_argument(
        "--replay",
        metavar="RUN_ID",
        help="do this run again by itself, that of a program or a ROS node by its recorded commands; write its samples"
        " as RUN_ID.csv, and a lidar's scans in the lane as RUN_ID_scans.csv, which overlay reads; print where",
    )
    parser.add_argument(
        "--bag",
        action="store_true",
        help="with --replay: write RUN_ID.bag, too, with all topics of the node simulator but cameras and clouds that"
        " are not among the robot's topics; needs ROS",
    )
    parser.add_argument(
        "--view",
        nargs="?",
        type=whole_in(0, 65535),
        const=8080,
        metavar="PORT",
        help="with --replay: show it in real time in a page of the browser, paused at its start and at its end, at this"
        " port (default: 8080; 0: any free one); needs viser",
    )
    args = parser.parse_args(argv)
    _check_flags(parser, args)
    return args


def _check_flags(parser: Parser, args: argparse.Namespace) -> None:
    """Ends with an error for a flag that would have no effect."""
    for flag, is_given in (("--bag", args.bag), ("--view", args.view is not None)):
        if is_given and not args.replay:
            parser.error(f"{flag}: found no --replay, expected the run that it is for")
    kept = [flag for flag in ("list", "replay") if getattr(args, flag)]
    unused = [flag for flag in ("csv", "retry_failed", "scheduler") if kept and getattr(args, flag)]
    for flag in kept[1:] + unused:
        found = f"found it with --{kept[0]}, which works no campaign off"
        parser.error(f"--{flag.replace('_', '-')}: {found}, expected one of them")


def _shipped() -> Dict[str, Path]:
    """Returns the campaigns that ship, by name."""
    files = (Path(__file__).resolve().parent / "examples").glob("*.yaml")
    return {file.stem: file for file in sorted(files)}


def _found(file: Path) -> Path:
    """Returns the file of a campaign, or the shipped one of that name."""
    shipped = _shipped()
    if str(file) in shipped or file.is_file():
        return shipped.get(str(file), file)
    raise GeneratorError(f"{file}: found no such file, and {known_names(file.stem, shipped)}")


class Progress:
    """A line for each run that has ended."""

    def __init__(self, count: int) -> None:
        self._count, self.done, self.failed = count, 0, 0

    def __call__(self, job: Job, error: str) -> None:
        """Tells of a run."""
        self.done += 1
        self.failed += bool(error)
        cell = job.cell
        what = f"{cell.world}, {cell.robot}, {cell.controller}, replicate {job.replicate}"
        factors = "".join(f", {name} {value}" for name, value in cell.factors)
        end = f"failed: {error}" if error else "ok"
        say(PROG, f"{self.done} of {self._count}: {job.run_id} ({what}{factors}) {end}")


class Session:
    """A campaign, its plan and its folder."""

    def __init__(self, campaign: Campaign, folder: Path) -> None:
        self.campaign, self.folder = campaign, folder
        self.planner = Planner(campaign)
        self._jobs: Dict[Any, Job] = {}

    def jobs(self, replicates: int, cells: Optional[Sequence[Cell]] = None) -> List[Job]:
        """Returns the runs of the first replicates."""
        chosen = self.planner.cells if cells is None else cells
        return [self._job(cell, number) for cell in chosen for number in range(replicates)]

    def _job(self, cell: Cell, replicate: int) -> Job:
        key = cell, replicate
        if key not in self._jobs:
            self._jobs[key] = self.planner.job(cell, replicate, self.folder / ROBOTS)
        return self._jobs[key]

    def possible_ids(self) -> Set[str]:
        """Returns the ids of all runs that the plan may come to."""
        keys, planner = self.campaign.keys, self.planner
        most = keys.plan.most_replicates if keys.plan.kind == "until" else keys.replicates
        jobs = (planner.job(cell, n, self.folder) for cell in planner.cells for n in range(most))
        return {job.run_id for job in jobs}

    def all_jobs(self) -> List[Job]:
        """Returns the runs that were planned so far."""
        return list(self._jobs.values())

    def open(self, jobs: Sequence[Job]) -> List[Job]:
        """Returns the runs that are not done yet."""
        there = set(tables.finished(self.folder))
        return [job for job in jobs if job.run_id not in there]

    def write_robots(self, jobs: Sequence[Job]) -> None:
        """Writes the descriptions of the robots for the workers."""
        for job in jobs:
            if not job.urdf.is_file():
                tables.write_file(job.urdf, self.planner.urdf(job.cell).encode())

    def schema(self) -> Any:
        """Returns the schema of runs.parquet."""
        cells, kinds = self.planner.cells, {}
        for number, name in enumerate(self.campaign.factors):
            kinds[name] = tables.factor_type([cell.factors[number][1] for cell in cells])
        names = [measures.column(name) for name in self.campaign.keys.measures]
        return tables.runs_schema(kinds, names, about(self.campaign))

    def too_wide(self) -> List[Cell]:
        """Returns the combinations whose interval of the plan's measure is still too wide."""
        keys, wide = self.campaign.keys, []
        for cell in self.planner.cells:
            done = [job for key, job in self._jobs.items() if key[0] == cell]
            heads = [tables.read_run_head(self.folder, job.run_id).row for job in done]
            column = measures.column(keys.plan.measure)
            values = [row.measures.get(column, math.nan) for row in heads]
            half = half_width([value for value in values if math.isfinite(value)])
            if half > keys.plan.half_width and len(done) < keys.plan.most_replicates:
                wide.append(cell)
        return wide

    def replicates_of(self, cell: Cell) -> int:
        """Returns how many replicates of a combination were planned so far."""
        return sum(key[0] == cell for key in self._jobs)


def half_width(values: Sequence[float]) -> float:
    """Returns half of the 95 % Student interval of the mean; infinite for less than two values."""
    from ardee_campaigns.report.statistics import mean_interval

    if len(values) < 2:
        return math.inf
    found = mean_interval(values)
    return (found.high - found.low) / 2.0


def _list(session: Session) -> None:
    keys = session.campaign.keys
    jobs = session.jobs(keys.replicates)
    left = {job.run_id for job in session.open(jobs)}
    print("run_id,world,robot,controller,replicate,seed,is_done" + _header(session))
    lines = csv.writer(sys.stdout, lineterminator="\n")
    for job in jobs:
        cell, is_done = job.cell, int(job.run_id not in left)
        names = (job.run_id, cell.world, cell.robot, cell.controller)
        factors = (value for _, value in cell.factors)
        lines.writerow((*names, job.replicate, job.seed, is_done, *factors))
    workers = keys.workers or len(os.sched_getaffinity(0))
    wall_s, how = _wall_s(session, jobs)
    hours = len(left) * wall_s / workers / 3600.0
    more = " or more, until the interval is narrow" if keys.plan.kind == "until" else ""
    say(PROG, f"{len(jobs)} runs{more}, {len(left)} of them to do: {hours:.2g} h, {how}")


def _header(session: Session) -> str:
    return "".join(f",factor_{name}" for name in session.campaign.factors)


def _wall_s(session: Session, jobs: Sequence[Job]) -> Any:
    """Returns the time that a run takes: of those that are done, or a guess."""
    there = set(tables.finished(session.folder))
    done = [job.run_id for job in jobs if job.run_id in there]
    if done:
        walls = [tables.read_run_head(session.folder, run_id).timing.wall_s for run_id in done]
        return float(np.nanmean(walls)), "as long a run as those that are done"
    limit_s = session.campaign.keys.limit_sim_s
    guess = f"if each lasts {limit_s:g} s at {_PACE:g} x real time; with cameras many times as long"
    return limit_s / _PACE, guess


def _work(session: Session, args: argparse.Namespace) -> int:
    from ardee_campaigns.workers import Workers, collect

    keys, folder = session.campaign.keys, session.folder
    jobs = session.jobs(keys.replicates)
    try:
        (folder / tables.FOLDER).mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise GeneratorError(
            f"--output: found {str(folder)!r}, expected a folder to write in: {error.strerror}"
        ) from None
    with locked(folder):
        _check_folder(session, jobs)
        note_file(folder, session.campaign.file)
        if args.retry_failed:
            _forget_failed(session)
        try:
            with Workers(folder, args.scheduler, keys.workers) as workers:
                _rounds(session, workers, jobs)
        finally:
            rows = collect(folder, session.all_jobs(), session.schema())
            if args.csv:
                _write_csv(folder)
    failed = sum(row.status == tables.FAILED for row in rows)
    say(PROG, f"{len(rows)} runs, {failed} of them failed")
    print(folder / tables.RUNS)
    return 0


def _rounds(session: Session, workers: Any, jobs: List[Job]) -> None:
    """Does the jobs, and further replicates as long as the plan wants them."""
    keys = session.campaign.keys
    while jobs:
        left = session.open(jobs)
        session.write_robots(left)
        if len(left) < len(jobs):
            say(PROG, f"{len(jobs) - len(left)} of {len(jobs)} runs are done already")
        workers.work_off(left, Progress(len(left)))
        jobs = []
        for cell in session.too_wide() if keys.plan.kind == "until" else []:
            more = session.replicates_of(cell) + keys.replicates
            jobs += session.jobs(min(more, keys.plan.most_replicates), [cell])


def _check_folder(session: Session, jobs: Sequence[Job]) -> None:
    """Raises GeneratorError if the folder holds runs of another campaign's file alone."""
    there, file = set(tables.finished(session.folder)), noted_file(session.folder)
    is_other = file is not None and file != session.campaign.file and file.is_file()  # not moved
    if is_other and there and not there & {job.run_id for job in jobs}:
        found = f"--output: found the runs of {file} in {session.folder}"
        raise GeneratorError(f"{found}, expected another folder")


def _forget_failed(session: Session) -> None:
    """Deletes the files of the campaign's failed runs; those of other campaigns stay."""
    for run_id in set(tables.finished(session.folder)) & session.possible_ids():
        head = tables.read_run_head(session.folder, run_id)
        if head.row.status == tables.FAILED:
            tables.run_path(session.folder, run_id).unlink()


def _write_csv(folder: Path) -> None:
    import pyarrow.csv

    for name in (tables.RUNS, tables.TIMINGS):
        table = tables.read_table(folder / name)
        pyarrow.csv.write_csv(table, (folder / name).with_suffix(".csv"))


def _bag_writer() -> Any:
    """Returns the function that writes a bag, which needs ROS."""
    try:
        from ardee_campaigns.ros.bag import write_bag
    except ImportError as error:
        expected = "ROS and its set-up file sourced"
        raise GeneratorError(f"--bag: found {error}, expected {expected}") from None
    return write_bag


def _write_bag(folder: Path, job: Job, done: tables.RunFile, write: Any) -> None:
    from ardee_campaigns.ros.process import Lost, apart
    from ardee_campaigns.ros.simulator import SimulationError

    path = folder / f"{job.run_id}.bag"
    try:
        apart(write, job, done, path)
    except (Lost, SimulationError) as error:
        raise WorkersError(f"--bag: {' '.join(str(error).split())}") from None
    print(path)


def _replay(session: Session, args: argparse.Namespace) -> int:
    """Does one run again."""
    import pyarrow.csv

    from ardee_campaigns.lane.real_run import write_scans
    from ardee_campaigns.rerun import do_again

    run_id = args.replay
    write_bag = _bag_writer() if args.bag else None
    keys = session.campaign.keys
    is_until = keys.plan.kind == "until"
    jobs = session.jobs(keys.plan.most_replicates if is_until else keys.replicates)
    job = next((job for job in jobs if job.run_id == run_id), None)
    if job is None:
        known = [job.run_id for job in jobs]
        raise GeneratorError(f"--replay: found {run_id!r}, {known_names(run_id, known)}")
    session.write_robots([job])
    log = ScanLog()
    with contextlib.ExitStack() as ends:
        page = None if args.view is None else ends.enter_context(Page(args.view))
        done = do_again(job, session.folder, log.watch, page)
    samples = done.samples.select([name for name, _ in tables.SAMPLE_FIELDS])
    path = session.folder / f"{run_id}.csv"
    pyarrow.csv.write_csv(samples, path)
    say(PROG, f"{done.row.status}, {done.row.error or done.row.end_reason}")
    scans = in_lane(log.scans(), done) if len(log.readings) > 1 and done.about else None
    if scans is not None and len(scans.time_s) > 1:
        write_scans(scans, session.folder / f"{run_id}_scans.csv")
    print(path)
    if write_bag:
        _write_bag(session.folder, job, done, write_bag)
    return 0


def _command(args: argparse.Namespace) -> int:
    campaign = read_campaign(_found(args.file))
    folder = (args.output or Path("campaign_output") / campaign.keys.name).resolve()
    placed = read_yaml_lines(campaign.file)
    if args.scheduler and "workers" in placed:
        found = "found it with --scheduler, whose workers do the runs"
        raise placed.error("workers", f"workers: {found}, expected none")
    session = Session(campaign, folder)
    if args.list:
        _list(session)
        return 0
    return _replay(session, args) if args.replay else _work(session, args)


def exit_code(prog: str, work: Callable[[], int], interrupted: str = "") -> int:
    """Returns what `work` does, 1 it could not go on, 2 bad input, 130 Ctrl-C, after which it says `interrupted`."""
    end_by_signals()
    try:
        return work()
    except Ended as ended:
        if interrupted:
            say(prog, interrupted)
        return int(ended.code or 1)
    except (GeneratorError, OSError) as error:
        print(f"{prog}: {error}", file=sys.stderr)
        return 2
    except WorkersError as error:
        print(f"{prog}: {error}", file=sys.stderr)
        return 1


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Runs the command; returns the exit code: 0 all runs are done, else as exit_code()."""
    args = _arguments(argv)
    return exit_code(PROG, lambda: _command(args), "interrupted; the same command goes on")
