# SPDX-License-Identifier: MIT
"""A controller that plays a list of commands."""
from typing import Any, List, Mapping, Sequence, Tuple


class Scripted:
    """Commands in their order, each for a time; then it has finished."""

    def __init__(self, commands: Sequence[Sequence[float]]) -> None:
        self._commands: List[Tuple[float, float, float]] = [
            (float(for_s), float(speed), float(turn)) for for_s, speed, turn in commands
        ]
        self.reset()

    def reset(self) -> None:
        """Begins anew."""
        self._began_s = -1.0
        self.is_finished = False

    def step(self, observation: Mapping[str, Any], time_s: float) -> Tuple[float, float]:
        """Returns the command of this time."""
        if self._began_s < 0.0:
            self._began_s = time_s
        left_s = time_s - self._began_s
        for for_s, speed_m_s, turn_rad_s in self._commands:
            if left_s < for_s:
                return speed_m_s, turn_rad_s
            left_s -= for_s
        self.is_finished = True
        return 0.0, 0.0


def make(params: Mapping[str, Any], robot: Any, seed: int) -> Scripted:
    """Returns the controller of a campaign; params: commands, a list of [for_s, speed_m_s, turn_rad_s]."""
    return Scripted(**params)
