# SPDX-License-Identifier: MIT
"""Tests that bad input is one exception of a documented type, which says the place, and that the simulation goes on."""
import pathlib
from typing import Callable, Dict, List, Tuple, Type

import ardee_sim
import numpy as np
import pytest
from ardee_sim import ArdeeError, World


def test_bad_calls_say_what_was_expected(sim: ardee_sim.Simulation, terrasentia: str) -> None:
    calls: List[Tuple[Type[Exception], str, Callable[[], object]]] = [
        (KeyError, "/cmd_vel", lambda: sim.command("cmd_vell", ardee_sim.Twist())),
        (KeyError, "/ardee/hokuyo", lambda: sim.demand("ardee/hokuyu")),
        (KeyError, "calibrate", lambda: sim.call("ardee/imu/custom/calibrat")),
        (TypeError, "expected a Twist", lambda: sim.command("cmd_vel", 1.0)),
        (ArdeeError, "not finite", lambda: sim.command("cmd_vel", ardee_sim.Twist(float("nan")))),
        (ArdeeError, "was not demanded", lambda: sim.latest("ardee/imu/custom")),
        (ArdeeError, "already exists", lambda: sim.spawn("robot", terrasentia)),
        (ArdeeError, "expected 3 finite", lambda: sim.spawn("x", terrasentia, xyz_m=(0, 1))),
        (ArdeeError, "expected 3 numbers", lambda: sim.spawn("x", terrasentia, xyz_m=("0", 1, 2))),
        (ArdeeError, "expected 3 numbers", lambda: sim.spawn("x", terrasentia, xyz_m=(0, 1, 2j))),
        (ArdeeError, "n: found -1, expected 0", lambda: sim.step(-1)),
        (ArdeeError, "no model 'nobody'", lambda: sim.remove("nobody")),
        (ArdeeError, "as robot\\(\\) returns", lambda: sim.spawn("x", "tsv1_default")),
        (ArdeeError, "the scale 2.*1 of a model", lambda: sim.spawn("x", terrasentia, scale=2)),
        (ArdeeError, "label: found 65536", lambda: sim.spawn("x", terrasentia, label=2**16)),
        (ArdeeError, "length 1", lambda: sim.set_state("robot", quat_xyzw=np.zeros(4))),
        (ArdeeError, "length 1", lambda: sim.render((0, 0, 1), (0, 0, 0, 1e300))),
        (TypeError, "expected a Snapshot", lambda: sim.restore(b"")),  # type: ignore[arg-type]
        (TypeError, "expected a World", lambda: ardee_sim.Simulation("corn.world")),  # type: ignore[arg-type]
        (
            ArdeeError,
            "ray_threads: found -1",
            lambda: ardee_sim.Simulation(sim.world, ray_threads=-1),
        ),
        (TypeError, "seed: found 1.5", lambda: ardee_sim.Simulation(sim.world, seed=1.5)),  # type: ignore[arg-type]
        (TypeError, "model: found None, expected a path", lambda: sim.spawn("x", None)),  # type: ignore[arg-type]
        (TypeError, "a mapping", lambda: sim.spawn("x", terrasentia, joint_positions=[1])),  # type: ignore[arg-type]
        (TypeError, "light: found None, expected a Dayl", lambda: sim.set_light(None)),  # type: ignore[arg-type]
        (
            ArdeeError,
            "cloud: found nan",
            lambda: sim.set_light(ardee_sim.Daylight(0, 9, 3, np.nan)),
        ),
        (ArdeeError, "without NUL", lambda: sim.state("robot\0")),
        (TypeError, "expected a list of f", lambda: World.from_file("w", model_paths="lost")),
        (TypeError, "path: found None", lambda: World.from_file(None)),  # type: ignore[arg-type]
        (ArdeeError, "found no robot 'x", lambda: ardee_sim.robot("x" * 300)),
    ]
    for error, text, call in calls:
        with pytest.raises(error, match=text):
            call()
    sim.step()


