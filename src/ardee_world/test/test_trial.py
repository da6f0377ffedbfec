# SPDX-License-Identifier: MIT
"""Tests where a robot starts, and which field and ground a world has."""
from pathlib import Path

import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_world.start import Start
from ardee_world.trial import START_SD_M, START_SD_RAD, field_and_terrain, start_near


def test_start_poses_scatter_as_said_and_repeat() -> None:
    """In 2000 seeds, mean and variance lie within 3.9 standard errors (99.99 %)."""
    start = Start(1.0, 2.0, 0.0, 0.5)
    poses = np.array([start_near(start, seed) for seed in range(2000)])
    aside = -np.sin(0.5) * (poses[:, 0] - 1.0) + np.cos(0.5) * (poses[:, 1] - 2.0)
    ahead = np.cos(0.5) * (poses[:, 0] - 1.0) + np.sin(0.5) * (poses[:, 1] - 2.0)
    assert np.abs(ahead).max() < 1e-9
    for values, sd in ((aside, START_SD_M), (poses[:, 2] - 0.5, START_SD_RAD)):
        assert abs(values.mean()) < 3.9 * sd / np.sqrt(2000)
        assert abs(values.var() / sd**2 - 1.0) < 3.9 * np.sqrt(2.0 / 2000)
    assert start_near(start, 5) == start_near(start, 5)


def _model(folder: Path, name: str, collision: str, *files: str) -> None:
    (folder / name).mkdir()
    text = f"<sdf><model><link><collision><geometry><{collision}/></geometry></collision></link></model></sdf>"
    for file in ("model.config", "model.sdf", *files):
        (folder / name / file).write_text(text)


def _world(folder: Path, *models: str) -> Path:
    includes = "".join(f"<include><uri>model://{name}</uri></include>" for name in models)
    path = folder / "w.world"
    path.write_text(f"<sdf><world>{includes}</world></sdf>")
    return path


def test_field_and_terrain_are_found_among_other_includes(tmp_path: Path) -> None:
    _model(tmp_path, "my_field", "cylinder", "truth.json")
    _model(tmp_path, "my_ground", "heightmap")
    _model(tmp_path, "barn", "box")
    for names in (("sun", "my_field", "barn", "my_ground"), ("my_ground", "my_field")):
        found = field_and_terrain(_world(tmp_path, *names), [tmp_path])
        assert found == (tmp_path / "my_field", "my_ground")


@pytest.mark.parametrize(
    "names, message",
    [
        (("sun", "my_ground"), "w.world: found 0 fields with truth.json, expected one include"),
        (("my_field",), "w.world: found 0 terrains, expected one include"),
        (("my_field", "my_ground", "plane"), r"w.world: found 2 terrains \(my_ground, plane\)"),
    ],
)
def test_a_world_without_one_field_and_one_terrain_is_no_scenario(
    tmp_path: Path, names: tuple, message: str
) -> None:
    _model(tmp_path, "my_field", "cylinder", "truth.json")
    _model(tmp_path, "my_ground", "heightmap")
    _model(tmp_path, "plane", "plane")
    with pytest.raises(GeneratorError, match=message):
        field_and_terrain(_world(tmp_path, *names), [tmp_path])


def test_a_world_that_is_no_xml_is_named(tmp_path: Path) -> None:
    world = tmp_path / "w.world"
    world.write_text("<sdf>")
    with pytest.raises(GeneratorError, match="w.world: not valid XML"):
        field_and_terrain(world, [tmp_path])
