# SPDX-License-Identifier: MIT
"""A controller that drives on with a constant command."""
from typing import Any, Mapping, Tuple


class Constant:
    """Speed [m/s] and turn rate [rad/s] that never change."""

    def __init__(self, speed_m_s: float = 0.5, turn_rad_s: float = 0.0) -> None:
        self._command = speed_m_s, turn_rad_s

    def reset(self) -> None:
        """Does nothing: there is no state."""

    def step(self, observation: Mapping[str, Any], time_s: float) -> Tuple[float, float]:
        """Returns the command."""
        return self._command


def make(params: Mapping[str, Any], robot: Any, seed: int) -> Constant:
    """Returns the controller of a campaign; params: speed_m_s, turn_rad_s."""
    return Constant(**params)
