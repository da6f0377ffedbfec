# SPDX-License-Identifier: MIT
"""Command `overlay`: lays the scans of a real run over those of simulated ones, as a controller perceives them."""
import argparse
import csv
import io
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence

import yaml

from ardee_common.cli import Parser, number_in, run, say, steps, whole_in
from ardee_common.errors import GeneratorError
from ardee_common.output import output_folder, write_file

PROG = "overlay"
TOPIC = "/scan"
FOLLOWER = "ardee_navigation.control:make"


def _runs_arguments(parser: Parser) -> None:
    parser.add_argument(
        "--runs",
        type=whole_in(1, 1000),
        help="of the campaign, the first ones that did not fail (default: 3)",
    )
    parser.add_argument(
        "--run",
        action="append",
        default=[],
        metavar="RUN_ID",
        help="run of the campaign, instead of the first ones; may be given again",
    )
    parser.add_argument(
        "--where",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="only runs of this world, robot, controller or factor; may be given again",
    )


def _parser() -> Parser:
    parser = Parser(
        prog=PROG,
        description="Show the scans of a real run and of simulated ones to a controller that only looks; write a page"
        " of raw and perceived distances and of distributions, real beside simulated, and how far they are apart.",
    )
    parser.add_argument(
        "simulated",
        type=Path,
        metavar="OUTPUT",
        help="a campaign's folder, some of whose runs are done again; or a recorded run, as --real",
    )
    parser.add_argument(
        "--real",
        type=Path,
        required=True,
        metavar="RUN",
        help="rosbag, CSV file as lidar_log.csv, or folder of one: a scan a line, the time [ms], then ranges [mm]",
    )
    parser.add_argument("--topic", help=f"of the scans in a rosbag (default: {TOPIC})")
    _runs_arguments(parser)
    parser.add_argument(
        "--factory", default=FOLLOWER, metavar="MODULE:FUNCTION", help="makes the controller"
    )
    parser.add_argument(
        "--param",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        help="parameter of the controller on both sides; may be given again",
    )
    parser.add_argument(
        "--lidar-ahead-m",
        type=number_in(-10.0, 10.0),
        default=0.22,
        help="place of the lidar before the robot's middle",
    )
    parser.add_argument(
        "--campaign", type=Path, metavar="FILE", help="the campaign's file, if it was moved"
    )
    parser.add_argument(
        "--output",
        type=Path,
        help="folder of overlay.html, overlay.md, overlay.csv and pictures (default: overlay in a campaign's folder,"
        " else overlay_output)",
    )
    return parser


def _params(texts: Sequence[str]) -> Dict[str, Any]:
    """Returns the parameters; their values are read as YAML."""
    found = {}
    for text in texts:
        name, is_there, value = text.partition("=")
        try:
            found[name] = yaml.safe_load(value)
        except yaml.YAMLError:
            is_there = ""
        if not is_there:
            raise GeneratorError(f"--param: found {text!r}, expected NAME=VALUE")
    return found


def _refuse_unused(args: argparse.Namespace, is_campaign: bool) -> None:
    """Raises GeneratorError for an argument that would have no effect."""
    for name in () if is_campaign else ("runs", "run", "where", "campaign"):
        if getattr(args, name):
            raise GeneratorError(
                f"--{name}: found it with {args.simulated}, which is no campaign's folder"
            )
    if args.runs and args.run:
        raise GeneratorError("--runs: found it with --run, expected one of them")
    recorded = [args.real] if is_campaign else [args.real, args.simulated]
    if args.topic and not any(path.suffix == ".bag" for path in recorded):
        raise GeneratorError(f"--topic: found {args.topic!r} without a .bag file, expected one")


def _run_ids(args: argparse.Namespace) -> List[str]:
    from ardee_campaigns.report.runs import chosen, read

    runs = chosen(read(args.simulated), args.where).ok()
    there = runs["run_id"].tolist()
    for run_id in args.run:
        if run_id not in there:
            raise GeneratorError(f"--run: found {run_id!r}, expected a run that did not fail")
    if not there:
        raise GeneratorError(f"{args.simulated}: found no run that did not fail, expected one")
    return args.run or there[: args.runs or 3]


def _table(lines: Sequence[Any]) -> List[List[str]]:
    """Returns the rows of the page's table."""
    from ardee_campaigns.report.page import number

    rows = []
    for line in lines:
        one = line.quantity

        def shown(value: float) -> str:
            return number(one.scale * value, one.digits)

        spread = [_middle(values, shown) for values in (line.real, line.simulated)]
        each = [run.wasserstein for run in line.each]
        span = f"{shown(min(each))} to {shown(max(each))}" if len(each) > 1 else ""
        apart = [shown(line.distance.wasserstein), span, shown(line.halves.wasserstein)]
        shares = [number(share.ks, 3) for share in (line.distance, line.halves)]
        rows.append([one.text, *spread, *apart, *shares])
    return rows