def test_no_argument_whatsoever_breaks_a_simulation(
    sim: ardee_sim.Simulation, terrasentia: str
) -> None:
    """Wrong ones are refused in one line, as the class says; scalars of numpy are numbers."""
    topic, vector = "ardee/hokuyo", (0, 0, 1)
    good: Dict[str, Tuple[object, ...]] = {
        "demand": (topic,),
        **{name: ("robot",) for name in ("state", "set_state", "description")},
        **{name: (topic,) for name in ("trigger", "undemand", "demands", "latest", "drain")},
        **{name: (np.int64(1),) for name in ("step", "set_noise_seed")},
        "spawn": ("other", terrasentia),
        "remove": ("other",),
        "set_light": (ardee_sim.Daylight(np.float32(10), 20),),
        "restore": (sim.snapshot(),),
        "command": ("cmd_vel", [0.0] * 6),
        "call": ("ardee/imu/custom/set_rate_bias", 0, np.float64(0), np.float32(0)),
        "scenery": (0, 0.0, np.float32(1)),
        "set_parameters": ({"gains": {"p": np.float64(1)}},),
    }
    wrong = [None, "", "\ud800", b"x", 1.5, np.nan, 2**70, -1, object(), np.array(2.0), [vector]]
    for name, arguments in good.items():
        for place in range(len(arguments)):
            for each in wrong:
                try:
                    getattr(sim, name)(*arguments[:place], each, *arguments[place + 1 :])
                except (ArdeeError, TypeError, KeyError) as error:
                    assert "\n" not in str(error) and "incompatible" not in str(error)
        if name != "trigger":
            getattr(sim, name)(*arguments)
    sim.render(np.array(vector), width_px=np.int32(8), height_px=8, near_m=np.float32(0.5))


def test_no_topic_is_demanded_if_one_is_unknown(sim: ardee_sim.Simulation) -> None:
    with pytest.raises(KeyError, match="hokuyu"):
        sim.demand("ardee/hokuyo", "ardee/hokuyu")
    assert not sim.demands("ardee/hokuyo")


def test_a_topic_of_several_devices_is_named_once(sim: ardee_sim.Simulation) -> None:
    with pytest.raises(KeyError) as caught:
        sim.command("cmd_vell", ardee_sim.Twist())
    assert str(caught.value).count("/cmd_vel,") == 1


def test_a_robot_that_is_refused_says_where_and_leaves_nothing(
    sim: ardee_sim.Simulation, tmp_path: pathlib.Path
) -> None:
    file = tmp_path / "bad.urdf"
    file.write_text("<robot name='r'>\n<link name='a'>\n<inertial><mass value='nan'/></inertial>")
    before = sim.entities()
    for text, line in [
        ("</link></robot>", 3),  # no inertia
        ("</link>", 3),  # not closed
    ]:
        broken = tmp_path / "broken.urdf"
        broken.write_text(file.read_text() + text)
        with pytest.raises(ArdeeError) as caught:
            sim.spawn("other", broken)
        assert caught.value.file == str(broken) and 1 <= (caught.value.line or 0) <= line
    with pytest.raises(ArdeeError, match="nowhere.urdf"):
        sim.spawn("other", tmp_path / "nowhere.urdf")
    with pytest.raises(ArdeeError, match="seed: found -1"):
        ardee_sim.Simulation(sim.world, seed=-1)
    assert sim.entities() == before
    sim.step()


def test_a_world_that_cannot_be_read_is_refused(tmp_path: pathlib.Path) -> None:
    accent = tmp_path / "accent.world"
    accent.write_bytes(
        b"<sdf version='1.6'><world name='w'>\n<gravity>\xe9</gravity></world></sdf>"
    )
    calls: List[Tuple[str, Callable[[], object]]] = [
        ("found a folder", lambda: World.from_file(tmp_path)),
        ("path: found '', expected a path", lambda: World.from_file("")),
        ("accent.world:2: <gravity>: found '\ufffd'", lambda: World.from_file(accent)),
        ("lost', expected a folder", lambda: World.from_file(accent, model_paths=["lost"])),
    ]
    for text, call in calls:
        with pytest.raises(ArdeeError, match=text):
            call()
    binary = tmp_path / "robot.urdf"
    binary.write_bytes(b"\xff\xfe")
    with pytest.raises(ArdeeError, match="robot.urdf: .*expected a text file"):
        ardee_sim.robot(binary)


@pytest.mark.parametrize(
    "text, expected",
    [
        ("{x_m: .nan, y_m: 0, z_m: 0, yaw_rad: 0}", "w.start.yaml:1: x_m: found nan"),
        (
            "{x_m: 0, y_m: 0, z_m: 0, yaw_rad: 0, yaw_deg: 90}",
            "w.start.yaml:1: unknown key 'yaw_deg'",
        ),
        ("[1, 2]", "w.start.yaml: found list, expected a mapping"),
    ],
)
def test_a_bad_start_pose_is_refused(tmp_path: pathlib.Path, text: str, expected: str) -> None:
    world = tmp_path / "w.world"
    world.write_text("<sdf version='1.6'><world name='w'/></sdf>")
    world.with_suffix(".start.yaml").write_text(text)
    with pytest.raises(ArdeeError, match=expected):
        World.from_file(world).start


def test_a_closed_simulation_says_so(sim: ardee_sim.Simulation) -> None:
    sim.close()
    sim.close()
    for call in (sim.step, sim.reset, sim.snapshot, sim.entities, lambda: sim.time_ns):
        with pytest.raises(RuntimeError, match="closed"):
            call()
