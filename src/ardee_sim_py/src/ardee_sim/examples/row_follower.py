# SPDX-License-Identifier: MIT
"""Drives a learnt row follower down straight corn that it has not seen, and draws its drives."""

import argparse
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

import ardee_sim.envs  # noqa: F401  registers the environments
import gymnasium
import numpy as np
from gymnasium import spaces

from ardee_world.row_truth import lane_of

SHIPPED = Path(__file__).with_name("row_follower.npz")
RANGE_MAX_M, BEAM_MAX_RAD = 30.0, np.radians(135.0)  # of the UTM-30LX scanner
REAR_M, SIDE_M = -0.5, 0.6  # where the map begins, along and across, from the scanner
CELL_M, CELLS = (0.5, 0.05), (6, 24)  # along and across
FIRST_UNSEEN_SEED = 1000
UNSEEN_LENGTH_M = 50.0
Ranges = Mapping[str, Tuple[float, float]]


class ReturnsInCells(gymnasium.ObservationWrapper):
    """Makes a scan a map of the ground beside and before the robot: log(1 + returns in a cell) / 2.

    The stalks of a row fill the same cells however leaves hang into the lane: a row shows far better here than in the
    nearest return of each sector.
    """

    def __init__(self, env: gymnasium.Env) -> None:
        super().__init__(env)
        beams = int(np.prod(env.observation_space.shape or ()))
        angles = np.linspace(-BEAM_MAX_RAD, BEAM_MAX_RAD, beams)
        self._ahead, self._left = np.cos(angles), np.sin(angles)
        highest = np.log1p(beams) / 2.0
        self.observation_space = spaces.Box(0.0, highest, (CELLS[0] * CELLS[1],), np.float32)

    def observation(self, scan: np.ndarray) -> np.ndarray:
        """Returns the cells, from the rear to the front, and in each slice from right to left."""
        ranges_m = scan * RANGE_MAX_M
        slices = np.floor((ranges_m * self._ahead - REAR_M) / CELL_M[0]).astype(int)
        places = np.floor((ranges_m * self._left + SIDE_M) / CELL_M[1]).astype(int)
        is_in = (slices >= 0) & (slices < CELLS[0]) & (places >= 0) & (places < CELLS[1])
        cells = slices[is_in] * CELLS[1] + places[is_in]
        counts = np.bincount(cells, minlength=CELLS[0] * CELLS[1])
        return (np.log1p(counts) / 2.0).astype(np.float32)


class OnlyForward(gymnasium.ActionWrapper):
    """Makes speeds of -1 to 1 those from standstill to full speed ahead."""

    def action(self, action: np.ndarray) -> np.ndarray:
        """Returns the environment's action."""
        return np.array([(action[0] + 1.0) / 2.0, action[1]], np.float32)


class KeepField(gymnasium.Wrapper):
    """Sows a new field only after so many steps in the last: sowing takes as long as 70 steps."""

    def __init__(self, env: gymnasium.Env, steps: int) -> None:
        super().__init__(env)
        self._least, self._steps, self._field = steps, steps, {}  # type: int, int, Dict[str, Any]

    def reset(
        self, *, seed: Optional[int] = None, options: Optional[Mapping[str, Any]] = None
    ) -> Tuple[Any, Dict[str, Any]]:
        """Begins an episode, in the last field unless that is used up, or a seed or options are given."""
        is_new = seed is not None or options is not None or self._steps >= self._least
        chosen = dict(options or {}) if is_new else self._field
        observation, info = self.env.reset(seed=seed, options=chosen)
        self._steps = 0 if is_new else self._steps
        self._field = {name: info["replay"][name] for name in ("field_seed", "numbers")}
        return observation, info

    def step(self, action: Any) -> Tuple[Any, Any, bool, bool, Dict[str, Any]]:
        """Counts a step."""
        self._steps += 1
        return self.env.step(action)


def make_env(ranges: Ranges, max_episode_steps: int, keep_steps: int = 0) -> gymnasium.Env:
    """Returns the environment as the follower sees it."""
    env = gymnasium.make(
        "ardee/RowFollow-v0",
        scenario="long_corn",
        randomise=ranges,
        max_episode_steps=max_episode_steps,
    )
    return OnlyForward(ReturnsInCells(KeepField(env, keep_steps)))


@dataclass(frozen=True)
class Follower:
    """A learnt policy: layers of (weights, biases) with tanh between; how it was made; its learning curve."""

    layers: Sequence[Tuple[np.ndarray, np.ndarray]]
    made_by: Mapping[str, Any]
    curve: np.ndarray  # (n, 3): steps, mean return, part of the episodes that reached the row's end

    def __call__(self, observation: np.ndarray) -> np.ndarray:
        """Returns the action for an observation of make_env()."""
        values = observation
        for weights, biases in self.layers[:-1]:
            values = np.tanh(weights @ values + biases)
        weights, biases = self.layers[-1]
        return np.clip(weights @ values + biases, -1.0, 1.0)

    def save(self, path: Path) -> None:
        """Writes a .npz file."""
        arrays = {"curve": self.curve, "made_by": np.array(json.dumps(self.made_by))}
        for number, (weights, biases) in enumerate(self.layers):
            arrays.update({f"weights_{number}": weights, f"biases_{number}": biases})
        np.savez_compressed(path, **arrays)

    @classmethod
    def load(cls, path: Path) -> "Follower":
        """Reads a file of save()."""
        with np.load(path, allow_pickle=False) as arrays:
            count = sum(name.startswith("weights_") for name in arrays)
            layers = [(arrays[f"weights_{i}"], arrays[f"biases_{i}"]) for i in range(count)]
            return cls(layers, json.loads(str(arrays["made_by"])), arrays["curve"])


