# SPDX-License-Identifier: MIT
"""Learns to follow a lane of corn: the cross-entropy method over a linear policy, a minute on one core."""

from typing import List

import ardee_sim.envs  # noqa: F401  registers the environments
import gymnasium
import numpy as np

SECTORS = 8  # of the scan
NEAR = 2 / 30  # ranges beyond 2 m of 30 m count as 2 m
GENERATIONS, POPULATION, BEST = 6, 16, 4


def act(policy: np.ndarray, scan: np.ndarray) -> np.ndarray:
    """Returns speed and turn rate, linear in the mean ranges of the scan's sectors."""
    near = np.minimum(scan / NEAR, 1.0)
    ranges = [sector.mean() for sector in np.array_split(near, SECTORS)]
    return np.tanh(policy.reshape(2, SECTORS + 1) @ np.array([*ranges, 1.0]))


def episode_return(env: gymnasium.Env, policy: np.ndarray, seed: int) -> float:
    """Returns the sum of an episode's rewards."""
    scan, _ = env.reset(seed=seed)
    total, is_over = 0.0, False
    while not is_over:
        scan, reward, terminated, truncated, _ = env.step(act(policy, scan))
        total, is_over = total + reward, terminated or truncated
    return total


def learn(env: gymnasium.Env, seed: int = 0) -> List[float]:
    """Returns the mean return of each generation's best; the first is that of a robot that stands still."""
    rng = np.random.default_rng(seed)
    mean, sd = np.zeros(2 * (SECTORS + 1)), np.ones(2 * (SECTORS + 1))
    curve = [episode_return(env, mean, seed)]
    for generation in range(GENERATIONS):
        policies = mean + sd * rng.standard_normal((POPULATION, mean.size))
        returns = np.array([episode_return(env, policy, generation) for policy in policies])
        best = np.argsort(returns)[-BEST:]
        mean, sd = policies[best].mean(axis=0), policies[best].std(axis=0) + 0.05
        curve.append(float(returns[best].mean()))
        print(f"generation {generation + 1}: the best {BEST} returned {curve[-1]:.2f}", flush=True)
    print(f"the mean of the last: {episode_return(env, mean, seed + 1000):.2f}")
    return curve


def main() -> None:
    """Runs the example."""
    name = "ardee/RowFollow-v0"
    env = gymnasium.make(name, seed_field=False, control_period_s=0.2, max_episode_steps=60)
    learn(env)
    env.close()


if __name__ == "__main__":
    main()
