# SPDX-License-Identifier: MIT
"""One run of a campaign: a pure function of its job, and the task of a worker process that writes its file."""
import contextlib
import faulthandler
import math
import os
import re
import resource
import socket
import tempfile
import time
import traceback
from pathlib import Path
from typing import Any, Callable, Dict, Optional

import ardee_sim

from ardee_campaigns import controllers, measures, tables, worlds
from ardee_campaigns.attempts import Attempts
from ardee_campaigns.outline import Contacts
from ardee_campaigns.plan import Job, factors_of, params_of
from ardee_campaigns.recorder import Recorder
from ardee_campaigns.robot import Driven, Observation
from ardee_campaigns.task import Judge
from ardee_common.errors import GeneratorError
from ardee_common.output import FULL, scratch_folder
from ardee_common.process import end_if_told
from ardee_world.row_truth import lane_of
from ardee_world.trial import Trial

_ADDRESS = re.compile(r"0x[0-9a-f]{6,}")  # of an object: differs from run to run
_LONGEST_ERROR = 500
SCRATCH = "ardee_drive_"  # begin of the names of folders for a run's temporary files
Watch = Callable[[Observation], None]
Show = Callable[[ardee_sim.Simulation, bool], None]  # of each period; whether the run is over


class FullDisk(Exception):
    """Error of a run whose file cannot be written: the campaign cannot go on."""


def _first_line(error: BaseException) -> str:
    kind = "" if type(error).__name__ == "GeneratorError" else f"{type(error).__name__}: "
    text = " ".join(f"{kind}{error}".split()).rstrip(": ")
    return _ADDRESS.sub("0x...", text)[:_LONGEST_ERROR]


def sow(job: Job, folder: Path) -> Trial:
    """Returns the world of a run, with its field sown in a folder of models."""
    factors = factors_of(job.campaign, job.cell, "field")
    keys = job.campaign.worlds[job.cell.world]
    beside = job.campaign.file.parent
    return worlds.sow(keys, job.files, factors, job.field_seed, folder, beside)


def _seconds(time_ns: int) -> float:
    """Returns a time [s] as a ROS node has it, so that it and a controller in Python give the same answers."""
    seconds, rest_ns = divmod(time_ns, 10**9)
    return seconds + rest_ns / 1e9


class Run:
    """A run while it goes, and what it left behind even if it failed.

    driven, controller, judge, recorder : its parts, once it goes
    """

    def __init__(self, job: Job, show: Optional[Show] = None) -> None:
        self._job, self._show = job, show
        self._keys = job.campaign.keys
        self.recorder: Optional[Recorder] = None
        self.about: Dict[str, Any] = {}
        self.measured: Dict[str, float] = {}
        self.end = ""

    def drive(self, work: Path, watch: Watch) -> None:
        """Sows the field, drives, and measures. `watch` sees each observation."""
        job, cell, campaign = self._job, self._job.cell, self._job.campaign
        trial = sow(job, work / "models")
        lane = lane_of(trial.field, trial.start)
        middle = lane.deviation(lane.centre.at(lane.centre.length_m / 2))
        with contextlib.ExitStack() as ends:
            driven = self.driven = self._driven(trial, work, ends)
            robot = driven.spawn(trial.start, trial)
            contacts = Contacts(robot.outline_m, trial.field.stalks)
            self.recorder = Recorder(lane, robot, contacts)
            self.about = {
                "length_m": lane.centre.length_m,
                "width_m": middle.left_m + middle.right_m,
                "lidar_ahead_m": float(robot.sensor_xyz_m[0]),
                "world_file": str(trial.world.name),
            }
            judge = self.judge = Judge(self._keys.task, lane, self._keys.limit_sim_s)
            controller = self.controller = controllers.make(
                campaign.controllers[cell.controller], params_of(campaign, cell), robot, job.seed
            )
            if is_ros(job):
                controller.attach(driven)
            if hasattr(controller, "close"):
                ends.callback(controller.close)
            controller.reset()
            self._loop(driven, controller, judge, lane, trial, watch)
            if is_ros(job):
                controller.check_end()
            self.about.update(controllers.about(controller, taken=self.about))
        self.end = judge.end
        recorded = measures.Recorded(
            self.recorder.columns(),
            lane,
            self.about["width_m"],
            contacts,
            self._keys.task,
            self.end,
        )
        for name in self._keys.measures:
            self.measured[measures.column(name)] = measures.measured(name, recorded, trial)

    def _driven(self, trial: Trial, work: Path, ends: contextlib.ExitStack) -> Any:
        """Returns the robot, in a simulation that ends with `ends`."""
        job, cell = self._job, self._job.cell
        if is_ros(job):
            from ardee_campaigns.ros.driven import RosDriven

            return ends.enter_context(RosDriven(job, trial, work, is_relay=True))
        world = ardee_sim.World.from_file(trial.world, model_paths=trial.models)
        sim = ends.enter_context(ardee_sim.Simulation(world, seed=job.seed))
        return Driven(sim, cell.robot, job.campaign.robots[cell.robot], job.urdf.read_text())

    def _loop(
        self,
        driven: Any,
        controller: Any,
        judge: Judge,
        lane: Any,
        trial: Any,
        watch: Watch,
    ) -> None:
        recorder = self.recorder
        assert recorder is not None
        while not judge.end:
            end_if_told()
            time_ns = driven.advance()
            observation = driven.observation()
            command = controllers.checked(controller.step(observation, _seconds(time_ns)))
            driven.command(*command)
            pose = driven.pose()
            here = lane.deviation(pose)
            recorder.take(time_ns, pose, here, command, controllers.seen(controller), observation)
            is_finished = controllers.is_finished(controller)
            why, back = judge.look(recorder.time_s(), pose, here, is_finished)
            watch(observation)
            if back is not None:
                recorder.note_event(why)
                driven.set_pose(back, trial)
                driven.settle()
                controller.reset()
            if self._show:
                self._show(driven.sim, bool(judge.end))

    def file(self, error: str, wall_s: float) -> tables.RunFile:
        """Returns what is to be kept."""
        job, cell = self._job, self._job.cell
        row = tables.RunRow(
            run_id=job.run_id,
            world=cell.world,
            robot=cell.robot,
            controller=cell.controller,
            factors=dict(cell.factors),
            replicate=job.replicate,
            seed=job.seed,
            status=tables.FAILED if error else tables.OK,
            error=error,
            end_reason="" if error else self.end,
            sim_s=self.recorder.time_s() if self.recorder else math.nan,
            measures={} if error else self.measured,
        )
        samples = self.recorder.table() if self.recorder else tables.RUN_FILE_SCHEMA.empty_table()
        timing = tables.Timing(job.run_id, wall_s, socket.gethostname())
        return tables.RunFile(row, timing, samples, self.about)


