# SPDX-License-Identifier: MIT
"""Tests that in every shipped world a robot can drive down the lane at the pose of the world's start file."""
import pathlib

import ardee_sim
import pytest

from ardee_campaigns.campaign_file import RobotKeys
from ardee_campaigns.robot import Driven, expand
from ardee_common.config import build, read_yaml_lines
from ardee_world.row_truth import Pose, lane_of
from ardee_world.start import Start
from ardee_world.trial import prepare

WORLDS = pathlib.Path(__file__).resolve().parents[1] / "src" / "ardee_world" / "worlds"
STARTS = sorted(path.name.replace(".start.yaml", ".world") for path in WORLDS.glob("*.start.yaml"))
STEPS_A_COMMAND, STEP_S, SPEED_M_S = 10, 0.005, 0.5
COMMANDS = 320  # 16 s of driving: 1 m of headland, 7 m of lane
HEADING_GAIN_PER_S, OFFSET_GAIN_RAD_PER_M_S = 1.0, 0.8


def way_driven_m(world: str, folder: pathlib.Path) -> float:
    """Returns the way along its lane of a robot that is kept in the middle by its true pose."""
    trial = prepare(WORLDS / world, None, 0, folder)
    start = build(Start, read_yaml_lines(trial.world.with_suffix(".start.yaml")))
    pose = Pose(start.x_m, start.y_m, start.yaw_rad)
    lane = lane_of(trial.field, pose)
    keys = RobotKeys()
    with ardee_sim.Simulation(ardee_sim.World.from_file(trial.world)) as sim:
        driven = Driven(sim, "robot", keys, expand(keys, {}, folder))
        driven.spawn(pose, trial)
        first = lane.deviation(driven.pose())
        for _ in range(COMMANDS):
            here = lane.deviation(driven.pose())
            turn = -HEADING_GAIN_PER_S * here.heading_rad - OFFSET_GAIN_RAD_PER_M_S * here.lateral_m
            driven.command(SPEED_M_S, turn)
            sim.step(STEPS_A_COMMAND)
        return lane.deviation(driven.pose()).along_m - first.along_m


@pytest.mark.parametrize("world", STARTS)
def test_a_robot_can_drive_off(world: str, tmp_path: pathlib.Path) -> None:
    commanded_m = COMMANDS * STEPS_A_COMMAND * STEP_S * SPEED_M_S
    assert way_driven_m(world, tmp_path) == pytest.approx(commanded_m, rel=0.05)
