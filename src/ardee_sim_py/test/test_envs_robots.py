# SPDX-License-Identifier: MIT
"""Environments with robots of others: their topics, ros_control, what is refused."""
import math
from pathlib import Path
from typing import Any, Dict

import numpy as np
import pytest
from ardee_sim import ArdeeError, Simulation, World, robot
from ardee_sim.envs.observations import scaled_depths
from ardee_sim.envs.randomise import with_noise, with_scene
from test_envs import Make, rollout

from ardee_models.terrain.ground import LevelGround
from ardee_world.row_truth import Field, Pose
from ardee_world.start import STAND_M
from ardee_world.trial import Trial

ROBOTS = Path(__file__).resolve().parents[3] / "tests" / "robots_with_ros_control"


def jackal(folder: Path) -> Dict[str, Any]:
    """Returns the arguments for a robot of ros_control, with other topics than a TerraSentia's."""
    file = folder / "jackal.urdf.xacro"
    file.write_text(
        f"""<robot name="with_lidar" xmlns:xacro="http://www.ros.org/wiki/xacro">
          <xacro:arg name="lidar" default="front"/>
          <xacro:include filename="{ROBOTS}/jackal.urdf.xacro"/>
          <xacro:include filename="$(find ardee_sensors)/urdf/hokuyo_ust10lx.urdf.xacro"/>
          <xacro:sensor_hokuyo_ust10lx name="$(arg lidar)" parent="base_link" color="black">
            <origin xyz="0.15 0 0.2"/>
          </xacro:sensor_hokuyo_ust10lx>
        </robot>"""
    )
    return dict(
        robot=file,
        xacro={"lidar": "eye"},
        parameters=ROBOTS / "jackal.yaml",
        controllers=("jackal_joint_publisher", "jackal_velocity_controller"),
        command_topic="jackal_velocity_controller/cmd_vel",
        stand_m=0.07,
    )


@pytest.mark.parametrize(
    "name, topics",
    [
        ("RowFollow", {"topics": ("ardee/eye",)}),
        (
            "HeadlandTurn",
            {"scan_topic": "ardee/eye", "odometry_topic": "jackal_velocity_controller/odom"},
        ),
    ],
)
def test_a_robot_of_ros_control_drives_by_its_own_topics(
    name: str, topics: Dict[str, Any], make: Make, tmp_path: Path
) -> None:
    env = make(name, **topics, **jackal(tmp_path))
    env.reset(seed=2)
    first = env.pose()
    for _ in range(10):
        env.step(np.array([0.625, 0.0], np.float32))
    state = env.simulation.state("robot")
    way_m = math.hypot(state.xyz_m[0] - first.x_m, state.xyz_m[1] - first.y_m)
    assert way_m == pytest.approx(0.5, abs=0.05)  # 1 s at 0.5 m/s, its acceleration at first
    ground_m = env.simulation.world.start["xyz_m"][2] - STAND_M
    assert abs(state.xyz_m[2] - 0.07 - ground_m) < 0.05
    assert rollout(env, 3, 10) == rollout(env, 3, 10)


@pytest.mark.parametrize(
    "wrong, said",
    [
        (
            {"controllers": ()},
            "command_topic: found 'jackal_velocity_controller/cmd_vel', known: none",
        ),
        ({"controllers": ("nothing",)}, "'nothing'"),
        ({"controllers": "base"}, "controllers: found 'base', expected a list of names"),
        ({"command_topic": "cmd_vel"}, "did you mean 'jackal_velocity_controller/cmd_vel'"),
        (
            {"topics": ("ardee/eye", "/ardee/eye")},
            "topics: found 'ardee/eye' twice, expected it once",
        ),
        ({"topics": ("ardee/eye/",)}, "topics: found 'ardee/eye/', known: "),
        ({"stand_m": math.nan}, "stand_m: found nan, expected a finite number"),
        ({"xacro": {"nonsense": 1}}, "nonsense"),
        ({"parameters": "missing.yaml"}, "missing.yaml"),
    ],
)
def test_a_robot_that_could_not_drive_is_refused(
    wrong: Dict[str, Any], said: str, make: Make, tmp_path: Path
) -> None:
    with pytest.raises(ArdeeError) as error:
        make(**{"topics": ("ardee/eye",), **jackal(tmp_path), **wrong})
    assert said in str(error.value)


