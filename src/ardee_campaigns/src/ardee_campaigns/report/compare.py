# SPDX-License-Identifier: MIT
"""Command `compare`: compares the controllers, or the levels of another factor, of a campaign."""
import argparse
from pathlib import Path
from typing import Optional, Sequence

from ardee_common.cli import Parser, run
from ardee_common.errors import GeneratorError
from ardee_common.output import output_folder, write_file

PROG = "compare"


def _parser() -> Parser:
    parser = Parser(
        prog=PROG,
        description="Compare the runs of a campaign by a factor: runs that are alike in all else, of the same seed, are"
        " paired. Print mean differences with 95 %% intervals, and write them with a figure.",
    )
    parser.add_argument("campaign", type=Path, metavar="OUTPUT", help="folder of run_campaign")
    parser.add_argument(
        "--by",
        default="controller",
        metavar="FACTOR",
        help="controller, robot, world or a factor of the campaign's file",
    )
    parser.add_argument(
        "--base", metavar="LEVEL", help="with which the others are compared (default: the first)"
    )
    parser.add_argument(
        "--where",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="only runs of this world, robot, controller or factor; may be given again",
    )
    parser.add_argument(
        "--output",
        type=Path,
        help="folder of compare_FACTOR.md and .png (default: the campaign's)",
    )
    return parser


def _compare(args: argparse.Namespace) -> str:
    from ardee_campaigns.report import comparison, statistics
    from ardee_campaigns.report.page import Page
    from ardee_campaigns.report.runs import chosen, factor_named, read, short

    all_runs = chosen(read(args.campaign), args.where)
    factor, runs = factor_named(all_runs, args.by, "--by"), all_runs.ok()
    levels = runs.levels(factor)
    if len(levels) < 2:
        found = f"found {len(levels)} values in the {len(runs)} runs that did not fail"
        raise GeneratorError(f"--by {args.by}: {found}, expected 2 or more")
    if args.base and statistics.is_scale(runs, factor):
        found = f"found {args.base!r} for {short(factor)}, a scale"
        raise GeneratorError(f"--base: {found} with a slope instead of differences, expected none")
    base = comparison.base_level(runs, factor, args.base)
    name = f"compare_{short(factor)}"
    with output_folder(args.output or args.campaign) as folder:
        page = Page(f"{runs.name}: by {short(factor)}", folder)
        given = f" with {', '.join(args.where)}" if args.where else ""
        failed = len(all_runs) - len(runs)
        page.text(f"{len(runs)} runs{given}; {failed} that failed are left out.")
        comparison.compare(page, runs, factor, base, folder / f"{name}.png")
        comparison.rates(page, runs, factor)
        write_file(folder / f"{name}.md", page.markdown().encode())
    return f"{page.markdown()}\n{folder / name}.md"


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the command; returns the exit code, 2 for bad input, 130 for Ctrl-C."""
    return run(_parser(), _compare, arguments)
