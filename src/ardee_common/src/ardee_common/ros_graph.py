# SPDX-License-Identifier: MIT
"""Runs a private ROS graph: a master on a free port, and processes around it, of which none is left behind."""
import os
import pathlib
import queue
import signal
import subprocess
import sys
import time
from multiprocessing import get_context
from typing import Any, Callable, Dict, List, Optional, Tuple

from ardee_common.process import HEED_CTRL_C, RosMaster, start_child, stop_child

Probe = Callable[..., Any]
PROBES = get_context("forkserver")  # its server imports once the modules that all probes need
PROBES.set_forkserver_preload(["numpy", "pytest", "rospy", "tf2_ros"])


def _run_probe(env: Dict[str, str], probe: Probe, args: Tuple[Any, ...], answers: Any) -> None:
    """Runs a probe in its own process; puts (worked, value or message) into `answers`."""
    os.environ.update(env)
    try:
        answers.put((True, probe(*args)))
    except BaseException as error:
        answers.put((False, f"{type(error).__name__}: {error}"))
    if "rospy" in sys.modules:  # a fork skips rospy's exit handlers, which tell the master
        sys.modules["rospy"].signal_shutdown("the probe ends")


def wait_until(condition: Callable[[], Any], what: str, timeout_s: float = 30.0) -> Any:
    """Returns the first true value of `condition`, tested repeatedly; fails after `timeout_s` of wall time."""
    deadline = time.monotonic() + timeout_s
    while True:
        value = condition()
        if value:
            return value
        if time.monotonic() > deadline:
            raise TimeoutError(f"waited {timeout_s} s in vain: {what}")
        time.sleep(0.05)


class Process:
    """A process of the graph, with its output in a file."""

    def __init__(self, command: List[str], env: Dict[str, str], log: pathlib.Path) -> None:
        self.command, self.log = command, log
        self._popen = start_child([*HEED_CTRL_C, *command], env, log)
        self.pid = self._popen.pid

    def output(self) -> str:
        """Returns the output so far, of both streams."""
        return self.log.read_text(errors="replace")

    def exit_code(self) -> Optional[int]:
        """Returns the exit code, None while the process runs."""
        return self._popen.poll()

    def wait(self, timeout_s: float = 60.0) -> int:
        """Waits for the end; returns the exit code."""
        try:
            return self._popen.wait(timeout_s)
        except subprocess.TimeoutExpired:
            raise TimeoutError(f"{self.command} still runs:\n{self.output()[-3000:]}") from None

    def interrupt(self) -> None:
        """Interrupts the process as Ctrl-C in its terminal does."""
        if self.exit_code() is None:
            os.killpg(self.pid, signal.SIGINT)

    def stop(self) -> None:
        """Ends the process: by Ctrl-C, then by stronger signals."""
        stop_child(self._popen)


class RosGraph:
    """ROS master and all processes started around it, in tests and in the demo."""

    def __init__(self, folder: pathlib.Path) -> None:
        self.folder, self.processes = folder, []  # type: pathlib.Path, List[Process]
        self.env = dict(
            os.environ,
            ROS_IP="127.0.0.1",
            ROS_HOME=str(folder),
            ROS_LOG_DIR=str(folder / "log"),
            ROSCONSOLE_STDOUT_LINE_BUFFERED="1",
            PYTHONUNBUFFERED="1",
        )
        for name in ("ROS_HOSTNAME", "ROS_NAMESPACE", "DISPLAY"):
            self.env.pop(name, None)
        self.uri = ""
        self.start_master()
        self.env["ROS_MASTER_URI"] = self.uri

    def start_master(self) -> None:
        """Starts the master on a free port; a later one on the port of the first."""
        port = self.uri.rstrip("/").rpartition(":")[2] or 0
        # alive() finds processes of this graph by this variable; the first master must not have that of another graph.
        env = {name: value for name, value in self.env.items() if name != "ROS_MASTER_URI"}
        # The master reports each node that goes without a word, such as probes and killed nodes: into a file.
        self._master = RosMaster(env, port, self.folder / "master.log")
        self.uri = self._master.uri

    def spawn(self, *command: str, **env: str) -> Process:
        """Starts a command, with additions to its environment if given."""
        words = [str(word) for word in command]
        log = self.folder / f"{len(self.processes):02d}_{os.path.basename(words[0])}.log"
        process = Process(words, dict(self.env, **env), log)
        self.processes.append(process)
        return process

    def launch(self, package: str, file: str, *args: str) -> Process:
        """Starts a launch file."""
        return self.spawn("roslaunch", package, file, *args)

    def run(self, *command: str, timeout_s: float = 60.0) -> str:
        """Runs a command that must succeed; returns its output."""
        process = self.spawn(*command)
        code = process.wait(timeout_s)
        if code != 0:
            raise RuntimeError(f"{command} exited with {code}:\n{process.output()}")
        return process.output()

    def call(self, probe: Probe, *args: Any, timeout_s: float = 90.0) -> Any:
        """Calls probe(*args) in a process of its own: rospy can be initialised only once in each."""
        answers = PROBES.Queue()
        process = PROBES.Process(target=_run_probe, args=(self.env, probe, args, answers))
        process.start()
        try:
            worked, value = answers.get(timeout=timeout_s)
        except queue.Empty:
            worked, value = False, f"no answer in {timeout_s} s"
        process.join(10)
        if process.is_alive():
            process.kill()
            process.join()
        assert worked, f"{probe.__name__}{args}: {value}\n{self.logs()}"
        return value

    def logs(self) -> str:
        """Returns the ends of all outputs, for the message of a failed test."""
        return "\n".join(f"--- {p.log.name}\n{p.output()[-3000:]}" for p in self.processes)

    def alive(self) -> Dict[int, str]:
        """Returns every process of this graph but the master, by the environment of its start."""
        marker, found = f"ROS_MASTER_URI={self.uri}".encode(), {}
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                if marker not in (folder / "environ").read_bytes().split(b"\0"):
                    continue
                words = (folder / "cmdline").read_bytes().replace(b"\0", b" ").decode().strip()
            except OSError:
                continue  # it has ended, or is not ours to read
            if words:  # empty: ended, but not reaped
                found[int(folder.name)] = words
        found.pop(os.getpid(), None)
        return found

    def close(self) -> Dict[int, str]:
        """Ends all processes; returns those that were still there after all were told to stop."""
        for child in reversed(self.processes):
            child.stop()
        deadline = time.monotonic() + 5.0
        while self.alive() and time.monotonic() < deadline:
            time.sleep(0.05)
        left = self.alive()
        for pid in left:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        self.end_master()
        return left

    def end_master(self) -> None:
        """Ends the master alone."""
        self._master.stop()
