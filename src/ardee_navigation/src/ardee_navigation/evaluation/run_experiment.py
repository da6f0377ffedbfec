# SPDX-License-Identifier: MIT
"""Command `run_experiment`: runs of a scenario, headless, in lockstep or with hardware in the loop, and a report."""
import argparse
import shutil
import sys
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, List, Optional

from tqdm import tqdm

from ardee_common.cli import Parser, whole_in
from ardee_common.errors import GeneratorError
from ardee_navigation.evaluation.command import LARGEST_SEED, drop_if_empty, make_folder, run
from ardee_navigation.evaluation.record import Record
from ardee_navigation.evaluation.scenario_files import Scenario, read_parameters
from ardee_navigation.evaluation.scenarios import known_scenarios, prepare


def _arguments(argv: List[str]) -> argparse.Namespace:
    names = sorted(known_scenarios())
    parser = Parser(
        prog="run_experiment",
        description="Let the row follower drive fields of a scenario and write a report; run r has the seed SEED + r.",
    )
    parser.add_argument(
        "--scenario",
        required=True,
        choices=names,
        metavar="NAME",
        help="name of the scenario: " + ", ".join(names),
    )
    parser.add_argument("--runs", type=whole_in(1, 10_000), default=10, help="number of runs")
    parser.add_argument(
        "--seed",
        type=whole_in(0, LARGEST_SEED),
        default=1,
        help="seed of the first run",
    )
    parser.add_argument(
        "--output",
        type=Path,
        help="folder of the report (default: experiment_output/NAME_seeds_FIRST_to_LAST)",
    )
    parser.add_argument(
        "--parameters",
        type=Path,
        help="YAML file of the row follower's parameters that differ from the scenario's",
    )
    parser.add_argument("--bot-model", default="tsv1_default.urdf.xacro", help="robot model file")
    parser.add_argument(
        "--hil",
        action="store_true",
        help="run in real time, with the row follower as a process without ROS that speaks only UDP",
    )
    args = parser.parse_args(argv)
    if args.seed + args.runs - 1 > LARGEST_SEED:
        parser.error(f"--seed and --runs: found a last seed above {LARGEST_SEED}, the largest")
    return args


def _one_run(
    scenario: Scenario, args: argparse.Namespace, number: int, urdf: str, work: Path
) -> Record:
    """Generates a field, starts the simulator, drives one run, ends the simulator."""
    from ardee_navigation.evaluation.trial import Judge

    seed = args.seed + number
    trial = prepare(scenario, seed, work / "models")
    judge = Judge(trial, args.scenario, number, seed, scenario.parameters.lidar_ahead_m)
    length_m = judge.record.length_m
    if args.hil:
        from ardee_navigation.evaluation.hil import drive
        from ardee_navigation.evaluation.ros_simulation import RosSimulation

        log = work / "simulator.log"
        simulation = RosSimulation(trial.world, seed, trial.models, log, realtime=True)  # type: Any
    else:
        from ardee_navigation.evaluation.lockstep import drive
        from ardee_navigation.evaluation.simulation import Simulation

        simulation = Simulation(trial.world, seed, trial.models)
    with simulation:
        simulation.spawn(urdf, trial.start, trial.height_m(trial.start))
        with tqdm(
            total=round(length_m, 1), unit="m", desc=f"run {number}", leave=False, disable=None
        ) as bar:

            def progress(along_m: float) -> None:
                bar.n = round(min(max(along_m, 0.0), length_m), 1)
                bar.update(0)

            return drive(simulation, trial, scenario.parameters, judge, progress)


def _scenario(args: argparse.Namespace) -> Scenario:
    """Returns the named scenario, with the parameters of the file over its own."""
    scenario = known_scenarios()[args.scenario]
    if not args.parameters:
        return scenario
    return replace(scenario, parameters=read_parameters(args.parameters, scenario.parameters))


def _experiment(args: argparse.Namespace, command: str, work: Path) -> None:
    from ardee_navigation.evaluation.experiment_report import (
        check_folder,
        in_short,
        table,
        write_report,
        write_run,
    )
    from ardee_navigation.evaluation.simulation import robot_urdf

    scenario = _scenario(args)
    seeds = range(args.seed, args.seed + args.runs)
    usual = f"{args.scenario}_seeds_{seeds[0]}_to_{seeds[-1]}"
    output = args.output or Path("experiment_output") / usual
    make_folder(output)
    check_folder(output, args.scenario, seeds)
    records: List[Record] = []
    report: Optional[Path] = None
    master: Any = None
    try:
        if args.hil:
            from ardee_navigation.evaluation.ros_simulation import Master

            master = Master("run_experiment")
        urdf = robot_urdf(args.bot_model)
        for number in tqdm(range(args.runs), unit="run", desc=args.scenario, disable=None):
            folder = work / f"run_{number}"
            folder.mkdir()
            records.append(_one_run(scenario, args, number, urdf, folder))
            write_run(records[-1], output)
            report = write_report(records, command, output)  # the runs so far survive a Ctrl-C
            if not sys.stderr.isatty():  # no bar there
                print(f"{number + 1} of {args.runs}: {in_short(records[-1])}", file=sys.stderr)
            shutil.rmtree(folder)
    except BaseException as error:
        drop_if_empty(output)
        if report:
            tqdm.write(f"run_experiment: what had ended by then is in {report}", file=sys.stderr)
        elif isinstance(error, SystemExit):
            tqdm.write("run_experiment: no run had ended, none is reported", file=sys.stderr)
        raise
    finally:
        if master:
            master.stop()
    print(table(records), end="")
    print(report)


def main() -> int:
    """Runs the command; returns the exit code: 0 all runs were driven, 1 the simulator failed, 2 bad input."""
    try:
        args = _arguments(sys.argv[1:])
    except GeneratorError as error:
        print(f"run_experiment: {error}", file=sys.stderr)
        return 2
    command = " ".join(["rosrun ardee_navigation run_experiment", *sys.argv[1:]])
    return run("run_experiment", partial(_experiment, args, command))
