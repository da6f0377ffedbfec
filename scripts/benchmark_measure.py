# SPDX-License-Identifier: MIT
"""Measures programs of the engine alone, and the node with ROS around it."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import time
from typing import Any, Callable, Dict, List

from benchmark_field import Field

from ardee_common.ros_graph import Process, RosGraph, wait_until

PROBE = pathlib.Path(__file__).with_name("benchmark_probe.py")
PACKAGE = "ardee_sim_cpp"
START_LIMIT_S = 120.0
DRIVE_LIMIT_S = 300.0
BRIEF = {
    "simulation_bench": ("--duration-s", "0.5"),
    "lidar_bench": ("--scans", "20", "--rounds", "2"),
    "camera_bench": ("--duration-s", "0.2", "--rounds", "1"),
}


def program(name: str) -> str:
    """Path of a program of the simulator's package, as rosrun finds it."""
    for prefix in os.environ.get("CMAKE_PREFIX_PATH", "").split(os.pathsep):
        path = pathlib.Path(prefix, "lib", PACKAGE, name)
        if path.is_file():
            return str(path)
    raise RuntimeError(f"{name}: not found below CMAKE_PREFIX_PATH; build with ARDEE_BENCH=ON")


def make_urdf(folder: pathlib.Path) -> pathlib.Path:
    """Expands the default robot with xacro."""
    package = subprocess.check_output(["rospack", "find", "terrasentia_description"], text=True)
    source = pathlib.Path(package.strip(), "robots", "tsv1_default.urdf.xacro")
    text = subprocess.check_output(["rosrun", "xacro", "xacro", str(source)], text=True)
    path = folder / "robot.urdf"
    path.write_text(text)
    return path


def run_engine(name: str, field: Field, urdf: pathlib.Path, brief: bool) -> Dict[str, Any]:
    """Runs simulation_bench, lidar_bench or camera_bench; returns its output."""
    command = [program(name), "--world", str(field.world), "--robot", str(urdf)]
    command += ["--pose", " ".join(map(str, field.start)), "--lane-m", str(field.lane_m)]
    command += BRIEF[name] if brief else ()
    done = subprocess.run(
        command, env=field.env, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    if done.returncode != 0:
        raise RuntimeError(f"{name}: exit code {done.returncode}: {done.stderr.strip()}")
    return json.loads(done.stdout)


def peak_memory_mb(pid: int) -> float:
    """Returns the greatest memory that a process has held so far [MB of 10^6 bytes]."""
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    found = re.search(r"VmHWM:\s+(\d+) kB", status)
    if not found:
        raise RuntimeError("the simulator has ended")
    return int(found.group(1)) * 1024 / 1e6


def _answer(probe: Process, simulator: Process, key: str, limit_s: float) -> Any:
    """Waits for an answer of the probe."""

    def look() -> Any:
        for line in probe.output().splitlines():
            if line.startswith("{") and key in json.loads(line):
                return [json.loads(line)[key]]
        for process in (probe, simulator):
            if process.exit_code() is not None:
                raise RuntimeError(f"{process.command[0]} has ended:\n{process.output()[-2000:]}")
        return None

    return wait_until(look, f"the benchmark's node to say {key}", limit_s)[0]


class _NotYet:
    """Stand-in for the simulator while only the probe runs."""

    command = ["simulator"]

    @staticmethod
    def exit_code() -> None:
        """Returns None: the stand-in never ends."""


def run_node(field: Field, urdf: pathlib.Path, window_s: float) -> Dict[str, Any]:
    """Starts the simulator in a ROS graph; measures the first scan's time, then a drive of `window_s` (0: none)."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="ros_", dir=field.world.parent))
    graph = RosGraph(folder)
    try:
        graph.env.update(GAZEBO_MODEL_PATH=field.env["GAZEBO_MODEL_PATH"])
        graph.run("rosparam", "set", "/use_sim_time", "true")
        pid_file = folder / "simulator.pid"
        words = ["--urdf", str(urdf), "--lane-m", str(field.lane_m), "--window-s", str(window_s)]
        words += ["--start", *(str(value) for value in field.start), "--pid-file", str(pid_file)]
        probe = graph.spawn("/usr/bin/python3", str(PROBE), *words)
        _answer(probe, _NotYet, "ready", START_LIMIT_S)
        settings = [f"_world:={field.world}", "_real_time_factor:=0.0", "_paused:=false"]
        started = time.monotonic()
        simulator = graph.spawn(program("simulator"), "__name:=gazebo", *settings)
        pid_file.write_text(str(simulator.pid))
        first_scan = _answer(probe, simulator, "first_scan_s", START_LIMIT_S)
        result = {"start_s": first_scan - started, "start_memory_mb": peak_memory_mb(simulator.pid)}
        if window_s > 0.0:
            result.update(_answer(probe, simulator, "drive", DRIVE_LIMIT_S))
            result["memory_mb"] = peak_memory_mb(simulator.pid)
        return result
    finally:
        graph.close()
        shutil.rmtree(folder, ignore_errors=True)


def measure(
    field: Field,
    urdf: pathlib.Path,
    only: List[str],
    window_s: float,
    brief: bool,
    say: Callable[[str], None],
) -> Dict[str, Any]:
    """Runs one repetition of the requested measurements on one field."""
    result = {}  # type: Dict[str, Any]
    if "physics" in only or "lidar" in only:
        say("engine")
        result["engine"] = run_engine("simulation_bench", field, urdf, brief)
    if "lidar" in only:
        say("rays")
        result["lidar"] = run_engine("lidar_bench", field, urdf, brief)
    if "camera" in only:
        say("cameras")
        result["camera"] = run_engine("camera_bench", field, urdf, brief)
    if "start" in only or "rtf" in only:
        say("node")
        result["node"] = run_node(field, urdf, window_s if "rtf" in only else 0.0)
    return result