def is_ros(job: Job) -> bool:
    """Returns whether a run's controller is a ROS node."""
    return job.campaign.controllers[job.cell.controller].kind == "ros"


def run_one(job: Job) -> tables.RunFile:
    """Returns what a run leaves behind. A failure of its world, robot, controller or measures is a failed row."""
    if is_ros(job):
        from ardee_campaigns.ros.process import run_apart

        return run_apart(job)
    return run_here(job)


def run_here(
    job: Job,
    watch: Optional[Watch] = None,
    show: Optional[Show] = None,
    *,
    is_traced: bool = False,
) -> tables.RunFile:
    """Returns the same of a run in this process. `is_traced` prints an error's traceback."""
    began, run, error = time.monotonic(), Run(job, show), ""
    try:
        with scratch_folder(SCRATCH) as work:
            run.drive(work, watch or (lambda observation: None))
    except Exception as raised:
        if getattr(raised, "errno", None) in FULL:
            raise FullDisk(f"{tempfile.gettempdir()}: {os.strerror(raised.errno)}") from None
        error = _first_line(raised)
        if is_traced and not isinstance(raised, GeneratorError):
            traceback.print_exc()
    return run.file(error, time.monotonic() - began)


def failed(job: Job, error: str) -> tables.RunFile:
    """Returns what is kept of a run whose workers were lost."""
    return Run(job).file(error, math.nan)


class _Bounds:
    """Bounds memory and time of this process while a run goes: beyond its time it ends, for no exception would."""

    def __init__(self, job: Job, log: Any) -> None:
        self._keys, self._log = job.campaign.keys, log

    def __enter__(self) -> None:
        self._before = resource.getrlimit(resource.RLIMIT_AS)
        pages = int(Path("/proc/self/statm").read_text().split()[0])
        most = pages * resource.getpagesize() + (self._keys.memory_mb << 20)
        hard = self._before[1]
        resource.setrlimit(
            resource.RLIMIT_AS, (most if hard < 0 else min(most, hard), self._before[1])
        )
        # Not a thread of Python: it ends a controller that keeps the interpreter to itself, too.
        faulthandler.dump_traceback_later(self._keys.watchdog_wall_s, exit=True, file=self._log)

    def __exit__(self, *_: object) -> None:
        faulthandler.cancel_dump_traceback_later()
        resource.setrlimit(resource.RLIMIT_AS, self._before)


def work(job: Job, folder: Path) -> str:
    """Does a run in this worker process and writes its file; returns the error, empty if it went well."""
    if tables.run_path(folder, job.run_id).is_file():  # its worker was lost just behind it
        return tables.read_run_head(folder, job.run_id).row.error
    attempts = Attempts(folder, job.run_id)
    try:
        with attempts.begin() as log:
            with _Bounds(job, log):
                done = run_one(job)
            tables.write_run(folder, attempts.counted(done))
        attempts.forget()
    except OSError as error:
        if error.errno not in FULL:
            raise
        raise FullDisk(f"{folder}: {os.strerror(error.errno)}") from None
    return done.row.error