@dataclass(frozen=True)
class Drive:
    """A drive down a lane of corn: the truth, which the follower does not see."""

    seed: int
    end_reason: str  # "" if time ran out
    length_m: float  # of the row
    seconds: float
    track: np.ndarray  # (n, 2): distance along the lane's middle from the first stalks, and to its left [m]
    stalks: np.ndarray  # (m, 2): likewise, those within 1 m of the lane's middle


def drive(env: gymnasium.Env, follower: Follower, seed: int) -> Drive:
    """Drives an episode."""
    field_env: Any = env.unwrapped
    observation, _ = env.reset(seed=seed)
    lane = lane_of(field_env.field, field_env.pose())
    track: List[Tuple[float, float]] = []
    is_over, info = False, {}  # type: bool, Dict[str, Any]
    while not is_over:
        observation, _, terminated, truncated, info = env.step(follower(observation))
        here = lane.deviation(field_env.pose())
        track.append((here.along_m, here.lateral_m))
        is_over = terminated or truncated
    stalks = np.array([lane.centre.project(*xy)[:2] for xy in field_env.field.stalks.xy_m])
    seconds = len(track) / field_env.metadata["render_fps"]
    near = stalks[np.abs(stalks[:, 1]) < 1.0]
    return Drive(seed, info["end_reason"], lane.centre.length_m, seconds, np.array(track), near)


def report(run: Drive) -> str:
    """Returns a line about a drive."""
    along_m, left_m = run.track.T
    is_inside = along_m > 0.0
    inside = left_m[is_inside] if is_inside.any() else left_m
    return (
        f"seed {run.seed}: {run.end_reason or 'time ran out'} after {along_m[-1]:.1f} of {run.length_m:.1f} m, "
        f"{run.seconds:.0f} s; off the middle by {np.sqrt(np.mean(inside**2)):.3f} m (rms), "
        f"{np.abs(inside).max():.3f} m at most"
    )


def drive_unseen(follower: Follower, count: int, length_m: float) -> List[Drive]:
    """Drives down straight rows of this length in fields that were not trained on, a seed each; prints each."""
    slow_m_s = 0.2
    env = make_env({"row_length_m": (length_m, length_m)}, round((length_m + 2.0) / slow_m_s * 10))
    drives: List[Drive] = []
    for seed in range(FIRST_UNSEEN_SEED, FIRST_UNSEEN_SEED + count):
        drives.append(drive(env, follower, seed))
        print(report(drives[-1]), flush=True)
    env.close()
    reached = sum(run.end_reason == "row_end" for run in drives)
    print(f"{reached} of {count} reached the row's end")
    return drives


def draw(follower: Follower, drives: Sequence[Drive], path: Path) -> None:
    """Writes a figure: learning curve, tracks between the stalks seen from above, distance from the middle."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure, (curve, above, aside) = pyplot.subplots(3, 1, figsize=(9, 7.5), layout="constrained")
    steps, returns, reached = follower.curve.T
    curve.plot(steps / 1000, returns, color="C0")
    curve.set(xlabel="steps / 1000", ylabel="return", title="learning: mean of 100 episodes")
    part = curve.twinx()
    part.plot(steps / 1000, 100 * reached, color="C1")
    part.set_ylabel("reached the end [%]", color="C1")
    shown = drives[0]
    above.plot(*shown.stalks.T, ".", color="C2", markersize=2)
    above.plot(*shown.track.T, color="C0", linewidth=1)
    above.set(xlabel="along the lane [m]", ylabel="to the left [m]", ylim=(-1, 1))
    above.set_title(
        f"seed {shown.seed} from above, stretched across: track of the robot's middle, stalks"
    )
    for run in drives:
        aside.plot(*run.track.T, linewidth=0.7)
    aside.set(xlabel="along the lane [m]", ylabel="to the left [m]")
    aside.set_title(f"{len(drives)} fields not trained on: distance from the lane's middle")
    figure.savefig(path, dpi=80)
    pyplot.close(figure)


def positive(text: str) -> int:
    """Returns a whole number above 0 of the command line."""
    if not text.isdecimal() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"found '{text}', expected a whole number above 0")
    return int(text)


def main() -> None:
    """Runs the example."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "--policy", type=Path, default=SHIPPED, help="that drives, default: shipped"
    )
    parser.add_argument("--drives", type=positive, default=10, help="number of fields, default 10")
    parser.add_argument(
        "--length-m", type=float, default=UNSEEN_LENGTH_M, help="of the rows, default 50"
    )
    parser.add_argument("--figure", type=Path, help="PNG file to write, needs matplotlib")
    arguments = parser.parse_args()
    follower = Follower.load(arguments.policy)
    print(f"{arguments.policy.name}: {json.dumps(follower.made_by)}")
    drives = drive_unseen(follower, arguments.drives, arguments.length_m)
    if arguments.figure:
        draw(follower, drives, arguments.figure)
        print(f"{arguments.figure}: learning curve and drives")


if __name__ == "__main__":
    main()
