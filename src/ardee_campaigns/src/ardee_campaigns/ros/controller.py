# SPDX-License-Identifier: MIT
"""A controller that is a ROS node or launch file, which subscribes and publishes as on a robot."""
import contextlib
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
from ardee_campaigns.ros.answers import CATCH_UP_WITHIN_S, Answers, NeverQuiet
from ardee_common.errors import GeneratorError
from ardee_common.process import HEED_CTRL_C, start_child, stop_child

START_WITHIN_S = 30.0  # from the start of the node to its first command
_ENDS_WITHIN_S = 5.0  # after it has left its topics
SIMULATOR = "/gazebo"  # name of the node simulator


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
        if not (realtime or robot.topics.get(robot.pace)):
            found = f"robot {robot.name}: found no topic of its pace {robot.pace!r}"
            raise GeneratorError(
                f"{found}, expected one whose readings a node answers, or realtime: true"
            )
        self._command = filled(command, params)
        self._topic, self._pace = (
            rosgraph.names.ns_join("/", robot.topics.get(use, ""))
            for use in ("command", robot.pace)
        )
        self._period_s, self._is_realtime = robot.period_s, realtime
        self._child: Optional[subprocess.Popen] = None
        self._subscriber: Optional[rospy.Subscriber] = None
        self._answers = Answers(self._check_alive)
        self._due_s: Optional[float] = None  # when the first command must have come
        self._has_commanded = False

    def attach(self, driven: Any) -> None:
        """Takes the robot, whose time goes on while the node starts in real time."""
        self._advance = driven.advance

    def reset(self) -> None:
        """Starts the node anew."""
        self.close()
        if self._answers.is_any:
            self._due_s = None
        self._answers = Answers(self._check_alive)
        self._began: Optional[Tuple[float, float]] = None
        self._log = tempfile.NamedTemporaryFile(prefix="node_", suffix=".log")
        words = [*HEED_CTRL_C, *self._command]
        self._child = start_child(words, log=Path(self._log.name))
        self._subscriber = rospy.Subscriber(self._topic, Twist, self._answers.put, tcp_nodelay=True)
        if self._is_realtime:
            self._wait_for_first_command()
            return
        self._wait_until_connected()
        self._answers.clear()  # they answer no reading

    def step(self, observation: Observation, time_s: float) -> Tuple[float, float]:
        """Returns the node's command."""
        now_s = time.monotonic()
        if self._began is None:
            self._began = now_s, time_s
        if self._is_realtime:
            self._answers.take_until(self._began[0] + time_s - self._began[1] + self._period_s)
        else:
            self._take_answer()
        self._check_deadline(now_s)
        return self._answers.latest

    def _take_answer(self) -> None:
        try:
            self._answers.take_answer(self._period_s)
        except NeverQuiet:
            what = f"was silent, then published {self._topic} for {CATCH_UP_WITHIN_S:.0f} s"
            hint = "realtime: true is for a node that commands at times of its own"
            raise self._error(f"{what} without a reading; {hint}") from None

    def _check_deadline(self, now_s: float) -> None:
        """Raises unless the node has commanded in time; being started anew before that gives it no more."""
        self._has_commanded |= self._answers.is_any
        if self._due_s is None:
            self._due_s = now_s + START_WITHIN_S
        if not self._answers.is_any and time.monotonic() > self._due_s:
            raise self._silent()

    def check_end(self) -> None:
        """Raises if no command has come in the whole run."""
        if not self._has_commanded:
            raise self._error(f"sent nothing on {self._topic}")

    def _wait_for_first_command(self) -> None:
        """Lets simulated time go on as the wall's while the robot stands and the node starts."""
        begin_s = due_s = time.monotonic()
        while not self._answers.is_any:
            if due_s > begin_s + START_WITHIN_S:
                raise self._silent()
            self._advance()
            due_s += self._period_s
            self._answers.take_until(due_s)

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
        is_gone = self._answers.is_any and not self._subscriber.get_num_connections()
        with contextlib.suppress(subprocess.TimeoutExpired):  # one that leaves its topics is ending
            code = self._child.wait(_ENDS_WITHIN_S if is_gone else 0.0)
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
