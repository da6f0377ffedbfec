# SPDX-License-Identifier: MIT
"""Command `judge_lane`: figures of a simulated lane as a lidar sees it, beside those of a real one, and a picture."""
import argparse
import shutil
import sys
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple

import numpy as np
from ardee_sim.packages import find_package
from tqdm import tqdm

from ardee_common.cli import Parser, number_in, whole_in
from ardee_common.errors import GeneratorError
from ardee_navigation.evaluation.command import LARGEST_SEED, drop_if_empty, make_folder, run
from ardee_navigation.evaluation.scenario_files import Scenario, read_parameters
from ardee_navigation.evaluation.scenarios import find_scenario, prepare

PROG = "judge_lane"


def _arguments(argv: List[str]) -> argparse.Namespace:
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
    parser.add_argument("--runs", type=whole_in(1, 10_000), default=10, help="number of runs")
    parser.add_argument(
        "--seed", type=whole_in(0, LARGEST_SEED), default=1, help="seed of the first run"
    )
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
        help="folder of a real run's lidar_log.csv and perception_lidar_log.csv (default: the figures of"
        " config/real_lane.yaml, without a scan for the picture)",
    )
    parser.add_argument(
        "--output",
        type=Path,
        help="folder of lane.md, lane.png and a real run's real_lane.yaml"
        " (default: lane_output/WORLD_seeds_FIRST_to_LAST)",
    )
    parser.add_argument(
        "--parameters",
        type=Path,
        help="YAML file of the row follower's parameters that differ from the scenario's",
    )
    parser.add_argument("--bot-model", default="tsv1_default.urdf.xacro", help="robot model file")
    args = parser.parse_args(argv)
    if args.world is None and args.real_run is None:
        parser.error("found neither WORLD nor --real-run, expected at least one")
    if args.seed + args.runs - 1 > LARGEST_SEED:
        parser.error(f"--seed and --runs: found a last seed above {LARGEST_SEED}, the largest")
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
        from ardee_navigation.evaluation.lane_picture import draw

        draw(self.output / "lane.png", self.real, self.real_scans, scans, self.name)

    def write(self, runs: Sequence[Any]) -> None:
        """Writes the table of the runs so far."""
        from ardee_navigation.evaluation.lane_figures import table

        self.table = table(self.columns, runs, self.name)
        about = f"Real: {self.real.source}, {self.real.scans} scans."
        about += f" {self.name}: {len(runs)} runs." if runs else ""
        title = f"# The lane as a lidar sees it\n\n`{self.command}`\n\n{about}\n"
        self.path.write_text(f"{title}\n{self.table}\n![Both lanes](lane.png)\n")


def _scenario(args: argparse.Namespace) -> Scenario:
    scenario = find_scenario(args.world)
    if not args.parameters:
        return scenario
    return replace(scenario, parameters=read_parameters(args.parameters, scenario.parameters))


def _one_run(
    scenario: Scenario, args: argparse.Namespace, number: int, urdf: str, work: Path
) -> Tuple[Any, Any, Any, str]:
    """Drives one run; returns its scans, what was perceived in them, the ride, and the run in one line."""
    from ardee_navigation.evaluation.lockstep import drive
    from ardee_navigation.evaluation.scan_run import Recorder
    from ardee_navigation.evaluation.simulation import Simulation
    from ardee_navigation.evaluation.trial import Judge

    seed = args.seed + number
    trial = prepare(scenario, seed, work / "models")
    judge = Judge(trial, args.world, number, seed, scenario.parameters.lidar_ahead_m)
    with Simulation(trial.world, seed, trial.models) as simulation:
        recorder = Recorder(judge, args.scans, args.from_m, simulation.tilt)
        simulation.spawn(urdf, trial.start, trial.height_m(trial.start))
        with tqdm(
            total=args.scans, unit="scan", desc=f"run {number}", leave=False, disable=None
        ) as bar:

            def progress(_along_m: float) -> None:
                bar.n = len(recorder.scans)
                bar.update(0)

            drive(simulation, trial, scenario.parameters, judge, progress, recorder.watch)
    if len(recorder.scans) < 2:
        found = f"found {len(recorder.scans)} scans in the lane from {args.from_m:g} m"
        raise GeneratorError(f"{args.world}: seed {seed}: {found} on, expected 2 or more")
    step_ins = len(judge.record.interventions)
    line = f"seed {seed}, {len(recorder.scans)} scans, {step_ins} step-ins"
    return (*recorder.result(), np.array(recorder.ride), line)


def _drive_all(args: argparse.Namespace, scenario: Scenario, report: Report, work: Path) -> None:
    """Drives the runs; the report is written anew after each, so that what was measured survives a Ctrl-C."""
    from ardee_navigation.evaluation.lane_figures import measure, with_ride
    from ardee_navigation.evaluation.simulation import robot_urdf

    runs = []  # type: List[Any]
    try:
        urdf = robot_urdf(args.bot_model)
        for number in tqdm(range(args.runs), unit="run", desc=args.world, disable=None):
            folder = work / f"run_{number}"
            folder.mkdir()
            scans, perceived, ride, line = _one_run(scenario, args, number, urdf, folder)
            figures = measure(scans, perceived, perceived.spread_m)
            runs.append(with_ride(figures, ride))
            if number == 0:
                report.draw(scans)
            report.write(runs)
            tqdm.write(f"{number + 1} of {args.runs}: {line}", file=sys.stderr)
            shutil.rmtree(folder)
    except BaseException:
        drop_if_empty(report.output)
        where = f"what had ended by then is in {report.path}" if runs else "no run had ended"
        tqdm.write(f"{PROG}: {where}", file=sys.stderr)
        raise


def _judge(args: argparse.Namespace, command: str, work: Path) -> None:
    from ardee_navigation.evaluation import lane_figures
    from ardee_navigation.evaluation.real_run import read_real_run

    scenario = _scenario(args) if args.world else None
    if args.real_run:
        real_run = read_real_run(args.real_run)  # type: Any
        real = lane_figures.measure_real(real_run, str(args.real_run))
        own = {"real scans, this follower": lane_figures.measure_follower(real_run)}
    else:
        config = find_package("ardee_navigation") / "config"
        real_run, real, own = None, lane_figures.read_real_lane(config / "real_lane.yaml"), {}
    name = Path(args.world).stem if args.world else "real_run"
    usual = f"{name}_seeds_{args.seed}_to_{args.seed + args.runs - 1}" if args.world else name
    output = args.output or Path("lane_output") / usual
    make_folder(output)
    report = Report(command, name, real, {"real": real.figures, **own}, output)
    report.real_scans = real_run.scans if real_run else None
    if real_run:
        lane_figures.write_real_lane(real, output / "real_lane.yaml")
    if scenario:
        _drive_all(args, scenario, report, work)
    else:
        report.draw(None)
        report.write([])
    print(report.table, end="")
    print(report.path)


def main() -> int:
    """Runs the command; returns the exit code: 0 measured, 1 the simulator failed, 2 bad input."""
    try:
        args = _arguments(sys.argv[1:])
    except GeneratorError as error:
        print(f"{PROG}: {error}", file=sys.stderr)
        return 2
    command = " ".join(["rosrun ardee_navigation judge_lane", *sys.argv[1:]])
    return run(PROG, partial(_judge, args, command))
