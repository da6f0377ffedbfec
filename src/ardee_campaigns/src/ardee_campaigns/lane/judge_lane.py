# SPDX-License-Identifier: MIT
"""Command `judge_lane`: figures of a simulated lane as a lidar sees it, beside those of a real one, and a picture."""
import argparse
import shutil
import sys
import tempfile
from contextlib import ExitStack
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
from ardee_sim import ArdeeError, LidarReading
from tqdm import tqdm

from ardee_campaigns.experiment import scenarios
from ardee_campaigns.plan import Job, Planner
from ardee_campaigns.robot import Observation
from ardee_campaigns.run import Run
from ardee_common.cli import Parser, number_in, whole_in
from ardee_common.errors import GeneratorError
from ardee_common.output import locked, output_folder, write_file
from ardee_common.process import end_by_signals
from ardee_navigation.lbirnt import State

PROG = "judge_lane"
REAL_LANE = Path(__file__).with_name("real_lane.yaml")


def _arguments(argv: Sequence[str]) -> argparse.Namespace:
    parser = Parser(
        prog=PROG,
        description="Let the row follower drive a world's lane; print figures of the lidar's scans beside those of a"
        " real run, and draw both. Run r has the seed SEED + r.",
    )
    parser.add_argument(
        "world",
        nargs="?",
        metavar="WORLD",
        help="scenario of run_experiment, world of ardee_world, or a .world file with its .start.yaml;"
        " without it the real run alone is measured",
    )
    scenarios.add_arguments(parser)
    parser.add_argument(
        "--scans",
        type=whole_in(2, 100_000),
        default=480,
        help="largest number of scans of a run, 40 a second",
    )
    parser.add_argument(
        "--from-m",
        type=number_in(0.0, 1e6),
        default=0.0,
        help="distance along the lane from which scans are measured",
    )
    parser.add_argument(
        "--real-run",
        type=Path,
        metavar="DIR",
        help="folder of a real run's lidar_log.csv and perception_lidar_log.csv (default: the figures of a"
        " real lane that ship, without a scan for the picture)",
    )
    parser.add_argument(
        "--output",
        type=Path,
        help="folder of lane.md, lane.png and a real run's real_lane.yaml"
        " (default: lane_output/WORLD_seeds_FIRST_to_LAST)",
    )
    args = scenarios.parse(parser, argv)
    if args.world is None and args.real_run is None:
        parser.error("found neither WORLD nor --real-run, expected at least one")
    return args


@dataclass
class Report:
    """Report in a folder: lane.md and lane.png."""

    command: str
    name: str  # of the simulated lane
    real: Any  # RealLane
    columns: Dict[str, Any]  # LaneFigures of a real run by heading
    output: Path
    real_scans: Optional[Any] = None
    table: str = ""

    @property
    def path(self) -> Path:
        """Returns the file of the table."""
        return self.output / "lane.md"

    def draw(self, scans: Optional[Any]) -> None:
        """Draws the real lane and the scans of a simulated run."""
        from ardee_campaigns.lane.lane_picture import draw

        draw(self.output / "lane.png", self.real, self.real_scans, scans, self.name)

    def write(self, runs: Sequence[Any]) -> None:
        """Writes the table of the runs so far."""
        from ardee_campaigns.lane.lane_figures import table

        self.table = table(self.columns, runs, self.name)
        about = f"Real: {self.real.source}, {self.real.scans} scans."
        about += f" {self.name}: {len(runs)} runs." if runs else ""
        title = f"# The lane as a lidar sees it\n\n`{self.command}`\n\n{about}\n"
        self.path.write_text(f"{title}\n{self.table}\n![Both lanes](lane.png)\n")


@dataclass
class Recorder:
    """Records scans while the lidar is in the lane, and the follower's answers to them; ends the run after enough."""

    run: Run
    wanted: int
    from_m: float  # along the lane
    readings: List[LidarReading] = field(default_factory=list)
    answers: List[Tuple[float, ...]] = field(default_factory=list)
    ride: List[Tuple[float, float, float]] = field(default_factory=list)

    def watch(self, observation: Observation) -> None:
        """Takes a scan and its answer."""
        from ardee_campaigns.lane.scans import answer

        output, recorder, about = self.run.controller.output, self.run.recorder, self.run.about
        along_m = recorder.last("along_m") + about["lidar_ahead_m"]
        if output.state is not State.FOLLOWING or not self.from_m <= along_m <= about["length_m"]:
            return
        reading: Any = observation["scan"]
        self.readings.append(reading)
        self.answers.append((reading.stamp_ns * 1e-9, *answer(output)))
        self.ride.append((*self.run.driven.tilt(), recorder.last("heading_rad")))
        if len(self.readings) >= self.wanted:
            self.run.judge.end = self.run.judge.end or "enough scans"

    def result(self) -> Tuple[Any, Any]:
        """Returns the Scans and what was Perceived in them, at least one scan."""
        from ardee_campaigns.lane.scans import Scans, perceived, returns_m

        ranges = returns_m(np.array([reading.ranges_m for reading in self.readings], dtype=float))
        found, first = perceived(self.answers), self.readings[0]
        angles = (
            float(np.float32(first.angle_min_rad)),
            float(np.float32(first.angle_increment_rad)),
        )
        return Scans(found.time_s, ranges, *angles), found


