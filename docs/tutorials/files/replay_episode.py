# SPDX-License-Identifier: MIT
"""Begins an episode in a field of drawn numbers, and the same one again."""
import ardee_sim.envs  # noqa: F401  registers the environments
import gymnasium


def main() -> None:
    """Prints what an episode drew, and whether it can be repeated."""
    ranges = {"emergence": (0.6, 0.95), "lodging": (0.0, 0.02), "stage": (6, 16)}
    env = gymnasium.make("ardee/RowFollow-v0", randomise=ranges)
    scan, info = env.reset(seed=1)
    print(info["replay"])
    env.reset()  # another one
    again, _ = env.reset(options=info["replay"])
    print("repeated:", (scan == again).all())
    env.close()


if __name__ == "__main__":
    main()
