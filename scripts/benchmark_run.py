# SPDX-License-Identifier: MIT
"""Runs scripts/benchmark in a workspace that is built and sourced."""
import argparse
import json
import pathlib
import shutil
import sys
import tempfile
from typing import Any, Dict, List

import benchmark_bridge
import benchmark_field
import benchmark_measure
import benchmark_python
import benchmark_table

from ardee_common.cli import Parser, number_in, whole_in
from ardee_common.process import end_by_signals, ignore_end_signals

ROOT = pathlib.Path(__file__).resolve().parents[1]
FARM_WORLD = ROOT / "src" / "ardee_world" / "worlds" / "farm.world"
KINDS = ("start", "physics", "lidar", "camera", "rtf", "bridge", "python")
SIZES = [200, 2_000, 20_000, 200_000]


def say(text: str) -> None:
    """Prints a line of progress."""
    print(f"   {text}", file=sys.stderr, flush=True)


def kinds(text: str) -> List[str]:
    """Parses a list with commas, as an argparse type."""
    found = text.split(",")
    unknown = [kind for kind in found if kind not in KINDS]
    if unknown:
        raise argparse.ArgumentTypeError(
            f"found {unknown[0]!r}, expected some of {','.join(KINDS)}"
        )
    return found


def options() -> argparse.Namespace:
    """Returns the parsed command line of scripts/benchmark."""
    parser = Parser(prog="scripts/benchmark")
    parser.add_argument("--plants", type=whole_in(1), nargs="+", default=SIZES)
    parser.add_argument("--only", type=kinds, default=list(KINDS))
    parser.add_argument("--repeat", type=whole_in(1), default=3)
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument(
        "--window-s",
        type=number_in(0.5, 100.0),
        default=8.0,
        help="wall time of a drive with ROS [s]",
    )
    parser.add_argument(
        "--loss-s",
        type=number_in(0.5, 86400.0),
        default=60.0,
        help="duration of the bridge's measurement beside cameras [s]",
    )
    parser.add_argument(
        "--brief",
        action="store_true",
        help="short run that only shows that every measurement works",
    )
    found = parser.parse_args()
    if found.json and not found.json.resolve().parent.is_dir():
        parser.error(f"--json: the folder of {found.json} does not exist")
    return found


def measure_all(
    found: argparse.Namespace, work: pathlib.Path, urdf: pathlib.Path
) -> Dict[int, Dict[str, Any]]:
    """Measures every size in every repetition; returns medians by number of plants."""
    results = {}  # type: Dict[int, Dict[str, Any]]
    for size in sorted(set(found.plants)):
        say(f"{size} plants: generate")
        folder = work / f"plants_{size}"
        field = benchmark_field.generate(size, folder, FARM_WORLD)
        repetitions = []
        for number in range(1, found.repeat + 1):
            repetitions.append(
                benchmark_measure.measure(
                    field,
                    urdf,
                    found.only,
                    found.window_s,
                    found.brief,
                    lambda what: say(f"{field.plants} plants: {what}, {number} of {found.repeat}"),
                )
            )
        results[field.plants] = benchmark_table.derive(benchmark_table.medians(repetitions))
        shutil.rmtree(folder)
    return results


def main() -> int:
    """Runs the benchmark; returns its exit code; a missed budget is not a failure."""
    found = options()
    end_by_signals()
    work = pathlib.Path(tempfile.mkdtemp(prefix="ardee_benchmark_"))
    try:
        about = benchmark_table.machine()
        urdf = benchmark_measure.make_urdf(work)
        has_sizes = not set(found.only) <= {"bridge", "python"}
        results = measure_all(found, work, urdf) if has_sizes else {}
        python = {}  # type: Dict[str, float]
        if "python" in found.only:
            python = benchmark_python.measure(found.brief, found.repeat, urdf, say)
        bridge = {}  # type: Dict[str, Any]
        if "bridge" in found.only:
            bridge = benchmark_bridge.measure(found.window_s, found.loss_s, found.repeat, say)
        print(benchmark_table.header(about, found.repeat))
        if results:
            print(benchmark_table.table(results))
        lines = benchmark_python.lines(python) + benchmark_bridge.lines(bridge)
        print("\n".join(lines))
        if found.json:
            figures = {
                "machine": about,
                "repeat": found.repeat,
                "plants": results,
                "python": python,
                "bridge": bridge,
            }
            found.json.write_text(json.dumps(figures, indent=2) + "\n")
        return 0
    except (RuntimeError, TimeoutError, OSError) as error:
        print(f"scripts/benchmark: {error}", file=sys.stderr)
        return 1
    finally:
        ignore_end_signals()
        shutil.rmtree(work, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
