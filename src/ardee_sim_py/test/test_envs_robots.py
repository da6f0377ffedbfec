# SPDX-License-Identifier: MIT
"""Environments with robots of others: their topics, ros_control, what is refused."""
import math
from pathlib import Path
from typing import Any, Dict

import numpy as np
import pytest
from ardee_sim import ArdeeError
from test_envs import Make, rollout

from ardee_world.start import STAND_M

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
        ({"stand_m": math.nan}, "stand_m: found nan, expected a finite number"),
        ({"xacro": {"nonsense": 1}}, "nonsense"),
        ({"parameters": "missing.yaml"}, "missing.yaml"),
    ],
)
def test_a_robot_that_could_not_drive_is_refused(
    wrong: Dict[str, Any], said: str, make: Make, tmp_path: Path
) -> None:
    with pytest.raises(ArdeeError) as error:
        make(topics=("ardee/eye",), **{**jackal(tmp_path), **wrong})
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


def test_readings_that_somebody_else_keeps_stay(make: Make) -> None:
    env = make()
    env.reset(seed=2)
    env.simulation.demand("ardee/hokuyo", keep=50)
    env.simulation.drain("ardee/hokuyo")
    for _ in range(5):
        env.step(np.array([0.5, 0.0], np.float32))
    assert len(env.simulation.drain("ardee/hokuyo")) == 20  # of 0.5 s at 40 Hz
