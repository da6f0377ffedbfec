# SPDX-License-Identifier: MIT
"""Answers of a row follower in another process to each scan, by the scan's simulated time."""
import threading
import time
from typing import Callable, Dict, Optional


class Answers:
    """Queue of answers, filled by one thread in the order of time, emptied by another."""

    def __init__(self) -> None:
        self._by_time_ms: Dict[int, dict] = {}
        self._lock = threading.Lock()

    @staticmethod
    def _key(time_s: float) -> int:
        return round(1e3 * time_s)

    def put(self, answer: dict) -> None:
        """Adds an answer with its scan's `time_s`."""
        with self._lock:
            self._by_time_ms[self._key(answer["time_s"])] = answer

    def _look(self, wanted: int) -> Optional[dict]:
        """Returns the answer; empty if a later scan has one, so none will come; None if it may still come."""
        with self._lock:
            for key in [key for key in self._by_time_ms if key < wanted]:
                del self._by_time_ms[key]
            return self._by_time_ms.pop(wanted, {} if self._by_time_ms else None)

    def take(
        self, time_s: float, patience_s: float, check: Callable[[], None] = lambda: None
    ) -> Optional[dict]:
        """Returns the answer to the scan of a time; None once a later scan has one, or after `patience_s` of wall time.

        Scans must be asked for in the order of time. `check` is called repeatedly meanwhile; it may raise.
        """
        deadline, wanted = time.monotonic() + patience_s, self._key(time_s)
        while True:
            found = self._look(wanted)
            if found is not None or time.monotonic() > deadline:
                return found or None
            check()
            time.sleep(0.001)
