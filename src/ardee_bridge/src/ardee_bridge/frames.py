# SPDX-License-Identifier: MIT
"""The sensor server's second process: images and clouds, whose conversion would hold up the small sensors.

It runs while somebody wants one, as a node of its own: `<name of the server>_frames`. It sends from the server's
socket, so that receivers see one sender; the server keeps the clients and tells it of them through a pipe. It ends
when that pipe does.
"""
import os
import signal
import socket
import subprocess
import sys
from multiprocessing.connection import Connection, Pipe
from typing import Any, Dict, List, Optional, Tuple

import rospy

from ardee_bridge import ros_node
from ardee_bridge.counters import Counters
from ardee_bridge.sensor_server import SensorServer, Target
from ardee_bridge.settings import read_server
from ardee_bridge.subscriptions import Subscriptions, by_rospy
from ardee_bridge.udp import PairLock

PATIENCE_S = 5.0


def _remappings() -> List[str]:
    """Those of topics: `from:=to`."""
    return [word for word in sys.argv[1:] if ":=" in word and not word.startswith("_")]


class FrameProcess:
    """The server's end: starts the process when somebody wants a frame, again if it has died."""

    def __init__(self, values: Dict[str, Any], opened: socket.socket, lock: PairLock) -> None:
        self._values, self._socket, self._lock = values, opened, lock
        self._sources = [source for source in read_server(values).sources if source.is_frame]
        self._process: Optional[subprocess.Popen] = None
        self._pipe: Optional[Connection] = None

    def serve(self, targets: Tuple[Target, ...]) -> None:
        """These are the targets now."""
        is_wanted = any(
            target.wants(source.data_type, source.component_id)
            for target in targets
            for source in self._sources
        )
        if self._process is None or self._process.poll() is not None:
            if not is_wanted:
                return
            self._start()
        try:
            self._pipe.send(targets)
        except OSError:
            rospy.logwarn("the process for images and clouds has ended; the next request starts it")

    def _start(self) -> None:
        self.stop()
        self._lock.is_shared = True
        self._pipe, theirs = Pipe()
        files = (theirs.fileno(), self._socket.fileno(), self._lock.file)
        words = [sys.executable, "-m", "ardee_bridge.frames", *map(str, files), *_remappings()]
        space = rospy.get_namespace()
        self._process = subprocess.Popen(
            words,
            stdin=subprocess.DEVNULL,
            pass_fds=files,
            env=dict(os.environ, ROS_NAMESPACE=space),
        )
        theirs.close()
        self._pipe.send((rospy.get_name().rpartition("/")[2], self._values))

    def stop(self) -> None:
        """End it."""
        if self._process is None:
            return
        self._pipe.close()
        try:
            self._process.wait(PATIENCE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self._process = None


def main() -> None:
    """Body of the process."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C is the server's, whose end ends the pipe
    pipe_file, socket_file, lock_file = map(int, sys.argv[1:4])
    pipe = Connection(pipe_file)
    sys.setswitchinterval(ros_node.SWITCH_INTERVAL_S)
    try:
        name, values = pipe.recv()
        rospy.init_node(f"{name}_frames", disable_rostime=True, disable_signals=True)
        _serve(pipe, values, socket.socket(fileno=socket_file), lock_file)
    except EOFError:
        pass
    rospy.signal_shutdown("the sensor server has ended")


def _serve(pipe: Connection, values: Dict[str, Any], opened: socket.socket, lock_file: int) -> None:
    counters = Counters(rospy.logwarn)
    settings = read_server(values)
    lock = PairLock(lock_file, is_shared=True, priority=settings.realtime_priority)
    server = SensorServer(settings, opened, counters, lock=lock)
    server.set_clients(())
    subscriptions = Subscriptions([s for s in settings.sources if s.is_frame], server, by_rospy)
    ros_node.start_diagnostics(rospy.get_name(), counters)
    while not rospy.is_shutdown():
        if pipe.poll(ros_node.POLL_S):
            server.set_clients(pipe.recv())
            subscriptions.update()


if __name__ == "__main__":
    main()
