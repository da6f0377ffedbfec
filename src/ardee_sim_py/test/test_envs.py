# SPDX-License-Identifier: MIT
"""Tests environments: Gymnasium's rules, repetition, ends, drawn fields, refusals."""
import concurrent.futures
import json
import pickle
import warnings
from typing import Any, Callable, Dict, List

import ardee_sim.envs
import gymnasium
import numpy as np
import pytest
from ardee_sim.envs import FieldEnv
from ardee_sim.envs.randomise import SCENE
from ardee_sim.examples import learn_to_follow
from gymnasium.utils.env_checker import check_env

IDS = ("RowFollow", "RowFollowCamera", "HeadlandTurn", "GoTo")
AHEAD = np.array([0.6, 0.0], dtype=np.float32)
STEPS = 300
SMALL_PICTURE = {"width_px": 32, "height_px": 24}
Make = Callable[..., FieldEnv]


def rollout(env: gymnasium.Env, seed: int, steps: int = 40) -> bytes:
    """Returns all bytes of an episode with random actions."""
    observation, _ = env.reset(seed=seed)
    rng, said = np.random.default_rng(seed), [bytes_of(observation)]
    for _ in range(steps):
        action = rng.uniform([0.2, -0.3], [0.8, 0.3])
        observation, reward, terminated, _, _ = env.step(action)
        said.append(bytes_of(observation) + np.float64(reward).tobytes())
        if terminated:
            break
    return b"".join(said)


def bytes_of(observation: Any) -> bytes:
    """Returns the bytes of an array, or of a dict of them."""
    if isinstance(observation, dict):
        return b"".join(observation[name].tobytes() for name in sorted(observation))
    return observation.tobytes()


@pytest.mark.slow
@pytest.mark.parametrize("name", IDS)
def test_gymnasium_finds_nothing_to_complain_about(name: str, make: Make) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(make(name, render_mode="rgb_array"))


@pytest.mark.parametrize("name", IDS)
def test_a_seed_repeats_all_bytes_in_any_instance_and_after_any_episode(
    name: str, make: Make
) -> None:
    one, other = make(name), make(name)
    first = rollout(one, 3)
    assert rollout(one, 4) != first
    assert rollout(other, 3) == first == rollout(one, 3)


def test_an_environment_repeats_all_pictures(make: Make) -> None:
    env = make("RowFollowCamera", scenario="weeds")  # 14 m long, more than one scene of pictures
    straight = np.array([1.0, 0.0], dtype=np.float32)

    def pictures() -> List[bytes]:
        first = env.reset(seed=1)[0]
        return [each.tobytes() for each in (first, *(env.step(straight)[0] for _ in range(60)))]

    assert pictures() == pictures()


@pytest.mark.parametrize("name", ["RowFollow", "GoTo"])
def test_a_touch_between_two_observations_counts(name: str, make: Make) -> None:
    env = make(name)
    env.reset(seed=1)
    sim, plant = env._scene.sim, next(iter(env._scene.plants))
    sim.touched()
    foot = next(each for each in env.world.plants() if each.name == plant)
    away = sim.state("robot").xyz_m
    sim.set_state("robot", xyz_m=(*foot.xyz_m[:2], away[2] + 0.05))
    sim.step(1)
    sim.set_state("robot", xyz_m=away)
    sim.step(1)
    assert env._scene.touches_plant() and not env._scene.touches_plant()


def test_an_episode_is_repeated_from_what_it_says(make: Make) -> None:
    ranges = {
        "emergence": (0.5, 0.9),
        "stalk_spacing_m": (0.1, 0.2),
        "stage": (6.0, 16.0),
        "lodging": (0.0, 0.1),
        "noise_scale": (0.5, 2.0),
        "sun_elevation_rad": (0.5, 1.5),
        "ground_friction": (0.3, 0.9),
    }
    env = make(seed_field=True, randomise=ranges)
    observation, info = env.reset(seed=1)
    replay = json.loads(json.dumps(info["replay"]))
    drawn = replay["numbers"]
    assert list(drawn) == list(ranges)
    assert all(low <= drawn[name] <= high for name, (low, high) in ranges.items())
    ahead = env.step(AHEAD)[0]
    other, other_info = env.reset()
    assert not np.array_equal(observation, other) and drawn != other_info["replay"]["numbers"]
    for repeating in (env, make(seed_field=True)):
        again, repeated = repeating.reset(options=replay)
        assert repeated["replay"] == replay
        assert np.array_equal(observation, again)
        assert np.array_equal(ahead, repeating.step(AHEAD)[0])


