# SPDX-License-Identifier: MIT
"""Texts of models as users of Gazebo have them: what is read, and what is warned about."""

from pathlib import Path

import pytest
from ardee_sim import Simulation, World

MODEL = "<sdf version='1.6'><model name='m'><link name='l'>{}</link>{}</model></sdf>"
SENSOR = "<sensor name='s' type='{}'/>"
RATE = (
    "<plugin name='p' filename='libgazebo_ros_p3d.so'><bodyName>l</bodyName><topicName>t</topicName>"
    "<updateRate>{}</updateRate></plugin>"
)


@pytest.fixture
def sim() -> Simulation:
    return Simulation(World.from_string("<sdf version='1.6'><world name='w'/></sdf>"))


def test_a_byte_order_mark_is_no_name(sim: Simulation) -> None:
    text = "\ufeff<robot name='r'><link name='l'/></robot>"
    assert sim.spawn("m", text, is_static=True).name == "m"


def test_an_include_alone_is_a_model(
    sim: Simulation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "post").mkdir()
    (tmp_path / "post" / "model.config").write_text(
        "<model><name>post</name><sdf version='1.6'>model.sdf</sdf></model>"
    )
    (tmp_path / "post" / "model.sdf").write_text(MODEL.format("", ""))
    monkeypatch.setenv("GAZEBO_MODEL_PATH", str(tmp_path))
    world = World.from_string("<sdf version='1.6'><world name='w'/></sdf>")
    text = "<sdf version='1.6'><include><uri>model://post</uri></include></sdf>"
    assert Simulation(world).spawn("m", text).name == "m"


@pytest.mark.parametrize("rate_hz, readings", [(-1, 10), (0, 10), (500, 5)])
def test_a_rate_below_zero_is_that_of_each_step(
    sim: Simulation, rate_hz: int, readings: int
) -> None:
    """A step takes 1 ms."""
    sim.spawn("m", MODEL.format("", RATE.format(rate_hz)), xyz_m=(0, 0, 9))
    sim.demand("t")
    stamps = set()
    for _ in range(10):
        sim.step(1)
        reading = sim.latest("t")
        stamps |= {reading.stamp_ns} if reading else set()
    assert len(stamps) == readings


@pytest.mark.parametrize("kind, is_warned", [("wideanglecamera", True), ("ray", False)])
def test_a_lens_that_is_drawn_as_another_is_warned_about(
    sim: Simulation, kind: str, is_warned: bool
) -> None:
    sim.spawn("m", MODEL.format(SENSOR.format(kind), ""))
    assert any("wide-angle" in line.text for line in sim.log()) == is_warned
