# SPDX-License-Identifier: MIT
"""Latency and losses of the UDP bridge on loopback, as lines below the table."""
import json
import math
import pathlib
import statistics
import subprocess
from typing import Any, Callable, Dict, List, Sequence

PROGRAM = pathlib.Path(__file__).resolve().parents[1] / "tests" / "bench" / "latency_benchmark"
# Budgets of small sensors and commands, and of images and clouds.
P99_BUDGET_MS, FRAMES_P99_BUDGET_MS = 5.0, 20.0
# Rows of the floor, measured beside the bridge, have no budget.
FLOOR = "bare forwarder"
# Fewest frames of a simulated robot, whose cameras are rendered as well: 3 depth images a second on 2 cores.
LEAST_FRAMES_S = 8.0
# Figures of a row without any message, or missing in a repetition: such a camera was not there.
NOTHING = dict(p50_ms=math.nan, p99_ms=math.nan, max_ms=math.nan, sent=0, lost=0)


def measure(
    seconds: float, loss_s: float, repeat: int, say: Callable[[str], None]
) -> Dict[str, Any]:
    """Returns the figures of tests/bench/latency_benchmark, run for so many seconds.

    They are those of small messages at full rates, and of a simulated robot's. For `loss_s` all sensors send at once,
    with cameras and a 3D lidar, once with JPEG and once with raw images, to count lost messages. The floor is measured
    beside each of them. All is repeated `repeat` times. The simulated robot is left out if packets cannot be captured,
    which takes CAP_NET_RAW and CAP_NET_ADMIN.
    """
    frames_s = max(loss_s, LEAST_FRAMES_S)
    sensors = ("--only", "sensors")
    runs = {
        "": (seconds,),
        "simulated, ": (frames_s, *sensors, "--simulator", "--cameras"),
        "beside cameras, ": (loss_s, *sensors, "--cameras"),
        "beside raw images, ": (loss_s, *sensors, "--cameras", "raw"),
    }
    repetitions = []
    for number in range(1, repeat + 1):
        figures = {}  # type: Dict[str, Any]
        for prefix, (run_s, *options) in runs.items():
            say(f"bridge: {prefix}{run_s:g} s, {number} of {repeat}")
            try:
                found = _run(run_s, *options)
            except RuntimeError as error:
                if "packets cannot be captured" not in str(error):
                    raise
                say(f"bridge: left out: {error}")
                continue
            figures.update((prefix + name, f) for name, f in found.items())
        repetitions.append(figures)
    return medians(repetitions)


def medians(repetitions: Sequence[Dict[str, Any]]) -> Dict[str, Any]:
    """Returns medians of both percentiles, the 99th's range, the longest, and sums of sent and lost, by row."""
    figures = {}
    for name in dict.fromkeys(name for found in repetitions for name in found):
        runs = [found.get(name, NOTHING) for found in repetitions]
        columns = {figure: [run[figure] for run in runs] for figure in NOTHING}
        figures[name] = {
            "p50_ms": _or_nan(statistics.median, columns["p50_ms"]),
            "p99_ms": _or_nan(statistics.median, columns["p99_ms"]),
            "p99_range_ms": [_or_nan(choose, columns["p99_ms"]) for choose in (min, max)],
            "max_ms": _or_nan(max, columns["max_ms"]),
            "sent": sum(columns["sent"]),
            "lost": sum(columns["lost"]),
        }
    return figures


def _or_nan(choose: Callable[[List[float]], float], values: List[float]) -> float:
    """Returns NaN if one of the values is NaN."""
    return math.nan if any(map(math.isnan, values)) else choose(values)


def _run(seconds: float, *options: str) -> Dict[str, Any]:
    command = [str(PROGRAM), "--json", "--duration-s", str(seconds)]
    command += options
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True) as process:
        try:
            output, complaints = process.communicate()
        finally:
            process.terminate()  # a signal ends this program: it ends its nodes first
    if not output.startswith("{"):
        raise RuntimeError(
            f"latency_benchmark: exit code {process.returncode}: {complaints.strip()}"
        )
    return json.loads(output)


def lines(figures: Dict[str, Any]) -> List[str]:
    """Returns one line a kind of message, with a mark if its budget is missed or a message lost."""
    found = []
    for name, f in figures.items():
        least, most = (f"{value:.2f}" for value in f["p99_range_ms"])
        tails = "" if least == most else f" of {least} to {most}"
        is_frame = "image message" in name or "point_cloud message" in name
        budget_ms = FRAMES_P99_BUDGET_MS if is_frame else P99_BUDGET_MS
        budget = "" if FLOOR in name else f" (<= {budget_ms:.2f})"
        missed = budget and not f["p99_ms"] <= budget_ms  # marks a row without any message, too
        mark = " !" if f["lost"] or missed else ""
        found.append(
            f"bridge, {name}: median {f['p50_ms']:.2f} ms, 99th percentile {f['p99_ms']:.2f}{tails} ms{budget}, "
            f"most {f['max_ms']:.2f} ms, {f['lost']} of {f['sent']} lost{mark}"
        )
    return found