@pytest.mark.parametrize("name", list(SCENE))
def test_numbers_of_the_scene_act_and_are_repeated(make: Make, name: str) -> None:
    values = {"noise_scale": (0.0, 5.0), "ground_friction": (0.02, 0.6)}
    low, high = values.get(name, SCENE[name])
    is_light = name in ("sun_azimuth_rad", "sun_elevation_rad", "sun_intensity", "ambient")
    env = make("RowFollowCamera" if is_light else "RowFollow", randomise={name: (low, high)})
    _, info = env.reset(seed=1)
    assert low <= info["replay"]["numbers"][name] <= high

    def ahead(number: float) -> bytes:
        observation, info = env.reset(
            options={"numbers": {name: number}, "start_seed": 1, "noise_seed": 1}
        )
        for _ in range(5):
            observation = env.step(AHEAD)[0]
        return observation.tobytes()

    middle = (low + 2 * high) / 3
    assert ahead(low) != ahead(middle) == ahead(middle)


def test_drawn_numbers_act(make: Make) -> None:
    def plants(emergence: float) -> int:
        env = make(seed_field=True, randomise={"emergence": (emergence, emergence)})
        env.reset(seed=1)
        return len(env.world.plants())

    # 4 rows of 53 places; a binomial number stays within four standard deviations
    assert plants(1.0) == 212 and plants(0.5) == pytest.approx(106, abs=4 * 7.3)


def test_plants_are_of_the_drawn_stage(make: Make) -> None:
    env = make(seed_field=True, randomise={"stage": (4.0, 12.0)})
    heights_m = {}
    for leaves in (4.0, 12.4):
        env.reset(options={"numbers": {"stage": leaves}})
        heights_m[leaves] = np.mean([plant.height_m for plant in env.world.plants()])
    # Corn of four leaves is about 0.3 m high, of twelve about 1.5 m.
    assert heights_m[4.0] < 0.6 and 1.0 < heights_m[12.4]


def test_a_kept_field_has_other_noise_in_each_episode(make: Make) -> None:
    env = make()
    _, info = env.reset(seed=1)
    first = env.reset(options=info["replay"])[0]
    second = env.reset(options={**info["replay"], "noise_seed": 7})[0]
    differences = np.abs(first - second)[(first < 1) & (second < 1)]
    assert 0 < np.median(differences) < 0.01


def test_driving_on_ends_at_the_rows_end_and_sums_its_terms(make: Make) -> None:
    env = make()
    env.reset(seed=1)
    total, info = 0.0, {}  # type: float, Dict[str, Any]
    for _ in range(200):
        _, reward, terminated, truncated, info = env.step(AHEAD)
        terms = [value for name, value in info.items() if name.startswith("reward_")]
        assert reward == pytest.approx(sum(terms)) and not truncated
        total += reward
        if terminated:
            break
    assert info["end_reason"] == "row_end" and info["reward_end"] == 1.0
    # 1 m of headland and 5 m of row, and 1 for the end, less the penalty for the offset
    assert 6.0 < total < 7.1


def test_driving_into_a_row_ends_in_it(make: Make) -> None:
    env = make()
    env.reset(seed=1)
    for _ in range(20):  # to where stalks stand on both sides
        assert not env.step(AHEAD)[2]
    for _ in range(60):
        _, _, terminated, _, info = env.step(np.array([0.4, 0.5]))
        if terminated:
            break
    assert info["end_reason"] in ("collision", "row_lost") and info["reward_end"] == -1.0


def drive_to(env: FieldEnv, x_m: float, y_m: float) -> str:
    """Turns towards a place by the truth and drives there; returns the reason of an end on the way."""
    for _ in range(150):
        here = env.pose()
        dx, dy = x_m - here.x_m, y_m - here.y_m
        turn = np.remainder(np.arctan2(dy, dx) - here.yaw_rad + np.pi, 2 * np.pi) - np.pi
        if np.hypot(dx, dy) < 0.15:
            return ""
        action = [0.5 if abs(turn) < 0.4 else 0.0, np.clip(2 * turn, -1, 1)]
        _, _, terminated, _, info = env.step(np.array(action))
        if terminated:
            return info["end_reason"]
    return "too slow"


