# SPDX-License-Identifier: MIT
"""Command `compare_experiments`: compares the runs of two experiments over the same seeds."""
import argparse
from pathlib import Path
from typing import Optional, Sequence

from ardee_common.cli import Parser, run


def _compare(args: argparse.Namespace) -> str:
    from ardee_campaigns.experiment.pairs import compare
    from ardee_campaigns.experiment.report import CAMPAIGN
    from ardee_campaigns.report.runs import read

    runs = [read(folder / CAMPAIGN).ok() for folder in (args.one, args.other)]
    return compare(*runs, (str(args.one), str(args.other)))


def main(argv: Optional[Sequence[str]] = None) -> int:
    """Runs the command; returns the exit code, 2 for bad input."""
    parser = Parser(
        prog="compare_experiments",
        description="Pair the runs of two experiments by seed; print mean differences with 95 %% intervals.",
    )
    parser.add_argument(
        "one", type=Path, metavar="ONE", help="folder of a report of run_experiment"
    )
    parser.add_argument(
        "other",
        type=Path,
        metavar="OTHER",
        help="folder of the other report; differences are OTHER - ONE",
    )
    return run(parser, _compare, argv)
