# SPDX-License-Identifier: MIT
"""Counts successes, and drops with their reasons; the first of each kind is logged, then a few."""
import threading
import time
from collections import Counter
from typing import Callable, Dict

LOG_AGAIN_S = 10.0


class Counters:
    """Thread-safe counters; `warn` gets one line for a kind of drop at once, then at most every LOG_AGAIN_S."""

    def __init__(
        self, warn: Callable[[str], None], clock: Callable[[], float] = time.monotonic
    ) -> None:
        self._warn, self._clock = warn, clock
        self._lock = threading.Lock()
        self._done: "Counter[str]" = Counter()
        self._dropped: "Counter[str]" = Counter()
        self._logged: Dict[str, float] = {}
        self._said: "Counter[str]" = Counter()

    def did(self, kind: str) -> None:
        """Counts a success."""
        with self._lock:
            self._done[kind] += 1

    def drop(self, kind: str, detail: str = "", count: int = 1) -> None:
        """Counts a drop; `detail` describes this one, `kind` all drops like it."""
        now = self._clock()
        with self._lock:
            self._dropped[kind] += count
            if now - self._logged.get(kind, -LOG_AGAIN_S) < LOG_AGAIN_S:
                return
            self._logged[kind] = now
            fresh = self._dropped[kind] - self._said[kind]
            self._said[kind] = self._dropped[kind]
        self._warn(f"dropped {fresh}: {kind}{', ' + detail if detail else ''}")

    def done(self) -> Dict[str, int]:
        """Returns the counts of successes so far, by kind."""
        with self._lock:
            return dict(self._done)

    def dropped(self) -> Dict[str, int]:
        """Returns the counts of drops so far, by reason."""
        with self._lock:
            return dict(self._dropped)
