# SPDX-License-Identifier: MIT
"""Environments side by side, a process each; the numbers of environment i do not depend on how many there are."""

import atexit
import weakref
from functools import partial
from typing import Any, ClassVar

import gymnasium
from gymnasium.vector import AsyncVectorEnv

_END_S = 5.0  # that the step of a worker may take at the end of the program


class ArdeeVectorEnv(AsyncVectorEnv):
    """Worker processes that share memory; environment i has the seed of reset() + i.

    Processes are spawned, not forked: a simulation has threads.
    """

    env_id: ClassVar[str]

    def __init__(self, num_envs: int = 1, **arguments: Any) -> None:
        make = partial(gymnasium.make, f"ardee_sim.envs:{self.env_id}", **arguments)
        super().__init__([make] * num_envs, context="spawn")
        # workers are killed where the program ends, before they delete their fields
        atexit.register(_close, weakref.ref(self))


def _close(envs: "weakref.ref[ArdeeVectorEnv]") -> None:
    open_envs = envs()
    if open_envs is not None and not open_envs.closed:
        open_envs.close(timeout=_END_S)


class RowFollowVectorEnv(ArdeeVectorEnv):
    """Environments of ardee/RowFollow-v0."""

    env_id = "ardee/RowFollow-v0"


class RowFollowCameraVectorEnv(ArdeeVectorEnv):
    """Environments of ardee/RowFollowCamera-v0."""

    env_id = "ardee/RowFollowCamera-v0"


class HeadlandTurnVectorEnv(ArdeeVectorEnv):
    """Environments of ardee/HeadlandTurn-v0."""

    env_id = "ardee/HeadlandTurn-v0"


class GoToVectorEnv(ArdeeVectorEnv):
    """Environments of ardee/GoTo-v0."""

    env_id = "ardee/GoTo-v0"
