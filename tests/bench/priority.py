# SPDX-License-Identifier: MIT
"""Keeps sending threads from waiting: for other programs, for Python's collector, for memory."""
import contextlib
import ctypes
import gc
import os

# Parameters of mallopt(3), and the greatest value of the first; several frames at once fit the second.
M_TRIM_THRESHOLD, M_MMAP_THRESHOLD = -1, -3
MOST_MMAP_THRESHOLD_BYTES, TRIM_THRESHOLD_BYTES = 32 << 20, 256 << 20


def keep_what_there_is() -> None:
    """Excludes all present objects from Python's garbage collection: at the end of a start."""
    gc.collect()
    gc.freeze()


def keep_memory() -> None:
    """Keeps freed memory in the process: new pages of the system for each image take up to a millisecond."""
    mallopt = ctypes.CDLL(None).mallopt
    mallopt(M_MMAP_THRESHOLD, MOST_MMAP_THRESHOLD_BYTES)
    mallopt(M_TRIM_THRESHOLD, TRIM_THRESHOLD_BYTES)


def hurry(priority: int = 1) -> None:
    """Runs this thread before programs without real-time priority, if permitted."""
    with contextlib.suppress(PermissionError):
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(priority))


def go_next() -> bool:
    """Runs after those with real-time priority and before all others; returns False if not permitted."""
    try:
        os.setpriority(os.PRIO_PROCESS, 0, -20)
    except PermissionError:
        return False
    return True
