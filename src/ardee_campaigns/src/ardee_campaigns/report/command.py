# SPDX-License-Identifier: MIT
"""Command `report`: writes a page of all runs of a campaign, in one file of HTML and as Markdown with its pictures."""
import argparse
import webbrowser
from pathlib import Path
from typing import Optional, Sequence

from ardee_common.cli import Parser, run, steps, whole_in
from ardee_common.errors import GeneratorError, known_names
from ardee_common.output import output_folder, write_file

PROG = "report"


def _parser() -> Parser:
    parser = Parser(
        prog=PROG,
        description="Write the report of a campaign: means with 95 %% intervals, distributions, effects of factors, the"
        " worst runs with pictures, and the failed ones.",
    )
    parser.add_argument("campaign", type=Path, metavar="OUTPUT", help="folder of run_campaign")
    parser.add_argument("--open", action="store_true", help="open the page in the browser")
    parser.add_argument(
        "--worst", type=whole_in(0, 100), default=3, help="number of worst runs that are shown"
    )
    parser.add_argument(
        "--worst-by",
        metavar="MEASURE",
        help="measure that says what is worst (default: interventions, then collisions, then lateral_rms_m, as far as"
        " they are measured)",
    )
    parser.add_argument(
        "--campaign",
        type=Path,
        metavar="FILE",
        dest="file",
        help="the campaign's file, if it was moved",
    )
    parser.add_argument(
        "--output",
        type=Path,
        help="folder of report.html, report.md and report_pictures (default: the campaign's)",
    )
    return parser


def _report(args: argparse.Namespace) -> Path:
    from ardee_campaigns.report.page import Page
    from ardee_campaigns.report.runs import read
    from ardee_campaigns.report.sections import Report

    runs = read(args.campaign)
    if args.worst_by and args.worst_by not in runs.measures:
        known = known_names(args.worst_by, runs.measures)
        raise GeneratorError(f"--worst-by: found {args.worst_by!r}, {known}")
    with output_folder(args.output or args.campaign) as folder:
        pictures = folder / "report_pictures"
        pictures.mkdir(exist_ok=True)
        report = Report(Page(f"Campaign {runs.name}", folder), args.campaign, pictures, runs)
        parts = {"overview": report.overview}
        if len(report.runs):
            parts["means"] = report.means
            parts["interquartile means"] = report.middle_halves
            parts["distributions"] = report.distributions
            parts["effects"] = report.effects
            parts["worst runs"] = lambda: report.drives(args.worst, args.worst_by, args.file)
        for part in steps(PROG, list(parts)):
            parts[part]()
        write_file(folder / "report.md", report.page.markdown().encode())
        page = folder / "report.html"
        write_file(page, report.page.html().encode())
    if args.open:
        webbrowser.open(page.resolve().as_uri())
    return page


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the command; returns the exit code, 2 for bad input, 130 for Ctrl-C."""
    return run(_parser(), _report, arguments)