@pytest.mark.parametrize("seed", [1, 2])
def test_a_headland_turn_ends_in_the_next_lane(make: Make, seed: int) -> None:
    env = make("HeadlandTurn")
    observation, _ = env.reset(seed=seed)
    side, begin = observation["side"][0], env.pose()
    c, s = np.cos(begin.yaw_rad), np.sin(begin.yaw_rad)
    lane_m = 0.762
    for ahead, left in [(1.4, 0.0), (1.4, lane_m * side), (-1.0, lane_m * side)]:
        reason = drive_to(env, begin.x_m + c * ahead - s * left, begin.y_m + s * ahead + c * left)
        if reason:
            break
    assert reason == "in_lane"
    observation = env.step(np.zeros(2))[0]
    assert observation["odom"][1] * 5 == pytest.approx(lane_m * side, abs=0.3)


def seen_goal(env: FieldEnv, observation: np.ndarray) -> np.ndarray:
    """Returns where the goal is by an observation and the robot's true pose [m]."""
    ahead, left = 20 * observation[:2]
    begin = env.pose()
    c, s = np.cos(begin.yaw_rad), np.sin(begin.yaw_rad)
    return np.array([begin.x_m + c * ahead - s * left, begin.y_m + s * ahead + c * left])


def test_the_goal_is_where_fix_and_imu_say(make: Make) -> None:
    env = make("GoTo")
    observation, _ = env.reset(seed=1)
    x_m, y_m = seen_goal(env, observation)
    # The lane lies on y = 0, towards -x; the receiver's error may lead past the goal.
    assert abs(y_m) < 1.0 and 1.5 < 20 * observation[0] < 6.5
    assert drive_to(env, x_m - 1.5, 0.0) == "arrived"


def test_a_first_fix_that_counts_as_exact_shows_the_true_goal(make: Make) -> None:
    env = make("GoTo", error_topic=None)
    assert abs(seen_goal(env, env.reset(seed=1)[0])[1]) < 0.05


def test_pictures_are_of_their_kind(make: Make) -> None:
    for picture, kind in (("rgb", np.uint8), ("depth", np.float32), ("labels", np.uint16)):
        env = make("RowFollowCamera", picture=picture)
        observation, _ = env.reset(seed=1)
        assert observation.shape[:2] == (24, 32) and observation.dtype == kind
        assert env.observation_space.contains(observation)
    assert 0.1 < np.mean(observation == 1) < 1.0  # corn


def test_several_sensors_are_a_dict(make: Make) -> None:
    env = make(topics=("ardee/hokuyo", "ardee/imu/custom"))
    observation, _ = env.reset(seed=1)
    assert observation["hokuyo"].shape == (1081,) and env.observation_space.contains(observation)
    sine, cosine = observation["custom"][:2]
    assert np.hypot(sine, cosine) == pytest.approx(1.0) and cosine < -0.9  # yaw is about -3.14


def to_and_fro(number: int) -> np.ndarray:
    """Returns the action of a step, so that an episode of any length does not end."""
    return np.array([0.4 if number % 40 < 20 else -0.4, 0.0], dtype=np.float32)


def long_rollout(env: FieldEnv) -> bytes:
    """Returns all bytes of STEPS steps."""
    said = [bytes_of(env.reset(seed=5)[0])]
    for number in range(STEPS):
        observation, reward, terminated, *_ = env.step(to_and_fro(number))
        assert not terminated
        said.append(bytes_of(observation) + np.float64(reward).tobytes())
    return b"".join(said)


def one_of(observations: Any, i: int) -> Any:
    """Returns the observation of an environment among those of a vector environment."""
    if isinstance(observations, dict):
        return {name: array[i] for name, array in observations.items()}
    return observations[i]


