# SPDX-License-Identifier: MIT
"""Robots whose wheels are moved by controllers of ros_control, as labs publish them."""
import math
import pathlib
from typing import Callable, Dict, Iterator, List, Tuple, Type

import ardee_sim
import numpy as np
import pytest
from ardee_sim import ArdeeError, Twist

ROBOTS = pathlib.Path(__file__).resolve().parents[3] / "tests" / "robots_with_ros_control"
JOINTS, DRIVE = "jackal_joint_publisher", "jackal_velocity_controller"
RADIUS_M, SPEED_M_S = 0.098, 0.5


@pytest.fixture
def sim() -> Iterator[ardee_sim.Simulation]:
    """Yields a Jackal on level ground, with the parameters of its controllers."""
    world = ardee_sim.World.from_file("empty.world")
    with ardee_sim.Simulation(world) as made:
        made.set_parameters(ROBOTS / "jackal.yaml")
        made.spawn("jackal", ardee_sim.robot(ROBOTS / "jackal.urdf.xacro"), xyz_m=(0, 0, 0.07))
        made.step(round(1e9 / made.step_ns))  # onto its wheels
        yield made


def drive(sim: ardee_sim.Simulation, drive_s: float) -> None:
    """Commands at 10 Hz: the controller's own limit is 0.25 s without a command."""
    for _ in range(round(10 * drive_s)):
        sim.command(f"{DRIVE}/cmd_vel", Twist(linear_x_m_s=SPEED_M_S))
        sim.step(round(1e8 / sim.step_ns))


def test_a_started_drive_turns_its_wheels(sim: ardee_sim.Simulation) -> None:
    with pytest.raises(KeyError, match="topic with commands"):
        drive(sim, 0.1)
    sim.start_controllers("jackal", JOINTS, DRIVE)
    assert sim.controllers("jackal") == {JOINTS: "running", DRIVE: "running"}
    assert f"/{DRIVE}/odom" in sim.topics() and "/joint_states" in sim.entities()[-1].topics
    sim.demand("joint_states", f"{DRIVE}/odom")
    drive(sim, 1.0)  # past its limit on acceleration
    turned_rad, x_m = sim.latest("joint_states").positions[0], sim.state("jackal").xyz_m[0]
    drive(sim, 2.0)
    way_m = 2.0 * SPEED_M_S
    late_m = SPEED_M_S / 50  # of the last joint state, at 50 Hz
    turned_m = (sim.latest("joint_states").positions[0] - turned_rad) * RADIUS_M
    assert turned_m == pytest.approx(way_m, abs=late_m)
    assert sim.state("jackal").xyz_m[0] - x_m == pytest.approx(way_m, rel=0.03)  # some slip
    assert sim.latest(f"{DRIVE}/odom").v_m_s[0] == pytest.approx(SPEED_M_S, rel=0.03)


def test_a_stopped_drive_stands(sim: ardee_sim.Simulation) -> None:
    sim.start_controllers("jackal", DRIVE)
    drive(sim, 1.0)
    sim.stop_controllers("jackal", DRIVE)
    assert sim.controllers("jackal") == {DRIVE: "stopped"}
    sim.step(round(1e9 / sim.step_ns))
    assert math.hypot(*sim.state("jackal").v_m_s[:2]) < 1e-3


def test_controllers_are_part_of_a_snapshot(sim: ardee_sim.Simulation) -> None:
    sim.start_controllers("jackal", JOINTS, DRIVE)
    sim.demand("joint_states")
    drive(sim, 0.7)
    before = sim.snapshot()
    drive(sim, 0.5)
    first = sim.snapshot().data, sim.latest("joint_states").positions.tobytes()
    with ardee_sim.Simulation(sim.world) as other:
        other.set_parameters(ROBOTS / "jackal.yaml")
        other.restore(before)
        other.demand("joint_states")
        drive(other, 0.5)
        assert (
            other.snapshot().data,
            other.latest("joint_states").positions.tobytes(),
        ) == first


def test_parameters_are_merged_below_a_namespace(sim: ardee_sim.Simulation) -> None:
    sim.set_parameters(
        {JOINTS: {"type": "joint_state_controller/JointStateController"}}, namespace="a/b"
    )
    sim.set_parameters({"a": {"b": {JOINTS: {"publish_rate": np.int64(20)}}}})
    urdf = ardee_sim.robot(ROBOTS / "jackal.urdf.xacro").replace(
        "<robotNamespace>/<", "<robotNamespace>/a/b<"
    )
    sim.spawn("other", urdf, xyz_m=(0, 3, 0.07))
    sim.start_controllers("other", JOINTS)
    assert sim.topics()["/a/b/joint_states"].kind == "JointStateReading"


def test_names_with_slashes_are_groups(sim: ardee_sim.Simulation) -> None:
    sim.set_parameters({f"{JOINTS}/publish_rate": 20, JOINTS: {"a/b": 1, "a": {"c": 2}}})
    sim.start_controllers("jackal", JOINTS)
    sim.demand("joint_states", keep=100)
    sim.step(round(1e9 / sim.step_ns))
    assert len(sim.drain("joint_states")) == pytest.approx(20, abs=1)


def test_what_cannot_be_started_is_refused_and_changes_nothing(
    sim: ardee_sim.Simulation, tmp_path: pathlib.Path
) -> None:
    (tmp_path / "bad.yaml").write_text("a: 1\na: 2\n")
    endless: Dict[str, object] = {}
    endless["a"] = [endless]
    calls: List[Tuple[Type[Exception], str, Callable[[], object]]] = [
        (
            ArdeeError,
            "nothing_there",
            lambda: sim.start_controllers("jackal", DRIVE, "nothing_there"),
        ),
        (ArdeeError, "found no model 'nobody'", lambda: sim.controllers("nobody")),
        (
            ArdeeError,
            "without a controller manager",
            lambda: sim.start_controllers("ground_plane", DRIVE),
        ),
        (
            ArdeeError,
            "bad.yaml:2: found key 'a' a second",
            lambda: sim.set_parameters(tmp_path / "bad.yaml"),
        ),
        (
            ArdeeError,
            "/a/b: found None, expected a number",
            lambda: sim.set_parameters({"a": {"b": None}}),
        ),
        (ArdeeError, "more than 20 levels", lambda: sim.set_parameters(endless)),
        (ArdeeError, "32 bits", lambda: sim.set_parameters({"a": 2**31})),
        (TypeError, "parameters: found 1", lambda: sim.set_parameters(1)),  # type: ignore[arg-type]
        (TypeError, "name: found 1", lambda: sim.start_controllers("jackal", 1)),  # type: ignore[arg-type]
    ]
    for error, text, call in calls:
        with pytest.raises(error, match=text):
            call()
    assert sim.controllers("jackal") == {}