def test_a_robot_drives_on_through_a_long_control_period(make: Make) -> None:
    """A TerraSentia stops 0.5 s after a command, but for the next one."""
    env = make(control_period_s=1.0, v_max_m_s=0.8)
    env.reset(seed=2)
    env.step(np.array([0.5, 0.0], np.float32))
    first = env.pose()
    env.step(np.array([0.5, 0.0], np.float32))
    second = env.pose()
    way_m = math.hypot(second.x_m - first.x_m, second.y_m - first.y_m)
    assert way_m == pytest.approx(0.4, abs=0.02)


def test_a_robot_finds_the_files_beside_its_own(make: Make, tmp_path: Path) -> None:
    (tmp_path / "hat.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    visual = '<visual><geometry><mesh filename="hat.obj"/></geometry></visual><collision>'
    text = robot("tsv1_default")
    assert "<collision>" in text
    (tmp_path / "bot.urdf").write_text(text.replace("<collision>", visual, 1))
    make(robot=tmp_path / "bot.urdf", randomise={"noise_scale": (2, 2)}).reset(seed=1)
    with Simulation(World.from_file("empty.world")) as sim:
        sim.spawn("bot", robot(tmp_path / "bot.urdf"))


def test_a_depth_that_was_not_measured_is_far() -> None:
    depths = np.array([[np.nan, 1.0, np.inf]], np.float32)
    assert scaled_depths(depths).tolist() == [[1.0, np.float32(0.1), 1.0]]


def test_noise_in_a_comment_or_with_commas() -> None:
    text = "<a><!-- <drift>as read</drift> --><drift>1, 2, 0</drift></a>"
    assert "<drift>2.0 4.0 0.0</drift>" in with_noise(text, 2.0) and "as read" in with_noise(
        text, 2.0
    )


def test_a_sun_of_three_numbers_is_dimmed_in_all_and_files_stay(tmp_path: Path) -> None:
    (tmp_path / "m.obj").touch()
    world = tmp_path / "w.world"
    world.write_text(
        "<sdf><world><scene/><light type='directional'><diffuse>1 0.8 0.6</diffuse></light>"
        "<uri>m.obj</uri><uri>model://sun</uri></world></sdf>"
    )
    world.with_suffix(".start.yaml").touch()
    trial = Trial(world, [], Field((), None), Pose(0.0, 0.0, 0.0), LevelGround())
    (tmp_path / "drawn").mkdir()
    made = with_scene(trial, {"sun_intensity": 0.5}, tmp_path / "drawn", []).world.read_text()
    assert "<diffuse>0.5 0.4 0.3</diffuse>" in made and f"<uri>{tmp_path}/m.obj</uri>" in made
    assert "<uri>model://sun</uri>" in made
    world.write_text(world.read_text().replace("1 0.8 0.6", "bright"))
    with pytest.raises(ArdeeError, match="w.world: <diffuse>: found 'bright', expected 3 or 4 num"):
        with_scene(trial, {"sun_intensity": 0.5}, tmp_path / "drawn", [])


def test_readings_that_somebody_else_keeps_stay(make: Make) -> None:
    env = make()
    env.reset(seed=2)
    env.simulation.demand("ardee/hokuyo", keep=50)
    env.simulation.drain("ardee/hokuyo")
    for _ in range(5):
        env.step(np.array([0.5, 0.0], np.float32))
    assert len(env.simulation.drain("ardee/hokuyo")) == 20  # of 0.5 s at 40 Hz
