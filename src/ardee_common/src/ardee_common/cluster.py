# SPDX-License-Identifier: MIT
"""Worker processes on dask.distributed: those of this machine, or of a scheduler elsewhere."""
import contextlib
import logging
import shutil
import tempfile
import uuid
from concurrent.futures import CancelledError
from typing import Any, Callable, Dict, Iterator, Optional, Tuple

import dask
from distributed import Client, LocalCluster, as_completed
from distributed.comm import CommClosedError
from distributed.scheduler import KilledWorker

from ardee_common.errors import GeneratorError, WorkersError
from ardee_common.process import end_put_off

# Of workers at a task, beside one for each worker: if all end at once, the task is passed on to each.
_LOSSES = 3
_PATIENCE_S = 30.0  # for a scheduler and its first worker
LOST = WorkersError("the scheduler was lost; start again to go on")


@contextlib.contextmanager
def connected(address: Optional[str], workers: int, losses: int) -> Iterator[Client]:
    """Connects to a scheduler, or starts one with worker processes that end with this one.

    address : of a scheduler, tcp://HOST:PORT, whose workers have one thread each; None: this machine's processes
    workers : number of processes on this machine
    losses : of workers at a task that this machine's scheduler bears before it gives the task up
    """
    for name in ("distributed", "asyncio"):  # which tell of a lost scheduler in tracebacks
        logging.getLogger(name).setLevel(logging.CRITICAL)
    settings = {
        "distributed.scheduler.allowed-failures": losses,
        "distributed.scheduler.work-stealing": True,
        "distributed.worker.memory.terminate": False,  # a task sets its own limit
        # dask's own tells malloc to return memory at once, which would cost a data set 10 % of its time.
        "distributed.nanny.pre-spawn-environ": {"OMP_NUM_THREADS": 1, "OPENBLAS_NUM_THREADS": 1},
        "distributed.admin.tick.limit": "1h",
        # Callbacks for dask's dashboard, 10 to 100 times a second in each process, interrupt the tasks.
        "distributed.admin.tick.interval": "1s",
        "distributed.admin.system-monitor.interval": "10s",
        "distributed.worker.profile.enabled": False,
        "distributed.comm.timeouts.connect": f"{_PATIENCE_S}s",
    }
    with dask.config.set(settings):
        stack = contextlib.ExitStack()
        try:
            yield _begun(address, workers, stack)
        finally:
            with contextlib.suppress(CommClosedError):  # of a scheduler that is lost already
                stack.close()


def _begun(address: Optional[str], workers: int, stack: contextlib.ExitStack) -> Client:
    """Returns the client of a scheduler that has workers; it ends with the stack, and so do the workers made here."""
    with contextlib.nullcontext() if address else end_put_off():
        try:
            target: Any = address or _local(workers, stack)
            client = stack.enter_context(Client(target, set_as_default=False))
        except (OSError, TimeoutError, ValueError, RuntimeError) as error:
            why = " ".join(str(error).split())
            if address is None:
                raise WorkersError(f"the worker processes did not start: {why}") from None
            found = f"found {address!r}, no scheduler: {why}"
            raise GeneratorError(f"--scheduler: {found}") from None
        _check_workers(client, address or "this machine")
    return client


def _local(workers: int, stack: contextlib.ExitStack) -> LocalCluster:
    """Returns a scheduler with worker processes; it ends with the stack."""
    # Ended workers leave their temporary files: in a folder that goes with the cluster.
    scratch = tempfile.mkdtemp(prefix="ardee_workers_")
    stack.callback(shutil.rmtree, scratch, ignore_errors=True)
    return stack.enter_context(
        LocalCluster(
            n_workers=workers,
            threads_per_worker=1,
            processes=True,
            memory_limit=0,
            dashboard_address="127.0.0.1:0",  # None would be all addresses
            worker_dashboard_address="127.0.0.1:0",
            host="127.0.0.1",
            silence_logs=logging.CRITICAL,
            local_directory=scratch,
            env={"TMPDIR": scratch},
        )
    )


def _check_workers(client: Client, address: str) -> None:
    try:
        client.wait_for_workers(1, timeout=_PATIENCE_S)
    except TimeoutError:
        raise WorkersError(f"{address}: waited {_PATIENCE_S:.0f} s for a worker") from None
    for name, info in client.scheduler_info()["workers"].items():
        if info["nthreads"] != 1:
            raise GeneratorError(
                f"--scheduler: found worker {name} of {info['nthreads']} threads, expected"
                " dask-worker --nthreads 1: a task is a process's only one"
            )


def worked_off(
    task: Callable[..., Any],
    inputs: Dict[str, Tuple[Any, ...]],
    address: Optional[str],
    workers: int,
) -> Iterator[Any]:
    """Yields what task(*each) of the inputs, by name, returns, as each is done.

    Raises what the task raises, and WorkersError if it cannot go on.
    """
    with connected(address, workers, _LOSSES + workers) as client:
        try:
            # A key of dask's is that of a result: the same name may be asked for again.
            keys = {f"{name}-{uuid.uuid4().hex}": each for name, each in inputs.items()}
            futures = [client.submit(task, *each, key=key) for key, each in keys.items()]
            for future in as_completed(futures, loop=client.loop):
                yield future.result()
                future.release()
        except (CommClosedError, CancelledError):
            raise LOST from None
        except KilledWorker as error:
            name = error.task.rpartition("-")[0]
            what = f"{name}: {error.allowed_failures + 1} workers ended at it, perhaps for want of memory"
            raise WorkersError(f"{what}; start again, with fewer workers, to go on") from None
