# SPDX-License-Identifier: MIT
"""Command `compare_experiments`: compares the runs of two experiments over the same seeds."""
import argparse
from pathlib import Path

from ardee_common.cli import Parser, run
from ardee_navigation.evaluation.comparison import compare, read_runs


def _compare(args: argparse.Namespace) -> str:
    return compare(read_runs(args.one), read_runs(args.other), (str(args.one), str(args.other)))


def main() -> int:
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
    return run(parser, _compare)
