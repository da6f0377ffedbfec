# SPDX-License-Identifier: MIT
"""Tests that in every shipped world a robot can drive down the lane at the pose of the world's start file."""
import pathlib

import pytest

from ardee_common.config import build, read_yaml_lines
from ardee_navigation.evaluation.scenario_files import Scenario
from ardee_navigation.evaluation.scenarios import prepare
from ardee_navigation.evaluation.simulation import Simulation, robot_urdf
from ardee_world.row_truth import Pose, lane_of
from ardee_world.start import Start

WORLDS = pathlib.Path(__file__).resolve().parents[1] / "src" / "ardee_world" / "worlds"
STARTS = sorted(path.name.replace(".start.yaml", ".world") for path in WORLDS.glob("*.start.yaml"))
STEPS_A_COMMAND, STEP_S, SPEED_M_S = 10, 0.005, 0.5
SETTLE_STEPS, COMMANDS = (
    200,
    320,
)  # 1 s to come to rest, 16 s of driving: 1 m of headland, 7 m of lane
HEADING_GAIN_PER_S, OFFSET_GAIN_RAD_PER_M_S = 1.0, 0.8


def way_driven_m(world: str, folder: pathlib.Path) -> float:
    """Returns the way along its lane of a robot that is kept in the middle by its true pose."""
    trial = prepare(Scenario(world=world), 0, folder)
    start = build(Start, read_yaml_lines(trial.world.with_suffix(".start.yaml")))
    pose = Pose(start.x_m, start.y_m, start.yaw_rad)
    lane = lane_of(trial.field, pose)
    with Simulation(trial.world, 0, []) as simulation:
        simulation.spawn(robot_urdf(), pose, start.z_m)
        simulation.command(0.0, 0.0)
        simulation.step(SETTLE_STEPS)
        first = lane.deviation(simulation.pose())
        for _ in range(COMMANDS):
            here = lane.deviation(simulation.pose())
            turn = -HEADING_GAIN_PER_S * here.heading_rad - OFFSET_GAIN_RAD_PER_M_S * here.lateral_m
            simulation.command(SPEED_M_S, turn)
            simulation.step(STEPS_A_COMMAND)
        return lane.deviation(simulation.pose()).along_m - first.along_m


@pytest.mark.parametrize("world", STARTS)
def test_a_robot_can_drive_off(world: str, tmp_path: pathlib.Path) -> None:
    commanded_m = COMMANDS * STEPS_A_COMMAND * STEP_S * SPEED_M_S
    assert way_driven_m(world, tmp_path) == pytest.approx(commanded_m, rel=0.05)
