# SPDX-License-Identifier: MIT
"""Does a run again: the same run, for it follows from its inputs and its controller's commands."""
import math
from pathlib import Path
from typing import Any, Iterator, Optional

import ardee_sim

from ardee_campaigns import tables
from ardee_campaigns.plan import Job
from ardee_campaigns.robot import Driven
from ardee_campaigns.run import SCRATCH, Show, Watch, run_here, run_one, sow
from ardee_campaigns.task import set_down
from ardee_common.errors import GeneratorError
from ardee_common.output import scratch_folder
from ardee_world.row_truth import lane_of
from ardee_world.trial import Trial

_APART_M = 1e-3  # of two runs that are not the same


def follow(job: Job, samples: Any, driven: Any, trial: Trial) -> Iterator[bool]:
    """Commands a robot as recorded, and sets it down where a person did; yields after each sample if it was the last.

    driven : a Driven or RosDriven, spawned at the trial's start
    """
    lane, keys = lane_of(trial.field, trial.start), job.campaign.keys.task
    for number, row in enumerate(samples.to_pylist(), 1):
        while driven.advance() < row["time_ns"]:
            pass  # a node in real time started meanwhile
        driven.command(row["command_speed_m_s"], row["command_turn_rad_s"])
        pose = driven.pose()
        apart_m = math.hypot(pose.x_m - row["x_m"], pose.y_m - row["y_m"])
        if apart_m > _APART_M:
            found = f"{apart_m:.3g} m from its place at {row['time_ns'] * 1e-9:.3f} s"
            raise GeneratorError(f"run {job.run_id}: found the robot {found}: its inputs differ")
        yield number == len(samples)
        if row["event"]:
            driven.set_pose(set_down(keys, lane, row["event"], row["along_m"]), trial)
            driven.settle()


def do_again(job: Job, folder: Path, watch: Watch, show: Optional[Show] = None) -> tables.RunFile:
    """Returns a run of a campaign's folder, done again; `watch` sees each observation, `show` the simulation.

    A controller in Python drives anew, and an error's traceback is printed. A program or ROS node, whose time may be
    real, is not started: the robot gets the commands of the run's record. Only for a run without one it drives first.
    """
    if job.campaign.controllers[job.cell.controller].kind == "python":
        return run_here(job, watch, show, is_traced=True)
    is_there = tables.run_path(folder, job.run_id).is_file()
    run = tables.read_run(folder, job.run_id) if is_there else run_one(job)
    if len(run.samples):
        _drive(job, run, watch, show)
    return run


def _drive(job: Job, run: tables.RunFile, watch: Watch, show: Optional[Show]) -> None:
    with scratch_folder(SCRATCH) as work:
        trial = sow(job, work / "models")
        world = ardee_sim.World.from_file(trial.world, model_paths=trial.models)
        with ardee_sim.Simulation(world, seed=job.seed) as sim:
            keys = job.campaign.robots[job.cell.robot]
            driven = Driven(sim, job.cell.robot, keys, job.urdf.read_text())
            driven.spawn(trial.start, trial)
            for is_last in follow(job, run.samples, driven, trial):
                watch(driven.observation())
                if show:
                    show(sim, is_last)
