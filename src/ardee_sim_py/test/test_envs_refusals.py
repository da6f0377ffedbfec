# SPDX-License-Identifier: MIT
"""Tests what environments refuse, with what was expected, and that they go on afterwards."""
import os
import subprocess
import sys
from pathlib import Path
from typing import Any, Dict

import gymnasium
import numpy as np
import pytest
from ardee_sim import ArdeeError, World
from test_envs import AHEAD, Make


def test_a_refused_reset_leaves_the_episode_as_it_was(make: Make) -> None:
    env = make()
    good = env.reset(seed=1)[1]["replay"]
    ahead = env.step(AHEAD)[0]
    env.reset(options=good)
    with pytest.raises(ArdeeError, match="emergence"):
        env.reset(options={**good, "numbers": {"emergence": 1.4}})
    assert np.array_equal(env.step(AHEAD)[0], ahead)


@pytest.mark.parametrize("is_sown", [False, True])
def test_a_reset_after_a_refused_one_begins_an_episode(make: Make, is_sown: bool) -> None:
    env = make(seed_field=is_sown)
    first, info = env.reset(seed=1)
    with pytest.raises(ArdeeError):
        env.reset(options={**info["replay"], "numbers": {"emergence": 1.4}})
    assert np.array_equal(env.reset(options=info["replay"])[0], first)
    assert np.array_equal(env.reset(seed=1)[0], first)


@pytest.mark.parametrize(
    "ranges, said",
    [
        ({"emergence": (0.5, 1.4)}, "randomise: emergence.*found 1.4, expected 0 to 1"),
        ({"emergence": (-0.1, 0.9)}, "randomise: emergence.*found -0.1, expected 0 to 1"),
        (
            {"lodging_angle_min_deg": (10, 60), "lodging_angle_max_deg": (50, 70)},
            "randomise: lodging angle: found minimum 60.* above maximum 50",
        ),
        ({"ambient": ("a", "b")}, r"randomise: ambient: found \('a', 'b'\), expected least and"),
        ({"ambient": (0.1, (0.2, 0.3))}, "randomise: ambient: found"),
        ({"lodging": (0.0, float("inf"))}, "randomise: lodging: found"),
        (5, "randomise: found 5, expected values by their names"),
    ],
)
def test_a_range_of_which_some_numbers_are_impossible_is_refused(
    make: Make, ranges: Any, said: str
) -> None:
    with pytest.raises(ArdeeError, match=said):
        make(seed_field=True, randomise=ranges)


@pytest.mark.parametrize(
    "name, wrong, said",
    [
        ("RowFollow", {"topics": ()}, "topics: found none, expected one or more names"),
        ("RowFollow", {"topics": "ardee/hokuyo"}, "topics: found 'ardee/hokuyo', expected a list"),
        ("RowFollow", {"topics": (5,)}, "topics: found 5, expected a text"),
        ("RowFollow", {"topics": ("hokuyo",)}, "topics: found 'hokuyo', .*ardee/hokuyo"),
        ("RowFollow", {"field_seed": -1}, "field_seed: found -1, expected 0 to"),
        ("RowFollow", {"seed_field": "no"}, "seed_field: found 'no', expected True or False"),
        ("RowFollow", {"controllers": 5}, "controllers: found 5, expected a list of names"),
        ("RowFollow", {"command_topic": 5}, "command_topic: found 5, expected a text"),
        ("RowFollow", {"world": 5}, "world: found 5, expected a path"),
        ("RowFollow", {"world": "corm.world"}, "found no world 'corm.world'.*corn.world"),
        (
            "HeadlandTurn",
            {"odometry_topic": "ardee/gps"},
            "odometry_topic: found 'ardee/gps' of FixReading, expected a topic of OdometryReading",
        ),
        ("HeadlandTurn", {"scan_topic": "ardee/imu/custom"}, "scan_topic: .* of LidarReading"),
        ("GoTo", {"fix_topic": "odom"}, "fix_topic: found 'odom' of Odom.* of FixReading"),
        ("GoTo", {"imu_topic": "ardee/hokuyo"}, "imu_topic: .* of LidarReading, .* of ImuReading"),
        ("GoTo", {"error_topic": "odom"}, "error_topic: .* of GpsQualityReading"),
    ],
)
def test_an_argument_that_cannot_be_is_refused(
    make: Make, name: str, wrong: Dict[str, Any], said: str
) -> None:
    with pytest.raises(ArdeeError, match=said):
        make(name, **wrong)


def test_options_that_cannot_be_are_refused(make: Make) -> None:
    env = make()
    for options, said in [
        (5, "options: found 5, expected values by their names"),
        ({"start_seed": -1}, "start_seed: found -1, expected 0 to"),
        ({"noise_seed": 0.5}, "noise_seed: found 0.5, expected a whole number"),
        ({"numbers": 3}, "numbers: found 3, expected a mapping of names to numbers"),
        ({"numbers": {"ambient": "a"}}, "numbers.*: found 'a', expected a number"),
        ({"numbers": {"ambient": 2}}, "numbers: ambient: found .*expected .* within 0 and 1"),
    ]:
        with pytest.raises(ArdeeError, match=said):
            env.reset(options=options)


def test_a_field_that_was_moved_away_from_its_truth_is_refused(tmp_path: Path, make: Make) -> None:
    shipped = Path(World.from_file("corn.world").path)
    text, pose = shipped.read_text(), "<pose>0 0 0 0 0 -1.57</pose>"
    assert text.count(pose) == 1
    start = shipped.with_suffix(".start.yaml").read_text()
    (tmp_path / "moved.start.yaml").write_text(start)
    moved = tmp_path / "moved.world"
    moved.write_text(text.replace(pose, "<pose>0 0.4 0 0 0 -1.57</pose>"))
    said = "found corn-field included at 0 0.4 0 0 0 -1.57, expected 0 0 0 0 0 -1.57, for which"
    with pytest.raises(ArdeeError, match=said):
        make(scenario=None, world=moved)


def test_an_action_of_words_is_refused(make: Make) -> None:
    env = make()
    env.reset(seed=1)
    with pytest.raises(ArdeeError, match="action: found 'ahead', expected 2 numbers"):
        env.step("ahead")


def test_a_long_control_period_has_one_picture_a_second(make: Make) -> None:
    assert make(control_period_s=2.0).metadata["render_fps"] == 1


@pytest.mark.filterwarnings("ignore:.*ERROR")  # gymnasium's own report of it
def test_a_worker_s_error_is_the_environment_s() -> None:
    envs = gymnasium.make_vec("ardee/RowFollow-v0", num_envs=1, seed_field=False)
    with pytest.raises(ArdeeError, match="options: found 'noise_sed', expected one of"):
        envs.reset(options={"noise_sed": 1})
    envs.close(terminate=True)


OPEN_AT_THE_END = """
import gymnasium, ardee_sim.envs
if __name__ == "__main__":
    envs = gymnasium.make_vec("ardee/RowFollow-v0", num_envs=2, seed_field=False)
    envs.reset(seed=1)
"""


def test_the_end_of_a_program_deletes_the_fields_of_its_workers(tmp_path: Path) -> None:
    (tmp_path / "scratch").mkdir()
    program = tmp_path / "program.py"
    program.write_text(OPEN_AT_THE_END)
    env = {**os.environ, "TMPDIR": str(tmp_path / "scratch")}
    subprocess.run([sys.executable, str(program)], env=env, check=True)
    assert list((tmp_path / "scratch").iterdir()) == []
