# SPDX-License-Identifier: MIT
"""Shared parts of commands that drive runs in a simulator of their own: folder of the output, errors, clean endings."""
import contextlib
import fcntl
import os
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Callable

from ardee_common.errors import GeneratorError
from ardee_common.process import end_by_signals

LARGEST_SEED = 2**31 - 1


def make_folder(output: Path) -> None:
    """Makes the folder, and locks it until the program ends."""
    try:
        output.mkdir(parents=True, exist_ok=True)
        handle = os.open(output, os.O_RDONLY)
    except OSError as error:
        raise GeneratorError(
            f"--output: found {str(output)!r}, expected a folder to write in: {error.strerror}"
        ) from None
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise GeneratorError(
            f"--output: found {str(output)!r}, where another experiment writes, expected a folder of its own"
        ) from None


def drop_if_empty(output: Path) -> None:
    """Removes the folder unless something is in it."""
    with contextlib.suppress(OSError):
        output.rmdir()


def run(prog: str, experiment: Callable[[Path], None]) -> int:
    """Runs an experiment in a temporary folder; returns the exit code: 0 done, 1 the simulator failed, 2 bad input."""
    from ardee_sim import ArdeeError

    from ardee_navigation.evaluation.simulation import SimulationError

    end_by_signals()
    work = Path(tempfile.mkdtemp(prefix="ardee_experiment_"))
    try:
        experiment(work)
    except GeneratorError as error:
        print(f"{prog}: {error}", file=sys.stderr)
        return 2
    except (SimulationError, ArdeeError, OSError) as error:
        print(f"{prog}: {error}", file=sys.stderr)
        return 1
    finally:
        shutil.rmtree(work, ignore_errors=True)
    return 0
