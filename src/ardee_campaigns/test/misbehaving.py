# SPDX-License-Identifier: MIT
"""Controllers that no campaign may stumble over."""
import contextlib
import math
import os
import signal
import time
from pathlib import Path
from typing import Any, Mapping, Tuple


class Misbehaving:
    """Drives on for some steps, then does what its name says."""

    def __init__(self, how: str, after: int = 5, marks: str = "") -> None:
        self._how, self._left, self._marks = how, after, marks

    def reset(self) -> None:
        """Does nothing."""

    def step(self, observation: Mapping[str, Any], time_s: float) -> Tuple[float, float]:
        """Returns a command, or does not."""
        self._left -= 1
        if self._left > 0:
            return 0.5, 0.0
        return getattr(self, self._how)()

    def raises(self) -> Tuple[float, float]:
        raise KeyError("no such\nrow")

    def hangs(self) -> Tuple[float, float]:
        while True:
            time.sleep(60)

    def returns_nan(self) -> Tuple[float, float]:
        return math.nan, 0.0

    def returns_none(self) -> None:
        return None

    def eats_memory(self) -> Tuple[float, float]:
        held = []
        while True:
            held.append(bytearray(50 << 20))

    def loses_ctrl_c(self) -> Tuple[float, float]:
        with contextlib.suppress(BaseException):
            signal.raise_signal(signal.SIGINT)
        return 0.5, 0.0

    def dies(self) -> Tuple[float, float]:
        os.kill(os.getpid(), signal.SIGKILL)
        return 0.0, 0.0

    def dies_once(self) -> Tuple[float, float]:
        mark = Path(self._marks) / "died"
        if not mark.exists():
            mark.touch()
            self.dies()
        return 0.5, 0.0


def make(params: Mapping[str, Any], robot: Any, seed: int) -> Misbehaving:
    """Returns the controller."""
    return Misbehaving(**params)


def endless(run: Any, truth: Any) -> float:
    """A measure that raises."""
    raise ValueError("no measure")


def samples(run: Any, truth: Any) -> float:
    """A measure: the number of samples."""
    return len(run["time_ns"])


def distance_m(run: Any, truth: Any) -> float:
    """Measures what a shipped one of the same name does."""
    return 0.0


def seed(run: Any, truth: Any) -> float:
    """Measures something that has the name of another column."""
    return 0.0
