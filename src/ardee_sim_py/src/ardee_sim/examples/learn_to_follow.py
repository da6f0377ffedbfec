# SPDX-License-Identifier: MIT
"""Learns to follow a lane of corn: the cross-entropy method over a linear policy, half a minute on one core."""

from typing import List

import ardee_sim.envs  # noqa: F401  registers the environments
import gymnasium
import numpy as np

PAIRS = 4  # of sectors of the scan, one on the left, one on the right
NEAR = 2 / 30  # ranges beyond 2 m of 30 m count as 2 m
PARAMETERS = 2 + PAIRS
GENERATIONS, POPULATION, BEST = 4, 16, 4


def act(policy: np.ndarray, scan: np.ndarray) -> np.ndarray:
    """Returns speed, linear in the range ahead, and turn rate, linear in how much freer the left is than the right."""
    near = np.minimum(scan / NEAR, 1.0)
    ranges = np.array([sector.mean() for sector in np.array_split(near, 2 * PAIRS)])
    right, left = ranges[:PAIRS], ranges[PAIRS:][::-1]
    ahead = (right[-1] + left[-1]) / 2
    return np.tanh(np.array([policy[0] + policy[1] * ahead, policy[2:] @ (left - right)]))


def episode_return(env: gymnasium.Env, policy: np.ndarray, seed: int) -> float:
    """Returns the sum of an episode's rewards."""
    scan, _ = env.reset(seed=seed)
    total, is_over = 0.0, False
    while not is_over:
        scan, reward, terminated, truncated, _ = env.step(act(policy, scan))
        total, is_over = total + float(reward), terminated or truncated
    return total


def learn(env: gymnasium.Env, seed: int = 0) -> List[float]:
    """Returns the mean return of each generation's best; the first is that of a robot that stands still."""
    rng = np.random.default_rng(seed)
    mean, sd = np.zeros(PARAMETERS), np.ones(PARAMETERS)
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
