# SPDX-License-Identifier: MIT
"""Tests worlds, plants and robots' descriptions."""
import pathlib
import subprocess
import xml.etree.ElementTree as ElementTree

import ardee_sim
import numpy as np
import pytest
from ardee_sim.packages import find_package


def test_plants_have_their_rows_and_stand_where_truth_says(corn: ardee_sim.World) -> None:
    plants = corn.plants()
    assert len(plants) == len({plant.instance for plant in plants}) > 100
    assert {plant.species for plant in plants} == {"corn"}
    for row in {(plant.plot, plant.row) for plant in plants}:
        feet_m = np.array([p.xyz_m[:2] for p in plants if (p.plot, p.row) == row])
        assert (
            min(np.std(feet_m, axis=0)) < 0.05
        ), "rows of corn.world run along x, its end rows along y"
    assert all(0.5 < plant.height_m < 3.0 and plant.stage for plant in plants)


def test_the_start_is_the_shipped_one(corn: ardee_sim.World) -> None:
    assert corn.start == {"xyz_m": (0.0, 0.0, 0.175), "rpy_rad": (0.0, 0.0, -3.14)}
    assert ardee_sim.World.from_file("empty.world").start == corn.start  # it has no file


def test_a_world_that_cannot_be_read_says_where(tmp_path: pathlib.Path) -> None:
    file = tmp_path / "bad.world"
    file.write_text("<sdf version='1.6'>\n<world name='w'>\n<light/>\n</world></sdf>")
    with pytest.raises(ardee_sim.ArdeeError) as caught:
        ardee_sim.World.from_file(file)
    assert (caught.value.file, caught.value.line) == (str(file), 3)
    with pytest.raises(ardee_sim.ArdeeError, match="corn.world"):
        ardee_sim.World.from_file("corm.world")


def test_a_model_path_of_ones_own_comes_first(tmp_path: pathlib.Path) -> None:
    model = tmp_path / "mine"
    model.mkdir()
    (model / "model.config").write_text("<model><sdf version='1.6'>model.sdf</sdf></model>")
    (model / "model.sdf").write_text(
        "<sdf version='1.6'><model name='m'><link name='only'/></model></sdf>"
    )
    text = "<sdf version='1.6'><world name='w'><include><uri>model://mine</uri></include></world></sdf>"
    world = ardee_sim.World.from_string(text, model_paths=[tmp_path])
    with ardee_sim.Simulation(world) as sim:
        assert [entity.links for entity in sim.entities()] == [("only",)]


@pytest.mark.parametrize("name", ["tsv1_default", "tsv2_default", "tsv3_default"])
def test_a_robot_is_expanded_as_by_ros(name: str) -> None:
    file = find_package("terrasentia_description") / "robots" / f"{name}.urdf.xacro"
    command = ["rosrun", "xacro", "xacro", str(file), "command_timeout:=0"]
    by_ros = subprocess.run(command, stdout=subprocess.PIPE, check=True, text=True).stdout
    ours = ardee_sim.robot(name, command_timeout=0)
    assert ElementTree.canonicalize(ours, strip_text=True) == ElementTree.canonicalize(
        by_ros, strip_text=True
    )


def test_a_robot_that_is_not_there_or_broken_says_so(tmp_path: pathlib.Path) -> None:
    with pytest.raises(ardee_sim.ArdeeError, match="tsv1_default"):
        ardee_sim.robot("tsv9_default")
    with pytest.raises(ardee_sim.ArdeeError, match="'sensrs', expected one of: .*sensors"):
        ardee_sim.robot("tsv1_default", sensrs="full")
    broken = tmp_path / "broken.urdf.xacro"
    broken.write_text('<robot xmlns:xacro="http://ros.org/wiki/xacro" name="${1/0}"/>')
    with pytest.raises(ardee_sim.ArdeeError, match="division by zero"):
        ardee_sim.robot(broken)


def a_field(folder: pathlib.Path, truth: str) -> ardee_sim.World:
    """Returns a world with one plant of a field of this truth.csv."""
    field = folder / "field"
    field.mkdir(exist_ok=True)
    (field / "model.config").write_text("<model><sdf version='1.6'>model.sdf</sdf></model>")
    (field / "model.sdf").write_text(
        "<sdf version='1.6'><model name='f'><static>true</static><include><uri>model://corn_variant_1</uri>"
        "<name>plant_5</name><ardee:label>1</ardee:label></include></model></sdf>"
    )
    (field / "truth.csv").write_text(truth)
    text = "<sdf version='1.6'><world name='w'><include><uri>model://field</uri></include></world></sdf>"
    return ardee_sim.World.from_string(text, model_paths=[folder])


def test_plants_of_a_world_stay_as_they_were(tmp_path: pathlib.Path) -> None:
    """Also those of a table with the mark that Excel writes first."""
    head = "\ufeffid,plot,row,place,stage,height_m\n"
    world = a_field(tmp_path, f"{head}5,0,1,2,V6,0.5\n")
    (plant,) = world.plants()
    assert (plant.id, plant.row, plant.stage, plant.height_m) == (5, 1, "V6", 0.5)
    a_field(tmp_path, f"{head}5,0,1,2,R2,2.5\n")
    assert world.plants() == [plant]


@pytest.mark.parametrize(
    "truth, said",
    [
        ("plot,row\n0,1\n", "truth.csv:2: found 'id', expected whole numbers in id, plot"),
        ("id,plot,row,place,stage,height_m\n5,0.0,1,2,V6,0.5\n", "truth.csv:2: found .*'0.0'"),
        ("id,plot,row,place,stage,height_m\n5,0\n", "truth.csv:2: found"),
    ],
)
def test_a_truth_that_cannot_be_read_says_where(
    tmp_path: pathlib.Path, truth: str, said: str
) -> None:
    with pytest.raises(ardee_sim.ArdeeError, match=said) as caught:
        a_field(tmp_path, truth).plants()
    assert caught.value.line == 2


def test_a_robot_is_expanded_in_any_folder(
    tmp_path: pathlib.Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "xacro.py").write_text("raise SystemExit('mine')")
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("PYTHONPATH", raising=False)
    assert "TSv1" in ardee_sim.robot("tsv1_default")
