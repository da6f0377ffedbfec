# SPDX-License-Identifier: MIT
"""Starts and stops child processes, each in a session of its own, a ROS master too; ends programs by signals."""
import contextlib
import os
import signal
import subprocess
from multiprocessing import resource_tracker
from pathlib import Path
from typing import Any, Dict, Iterator, List, NoReturn, Optional, Sequence

END_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
# Signals that end a child, each with the time [s] that it is given to follow.
_ENDING = ((signal.SIGINT, 20.0), (signal.SIGTERM, 5.0), (signal.SIGKILL, 5.0))
# Put before a command: Ctrl-C ends it though its parents ignore that, as a shell's background jobs do. A preexec_fn
# would do so by a fork, in which Python prints and loses what a signal raises.
HEED_CTRL_C = ("env", "--default-signal=INT")
_MASTER = (
    "import sys, rosmaster.master as m; x = m.Master(int(sys.argv[1])); x.start();"
    "print(x.uri, flush=True); sys.stdin.read(); x.stop()"
)


class Ended(SystemExit, KeyboardInterrupt):
    """Ends the program with its code; rospy's wait_for_service lets nothing through but a KeyboardInterrupt."""


_told: List[int] = []  # exit codes that signals asked for


def end_by_signals() -> None:
    """Makes Ctrl-C, SIGTERM and SIGHUP raise Ended with code 128 + number, so that the program cleans up."""

    def end(number: int, _frame: Any) -> NoReturn:
        _told.append(128 + number)
        raise Ended(128 + number)

    for number in END_SIGNALS:
        if number != signal.SIGHUP or signal.getsignal(number) != signal.SIG_IGN:  # nohup's wish
            signal.signal(number, end)


def end_in_a_line(prog: str) -> None:
    """Makes Ctrl-C end the program at once, in a line and with code 130: for its imports, before end_by_signals()."""

    def end(number: int, _frame: Any) -> NoReturn:
        os.write(2, f"{prog}: interrupted\n".encode())
        os._exit(128 + number)

    if signal.getsignal(signal.SIGINT) != signal.SIG_IGN:
        signal.signal(signal.SIGINT, end)


def end_if_told() -> None:
    """Raises Ended again if a signal has raised it and it was lost: in a fork, or in a library's bare `except`."""
    if _told:
        raise Ended(_told[0])


@contextlib.contextmanager
def end_put_off() -> Iterator[None]:
    """Puts an end by signals off to the end of the block, and keeps Ctrl-C from all processes that the block starts.

    A terminal sends Ctrl-C to them, too, and few libraries bear an exception while they start some.
    """
    resource_tracker.ensure_running()  # multiprocessing's: where it starts later, it unblocks Ctrl-C
    came: List[int] = []
    heeded = [number for number in END_SIGNALS if signal.getsignal(number) != signal.SIG_IGN]
    before = [signal.signal(number, lambda now, _: came.append(now)) for number in heeded]
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # which children inherit
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for number, handler in zip(heeded, before):
            signal.signal(number, handler)
        for number in came[:1]:
            signal.raise_signal(number)


def ignore_end_signals() -> None:
    """Ignores these signals from now on: the program is cleaning up."""
    for number in END_SIGNALS:
        signal.signal(number, signal.SIG_IGN)


def start_child(
    command: Sequence[str],
    env: Optional[Dict[str, str]] = None,
    log: Optional[Path] = None,
    **options: Any,
) -> subprocess.Popen:
    """Starts a child without input, and with both outputs in a log, or nowhere; options are those of Popen."""
    settings = {"stdin": subprocess.DEVNULL, "stderr": subprocess.STDOUT, "start_new_session": True}
    with (log or Path(os.devnull)).open("wb") as output:
        return subprocess.Popen(command, env=env, **{**settings, "stdout": output, **options})


def stop_child(child: subprocess.Popen) -> None:
    """Ends a child and its process group: by Ctrl-C, and ever harder while the child goes on."""
    for number, patience_s in _ENDING:
        if child.poll() is not None:
            return
        os.killpg(child.pid, number)
        try:
            child.wait(patience_s)
        except subprocess.TimeoutExpired:
            continue


class RosMaster:
    """A ROS master on a port, which the kernel picks if it is 0; ends with the process that started it."""

    def __init__(self, env: Dict[str, str], port: int = 0, log: Optional[Path] = None) -> None:
        command = ["/usr/bin/python3", "-c", _MASTER, str(port)]
        with (log or Path(os.devnull)).open("ab") as complaints:
            pipe = subprocess.PIPE
            self._child = start_child(
                command, env, stdin=pipe, stdout=pipe, stderr=complaints, text=True
            )
        self.uri = self._child.stdout.readline().strip()

    def stop(self) -> None:
        """Ends the ROS master."""
        self._child.stdin.close()
        try:
            self._child.wait(5.0)
        except subprocess.TimeoutExpired:
            self._child.kill()
            self._child.wait()
        self._child.stdout.close()
