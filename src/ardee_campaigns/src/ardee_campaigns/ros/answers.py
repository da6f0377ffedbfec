# SPDX-License-Identifier: MIT
"""Commands of a node as they come, and which of them is the answer to a reading."""
import queue
import time
from typing import Any, Callable, Tuple

ANSWER_WITHIN_S = 2.0  # then a node is taken for silent, and not waited for until it commands again
CATCH_UP_WITHIN_S = 30.0  # for its answers to readings of the time when it was silent
_POLL_S = 0.1


class NeverQuiet(Exception):
    """Error of a node that commands though it has no reading left to answer."""


class Answers:
    """Commands of a node.

    check_alive : called while none comes
    latest : speed [m/s] and turn rate [rad/s] of the last one, at first zeros
    """

    def __init__(self, check_alive: Callable[[], None]) -> None:
        self._check_alive = check_alive
        self._queue: "queue.Queue[Any]" = queue.Queue()
        self.put = self._queue.put
        self.latest: Tuple[float, float] = (0.0, 0.0)
        self.is_any, self._is_silent = False, False

    def clear(self) -> None:
        """Forgets the commands that wait."""
        with self._queue.mutex:
            self._queue.queue.clear()

    def take_until(self, until_s: float) -> None:
        """Takes all commands until a time."""
        while self._take(until_s):
            pass

    def take_answer(self, period_s: float) -> None:
        """Takes the answer to the last reading; of a silent node what comes in a period.

        One that was silent answers older readings first: they are passed over until it is quiet again.
        """
        was_silent, now_s = self._is_silent, time.monotonic()
        wait_s = period_s if was_silent else ANSWER_WITHIN_S
        self._is_silent = not self._take_waiting(now_s + wait_s)
        if not was_silent or self._is_silent:
            return
        while self._take_waiting(time.monotonic() + ANSWER_WITHIN_S):
            if time.monotonic() > now_s + CATCH_UP_WITHIN_S:
                raise NeverQuiet

    def _take_waiting(self, until_s: float) -> bool:
        """Takes a command that comes until a time, and those behind it; returns whether one has come."""
        is_any = self._take(until_s)
        while is_any and not self._queue.empty():
            self._take(until_s)
        return is_any

    def _take(self, until_s: float) -> bool:
        while True:
            left_s = until_s - time.monotonic()
            try:
                command = self._queue.get(timeout=max(min(left_s, _POLL_S), 1e-4))
            except queue.Empty:
                self._check_alive()
                if left_s < 0.0:
                    return False
                continue
            self.latest = command.linear.x, command.angular.z
            self.is_any = True
            return True
