# SPDX-License-Identifier: MIT
"""Processes of the sensor server for images and clouds, which would hold up the small sensors and each other.

Each is a node of its own while somebody wants one of its sources. It sends from the server's socket, so that receivers
see one sender; the server keeps the clients and tells it of them through a pipe, by which it says what it has done.
It ends when that pipe does.
"""
import socket
import subprocess
import sys
import threading
import time
from collections import deque
from multiprocessing.connection import Connection, Pipe
from typing import Callable, Deque, Dict, FrozenSet, List, NamedTuple, Optional, Tuple, Union

from ardee_bridge import priority
from ardee_bridge.camera_topics import CameraTopics, Choice
from ardee_bridge.counters import Counters, Counts
from ardee_bridge.reader import Reader
from ardee_bridge.sensor_server import SensorServer, Target
from ardee_bridge.settings import ServerSettings, Source
from ardee_bridge.subscriptions import Subscriptions
from ardee_bridge.udp import PairLock

PATIENCE_S = 5.0
POLL_S = 0.2
RESTART_S = 2.0  # between two starts of a process that keeps ending
REPORT_PERIOD_S = 0.5


class Job(NamedTuple):
    """What a process is to do: name of its node, settings with its sources alone and full names of topics.

    Images that are compressed keep their process busy; one that only copies may go first, for it is soon through.
    """

    name: str
    settings: ServerSettings
    goes_first: bool


class Orders(NamedTuple):
    """Who gets messages, and names of the sources to read now."""

    targets: Tuple[Target, ...]
    names: FrozenSet[str]


class Report(NamedTuple):
    """What a process has done since its start, and what it has to say."""

    counts: Counts
    said: Tuple[str, ...]


class Shared(NamedTuple):
    """What the processes have of the server: its socket, the lock on it, and where to say something."""

    opened: socket.socket
    lock: PairLock
    warn: Callable[[str], None]


class FrameProcess:
    """The server's end: starts the process when somebody wants a frame, again if it has ended."""

    def __init__(self, job: Job, shared: Shared) -> None:
        self.name = job.name
        self._job, (self._socket, self._pair_lock, self._warn) = job, shared
        self._process: Optional[subprocess.Popen] = None
        self._pipe: Optional[Connection] = None
        self._started_s = 0.0
        self._lock = threading.Lock()
        self._counts = Counts({}, {})

    def serve(self, targets: Tuple[Target, ...], names: FrozenSet[str]) -> None:
        """These are the targets, and the sources to read, now."""
        is_wanted = any(
            target.wants(source.data_type, source.component_id)
            for target in targets
            for source in self._job.settings.sources
            if source.name in names
        )
        if self._process is None or self._process.poll() is not None:
            self.stop()
            if not is_wanted:
                return
            self._start()
            self._send(self._job)
        self._send(Orders(targets, names))

    def has_ended(self) -> bool:
        """Was it started, some time ago, and runs no more?"""
        if self._process is None or self._process.poll() is None:
            return False
        return time.monotonic() >= self._started_s + RESTART_S

    def counts(self) -> Counts:
        """The latest that it has said; what else it said is passed on."""
        with self._lock:
            try:
                while self._pipe is not None and self._pipe.poll():
                    self._counts, said = self._pipe.recv()
                    for text in said:
                        self._warn(f"{self.name}: {text}")
            except (EOFError, OSError):
                pass  # it has ended
            return self._counts

    def _start(self) -> None:
        self._started_s = time.monotonic()
        self._pair_lock.is_shared = True
        pipe, theirs = Pipe()
        files = (theirs.fileno(), self._socket.fileno(), self._pair_lock.file)
        words = [sys.executable, "-m", "ardee_bridge.frames", *map(str, files)]
        # Ctrl-C in the terminal is the server's alone, whose end ends the pipe
        self._process = subprocess.Popen(
            words, stdin=subprocess.DEVNULL, pass_fds=files, start_new_session=True
        )
        theirs.close()
        with self._lock:
            self._pipe = pipe

    def _send(self, what: Union[Job, Orders]) -> None:
        try:
            self._pipe.send(what)
        except OSError:
            pass  # it has ended

    def stop(self) -> None:
        """End it."""
        if self._process is None:
            return
        if self._process.poll() is not None:
            self._warn(f"{self.name} has ended: exit code {self._process.returncode}")
        with self._lock:
            self._pipe.close()
            self._pipe = None
        try:
            self._process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process = None


