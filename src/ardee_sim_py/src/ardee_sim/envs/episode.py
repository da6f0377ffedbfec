# SPDX-License-Identifier: MIT
"""Episodes as files: what an environment drew, and what was done in it."""

import json
from dataclasses import asdict, dataclass
from pathlib import Path, PurePath
from typing import Any, Dict, Iterator, List, Mapping, Optional, SupportsFloat, Tuple

import gymnasium
import numpy as np
from ardee_sim import checks
from ardee_sim.envs.field_env import FieldEnv
from ardee_sim.errors import ArdeeError
from ardee_sim.world import PathLike, read_text

_KEYS = ("environment", "arguments", "replay", "actions")
_LIMIT = "max_episode_steps"  # which older files have not


def _plain(value: Any) -> Any:
    """Returns what JSON has not as what it has. Raises ArdeeError for what would not come back equal in effect."""
    if isinstance(value, (np.generic, np.ndarray)) and value.dtype.kind in "biufU":
        return value.tolist()
    if isinstance(value, PurePath):
        return str(value)
    raise ArdeeError(
        f"found {value!r} in an episode, expected numbers, texts, paths, and lists and dicts of them"
    )


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


@dataclass(frozen=True)
class Episode:
    """An episode of an environment of this package, which play() repeats byte for byte.

    environment : id such as ardee/RowFollow-v0
    arguments : of gymnasium.make
    replay : of the info of reset()
    actions : of each step, lists of numbers
    max_episode_steps : of gymnasium.make; None: as registered, -1: no truncation
    """

    environment: str
    arguments: Dict[str, Any]
    replay: Dict[str, Any]
    actions: List[List[float]]
    max_episode_steps: Optional[int] = None

    def save(self, path: PathLike) -> None:
        """Writes a JSON file. Raises ArdeeError if an argument is neither number, text nor path."""
        Path(path).write_text(json.dumps(asdict(self), indent=1, default=_plain) + "\n")

    @classmethod
    def load(cls, path: PathLike) -> "Episode":
        """Reads a file of save(). Raises ArdeeError if it is none."""
        try:
            given = json.loads(read_text(Path(path)))
        except json.JSONDecodeError as error:
            raise ArdeeError(f"{path}: {error}, expected JSON") from None
        if not isinstance(given, dict) or given.keys() - {_LIMIT} != {*_KEYS}:
            raise ArdeeError(f"{path}: found no episode, expected the keys {', '.join(_KEYS)}")
        for key, kind in zip(_KEYS, (str, dict, dict, list)):
            if not isinstance(given[key], kind):
                raise ArdeeError(
                    f"{path}: {key}: found {given[key]!r:.60}, expected a {kind.__name__}"
                )
        for number, action in enumerate(given["actions"]):
            if not isinstance(action, list) or not all(map(_is_number, action)):
                raise ArdeeError(
                    f"{path}: actions[{number}]: found {action!r:.60}, expected a list of numbers"
                )
        limit = given.get(_LIMIT)
        if limit is not None and (type(limit) is not int or limit < -1 or limit == 0):
            raise ArdeeError(
                f"{path}: {checks.found(limit, _LIMIT)}, expected null, -1 or a positive whole number"
            )
        return cls(**given)

    def make(self) -> gymnasium.Env:
        """Makes the environment. Raises ArdeeError if it is no FieldEnv."""
        found = f"found environment '{self.environment}'"
        if ":" in self.environment:  # gymnasium imports the module before it, any that a file names
            raise ArdeeError(f"{found}, expected an id without a module")
        try:
            env = gymnasium.make(
                self.environment, max_episode_steps=self.max_episode_steps, **self.arguments
            )
        except (gymnasium.error.Error, TypeError) as error:
            raise ArdeeError(f"{found}: {error}") from error
        if not isinstance(env.unwrapped, FieldEnv):
            env.close()
            raise ArdeeError(f"{found}, expected one of ardee's")
        return env

    def play(self, env: gymnasium.Env) -> Iterator[Tuple[Any, ...]]:
        """Repeats the episode in an environment of make(); yields what reset() returns, then what each step() does."""
        yield env.reset(options=self.replay)
        for action in self.actions:
            yield env.step(np.array(action))


class RecordEpisode(gymnasium.Wrapper):
    """Records the present episode of an environment of this package, with the actions that wrappers made."""

    def __init__(self, env: gymnasium.Env) -> None:
        super().__init__(env)
        if env.spec is None:
            raise ArdeeError("found an environment without id, expected one of gymnasium.make")
        if not isinstance(env.unwrapped, FieldEnv):
            raise ArdeeError(f"found environment '{env.spec.id}', expected one of ardee's")
        self._driven = env.unwrapped
        self._limit = env.spec.max_episode_steps or -1
        self._id, self._arguments = env.spec.id, dict(env.spec.kwargs)
        self._replay: Dict[str, Any] = {}
        self._actions: List[List[float]] = []

    def reset(
        self, *, seed: Optional[int] = None, options: Optional[Mapping[str, Any]] = None
    ) -> Tuple[Any, Dict[str, Any]]:
        """Begins another record."""
        observation, info = self.env.reset(seed=seed, options=options)  # type: ignore[arg-type]
        self._replay, self._actions = info["replay"], []
        return observation, info

    def step(self, action: Any) -> Tuple[Any, SupportsFloat, bool, bool, Dict[str, Any]]:
        """Drives, and records what the environment did."""
        result = self.env.step(action)
        self._actions.append(self._driven.action.tolist())
        return result

    @property
    def episode(self) -> Episode:
        """The episode since the last reset()."""
        if not self._replay:
            raise RuntimeError("found no episode, expected reset() first")
        return Episode(self._id, self._arguments, self._replay, list(self._actions), self._limit)
