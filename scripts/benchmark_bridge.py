# SPDX-License-Identifier: MIT
"""Latency and losses of the UDP bridge on loopback, as lines below the table."""
import json
import subprocess
from typing import Any, Dict, List

P99_BUDGET_MS = 2.0
# The floor, measured beside the bridge: it has no budget.
FLOOR = "bare forwarder"
# A simulated robot's frames are few where its cameras are to be drawn first.
LEAST_FRAMES_S = 8.0


def measure(seconds: float, loss_s: float) -> Dict[str, Any]:
    """What ardee_bridge's own benchmark measures in so many seconds: messages at full rates, a simulated robot's.

    And for `loss_s` those of all sensors at once, cameras and a 3D lidar among them, with the images as JPEG and as
    they are: is a message lost? Beside each of them the floor.
    """
    frames_s = max(3 * seconds, LEAST_FRAMES_S)
    figures = _run(seconds)
    runs = {
        "simulated ": (seconds, "--simulator"),
        "simulated beside JPEG images, ": (frames_s, "--simulator", "--cameras", "jpeg"),
        "simulated beside raw images, ": (frames_s, "--simulator", "--cameras", "raw"),
        "beside cameras, ": (loss_s, "--cameras", "jpeg"),
        "beside raw images, ": (loss_s, "--cameras", "raw"),
    }
    for prefix, (run_s, *options) in runs.items():
        found = _run(run_s, "--only", "sensors", *options)
        figures.update((prefix + name, f) for name, f in found.items())
    return figures


def _run(seconds: float, *options: str) -> Dict[str, Any]:
    command = ["rosrun", "ardee_bridge", "latency_benchmark", "--json", "--seconds", str(seconds)]
    command += options
    pipe = subprocess.PIPE
    with subprocess.Popen(command, stdout=pipe, stderr=pipe, text=True) as process:
        try:
            output, complaints = process.communicate()
        finally:
            process.terminate()  # when this program is ended: it then ends its nodes, and we wait for that
    if not output.startswith("{"):
        raise RuntimeError(
            f"latency_benchmark: exit code {process.returncode}: {complaints.strip()}"
        )
    return json.loads(output)


def lines(figures: Dict[str, Any]) -> List[str]:
    """One line a kind of message, with a mark where its budget is missed or a message lost."""
    found = []
    for name, f in figures.items():
        budget = "" if FLOOR in name else f" (<= {P99_BUDGET_MS:.2f})"
        missed = budget and not f["p99_ms"] <= P99_BUDGET_MS  # so is one of no message at all
        mark = " !" if f["lost"] or missed else ""
        found.append(
            f"bridge, {name}: median {f['p50_ms']:.2f} ms, 99th percentile {f['p99_ms']:.2f} ms{budget}, "
            f"most {f['max_ms']:.2f} ms, {f['lost']} of {f['sent']} lost{mark}"
        )
    return found
