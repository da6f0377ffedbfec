# SPDX-License-Identifier: MIT
"""A controller that is a ROS node or launch file, which subscribes and publishes as on a robot."""
import contextlib
import queue
import subprocess
import tempfile
import time
import xmlrpc.client
from pathlib import Path
from typing import Any, Mapping, Optional, Sequence, Set, Tuple

import rosgraph
import rospy
from geometry_msgs.msg import Twist

from ardee_campaigns.program import check, filled
from ardee_campaigns.robot import Observation, Robot
from ardee_common.errors import GeneratorError
from ardee_common.process import HEED_CTRL_C, start_child, stop_child

START_WITHIN_S = 30.0  # from the start of the node to its first command
ANSWER_WITHIN_S = 2.0  # then it is taken for silent, and not waited for until it commands again
SIMULATOR = "/gazebo"  # name of the node simulator
_POLL_S = 0.1


def connections(publisher: str) -> Set[Tuple[str, str]]:
    """Returns topic and subscriber of each connection that a node has made for its messages."""
    master = rosgraph.Master(rospy.get_name())
    node = xmlrpc.client.ServerProxy(master.lookupNode(publisher))
    _, _, found = node.getBusInfo(rospy.get_name())
    return {(topic, other) for _, other, direction, _, topic, *_ in found if direction == "o"}


class RosController:
    """Starts the node; each reading of the robot's pace is answered by the node's next command.

    In real time the last command holds that has come before the next reading.
    """

    def __init__(
        self, command: Sequence[str], params: Mapping[str, Any], robot: Robot, realtime: bool
    ) -> None:
        check(command, params)
        self._command = filled(command, params)
        self._topic, self._pace = (
            rosgraph.names.ns_join("/", robot.topics.get(use, ""))
            for use in ("command", robot.pace)
        )
        self._period_s, self._is_realtime = robot.period_s, realtime
        self._child: Optional[subprocess.Popen] = None
        self._subscriber: Optional[rospy.Subscriber] = None

    def attach(self, driven: Any) -> None:
        """Takes the robot, whose time goes on while the node starts in real time."""
        self._advance = driven.advance

    def reset(self) -> None:
        """Starts the node anew."""
        self.close()
        self._commands: "queue.Queue[Twist]" = queue.Queue()
        self._latest = (0.0, 0.0)
        self._began: Optional[Tuple[float, float]] = None
        self._has_commanded, self._is_silent = False, False
        self._log = tempfile.NamedTemporaryFile(prefix="node_", suffix=".log")
        words = [*HEED_CTRL_C, *self._command]
        self._child = start_child(words, log=Path(self._log.name))
        self._subscriber = rospy.Subscriber(
            self._topic, Twist, self._commands.put, tcp_nodelay=True
        )
        if self._is_realtime:
            self._wait_for_first_command()
            return
        self._wait_until_connected()
        with self._commands.mutex:  # they answer no reading
            self._commands.queue.clear()

    def step(self, observation: Observation, time_s: float) -> Tuple[float, float]:
        """Returns the node's command."""
        now_s = time.monotonic()
        if self._began is None:
            self._began = now_s, time_s
        if self._is_realtime:
            self._listen(self._began[0] + time_s - self._began[1] + self._period_s, is_all=True)
        else:
            self._listen(now_s + (self._period_s if self._is_silent else ANSWER_WITHIN_S))
        if not self._has_commanded and now_s > self._began[0] + START_WITHIN_S:
            raise self._silent()
        return self._latest

    def _listen(self, until_s: float, *, is_all: bool = False) -> None:
        """Takes commands until a time, or until one has come."""
        self._is_silent = True
        while True:
            left_s = until_s - time.monotonic()
            try:
                command = self._commands.get(timeout=max(min(left_s, _POLL_S), 1e-4))
            except queue.Empty:
                self._check_alive()
                if left_s < 0.0:
                    return
                continue
            self._latest = command.linear.x, command.angular.z
            self._has_commanded, self._is_silent = True, False
            if not is_all and self._commands.empty():
                return

    def _wait_for_first_command(self) -> None:
        """Lets simulated time go on as the wall's while the robot stands and the node starts."""
        begin_s = due_s = time.monotonic()
        while not self._has_commanded:
            if due_s > begin_s + START_WITHIN_S:
                raise self._silent()
            self._advance()
            due_s += self._period_s
            self._listen(due_s, is_all=True)

    def _silent(self) -> GeneratorError:
        return self._error(f"sent nothing on {self._topic} in {START_WITHIN_S:.0f} s")

    def _wait_until_connected(self) -> None:
        end_s = time.monotonic() + START_WITHIN_S
        ours = self._pace, rospy.get_name()
        while not (
            self._subscriber.get_num_connections()
            and any(found[0] == self._pace and found != ours for found in connections(SIMULATOR))
        ):
            self._check_alive()
            if time.monotonic() > end_s:
                what = f"did not publish {self._topic} and subscribe to {self._pace}"
                hint = "realtime: true starts the clock before that"
                raise self._error(f"{what}, the robot's pace, in {START_WITHIN_S:.0f} s; {hint}")
            time.sleep(0.02)

    def _check_alive(self) -> None:
        is_gone = self._has_commanded and not self._subscriber.get_num_connections()
        with contextlib.suppress(subprocess.TimeoutExpired):  # one that leaves its topics is ending
            code = self._child.wait(float(is_gone))
            raise self._error(f"has ended with exit code {code}")
        if is_gone:
            raise self._error(f"publishes {self._topic} no more")

    def _error(self, what: str) -> GeneratorError:
        lines = Path(self._log.name).read_text(errors="replace").strip().splitlines()
        return GeneratorError(f"{' '.join(self._command)} {what}: {' | '.join(lines[-2:])}")

    def close(self) -> None:
        """Ends the node."""
        if self._child is None:
            return
        stop_child(self._child)
        self._subscriber.unregister()
        self._log.close()
        self._child = None