class FrameProcesses:
    """All of them: one for what is sent as it is, and one for each camera whose images have to be compressed."""

    def __init__(self, name: str, settings: ServerSettings, reader: Reader, shared: Shared) -> None:
        """`name` is the server's; its reader watches the cameras' publishers."""

        def make(ending: str, sources: List[Source], goes_first: bool) -> FrameProcess:
            alone = settings._replace(sources=tuple(sources))
            return FrameProcess(Job(f"{name}_{ending}", alone, goes_first), shared)

        frames = [source for source in settings.sources if source.is_frame]
        cameras = [source for source in frames if source.image_format == "jpeg"]
        plain = [source for source in frames if source not in cameras]
        as_they_are = plain + [source.of_camera() for source in cameras]
        self._frames = [make("frames", as_they_are, True)] if frames else []
        self._jpeg = [make(f"jpeg_{source.component_id}", [source], False) for source in cameras]
        self._plain = frozenset(source.name for source in plain)
        self._cameras = CameraTopics(cameras, reader)
        self._choice = Choice(frozenset(), frozenset())
        self._lock = threading.RLock()  # a node may be ended by any of its threads
        self._is_ended = False

    def serve(self, server: SensorServer) -> None:
        """Tell them what the server's targets want, and where it comes from."""
        with self._lock:
            if self._is_ended:
                return
            self._choice = self._cameras.choice(server.wanted())
            for process in self._frames:
                process.serve(server.clients(), self._plain | self._choice.compressed)
            for process in self._jpeg:
                process.serve(server.clients(), self._choice.raw)

    def follow(self, server: SensorServer) -> None:
        """The same, if a camera's publishers have come or gone, or a process has ended."""
        with self._lock:
            has_ended = any(process.has_ended() for process in self._frames + self._jpeg)
            if has_ended or self._cameras.choice(server.wanted()) != self._choice:
                self.serve(server)

    def counts(self) -> Dict[str, Counts]:
        """What each has done, by name."""
        return {process.name: process.counts() for process in self._frames + self._jpeg}

    def stop(self) -> None:
        """End them for good."""
        with self._lock:
            self._is_ended = True
            for process in self._frames + self._jpeg:
                process.stop()


def main() -> None:
    """Body of the process."""
    pipe_file, socket_file, lock_file = map(int, sys.argv[1:4])
    pipe = Connection(pipe_file)
    try:
        _serve(pipe, pipe.recv(), socket.socket(fileno=socket_file), lock_file)
    except (EOFError, OSError):
        pass  # the server has ended


def _serve(pipe: Connection, job: Job, opened: socket.socket, lock_file: int) -> None:
    priority.share_fairly()
    priority.keep_memory()
    said: Deque[str] = deque(maxlen=100)
    counters, has_to_end = Counters(said.append), threading.Event()
    goes_first = job.settings.realtime_priority if job.goes_first else 0
    lock = PairLock(lock_file, is_shared=True, priority=job.settings.realtime_priority)
    server = SensorServer(job.settings, opened, counters, lock=lock)
    server.set_clients(())
    reader = Reader(
        job.name, said.append, lambda reason: has_to_end.set(), counters.drop_unreadable
    )
    subscriptions = Subscriptions(job.settings.sources, server, reader)
    priority.keep_what_there_is()
    if goes_first and priority.go_first(goes_first):
        lock.priority = 0
    try:
        report_s = time.monotonic()
        while not has_to_end.is_set():
            if pipe.poll(POLL_S):
                orders = pipe.recv()
                server.set_clients(orders.targets)
                subscriptions.update(orders.names)
            if time.monotonic() >= report_s:
                report_s += REPORT_PERIOD_S
                pipe.send(
                    Report(counters.counts(), tuple(said.popleft() for _ in range(len(said))))
                )
    finally:
        reader.close()


if __name__ == "__main__":
    # by this name the server knows the classes that go through the pipe
    from ardee_bridge import frames

    frames.main()