@pytest.mark.slow
@pytest.mark.parametrize("name", IDS)
def test_workers_change_no_byte(name: str, make: Make) -> None:
    def run(num_envs: int) -> List[bytes]:
        """Returns what each environment said."""
        arguments = {"seed_field": False, **(SMALL_PICTURE if "Camera" in name else {})}
        envs = gymnasium.make_vec(f"ardee/{name}-v0", num_envs=num_envs, **arguments)
        try:
            begun = envs.reset(seed=5)[0]
            said = [[bytes_of(one_of(begun, i))] for i in range(num_envs)]
            for number in range(STEPS):
                observations, rewards, *_ = envs.step(np.tile(to_and_fro(number), (num_envs, 1)))
                for i in range(num_envs):
                    said[i].append(bytes_of(one_of(observations, i)) + rewards[i].tobytes())
        finally:
            envs.close()
        return [b"".join(each) for each in said]

    four = run(4)
    assert [long_rollout(make(name))] == run(1) == four[:1] and run(2) == four[:2]
    assert len(set(four)) == 4


@pytest.mark.slow
@pytest.mark.parametrize("name", IDS)
def test_threads_and_a_restored_beginning_change_no_byte(name: str, make: Make) -> None:
    envs = [make(name), make(name)]
    with concurrent.futures.ThreadPoolExecutor() as pool:
        one, other = pool.map(long_rollout, envs)
    assert one == other == long_rollout(envs[0])  # a reset restores a snapshot


@pytest.mark.slow
def test_a_reward_can_be_learnt_from(make: Make) -> None:
    env = gymnasium.wrappers.TimeLimit(make(control_period_s=0.2), 60)
    curve = learn_to_follow.learn(env)
    # Who stands still gets nothing but the penalty of its offset.
    assert -3.0 < curve[0] <= 0.0 and curve[-1] > 5.0


def test_a_specification_survives_pickling() -> None:
    spec = gymnasium.spec("ardee/RowFollow-v0")
    assert pickle.loads(pickle.dumps(spec)) == spec and spec.max_episode_steps == 600


def test_bad_arguments_are_refused_with_what_was_expected(make: Make) -> None:
    for arguments, message in [
        (dict(scenario="rice"), "scenario: found 'rice', nearest of 16: .*corn"),
        (dict(robot="tsv9"), "found no robot 'tsv9'"),
        (dict(control_period_s=0.012), "expected a whole number of steps of 0.005 s"),
        (dict(randomise={"emergence": (0, 1)}), "a field that is not sown anew"),
        (
            dict(randomise={"noise": (0, 1)}),
            "randomise: found 'noise', .*did you mean 'noise_scale'",
        ),
        (dict(randomise={"ambient": (0, 2)}), "ambient: found .*, expected .* within 0 and 1"),
        (dict(seed_field=True, randomise={"lodging": (1, 0)}), "lodging: found"),
        (
            dict(seed_field=True, randomise={"stage": (6, 30)}),
            "stage: .*corn.yaml: .*'V30', known: V1 to V18",
        ),
        (dict(randomise={"ambient": 0.5}), "ambient: found 0.5, expected least and greatest"),
        (dict(control_period_s=float("nan")), "control_period_s: found nan, expected a positive"),
        (dict(v_max_m_s=0.0), "v_max_m_s: found 0.0, expected a positive"),
        (dict(render_mode="human"), "render_mode"),
        (dict(topics=("ardee/gps",)), "found a FixReading, expected scan, image or IMU"),
        (dict(world="/nowhere.world"), "found no file /nowhere.world, expected a world file"),
    ]:
        with pytest.raises(ValueError, match=message):
            ardee_sim.envs.RowFollowEnv(**{"seed_field": False, **arguments})
    with pytest.raises(ValueError, match="picture: found 'x', expected rgb, depth, labels"):
        ardee_sim.envs.RowFollowCameraEnv(picture="x")


def test_bad_calls_are_refused(make: Make) -> None:
    env = make()
    with pytest.raises(RuntimeError, match="step before reset"):
        env.step(AHEAD)
    env.reset(seed=1)
    for action in ([0.1], [0.1, float("nan")], [[0.1, 0.2]]):
        with pytest.raises(ValueError, match="expected 2 finite numbers"):
            env.step(np.array(action))
    with pytest.raises(ValueError, match="options: found 'field', expected one of: field_seed"):
        env.reset(options={"field": 1})
    env.close()
    env.close()
    with pytest.raises(RuntimeError, match="closed"):
        env.reset()