def _one_run(args: argparse.Namespace, job: Job, work: Path) -> Tuple[Any, Any, Any, str]:
    """Drives one run; returns its scans, what was perceived in them, the ride, and the run in one line."""
    run = Run(job)
    recorder = Recorder(run, args.scans, args.from_m)
    with tqdm(
        total=args.scans, unit="scan", desc=f"run {job.replicate}", leave=False, disable=None
    ) as bar:

        def watch(observation: Observation) -> None:
            recorder.watch(observation)
            bar.n = len(recorder.readings)
            bar.update(0)

        run.drive(work, watch)
    if len(recorder.readings) < 2:
        found = f"found {len(recorder.readings)} scans in the lane from {args.from_m:g} m"
        raise GeneratorError(f"{args.world}: seed {job.seed}: {found} on, expected 2 or more")
    step_ins = round(run.measured["interventions"])
    line = f"seed {job.seed}, {len(recorder.readings)} scans, {step_ins} step-ins"
    return (*recorder.result(), np.array(recorder.ride), line)


def _jobs(args: argparse.Namespace, work: Path) -> List[Job]:
    """Returns the runs, of a campaign in a temporary folder."""
    scenario = scenarios.find_scenario(args.world)
    campaign = scenarios.write_campaign(work, "lane", scenario, args, measures=["interventions"])
    planner = Planner(campaign)
    (cell,) = planner.cells
    jobs = [planner.job(cell, number, work) for number in range(args.runs)]
    write_file(jobs[0].urdf, planner.urdf(cell).encode())
    return jobs


def _drive_all(args: argparse.Namespace, jobs: List[Job], report: Report, work: Path) -> None:
    """Drives the runs; the report is written anew after each, so that what was measured survives a Ctrl-C."""
    from ardee_campaigns.lane.lane_figures import measure, with_ride

    runs: List[Any] = []
    try:
        for job in tqdm(jobs, unit="run", desc=args.world, disable=None):
            folder = work / f"run_{job.replicate}"
            folder.mkdir()
            scans, perceived, ride, line = _one_run(args, job, folder)
            figures = measure(scans, perceived, perceived.spread_m)
            runs.append(with_ride(figures, ride))
            if len(runs) == 1:
                report.draw(scans)
            report.write(runs)
            tqdm.write(f"{len(runs)} of {args.runs}: {line}", file=sys.stderr)
            shutil.rmtree(folder)
    except BaseException:
        where = f"what had ended by then is in {report.path}" if runs else "no run had ended"
        tqdm.write(f"{PROG}: {where}", file=sys.stderr)
        raise


def _judge(args: argparse.Namespace, command: str, work: Path) -> None:
    from ardee_campaigns.lane import lane_figures
    from ardee_campaigns.lane.real_run import read_real_run

    jobs = _jobs(args, work) if args.world else []
    if args.real_run:
        real_run: Any = read_real_run(args.real_run)
        real = lane_figures.measure_real(real_run, str(args.real_run))
        own = {"real scans, this follower": lane_figures.measure_follower(real_run)}
    else:
        real_run, real, own = None, lane_figures.read_real_lane(REAL_LANE), {}
    name = Path(args.world).stem if args.world else "real_run"
    usual = f"{name}_seeds_{args.seed}_to_{args.seed + args.runs - 1}" if args.world else name
    with ExitStack() as ends:
        output = ends.enter_context(output_folder(args.output or Path("lane_output") / usual))
        ends.enter_context(locked(output))
        report = Report(command, name, real, {"real": real.figures, **own}, output)
        report.real_scans = real_run.scans if real_run else None
        if real_run:
            lane_figures.write_real_lane(real, output / "real_lane.yaml")
        if jobs:
            _drive_all(args, jobs, report, work)
        else:
            report.draw(None)
            report.write([])
    print(report.table, end="")
    print(report.path)


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Runs the command; returns the exit code: 0 measured, 1 the simulator failed, 2 bad input, 130 Ctrl-C."""
    words = sys.argv[1:] if argv is None else argv
    args = _arguments(words)
    end_by_signals()
    try:
        with tempfile.TemporaryDirectory(prefix="ardee_lane_") as work:
            _judge(args, " ".join(["rosrun ardee_navigation judge_lane", *words]), Path(work))
    except GeneratorError as error:
        print(f"{PROG}: {error}", file=sys.stderr)
        return 2
    except (ArdeeError, OSError) as error:
        print(f"{PROG}: {error}", file=sys.stderr)
        return 1
    return 0
