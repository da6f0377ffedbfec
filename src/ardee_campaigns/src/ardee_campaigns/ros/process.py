# SPDX-License-Identifier: MIT
"""Calls a function in a process of its own with a ROS graph of its own: rospy can be started once in each process."""
import os
import pickle
import signal
import subprocess
import sys
import tempfile
from functools import partial
from pathlib import Path
from typing import Any, Callable, Tuple

from ardee_campaigns import tables
from ardee_campaigns.plan import Job
from ardee_campaigns.program import end_with_parent
from ardee_campaigns.run import failed, run_here
from ardee_common.process import end_by_signals, ignore_end_signals, start_child, stop_child
from ardee_common.ros_graph import RosGraph

_DONE, _RAISED = "done", "raised"


class Lost(Exception):
    """Error of a process that ended without a result."""


def run_apart(job: Job) -> tables.RunFile:
    """Returns what a run leaves behind."""
    try:
        return apart(run_here, job)
    except Lost as error:
        return failed(job, str(error))


def apart(function: Callable[..., Any], *arguments: Any) -> Any:
    """Returns the function's result, or raises its error. The process ends its nodes itself if this one is lost."""
    pipes: Any = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    end = partial(end_with_parent, signal.SIGTERM)
    child = start_child([sys.executable, "-m", __name__], preexec_fn=end, **pipes)
    try:
        with child.stdin as asked, child.stdout as told:
            pickle.dump((function, arguments), asked)
            asked.flush()
            what, value = pickle.load(told)  # cut short if it is killed while it writes
            if what == _RAISED:
                raise value
            return value
    except (EOFError, BrokenPipeError, pickle.UnpicklingError):
        raise Lost(f"its process ended with exit code {child.wait()}") from None
    finally:
        stop_child(child)


def _call(folder: Path, function: Callable[..., Any], *arguments: Any) -> Tuple[str, Any]:
    """Calls the function in a new graph, of which nothing is left afterwards."""
    graph = RosGraph(folder)
    os.environ.clear()
    os.environ.update(graph.env)
    import rospy

    try:
        rospy.init_node("campaign", disable_signals=True)
        return _DONE, function(*arguments)
    except Exception as error:
        return _RAISED, error
    finally:
        ignore_end_signals()
        rospy.signal_shutdown("the run has ended")
        graph.close()


def main() -> None:
    """Reads a function and its arguments, writes the result."""
    told = os.fdopen(os.dup(1), "wb")
    os.dup2(2, 1)  # of what a library prints
    end_by_signals()
    function, arguments = pickle.load(sys.stdin.buffer)
    with tempfile.TemporaryDirectory(prefix="ardee_ros_") as folder:
        done = _call(Path(folder), function, *arguments)
    with told:
        pickle.dump(done, told)


if __name__ == "__main__":
    main()
