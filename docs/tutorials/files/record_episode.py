# SPDX-License-Identifier: MIT
"""Records an episode in a file, which the viewer shows."""
import gymnasium
from ardee_sim.envs import RecordEpisode


def main() -> None:
    """Drives straight ahead for 5 s."""
    env = RecordEpisode(gymnasium.make("ardee/RowFollow-v0"))
    env.reset(seed=1)
    for _ in range(50):
        env.step([0.6, 0.0])
    env.episode.save("episode.json")
    print(f"episode.json: {len(env.episode.actions)} actions")
    env.close()


if __name__ == "__main__":
    main()
