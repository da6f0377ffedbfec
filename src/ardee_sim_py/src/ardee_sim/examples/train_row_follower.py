# SPDX-License-Identifier: MIT
"""Trains a row follower by PPO on straight corn, drives it down 50 m of corn that it has not seen, draws both.

Needs stable-baselines3 and matplotlib. Ctrl-C ends the training and keeps the policy of the last update; the same
command goes on from there. A training that was not interrupted gives the same bytes for the same seed and versions.
"""

import argparse
import os
import resource
import signal
import time
from pathlib import Path
from typing import Any, List, Mapping, Tuple

import gymnasium
import numpy as np
from ardee_sim.examples.row_follower import (
    UNSEEN_LENGTH_M,
    Follower,
    draw,
    drive_unseen,
    make_env,
    positive,
)

try:
    import torch
    from stable_baselines3 import PPO
    from stable_baselines3 import __version__ as sb3_version
    from stable_baselines3.common.callbacks import BaseCallback
    from stable_baselines3.common.monitor import Monitor
    from stable_baselines3.common.vec_env import SubprocVecEnv
except ImportError as error:
    raise SystemExit(f"{error}; expected: pip install stable-baselines3") from error

CORN = {
    "row_length_m": (15.0, 15.0),
    "row_spacing_m": (0.74, 0.80),
    "stalk_spacing_m": (0.12, 0.20),
    "emergence": (0.7, 1.0),
}
MAX_EPISODE_STEPS = 600
UPDATE_STEPS = 2048  # between two updates, of all workers together
KEEP_STEPS = 600  # in a field before the next is sown
LEARNING_RATE, LEAST_RATE = 3e-4, 1e-5


def training_env() -> gymnasium.Env:
    """Returns an environment for a worker process, which leaves Ctrl-C to the learner."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    env = make_env(CORN, MAX_EPISODE_STEPS, KEEP_STEPS)
    return Monitor(env, info_keywords=("end_reason",))


def learning_rate(part_left: float) -> float:
    """Returns the step of the optimiser, which falls linearly."""
    return LEAST_RATE + LEARNING_RATE * part_left


def new_model(envs: SubprocVecEnv, seed: int) -> PPO:
    """Returns an untrained policy that drives at half speed, straight on, with noise of 0.25."""
    return PPO(
        "MlpPolicy",
        envs,
        n_steps=UPDATE_STEPS // envs.num_envs,
        batch_size=256,
        learning_rate=learning_rate,
        policy_kwargs={"net_arch": [64, 64], "log_std_init": -1.4},
        seed=seed,
        device="cpu",
    )


def follower_of(model: PPO, curve: np.ndarray, made_by: Mapping[str, Any]) -> Follower:
    """Returns the policy's mean as plain arrays."""
    linear = [layer for layer in model.policy.mlp_extractor.policy_net if hasattr(layer, "bias")]
    layers = [
        (layer.weight.detach().numpy(), layer.bias.detach().numpy())
        for layer in (*linear, model.policy.action_net)
    ]
    return Follower(layers, made_by, curve)


class Keeper(BaseCallback):
    """Keeps the policy after each update, and tells how far the training is."""

    def __init__(
        self, folder: Path, made_by: Mapping[str, Any], curve: List[Tuple[float, ...]]
    ) -> None:
        super().__init__()
        self._folder, self._made_by, self._curve = folder, made_by, curve
        self._begin = time.monotonic()

    def _on_step(self) -> bool:
        return True

    def _on_rollout_start(self) -> None:
        if not self._curve or self.num_timesteps > self._curve[-1][0]:
            self.keep()

    def keep(self) -> None:
        """Writes model and follower, each at once, and prints a line; nothing before the first episode's end."""
        episodes = list(self.model.ep_info_buffer)
        if not episodes:
            return
        reached = float(np.mean([episode["end_reason"] == "row_end" for episode in episodes]))
        mean_return = float(np.mean([episode["r"] for episode in episodes]))
        self._curve.append((self.num_timesteps, mean_return, reached))
        follower = follower_of(self.model, np.array(self._curve), self._made_by)
        for name, save in (("model.zip", self.model.save), ("row_follower.npz", follower.save)):
            part = self._folder / f"part_{name}"
            save(part)
            os.replace(part, self._folder / name)
        print(
            f"{self.num_timesteps} steps, {(time.monotonic() - self._begin) / 60:.1f} min: "
            f"return {mean_return:.2f}, {100 * reached:.0f} % reached the row's end",
            flush=True,
        )


def train(arguments: argparse.Namespace) -> Path:
    """Trains, from where an earlier training in the folder stopped; returns the follower's file."""
    folder, seed = arguments.folder, arguments.seed
    folder.mkdir(parents=True, exist_ok=True)
    saved, follower_file = folder / "model.zip", folder / "row_follower.npz"
    torch.set_num_threads(1)
    envs = SubprocVecEnv([training_env] * arguments.workers, start_method="spawn")
    curve: List[Tuple[float, ...]] = []
    if saved.exists():
        model = PPO.load(saved, env=envs, device="cpu")
        model.set_random_seed(seed + model.num_timesteps)
        curve = [tuple(row) for row in Follower.load(follower_file).curve]
        print(f"{saved}: going on from {model.num_timesteps} steps")
    else:
        model = new_model(envs, seed)
    made_by = {
        "command": f"train_row_follower --steps {arguments.steps} --seed {seed} --workers {arguments.workers}",
        "resumed_at_steps": model.num_timesteps,
        "torch": torch.__version__,
        "stable_baselines3": sb3_version,
    }
    keeper = Keeper(folder, made_by, curve)
    try:
        left = arguments.steps - model.num_timesteps
        if left > 0:
            model.learn(left, callback=keeper, reset_num_timesteps=False)
            keeper.keep()
    except KeyboardInterrupt:
        raise SystemExit(
            f"interrupted; the same command goes on from the last update in {folder}"
        ) from None
    finally:
        envs.close()
    return follower_file


def cpu_minutes() -> float:
    """Returns the time for which this process and its ended workers have computed."""
    used = [resource.getrusage(who) for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN)]
    return sum(one.ru_utime + one.ru_stime for one in used) / 60


def main() -> None:
    """Runs the example."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, help="for the policy; an earlier training goes on")
    parser.add_argument("--steps", type=positive, default=50_000, help="of 0.1 s, default 50000")
    parser.add_argument("--seed", type=int, default=1, help="of policy and episodes, default 1")
    parser.add_argument(
        "--workers", type=positive, default=2, help="processes that drive, default 2"
    )
    parser.add_argument("--drives", type=positive, default=10, help="unseen fields, default 10")
    arguments = parser.parse_args()
    follower = Follower.load(train(arguments))
    print(f"{cpu_minutes():.1f} CPU minutes")
    drives = drive_unseen(follower, arguments.drives, UNSEEN_LENGTH_M)
    figure = arguments.folder / "row_follower.png"
    draw(follower, drives, figure)
    print(f"{figure}: learning curve and drives")


if __name__ == "__main__":
    main()
