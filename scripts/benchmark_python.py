# SPDX-License-Identifier: MIT
"""Steps and resets of the Gymnasium environments, and the cost of stepping from Python, as lines below the table."""
import json
import pathlib
import statistics
import subprocess
import time
from typing import Callable, Dict, List

import ardee_sim.envs
import benchmark_measure
import gymnasium
import numpy as np

AHEAD = np.array([0.6, 0.0], dtype=np.float32)
# So slow that no episode ends: when one resets, all environments wait.
CREEP = np.array([0.05, 0.0], dtype=np.float32)
SPEED_M_S = 0.5
SCANS = "ardee/hokuyo"
SCAN_S = 0.025  # the lidar's period; simulation_bench commands after every other
# Figures by name: line, format, budget, whether the budget is the least value.
ROWS = {
    "steps_per_s": ("RowFollow-v0, a scan of 1081 beams a step [steps/s]", "{:.0f}", 400.0, True),
    "workers_ratio": ("RowFollow-v0, two workers / one [wall time]", "{:.2f}", 1.8, True),
    "camera_steps_per_s": ("RowFollowCamera-v0, 320x224 rgb [steps/s]", "{:.0f}", 30.0, True),
    "reset_ms": ("reset, the same field [ms]", "{:.1f}", 20.0, False),
    "sow_s": ("reset, field of 200 plants sown anew [s]", "{:.2f}", 1.0, False),
    "overhead_percent": (
        "a drive with scans, more than the engine's own in C++ [%]",
        "{:.1f}",
        5.0,
        False,
    ),
}


def measure(
    brief: bool, repeat: int, urdf: pathlib.Path, say: Callable[[str], None]
) -> Dict[str, float]:
    """Returns the medians of ROWS' figures; all but the workers' ratio are in the process' own processor time."""
    runs: List[Dict[str, float]] = []
    for number in range(1, repeat + 1):
        say(f"python: {number} of {repeat}")
        run = _environments(60 if brief else 600)
        run["workers_ratio"] = _workers_ratio(20 if brief else 400)
        run["overhead_percent"] = _overhead_percent(urdf, 0.5 if brief else 5.0)
        runs.append(run)
    return {name: statistics.median(run[name] for run in runs) for name in ROWS}


def _median_reset_s(env: gymnasium.Env, count: int) -> float:
    times_s = []
    for seed in range(count):
        begin_s = time.process_time()
        env.reset(seed=seed)
        times_s.append(time.process_time() - begin_s)
    return statistics.median(times_s)


def _steps_per_s(env: gymnasium.Env, steps: int) -> float:
    """Returns the speed of steps alone; an episode that ends is begun anew."""
    env.reset(seed=0)
    spent_s = 0.0
    for number in range(steps):
        begin_s = time.process_time()
        _, _, terminated, truncated, _ = env.step(AHEAD)
        spent_s += time.process_time() - begin_s
        if terminated or truncated:
            env.reset(seed=number)
    return steps / spent_s


def _environments(steps: int) -> Dict[str, float]:
    found = {}
    with gymnasium.make("ardee/RowFollow-v0", seed_field=False) as env:
        found["steps_per_s"] = _steps_per_s(env, steps)
        found["reset_ms"] = 1e3 * _median_reset_s(env, 9)
    with gymnasium.make("ardee/RowFollow-v0", randomise={"emergence": (0.94, 0.96)}) as env:
        found["sow_s"] = _median_reset_s(env, 3)
    with gymnasium.make("ardee/RowFollowCamera-v0", seed_field=False) as env:
        found["camera_steps_per_s"] = _steps_per_s(env, max(steps // 6, 10))
    return found


def _workers_ratio(steps: int) -> float:
    """Returns how many more steps a second two workers take than one."""
    speeds = []
    for workers in (1, 2):
        envs = gymnasium.make_vec("ardee/RowFollow-v0", num_envs=workers, seed_field=False)
        try:
            envs.reset(seed=0)
            begin_s = time.monotonic()
            for _ in range(steps):
                envs.step(np.tile(CREEP, (workers, 1)))
            speeds.append(workers * steps / (time.monotonic() - begin_s))
        finally:
            envs.close()
    return speeds[1] / speeds[0]


def _overhead_percent(urdf: pathlib.Path, drive_s: float) -> float:
    """Returns by how much a drive with a lidar takes longer from Python than in simulation_bench, which is C++."""
    world = ardee_sim.World.from_file("corn.world")
    (x, y, z), yaw = world.start["xyz_m"], world.start["rpy_rad"][2]
    command = [benchmark_measure.program("simulation_bench"), "--world", world.path]
    command += ["--robot", str(urdf), "--pose", f"{x} {y} {z} {yaw}", "--duration-s", str(drive_s)]
    done = subprocess.run([*command, "--threads", "1"], stdout=subprocess.PIPE, check=True)
    engine_s = json.loads(done.stdout)["lidars"]["cpu_s_per_simulated_s"] * drive_s
    with ardee_sim.Simulation(world) as sim:
        sim.spawn("robot", urdf, **world.start)
        _drive(sim, 1.0, 0.0)
        _drive(sim, drive_s, SPEED_M_S)
        sim.demand(SCANS)
        _drive(sim, SCAN_S, SPEED_M_S)  # the first scan makes the scene
        begin_s = time.process_time()
        _drive(sim, drive_s, SPEED_M_S, is_measured=True)
        return 100.0 * ((time.process_time() - begin_s) / engine_s - 1.0)


def _drive(
    sim: ardee_sim.Simulation, drive_s: float, speed_m_s: float, is_measured: bool = False
) -> None:
    """Steps from scan to scan, takes each, and commands after every other."""
    steps = round(SCAN_S * 1e9 / sim.step_ns)
    for number in range(round(drive_s / SCAN_S)):
        if number % 2 == 0:
            sim.command("cmd_vel", ardee_sim.Twist(linear_x_m_s=speed_m_s))
        sim.step(steps)
        if is_measured:
            sim.latest(SCANS)


def lines(figures: Dict[str, float]) -> List[str]:
    """Returns one line a figure, with a mark if its budget is missed."""
    found = []
    for name, value in figures.items():
        text, form, budget, is_least = ROWS[name]
        sign, misses = (">=", value < budget) if is_least else ("<=", value > budget)
        mark = " !" if misses else ""
        found.append(f"python, {text}: {form.format(value)} ({sign} {form.format(budget)}){mark}")
    return found
