# SPDX-License-Identifier: MIT
"""Gymnasium environments: importing this module registers them."""

try:
    import gymnasium
except ImportError as error:
    raise ImportError(f"{error}; expected: pip install gymnasium") from error

from ardee_sim.envs.environments import GoToEnv, HeadlandTurnEnv, RowFollowCameraEnv, RowFollowEnv
from ardee_sim.envs.episode import Episode, RecordEpisode
from ardee_sim.envs.field_env import FieldEnv
from ardee_sim.envs.task import Scene, Task

__all__ = [
    "Episode",
    "FieldEnv",
    "GoToEnv",
    "HeadlandTurnEnv",
    "RecordEpisode",
    "RowFollowCameraEnv",
    "RowFollowEnv",
    "Scene",
    "Task",
]

for _name, _env, _max_episode_steps in (
    ("RowFollow", RowFollowEnv, 600),
    ("RowFollowCamera", RowFollowCameraEnv, 600),
    ("HeadlandTurn", HeadlandTurnEnv, 300),
    ("GoTo", GoToEnv, 600),
):
    gymnasium.register(
        f"ardee/{_name}-v0",
        entry_point=f"ardee_sim.envs.environments:{_env.__name__}",
        vector_entry_point=f"ardee_sim.envs.vector:{_name}VectorEnv",
        max_episode_steps=_max_episode_steps,
    )