def _middle(values: Any, shown: Any) -> str:
    """Returns median and 5th to 95th percentile."""
    import numpy as np

    if not len(values):
        return "-"
    low, middle, high = np.quantile(values, (0.05, 0.5, 0.95))
    return f"{shown(middle)} ({shown(low)} to {shown(high)})"


HEADS = (
    "",
    "real: median (5 to 95 %)",
    "simulated",
    "Wasserstein distance",
    "of each run",
    "real run's halves",
    "KS distance",
    "real run's halves",
)
NOTES = (
    "Wasserstein: how far a value must be moved on average to turn one distribution into the other, in the line's"
    " unit. KS (Kolmogorov and Smirnov): the largest difference of the two cumulative shares, 0 to 1. The same"
    " distances between the first and the second half of the real run are the measure of likeness: a simulated run can"
    " hardly be nearer to a real one than two parts of one field are to each other. Neighbouring scans see the same"
    " plants, so no p-value is given."
)


def _csv(lines: Sequence[Any], names: Sequence[str]) -> bytes:
    """Returns the table in SI units, with a row for each simulated run and one for all."""
    import numpy as np

    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    heads = ["quantity", "run", "real_median", "run_median", "wasserstein", "ks"]
    writer.writerow([*heads, "wasserstein_of_real_halves", "ks_of_real_halves"])
    for line in lines:
        medians = [f"{np.median(v):.6g}" if len(v) else "" for v in (line.real, line.simulated)]
        halves = [f"{value:.6g}" for value in line.halves]
        whole = [f"{value:.6g}" for value in line.distance]
        writer.writerow([line.quantity.name, "all", *medians, *whole, *halves])
        for name, found in zip(names, line.each):
            values = [f"{value:.6g}" for value in found]
            writer.writerow([line.quantity.name, name, medians[0], "", *values, *halves])
    return text.getvalue().encode()


def _overlay(args: argparse.Namespace) -> Path:
    import numpy as np

    from ardee_campaigns.controllers import load_function
    from ardee_campaigns.overlay import look, sources

    make, params = load_function(args.factory, "--factory"), _params(args.param)
    is_campaign = sources.is_campaign(args.simulated)
    _refuse_unused(args, is_campaign)
    topic = args.topic or TOPIC
    real_scans = sources.read_recorded(args.real, topic)
    if is_campaign:
        scans = sources.rerun(args.simulated, _run_ids(args), args.campaign, PROG)
    else:
        scans = [(args.simulated.stem, sources.read_recorded(args.simulated, topic))]
    looked = []
    for name, one in steps(PROG, [(f"real: {args.real.name}", real_scans), *scans]):
        looked.append(look.look(name, one, make, params, args.lidar_ahead_m))
    real, *runs = looked
    if not any(np.isfinite(one.left_m).any() for one in looked):
        say(PROG, f"{args.factory} says of no scan how far the rows are: it has no `seen`")
    lines = look.compare(real, runs)
    usual = args.simulated / PROG if is_campaign else Path("overlay_output")
    with output_folder(args.output or usual) as folder:
        return _write(folder, args, real, runs, lines)


def _write(
    folder: Path, args: argparse.Namespace, real: Any, runs: Sequence[Any], lines: Sequence[Any]
) -> Path:
    from ardee_campaigns.lane import lane_picture
    from ardee_campaigns.overlay import figures
    from ardee_campaigns.report.page import Page

    figures.distances(folder / "distances.png", real, runs[0])
    figures.distributions(folder / "distributions.png", lines)
    lane_picture.draw(folder / "lane.png", None, real.scans, runs[0].scans, "simulated")
    page = Page("Real beside simulated", folder)
    names = ", ".join(run.name for run in runs)
    counts = [len(real.time_s), sum(len(run.time_s) for run in runs)]
    given = "".join(f", {text}" for text in args.param)
    page.text(
        f"Real: {args.real}, {counts[0]} scans. Simulated: {args.simulated}, {len(runs)} runs ({names}), {counts[1]}"
        f" scans in the lane. Perceived by {args.factory}{given}."
    )
    page.heading("Raw and perceived distances")
    page.picture(folder / "distances.png", "Returns abeam of the lidar, and the rows in use")
    page.heading("Distributions")
    page.picture(folder / "distributions.png", "Share of the values that are at most so large")
    rows = _table(lines)
    page.table(HEADS, rows)
    page.text(NOTES)
    page.heading("Scans")
    page.picture(folder / "lane.png", "One scan of each from above, and range by bearing")
    write_file(folder / "overlay.csv", _csv(lines, [run.name for run in runs]))
    write_file(folder / "overlay.md", page.markdown().encode())
    write_file(folder / "overlay.html", page.html().encode())
    for row in rows:
        say(PROG, f"{row[0]}: real {row[1]}, simulated {row[2]}, Wasserstein {row[3]}, KS {row[6]}")
    return folder / "overlay.html"


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs the command; returns the exit code, 2 for bad input, 130 for Ctrl-C."""
    return run(_parser(), _overlay, arguments)
