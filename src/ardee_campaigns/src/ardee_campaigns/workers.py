# SPDX-License-Identifier: MIT
"""Works off the runs of a campaign on dask.distributed: processes of this machine, or those of a scheduler."""
import contextlib
import os
from pathlib import Path
from typing import Any, Callable, List, Optional, Sequence

from distributed import Client, as_completed
from distributed.comm import CommClosedError
from distributed.scheduler import KilledWorker

from ardee_campaigns import tables
from ardee_campaigns.attempts import Attempts
from ardee_campaigns.plan import Job
from ardee_campaigns.replay import ROBOTS
from ardee_campaigns.run import FullDisk, failed, work
from ardee_common.cluster import LOST, connected
from ardee_common.errors import WorkersError
from ardee_common.output import FULL, remove_stale

_MOST_LOSSES = 3  # of a run's workers, or of its file: then it has failed
_NO_FILE = "its worker left no file in {}, expected one and the same folder for all workers"
Told = Callable[[Job, str], None]


class Workers:
    """Workers for the jobs of a campaign, as a context manager; each job's file is in the folder when it is done.

    The folder is locked.
    """

    def __init__(self, folder: Path, address: Optional[str], workers: int) -> None:
        self._folder, self._address = folder, address
        self._workers = workers or len(os.sched_getaffinity(0))
        self._stack = contextlib.ExitStack()
        self._opened: Optional[Client] = None

    def __enter__(self) -> "Workers":
        for folder in (self._folder, self._folder / tables.FOLDER, self._folder / ROBOTS):
            remove_stale(folder)
        return self

    def __exit__(self, *_: object) -> None:
        self._stack.close()

    def _connected(self) -> Client:
        if self._opened is None:
            self._opened = self._stack.enter_context(
                connected(self._address, self._workers, losses=0)
            )
        return self._opened

    def work_off(self, jobs: Sequence[Job], told: Told) -> None:
        """Does the jobs, in any order; `told` gets each one and its error. Raises WorkersError if it cannot go on."""
        if not jobs:
            return
        for job in jobs:  # attempts that an earlier command's end cut off are no losses
            Attempts(self._folder, job.run_id).forget()
        try:
            self._work_off(jobs, told)
        except CommClosedError:
            raise LOST from None

    def _work_off(self, jobs: Sequence[Job], told: Told) -> None:
        client, by_key = self._connected(), {}

        def submit(job: Job, attempt: int = 0) -> Any:
            key = f"{job.run_id}-{attempt} in {self._folder}"  # a scheduler has campaigns side by side
            by_key[key] = job, attempt
            return client.submit(work, job, self._folder, key=key, pure=False)

        ended = as_completed([submit(job) for job in jobs], loop=client.loop)
        for future in ended:
            job, attempt = by_key.pop(future.key)
            error = self._outcome(job, future, attempt)
            if error is None:
                ended.add(submit(job, attempt + 1))
            else:
                told(job, error)
            future.release()

    def _outcome(self, job: Job, future: Any, attempt: int) -> Optional[str]:
        """Returns the error of a job that has ended, empty if it went well; None if it is to be tried again."""
        if future.cancelled():
            raise LOST
        error = future.exception()
        if isinstance(error, CommClosedError):
            raise LOST
        if error is None:
            if tables.run_path(self._folder, job.run_id).is_file():
                return future.result()
            is_last = attempt + 1 >= _MOST_LOSSES
            return self._give_up(job, _NO_FILE.format(self._folder)) if is_last else None
        if isinstance(error, KilledWorker):  # dask blames all jobs that waited for the worker
            lost = Attempts(self._folder, job.run_id).lost()
            return self._give_up(job, lost[-1]) if len(lost) >= _MOST_LOSSES else None
        if isinstance(error, FullDisk):
            raise _full(error)
        raise WorkersError(f"run {job.run_id}: {type(error).__name__}: {error}")

    def _give_up(self, job: Job, how: str) -> str:
        attempts = Attempts(self._folder, job.run_id)
        done = failed(job, f"lost each time it was tried: {how}")
        tables.write_run(self._folder, attempts.counted(done, is_last_lost=True))
        attempts.forget()
        return done.row.error


def collect(folder: Path, jobs: Sequence[Job], schema: Any) -> List[tables.RunRow]:
    """Writes the tables of all runs that are done; returns their rows."""
    there = set(tables.finished(folder))
    heads = [tables.read_run_head(folder, job.run_id) for job in jobs if job.run_id in there]
    try:
        tables.write_samples(folder, [head.row.run_id for head in heads])
        tables.write_timings(folder, [head.timing for head in heads])
        tables.write_runs(folder, [head.row for head in heads], schema)
    except OSError as error:
        if error.errno not in FULL:
            raise
        raise _full(f"{folder}: {os.strerror(error.errno)}") from None
    return [head.row for head in heads]


def _full(text: object) -> WorkersError:
    return WorkersError(f"{text}; free some and start again to go on")
