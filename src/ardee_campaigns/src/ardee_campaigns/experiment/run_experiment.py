# SPDX-License-Identifier: MIT
"""Command `run_experiment`: a campaign of the row follower in one scenario, over seeds that follow each other."""
import argparse
import shutil
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence

import yaml

from ardee_campaigns import tables
from ardee_campaigns.campaign_file import Campaign
from ardee_campaigns.experiment import scenarios
from ardee_campaigns.experiment.report import CAMPAIGN, MEASURES, Report, in_short
from ardee_campaigns.plan import Job
from ardee_campaigns.replay import note_file
from ardee_campaigns.run_campaign import Session, exit_code
from ardee_common.cli import Parser, say, seconds_shown
from ardee_common.errors import GeneratorError
from ardee_common.output import locked, output_folder, remove_stale, write_file
from ardee_common.process import Ended
from ardee_navigation.evaluation.scenario_files import Scenario
from ardee_navigation.evaluation.scenarios import known_scenarios

PROG = "run_experiment"
_PARAMETERS = "parameters.yaml"  # of the program over UDP
_HIL = ("rosrun", "ardee_navigation", "hil_row_follower", "--log", "-")


def _parser() -> Parser:
    names = sorted(known_scenarios())
    parser = Parser(
        prog=PROG,
        description="Let the row follower drive fields of a scenario and write a report; run r has the seed SEED + r."
        " Ctrl-C ends it; the same command goes on.",
    )
    parser.add_argument(
        "--scenario",
        required=True,
        choices=names,
        metavar="NAME",
        help="name of the scenario: " + ", ".join(names),
    )
    scenarios.add_arguments(parser)
    parser.add_argument(
        "--output",
        type=Path,
        help="folder of the report (default: experiment_output/NAME_seeds_FIRST_to_LAST)",
    )
    parser.add_argument(
        "--hil",
        action="store_true",
        help="run in real time, with the row follower as a process without ROS that speaks only UDP",
    )
    return parser


def check_folder(output: Path, scenario: str, seeds: Sequence[int]) -> None:
    """Raises GeneratorError if a folder holds a report that an experiment over these seeds would erase."""
    folder = output / CAMPAIGN
    if not (output / "report.md").is_file() and not folder.is_dir():
        return
    rows = [tables.read_run_head(folder, run_id).row for run_id in tables.finished(folder)]
    others = [row for row in rows if row.world != scenario or row.seed not in seeds]
    if others or not folder.is_dir():
        of = f"of {others[0].world}, seed {others[0].seed}" if others else "without its campaign"
        raise GeneratorError(
            f"{output}: found the report of an experiment {of}, which would be erased;"
            " expected an empty folder, or a report of the same scenario and no other seeds"
        )


def check_runs(folder: Path, jobs: Sequence[Job]) -> None:
    """Raises GeneratorError if a campaign's folder holds a finished run that is none of the jobs."""
    ours = {job.run_id for job in jobs}
    others = (tables.read_run_head(folder, run_id) for run_id in tables.finished(folder))
    if any(head.row.status == tables.OK and head.row.run_id not in ours for head in others):
        found = "found finished runs of another first seed, parameters, robot, program or build"
        raise GeneratorError(
            f"{folder.parent}: {found}, which would be erased; expected another --output"
        )


def _session(folder: Path, args: argparse.Namespace, scenario: Scenario) -> Session:
    """Returns the session of an experiment, whose file is written; that of another one stays as it was."""
    files = [folder / scenarios.FILE, folder / _PARAMETERS]
    before = {file: file.read_bytes() for file in files if file.is_file()}
    try:
        session = Session(_write_campaign(folder, args, scenario), folder)
        check_runs(folder, session.jobs(args.runs))
    except BaseException:
        for file, content in before.items():
            write_file(file, content)
        raise
    return session


def _write_campaign(folder: Path, args: argparse.Namespace, scenario: Scenario) -> Campaign:
    keys: Dict[str, Any] = {"measures": list(MEASURES)}
    if args.hil:  # in real time: a run beside another would take its time
        parameters = folder / _PARAMETERS
        values = asdict(scenarios.parameters_of(args, scenario))
        write_file(parameters, yaml.safe_dump(values).encode())
        places = [f"--{name}={{{name}}}" for name in ("bind", "sensors", "controls")]
        words = [*_HIL, "--parameters", str(parameters), *places]
        keys.update(workers=1, controller={"kind": "udp", "command": words})
    return scenarios.write_campaign(folder, args.scenario, scenario, args, **keys)


def _drive(session: Session, jobs: List[Job], report: Report) -> None:
    """Does the runs that are not done yet, and those that failed; the report has each one that has ended."""
    from ardee_campaigns.workers import Workers, collect

    folder, numbers = session.folder, {job.run_id: job.replicate for job in jobs}
    for run_id in tables.finished(folder):
        row = tables.read_run_head(folder, run_id).row
        if run_id not in numbers or row.status == tables.FAILED:
            tables.run_path(folder, run_id).unlink()
    left = session.open(jobs)
    done = set(numbers) - {job.run_id for job in left}
    report.begin([numbers[run_id] for run_id in done])
    if done:
        say(PROG, f"{len(done)} of {len(jobs)} runs are done already")
    for run_id in done:
        report.add(numbers[run_id], tables.read_run(folder, run_id))

    def told(job: Job, _error: str) -> None:
        run = tables.read_run(folder, job.run_id)
        report.add(job.replicate, run)
        done.add(job.run_id)
        say(PROG, f"{len(report)} of {len(jobs)}: {in_short(run)}")

    session.write_robots(left)
    try:
        with Workers(folder, None, session.campaign.keys.workers) as workers:
            workers.work_off(left, told)
    except Ended:  # workers finish their runs, so some may have ended since
        for run_id in set(tables.finished(folder)) & set(numbers) - done:
            report.add(numbers[run_id], tables.read_run(folder, run_id))
        raise
    finally:
        collect(folder, jobs, session.schema())


def _experiment(args: argparse.Namespace, command: str) -> int:
    scenario = known_scenarios()[args.scenario]
    seeds = range(args.seed, args.seed + args.runs)
    usual = f"{args.scenario}_seeds_{seeds[0]}_to_{seeds[-1]}"
    output = (args.output or Path("experiment_output") / usual).absolute()
    report = Report(output, f"Row following: {args.scenario}", command)
    with output_folder(output), locked(output):
        check_folder(output, args.scenario, seeds)
        remove_stale(output)
        folder = output / CAMPAIGN
        (folder / tables.FOLDER).mkdir(parents=True, exist_ok=True)
        try:
            session = _session(folder, args, scenario)
            note_file(folder, session.campaign.file)
            with seconds_shown(PROG):
                _drive(session, session.jobs(args.runs), report)
        except BaseException as error:
            said = f"what had ended by then is in {report.path}; the same command goes on"
            if not len(report):
                said = "no run had ended, none is reported"
                if not tables.finished(folder):
                    shutil.rmtree(folder)
            if len(report) or isinstance(error, Ended):
                say(PROG, said)
            raise
    print(report.table(), end="")
    print(report.path)
    return int(report.has_failed)


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Runs the command; returns the exit code: 0 all runs were driven, 1 one failed, else as exit_code()."""
    words = sys.argv[1:] if argv is None else argv
    args = scenarios.parse(_parser(), words)
    command = " ".join(["rosrun ardee_navigation run_experiment", *words])
    return exit_code(PROG, lambda: _experiment(args, command))
