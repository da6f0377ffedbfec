# SPDX-License-Identifier: MIT
"""Tests what the row follower's example does without a learner: what it sees, its file, its drives, its figure."""
import json
from pathlib import Path
from typing import Any, Dict, Optional

import gymnasium
import numpy as np
import pytest
from ardee_sim.examples import row_follower
from ardee_sim.examples.row_follower import Follower, KeepField, OnlyForward, ReturnsInCells
from gymnasium import spaces
from PIL import Image

STANDS = Follower([(np.zeros((2, 144), np.float32), np.array([-1.0, 0.0]))], {}, np.zeros((2, 3)))


class Scanner(gymnasium.Env):
    """Sees nothing in 1081 beams, and says which field it was given."""

    observation_space = spaces.Box(0.0, 1.0, (1081,), np.float32)
    action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
    fields = 0

    def reset(self, *, seed: Optional[int] = None, options: Optional[Dict[str, Any]] = None) -> Any:
        self.fields += not options
        replay = {"field_seed": self.fields, "numbers": {}, "noise_seed": 1, "start_seed": 2}
        return np.ones(1081, np.float32), {"replay": {**replay, **(options or {})}}

    def step(self, action: np.ndarray) -> Any:
        return np.ones(1081, np.float32), 0.0, False, False, {"action": action}


def test_returns_are_counted_in_cells_of_the_ground() -> None:
    view = ReturnsInCells(Scanner())
    scan = np.ones(1081, np.float32)
    assert not view.observation(scan).any()
    scan[541:544] = 1.1 / 30  # ahead, a little to the left: slice 3, place 12
    scan[180] = 0.38 / 30  # at right angles to the right: slice 1, place 4
    scan[900] = 0.7 / 30  # too far to the left
    seen = view.observation(scan)
    assert seen.shape == (144,) and seen in view.observation_space
    assert seen[3 * 24 + 12] == pytest.approx(np.log(4) / 2)
    assert seen[1 * 24 + 4] == pytest.approx(np.log(2) / 2) and np.count_nonzero(seen) == 2


def test_speeds_are_ahead_only() -> None:
    env = OnlyForward(Scanner())
    for wanted, given in ((-1.0, 0.0), (0.0, 0.5), (1.0, 1.0)):
        action = env.step(np.array([wanted, -0.3]))[4]["action"]
        assert action == pytest.approx([given, -0.3])


def test_a_field_is_kept_for_some_steps_unless_a_seed_is_given() -> None:
    env = KeepField(Scanner(), 3)

    def field() -> int:
        return env.reset()[1]["replay"]["field_seed"]

    assert field() == 1
    env.step(np.zeros(2))
    assert field() == 1
    for _ in range(2):
        env.step(np.zeros(2))
    assert field() == 2 and field() == 2
    assert env.reset(seed=1)[1]["replay"]["field_seed"] == 3


def test_a_follower_is_kept_in_a_file_and_computes_its_layers(tmp_path: Path) -> None:
    layers = [
        (np.array([[1.0, 0.0], [0.0, 2.0]]), np.array([0.5, 0.0])),
        (np.array([[1.0, 1.0], [0.0, 9.0]]), np.array([0.0, -1.0])),
    ]
    Follower(layers, {"seed": 1}, np.array([[2048.0, 1.5, 0.25]])).save(tmp_path / "one.npz")
    read = Follower.load(tmp_path / "one.npz")
    first, second = np.tanh(0.75), np.tanh(1.0)
    assert read(np.array([0.25, 0.5])) == pytest.approx([min(first + second, 1), 1.0])
    assert read.made_by == {"seed": 1} and read.curve.tolist() == [[2048.0, 1.5, 0.25]]
    read.save(tmp_path / "two.npz")
    assert (tmp_path / "two.npz").read_bytes() == (tmp_path / "one.npz").read_bytes()


def test_who_stands_gets_nowhere_and_time_runs_out() -> None:
    env = row_follower.make_env({"row_length_m": (5.0, 5.0)}, 20)
    run = row_follower.drive(env, STANDS, 1)
    env.close()
    assert run.end_reason == "" and run.seconds == pytest.approx(2.0) and len(run.track) == 20
    # 1 m of headland before the first stalks; a start is 0.03 m inaccurate
    assert np.all(np.abs(run.track - (-1.0, 0.0)) < 0.15)
    assert run.length_m == pytest.approx(5.0, abs=0.2)
    assert run.stalks.shape[1] == 2 and np.median(np.abs(run.stalks[:, 1])) == pytest.approx(
        0.381, abs=0.03
    )


@pytest.mark.slow
def test_the_shipped_follower_reaches_the_end_of_corn_it_has_not_seen(tmp_path: Path) -> None:
    follower = Follower.load(row_follower.SHIPPED)
    assert row_follower.SHIPPED.stat().st_size < 200_000
    assert "--seed" in json.loads(json.dumps(follower.made_by))["command"]
    drives = row_follower.drive_unseen(follower, 1, 8.0)
    assert drives[0].end_reason == "row_end"
    assert np.abs(drives[0].track[:, 1]).max() < 0.3  # half the lane, less half the robot
    row_follower.draw(follower, drives, tmp_path / "drives.png")
    with Image.open(tmp_path / "drives.png") as picture:
        assert len(picture.convert("RGB").getcolors(1 << 20)) > 20
