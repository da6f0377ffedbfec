# SPDX-License-Identifier: MIT
"""Tells when scans have stopped, so that the last command does not stay in force."""
from typing import Optional, Tuple


class Silence:
    """Silence by the shorter time of two clocks: the simulation's, which stops in a pause, and the wall's.

    By the simulation's clock alone, a run many times faster than real time would be silent while a scan is on its way.
    """

    def __init__(self, longest_s: float) -> None:
        self._longest_s = longest_s
        self._heard_s = None  # type: Optional[Tuple[float, float]]

    def end(self, simulated_s: float, wall_s: float) -> None:
        """Ends the silence: a scan was answered now."""
        self._heard_s = (simulated_s, wall_s)

    def begins(self, simulated_s: float, wall_s: float) -> bool:
        """Returns whether the silence has just become too long; true once a silence, never before the first scan."""
        if self._heard_s is None:
            return False
        since_s = min(simulated_s, self._heard_s[0])  # less: the simulation was started again
        self._heard_s = (since_s, self._heard_s[1])
        if min(simulated_s - since_s, wall_s - self._heard_s[1]) <= self._longest_s:
            return False
        self._heard_s = None
        return True
