# SPDX-License-Identifier: MIT
"""Cameras as they are in the field: with dust on the lens, on a robot that drives."""

import math
from pathlib import Path

import numpy as np
import pytest
from small_sets import DRIVEN, MOVING, generated, samples

from ardee_common.errors import GeneratorError
from ardee_datasets.generate_dataset import main
from ardee_datasets.robots import RobotKeys, read_robot
from ardee_datasets.sample import LAYERS
from ardee_world.row_truth import Pose, lane_of, read_field

ROBOTS = Path(__file__).resolve().parents[3] / "tests" / "robots_with_ros_control"


def test_dust_and_drops_change_the_picture_alone(tmp_path: Path) -> None:
    """Labels, depth and annotations stay."""
    once = MOVING.replace("frames: 4", "frames: 1")
    dirty = once.replace("speed_m_s", "lens: {dust: [20, 30], drops: [2, 3]}, speed_m_s")
    moving, other = generated(tmp_path / "clean", once), generated(tmp_path / "dirty", dirty)
    for sample, same in zip(samples(other), samples(moving)):
        assert len(sample.pop("lens")) >= 22 and same.pop("lens") == []
        assert sample == same
        for layer, ending in LAYERS.items():
            one, two = (
                made / sample["split"] / layer / f"{sample['id']}.{ending}"
                for made in (other, moving)
            )
            assert (one.read_bytes() == two.read_bytes()) == (layer != "rgb")


JACKAL = f"""robot: jackal.urdf.xacro, command: jackal_velocity_controller/cmd_vel,
    parameters: {ROBOTS}/jackal.yaml, controllers: [jackal_velocity_controller]"""


def write_jackal(folder: Path) -> None:
    """Writes a robot whose wheels are moved by ros_control, with a camera."""
    sensor = '<sensor name="camera_front_sensor" type="camera"><pose>0.2 0 0.2 0 0 0</pose><camera/></sensor>'
    (folder / "jackal.urdf.xacro").write_text(
        f"""<robot name="with_camera" xmlns:xacro="http://www.ros.org/wiki/xacro">
          <xacro:include filename="{ROBOTS}/jackal.urdf.xacro"/>
          <gazebo reference="base_link">{sensor}</gazebo>
        </robot>"""
    )


@pytest.mark.parametrize("robot", ["robot: tsv3_default", JACKAL])
def test_a_robot_takes_pictures_at_places_along_its_lane(tmp_path: Path, robot: str) -> None:
    """At a sixth, a half, five sixths of the lane, left of its middle, at its speed and time."""
    write_jackal(tmp_path)
    recipe = (DRIVEN % "camera_front_sensor").replace("robot: tsv3_default", robot)
    made = generated(tmp_path, recipe)
    found = samples(made)
    assert len(found) == 3 and {sample["camera"] for sample in found} == {
        "terra_camera_front_sensor"
    }
    field = read_field(made / "truth" / "corn_0000" / "truth.json")
    for k, sample in enumerate(found):
        X_WC, v_m_s = np.array(sample["X_WC"]), np.array(sample["motion"]["v_m_s"])
        yaw = math.atan2(X_WC[1, 2], X_WC[0, 2])
        lane = lane_of(field, Pose(*X_WC[:2, 3], yaw))
        here = lane.deviation(Pose(*X_WC[:2, 3], yaw))
        assert abs(here.lateral_m - 0.05) < 0.05 and abs(here.heading_rad) < 0.2
        assert abs(np.hypot(*v_m_s[:2]) - 0.9) < 0.1
        if k:
            away = np.linalg.norm(X_WC[:2, 3] - np.array(found[k - 1]["X_WC"])[:2, 3])
            assert abs(away - lane.centre.length_m / 3) < 0.1
            passed_s = (sample["stamp_ns"] - found[k - 1]["stamp_ns"]) * 1e-9
            assert passed_s == pytest.approx(away / 0.9, rel=0.1)


@pytest.mark.parametrize("key", ["<exposure>dark</exposure>", "<whiteBalance>dark</whiteBalance>"])
def test_a_camera_that_cannot_be_read_is_refused(tmp_path: Path, key: str) -> None:
    sensor = f'<sensor name="eye" type="camera"><camera/><plugin>{key}</plugin></sensor>'
    robot = tmp_path / "robot.urdf"
    robot.write_text(f'<robot name="r"><gazebo reference="l">{sensor}</gazebo></robot>')
    with pytest.raises(GeneratorError, match="robot: found .*robot.urdf: .*'dark', expected"):
        read_robot(RobotKeys(robot=str(robot)), tmp_path)


def test_no_picture_is_added_once_a_robot_has_changed(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    write_jackal(tmp_path)
    recipe = (DRIVEN % "camera_front_sensor").replace("robot: tsv3_default", JACKAL)
    made = generated(tmp_path, recipe.replace("frames: 3", "frames: 1"))
    robot = tmp_path / "jackal.urdf.xacro"
    robot.write_text(robot.read_text().replace("0.2 0 0.2", "0.2 0 0.3"))
    with pytest.raises(SystemExit):
        main([str(tmp_path / "recipe.yaml"), "--output", str(made)])
    assert "of another robot terra than there is now" in capsys.readouterr().err
