# SPDX-License-Identifier: MIT
"""Does a run in a process of its own that has a ROS graph of its own: rospy can be started once in each process."""
import os
import pickle
import signal
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path
from typing import Any, Optional

from ardee_campaigns import tables
from ardee_campaigns.plan import Job
from ardee_campaigns.program import end_with_parent
from ardee_campaigns.run import FullDisk, Watch, failed, run_here
from ardee_common.process import end_by_signals, ignore_end_signals, start_child, stop_child
from ardee_common.ros_graph import RosGraph


def run_apart(job: Job, watch: Optional[Watch]) -> tables.RunFile:
    """Returns what a run leaves behind. The process ends its nodes itself if this one is lost."""
    pipes: Any = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    end = partial(end_with_parent, signal.SIGTERM)
    child = start_child([sys.executable, "-m", __name__], preexec_fn=end, **pipes)
    try:
        with child.stdin as asked, child.stdout as told:
            pickle.dump((job, watch is not None), asked)
            asked.flush()
            return _answer(told, watch)
    except (EOFError, BrokenPipeError):
        return failed(job, f"its process ended with exit code {child.wait()}")
    finally:
        stop_child(child)


def _answer(told: Any, watch: Optional[Watch]) -> tables.RunFile:
    while True:
        value = pickle.load(told)
        if isinstance(value, tables.RunFile):
            return value
        if isinstance(value, FullDisk):
            raise value
        assert watch is not None
        watch(value)


def _run(job: Job, watch: Watch, folder: Path) -> Any:
    """Does the run in a new graph, of which nothing is left afterwards; returns it or its FullDisk."""
    graph = RosGraph(folder)
    os.environ.clear()
    os.environ.update(graph.env)
    import rospy

    try:
        rospy.init_node("campaign", disable_signals=True)
        return run_here(job, watch)
    except FullDisk as error:
        return error
    finally:
        ignore_end_signals()
        rospy.signal_shutdown("the run has ended")
        graph.close()


def main() -> None:
    """Reads a job, writes observations if they are wanted, and at last what the run leaves behind."""
    told = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # of what a library prints
    end_by_signals()
    job, is_watched = pickle.load(sys.stdin.buffer)

    def tell(value: Any) -> None:
        pickle.dump(value, told)
        told.flush()

    with tempfile.TemporaryDirectory(prefix="ardee_ros_") as folder:
        done = _run(job, tell if is_watched else lambda observation: None, Path(folder))
    tell(done)


if __name__ == "__main__":
    main()
