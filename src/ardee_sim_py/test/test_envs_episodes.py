# SPDX-License-Identifier: MIT
"""Tests recorded episodes: what was driven is repeated, from a file too; worlds by name."""
import json
from pathlib import Path
from typing import Any, Iterator

import gymnasium
import numpy as np
import pytest
from ardee_sim import ArdeeError, World
from ardee_sim.envs import Episode, RecordEpisode
from test_envs import Make


@pytest.fixture
def recorded() -> Iterator[RecordEpisode]:
    env = RecordEpisode(gymnasium.make("ardee/RowFollow-v0", max_episode_steps=5, seed_field=False))
    yield env
    env.close()


@pytest.mark.parametrize("action", [np.array([0.7, 0.1]), [0.7, 0.1]])
def test_a_recorded_episode_is_repeated_whatever_its_actions_were(
    recorded: RecordEpisode, action: Any
) -> None:
    recorded.reset(seed=5)
    driven = [recorded.step(action)[0] for _ in range(4)]
    _, *again = recorded.episode.play(recorded.env)
    assert [each.tobytes() for each in driven] == [result[0].tobytes() for result in again]


def test_an_episode_of_a_file_is_truncated_as_the_recorded_one(
    recorded: RecordEpisode, tmp_path: Path
) -> None:
    recorded.reset(seed=5)
    truncated = [recorded.step([0.5, 0.0])[3] for _ in range(5)]
    assert truncated == [False] * 4 + [True]
    recorded.episode.save(tmp_path / "episode.json")
    episode = Episode.load(tmp_path / "episode.json")
    again = episode.make()
    _, *results = episode.play(again)
    again.close()
    assert [result[3] for result in results] == truncated


@pytest.mark.parametrize("given, limit", [({}, 600), ({"max_episode_steps": -1}, None)])
def test_an_episode_without_a_limit_of_its_own_is_made(
    given: Any, limit: Any, tmp_path: Path
) -> None:
    parts = dict(environment="ardee/RowFollow-v0", replay={}, actions=[], **given)
    file = tmp_path / "episode.json"
    file.write_text(json.dumps({**parts, "arguments": {"seed_field": False}}))
    env = Episode.load(file).make()
    env.close()
    assert env.spec is not None and env.spec.max_episode_steps == limit


@pytest.mark.parametrize("limit", ["0", "-2", "1.5", "true", '"x"'])
def test_a_limit_that_cannot_be_is_refused(limit: str, tmp_path: Path) -> None:
    parts = '"environment": "id", "arguments": {}, "replay": {}, "actions": []'
    file = tmp_path / "episode.json"
    file.write_text(f'{{{parts}, "max_episode_steps": {limit}}}')
    with pytest.raises(ArdeeError, match="max_episode_steps: found .*, expected null, -1 or"):
        Episode.load(file)


def test_an_environment_of_others_is_not_recorded() -> None:
    with pytest.raises(ArdeeError, match="'CartPole-v1', expected one of ardee's"):
        RecordEpisode(gymnasium.make("CartPole-v1"))


def test_a_world_is_found_by_its_name(make: Make) -> None:
    path = World.from_file("corn.world").path
    named, given = make(world="corn.world"), make(world=path)
    assert named.world.path == given.world.path
    assert np.array_equal(named.reset(seed=1)[0], given.reset(seed=1)[0])


class Halved(gymnasium.ActionWrapper):
    """Drives by half of the action."""

    def action(self, action: Any) -> Any:
        return np.asarray(action, np.float32) / 2


def test_what_a_wrapper_makes_of_an_action_is_recorded() -> None:
    env = RecordEpisode(Halved(gymnasium.make("ardee/RowFollow-v0", seed_field=False)))
    env.reset(seed=5)
    driven = [env.step(np.array([0.9, 0.4], np.float32))[0] for _ in range(4)]
    assert env.episode.actions[0] == np.array([0.45, 0.2], np.float32).tolist()
    again = env.episode.make()
    _, *results = env.episode.play(again)
    for each in (env, again):
        each.close()
    assert [each.tobytes() for each in driven] == [result[0].tobytes() for result in results]


@pytest.mark.parametrize(
    "name, said",
    [("this:Foo-v0", "an id without a module"), ("CartPole-v1", "expected one of ardee's")],
)
def test_an_episode_of_another_environment_is_refused(name: str, said: str) -> None:
    with pytest.raises(ArdeeError, match=f"found environment '{name}', .*{said}"):
        Episode(name, {}, {}, []).make()
