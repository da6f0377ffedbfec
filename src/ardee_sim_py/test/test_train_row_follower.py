# SPDX-License-Identifier: MIT
"""Tests the training script's loop with stand-ins for torch and stable-baselines3, whose learner does not learn."""
import argparse
import importlib
import signal
import sys
from collections import deque
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import Any, Callable, Iterator, List

import gymnasium
import numpy as np
import pytest
from ardee_sim.examples import row_follower
from ardee_sim.examples.row_follower import Follower
from PIL import Image

SCRIPT = "ardee_sim.examples.train_row_follower"
EPISODE_STEPS, UPDATE_STEPS = 110, 100


class Monitor(gymnasium.Wrapper):
    """Puts an episode's return into the last info, as that of stable-baselines3."""

    def __init__(self, env: gymnasium.Env, info_keywords: Any) -> None:
        super().__init__(env)
        self._keywords, self._return = info_keywords, 0.0

    def step(self, action: Any) -> Any:
        observation, reward, terminated, truncated, info = self.env.step(action)
        self._return += float(reward)
        if terminated or truncated:
            told = {key: info[key] for key in self._keywords}
            info["episode"], self._return = {"r": self._return, **told}, 0.0
        return observation, reward, terminated, truncated, info


class Envs:
    """Steps environments in this process."""

    def __init__(self, makers: List[Callable[[], Any]], start_method: str) -> None:
        self.envs = [make() for make in makers]
        self.num_envs = len(makers)

    def close(self) -> None:
        for env in self.envs:
            env.close()


class Layer:
    """Weights and biases that read as torch's."""

    def __init__(self, weights: np.ndarray, biases: np.ndarray) -> None:
        self.weight, self.bias = (
            SimpleNamespace(detach=lambda array=array: SimpleNamespace(numpy=lambda: array))
            for array in (weights, biases)
        )


class Straight:
    """Drives straight on at a bit more than half speed: a learner that learns nothing."""

    def __init__(self, kind: str, envs: Envs, n_steps: int, **options: Any) -> None:
        self._envs, self._n_steps, self.seed = envs, n_steps, options["seed"]
        self.num_timesteps = 0
        self.ep_info_buffer: Any = deque(maxlen=100)
        hidden = Layer(np.zeros((3, 144), np.float32), np.zeros(3, np.float32))
        net = [hidden, SimpleNamespace()]  # a layer, and a tanh
        self.policy = SimpleNamespace(
            mlp_extractor=SimpleNamespace(policy_net=net),
            action_net=Layer(np.zeros((2, 3), np.float32), np.array([0.3, 0.0], np.float32)),
        )

    def learn(self, steps: int, callback: Any, reset_num_timesteps: bool) -> None:
        callback.model, end = self, self.num_timesteps + steps
        for env in self._envs.envs:
            env.reset(seed=self.seed)
        while self.num_timesteps < end:
            callback.num_timesteps = self.num_timesteps
            callback._on_rollout_start()
            for _ in range(self._n_steps):
                self.num_timesteps += self._envs.num_envs
                for env in self._envs.envs:
                    info = env.step(np.array([0.3, 0.0], np.float32))[4]
                    if "episode" in info:
                        self.ep_info_buffer.append(info["episode"])
                        env.reset()
        callback.num_timesteps = self.num_timesteps

    def save(self, path: Path) -> None:
        path.write_text(str(self.num_timesteps))

    @classmethod
    def load(cls, path: Path, env: Envs, device: str) -> "Straight":
        model = cls("", env, UPDATE_STEPS, seed=0)
        model.num_timesteps = int(path.read_text())
        return model

    def set_random_seed(self, seed: int) -> None:
        self.seed = seed


@pytest.fixture
def script(monkeypatch: pytest.MonkeyPatch) -> Iterator[Any]:
    """Yields the script with stand-ins, short rows and short updates."""
    made = {
        "torch": dict(set_num_threads=lambda count: None, __version__="0"),
        "stable_baselines3": dict(PPO=Straight, __version__="0"),
        "stable_baselines3.common": {},
        "stable_baselines3.common.callbacks": dict(BaseCallback=object),
        "stable_baselines3.common.monitor": dict(Monitor=Monitor),
        "stable_baselines3.common.vec_env": dict(SubprocVecEnv=Envs),
    }
    for name, members in made.items():
        module = ModuleType(name)
        module.__dict__.update(members)
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.delitem(sys.modules, SCRIPT, raising=False)
    handler = signal.getsignal(signal.SIGINT)  # which a worker gives up
    loaded: Any = importlib.import_module(SCRIPT)
    monkeypatch.setitem(loaded.CORN, "row_length_m", (2.0, 2.0))
    monkeypatch.setattr(loaded, "MAX_EPISODE_STEPS", EPISODE_STEPS)
    monkeypatch.setattr(loaded, "UPDATE_STEPS", UPDATE_STEPS)
    monkeypatch.setattr(loaded, "UNSEEN_LENGTH_M", 2.0)
    yield loaded
    signal.signal(signal.SIGINT, handler)
    del sys.modules[SCRIPT]


@pytest.mark.slow
def test_a_training_keeps_its_policy_goes_on_and_draws_its_drives(
    script: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    words = [SCRIPT, str(tmp_path), "--workers", "1", "--drives", "1", "--steps"]
    monkeypatch.setattr(sys, "argv", [*words, "150"])
    script.main()
    said = capsys.readouterr().out
    assert "200 steps, " in said and "% reached the row's end" in said and "CPU minutes" in said
    assert "seed 1000: " in said and "of 1 reached the row's end" in said
    follower = Follower.load(tmp_path / "row_follower.npz")
    assert follower.made_by["command"] == "train_row_follower --steps 150 --seed 1 --workers 1"
    assert follower(np.ones(144)) == pytest.approx([0.3, 0.0])
    steps, returns, reached = follower.curve.T
    assert steps.tolist() == [100, 200] and np.all(returns > 1.0) and np.all(reached == 1.0)
    with Image.open(tmp_path / "row_follower.png") as picture:
        assert len(picture.convert("RGB").getcolors(1 << 20)) > 20

    script.train(argparse.Namespace(folder=tmp_path, steps=300, seed=1, workers=1))
    assert "going on from 200 steps" in capsys.readouterr().out
    follower = Follower.load(tmp_path / "row_follower.npz")
    assert follower.made_by["resumed_at_steps"] == 200
    assert follower.curve[:, 0].tolist() == [100, 200, 300]


def test_a_training_that_is_interrupted_says_how_to_go_on(
    script: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: Any, **__: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(Straight, "learn", interrupted)
    with pytest.raises(SystemExit, match="the same command goes on"):
        script.train(argparse.Namespace(folder=tmp_path, steps=100, seed=1, workers=1))


def test_a_missing_learner_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "torch", None)
    monkeypatch.delitem(sys.modules, SCRIPT, raising=False)
    with pytest.raises(SystemExit, match="expected: pip install stable-baselines3"):
        importlib.import_module(SCRIPT)


def test_the_real_learner_trains(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pytest.importorskip("stable_baselines3", reason="stable-baselines3 is the user's to install")
    script: Any = importlib.import_module(SCRIPT)
    monkeypatch.setattr(script, "UPDATE_STEPS", 512)
    options = argparse.Namespace(folder=tmp_path, steps=1024, seed=1, workers=2)
    follower = Follower.load(script.train(options))
    assert len(follower.layers) == 3 and follower.curve[-1][0] == 1024
    assert row_follower.drive_unseen(follower, 1, 2.0)[0].track.shape[1] == 2
