# SPDX-License-Identifier: MIT
"""Tests simulations: motion, readings, snapshots, threads, refusals."""
import pathlib
import signal
import subprocess
import sys
import threading
import time
from typing import Dict, Iterator, List

import ardee_sim
import numpy as np
import pytest

ON_WHEELS_M = (0.0, 0.0, 0.175)
BALL = """<sdf version='1.6'><model name='ball'><link name='link'>
<inertial><mass>1</mass><inertia><ixx>0.004</ixx><iyy>0.004</iyy><izz>0.004</izz></inertia></inertial>
<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision></link></model></sdf>"""
GROUND = """<sdf version='1.6'><world name='plain'><model name='ground'><static>true</static><link name='link'>
<collision name='c'><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>
</link></model></world></sdf>"""


def drive(sim: ardee_sim.Simulation, steps: int) -> bytes:
    """Returns the bytes of all scans and of the last pose of a drive."""
    sim.demand("ardee/hokuyo", "ardee/imu/custom", keep=1000)
    sim.command("cmd_vel", ardee_sim.Twist(linear_x_m_s=0.5, angular_z_rad_s=0.1))
    sim.step(steps)
    scans = b"".join(scan.ranges_m.tobytes() for scan in sim.drain("ardee/hokuyo"))
    turns = b"".join(reading.w_rad_s.tobytes() for reading in sim.drain("ardee/imu/custom"))
    return scans + turns + sim.state("robot").xyz_m.tobytes()


def placed(corn: ardee_sim.World, terrasentia: str, seed: int = 1) -> ardee_sim.Simulation:
    made = ardee_sim.Simulation(corn, seed=seed)
    made.spawn("robot", terrasentia, xyz_m=ON_WHEELS_M, rpy_rad=(0, 0, -3.14))
    return made


def test_it_drives_as_commanded(sim: ardee_sim.Simulation) -> None:
    sim.step(100)
    before = sim.state("robot").xyz_m
    for _ in range(5):
        sim.command("cmd_vel", ardee_sim.Twist(linear_x_m_s=0.5))
        sim.step(40)
    # The legs' springs and the start cost a little of 1 s at 0.5 m/s; yaw is -3.14.
    assert before[0] - sim.state("robot").xyz_m[0] == pytest.approx(0.5, abs=0.05)
    assert sim.time_ns == sim.step_count * sim.step_ns == 1_500_000_000


def test_a_ball_falls_as_galilei_says_and_tells_whom_it_touches() -> None:
    with ardee_sim.Simulation(ardee_sim.World.from_string(GROUND)) as sim:
        sim.spawn("ball", BALL, xyz_m=(0, 0, 2.0))
        seconds = 0.5
        sim.step(round(seconds / (sim.step_ns * 1e-9)))
        fallen_m = 0.5 * -sim.gravity_m_s2[2] * seconds**2
        # Symplectic Euler falls half a step's velocity too far.
        assert 2.0 - sim.state("ball").xyz_m[2] == pytest.approx(fallen_m, rel=0.003)
        assert sim.contacts() == []
        sim.step(200)  # it lies, and does not sleep yet
        (contact,) = sim.contacts()
        assert {contact.collision1, contact.collision2} == {"ball::link::c", "ground::link::c"}
        sim.touched()
        sim.set_state("ball", xyz_m=(0, 0, 0.101), v_m_s=(0, 0, -1.0))
        sim.step(5)
        sim.set_state("ball", xyz_m=(0, 0, 1.0))
        sim.step(5)
        assert sim.contacts() == [] and [set(pair) for pair in sim.touched()] == [
            {"ball::link::c", "ground::link::c"}
        ]
        assert sim.touched() == []
        assert abs(contact.force_n[2]) == pytest.approx(9.8, rel=0.01)


@pytest.mark.slow
def test_readings_are_read_only_and_outlive_the_simulation(
    corn: ardee_sim.World, terrasentia: str
) -> None:
    with placed(corn, terrasentia) as sim:
        sim.demand("ardee/hokuyo", "ardee/camera/front/image_raw")
        assert sim.latest("ardee/hokuyo") is None
        sim.step(100)
        scan, image = sim.latest("ardee/hokuyo"), sim.latest("ardee/camera/front/image_raw")
        first = scan.ranges_m.copy()
        sim.step(100)
        assert not np.array_equal(sim.latest("ardee/hokuyo").ranges_m, first)
    assert scan.ranges_m.dtype == np.float32 and scan.ranges_m.shape == (1081,)
    assert np.array_equal(scan.ranges_m, first)
    assert image.pixels.dtype == np.uint8 and image.pixels.shape == (480, 640, 3)
    for array in (scan.ranges_m, scan.intensities, image.pixels):
        assert not array.flags.writeable
        with pytest.raises(ValueError):
            array[0] = 0


@pytest.mark.slow
def test_what_nobody_demands_is_not_measured(sim: ardee_sim.Simulation) -> None:
    begin = time.process_time()
    sim.step(200)
    without_s = time.process_time() - begin
    sim.demand("ardee/camera/front/image_raw")
    begin = time.process_time()
    sim.step(200)
    # Thirty pictures cost far more than a second of a robot without one.
    assert time.process_time() - begin > 3 * without_s


def test_what_is_demanded_no_more_is_not_measured_and_its_last_reading_stays(
    sim: ardee_sim.Simulation,
) -> None:
    sim.demand("ardee/hokuyo")
    sim.step(10)
    sim.undemand("ardee/hokuyo")
    sim.undemand("ardee/imu/custom")  # which nobody demanded
    sim.step(20)
    assert sim.latest("ardee/hokuyo").stamp_ns == 50_000_000
    sim.demand("ardee/hokuyo")
    sim.step(10)
    assert sim.latest("ardee/hokuyo").stamp_ns == 200_000_000
    with pytest.raises(KeyError, match="/ardee/hokuyo"):
        sim.undemand("ardee/hokuyu")


def test_drain_keeps_the_last_ones_and_counts_the_lost(sim: ardee_sim.Simulation) -> None:
    sim.demand("ardee/hokuyo", keep=10)
    sim.step(200)  # 1 s: 40 scans
    stamps = [reading.stamp_ns for reading in sim.drain("ardee/hokuyo")]
    assert stamps == [775_000_000 + 25_000_000 * k for k in range(10)]
    assert sim.dropped("ardee/hokuyo") == 30
    assert sim.drain("ardee/hokuyo") == []
    sim.step(20)
    sim.demand("ardee/hokuyo")
    assert [reading.stamp_ns for reading in sim.drain("ardee/hokuyo")] == [1_100_000_000]
    sim.reset()
    assert sim.dropped("ardee/hokuyo") == 0


def test_a_seed_repeats_all_bytes_and_another_does_not(
    corn: ardee_sim.World, terrasentia: str
) -> None:
    def run(seed: int) -> bytes:
        with placed(corn, terrasentia, seed) as sim:
            return drive(sim, 400)

    assert run(1) == run(1) != run(2)


def test_a_reset_repeats_all_bytes(sim: ardee_sim.Simulation) -> None:
    first = drive(sim, 300)
    sim.reset()
    assert sim.time_ns == 0
    assert drive(sim, 300) == first


def test_pictures_are_the_same_bytes_after_a_restore_and_a_reset(corn: ardee_sim.World) -> None:
    def pictures(sim: ardee_sim.Simulation, *places: float) -> List[bytes]:
        lens = {"quat_xyzw": (0, 0, 1, 0), "width_px": 160, "height_px": 120}
        return [sim.render((x_m, 0.0, 0.5), **lens).tobytes() for x_m in places]

    with ardee_sim.Simulation(corn) as sim, ardee_sim.Simulation(corn) as other:
        begin = sim.snapshot()
        first = pictures(sim, 0.0, -2.0, -5.0)
        middle = sim.snapshot()
        second = pictures(sim, -5.0, -3.0)
        sim.restore(begin)
        assert pictures(sim, 0.0, -2.0, -5.0) == first
        sim.reset()
        assert pictures(sim, 0.0, -2.0, -5.0) == first
        for again in (sim, other):
            again.restore(middle)
            assert pictures(again, -5.0, -3.0) == second


def test_pictures_of_a_small_world_do_not_depend_on_their_order() -> None:
    world = ardee_sim.World.from_file("farm.world")
    x_m, y_m, _ = world.start["xyz_m"]

    def pictures(*ways: float) -> Dict[float, bytes]:
        lens = {"quat_xyzw": (0, 0, 1, 0), "width_px": 160, "height_px": 120}
        with ardee_sim.Simulation(world) as sim:
            return {way: sim.render((x_m - way, y_m, 0.5), **lens).tobytes() for way in ways}

    assert pictures(0.0, 2.0, 5.0) == pictures(5.0, 2.0, 0.0)


def test_a_noise_seed_changes_the_noise_alone_and_is_part_of_a_snapshot(
    sim: ardee_sim.Simulation,
) -> None:
    beginning = sim.snapshot()

    def run(noise_seed: int) -> bytes:
        sim.restore(beginning)
        sim.set_noise_seed(noise_seed)
        return drive(sim, 100)

    plain = drive(sim, 100)
    assert run(0) == plain != run(1) and run(1) != run(2)
    place = 24  # bytes of the last pose
    assert run(1)[-place:] == plain[-place:]
    sim.set_noise_seed(7)
    moment, ahead = sim.snapshot(), drive(sim, 100)
    sim.set_noise_seed(8)
    sim.restore(moment)
    assert drive(sim, 100) == ahead
    with pytest.raises(ValueError, match="seed: found -1"):
        sim.set_noise_seed(-1)


RESTORED_ELSEWHERE = """
import pathlib, sys, ardee_sim
sys.path.insert(0, sys.argv[1])
from test_simulation import drive
sim = ardee_sim.Simulation(ardee_sim.World.from_file("corn.world"), seed=1)
sim.restore(ardee_sim.Snapshot(pathlib.Path(sys.argv[2]).read_bytes()))
sys.stdout.buffer.write(drive(sim, 300))
"""


def test_a_snapshot_goes_on_here_and_in_another_process(
    sim: ardee_sim.Simulation, tmp_path: "object", request: pytest.FixtureRequest
) -> None:
    drive(sim, 300)
    moment = sim.snapshot()
    first = drive(sim, 300)
    sim.remove("robot")
    sim.restore(moment)
    assert drive(sim, 300) == first
    file = tmp_path / "moment"
    file.write_bytes(moment.data)
    command = [sys.executable, "-c", RESTORED_ELSEWHERE, str(request.path.parent), str(file)]
    assert subprocess.run(command, stdout=subprocess.PIPE, check=True).stdout == first


def flipped(data: bytes, place: int) -> bytes:
    """Returns the bytes with one bit of one of them turned over."""
    return data[:place] + bytes([data[place] ^ 4]) + data[place:][1:]


def test_a_broken_snapshot_is_refused(sim: ardee_sim.Simulation) -> None:
    sim.step(10)
    data = sim.snapshot().data
    broken = [flipped(data, place) for place in (0, 20, len(data) // 2, -9, -1)]
    for each in (data[:-1], data[:40], b"", data + b"x", data[:-4], *broken):
        with pytest.raises(ardee_sim.ArdeeError, match="damaged or of an older version"):
            sim.restore(ardee_sim.Snapshot(each))
    assert sim.snapshot().data == data


def test_a_snapshot_of_another_seed_is_refused(
    sim: ardee_sim.Simulation, corn: ardee_sim.World, terrasentia: str
) -> None:
    with placed(corn, terrasentia, seed=2) as other:
        with pytest.raises(ardee_sim.ArdeeError, match="another world, seed or version"):
            other.restore(sim.snapshot())


FIELD = """<sdf version='1.6'><model name='f'><static>true</static>
<include><uri>model://corn_variant_1</uri><pose>%s 0 0 0 0 0</pose></include></model></sdf>"""


def test_a_snapshot_of_another_field_is_refused(tmp_path: pathlib.Path) -> None:
    """Though both worlds' own files are equal."""
    folder = tmp_path / "field"
    folder.mkdir()
    (folder / "model.config").write_text("<model><sdf version='1.6'>model.sdf</sdf></model>")
    text = "<sdf version='1.6'><world name='w'><include><uri>model://field</uri></include></world></sdf>"
    snapshots = []
    for x_m in (1, 2, 1):
        (folder / "model.sdf").write_text(FIELD % x_m)
        with ardee_sim.Simulation(
            ardee_sim.World.from_string(text, model_paths=[tmp_path])
        ) as made:
            snapshots.append(made.snapshot())
            if x_m == 2:
                with pytest.raises(ardee_sim.ArdeeError, match="snapshot of another world"):
                    made.restore(snapshots[0])
    assert snapshots[0] == snapshots[2]


def test_a_model_in_another_s_place_is_gone_after_a_restore() -> None:
    cube = BALL.replace("<sphere><radius>0.1</radius></sphere>", "<box><size>1 1 1</size></box>")
    world = GROUND.replace("</world>", cube[cube.index("<model") : -len("</sdf>")] + "</world>")
    with ardee_sim.Simulation(ardee_sim.World.from_string(world)) as sim:
        first = sim.snapshot()
        sim.remove("ball")
        sim.spawn("ball", BALL, xyz_m=(0, 0, 5))
        sim.restore(first)
        assert sim.snapshot().data == first.data


STEPS_ON = """
import threading, time, ardee_sim
sim = ardee_sim.Simulation(ardee_sim.World.from_file("empty.world"))
def run():
    while True:
        sim.step(%d)
threading.Thread(target=run, daemon=True).start()
time.sleep(0.3)
"""


@pytest.mark.parametrize("steps", [1, 10**9])
def test_a_program_ends_while_a_thread_of_its_steps(steps: int) -> None:
    assert subprocess.run([sys.executable, "-c", STEPS_ON % steps], timeout=60).returncode == 0


def test_threads_and_interleaving_change_no_byte(corn: ardee_sim.World, terrasentia: str) -> None:
    sims = [placed(corn, terrasentia) for _ in range(3)]
    results: List[bytes] = [b""] * 2

    def run(index: int) -> None:
        results[index] = drive(sims[index], 400)

    threads = [threading.Thread(target=run, args=(k,)) for k in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert results[0] == results[1] == drive(sims[2], 400)


def test_a_second_caller_of_a_busy_simulation_gets_an_error(sim: ardee_sim.Simulation) -> None:
    thread = threading.Thread(target=lambda: sim.step(20_000))
    thread.start()
    said = ""
    while thread.is_alive() and not said:
        try:
            sim.state("robot")
        except RuntimeError as error:
            said = str(error)
    thread.join()
    assert "another thread is using" in said
    assert sim.step_count == 20_000


@pytest.fixture
def obeys_ctrl_c() -> Iterator[None]:
    """Undoes that a shell starts programs in the background with Ctrl-C ignored."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


def test_ctrl_c_ends_a_long_step(sim: ardee_sim.Simulation, obeys_ctrl_c: None) -> None:
    threading.Timer(0.3, signal.raise_signal, [signal.SIGINT]).start()
    with pytest.raises(KeyboardInterrupt):
        sim.step(100_000_000)
    sim.step()  # and it goes on


def test_pictures_agree_with_each_other_and_with_the_plants(
    sim: ardee_sim.Simulation, corn: ardee_sim.World
) -> None:
    eye = dict(xyz_m=(0, 0, 0.5), quat_xyzw=(0, 0, 1, 0), width_px=160, height_px=120)
    rgb, depth_m = sim.render(**eye), sim.depth_image(**eye)
    labels, instances = sim.label_image(**eye), sim.instance_image(**eye)
    assert rgb.shape == (120, 160, 3) and depth_m.shape == labels.shape == (120, 160)
    plants = {plant.instance: plant for plant in corn.plants()}
    crop = instances[labels == 1]
    assert crop.size > 500 and set(crop) <= set(plants)
    label_of = {placement.instance: placement.label for placement in corn.placements()}
    assert {10, 11} <= set(labels.flat)
    has_label = labels > 0
    assert [label_of[i] for i in instances[has_label]] == list(labels[has_label])
    layers = sim.picture(**eye)
    for name, layer in dict(rgb=rgb, depth_m=depth_m, labels=labels, instances=instances).items():
        assert np.array_equal(layers[name], layer)
    visuals_of = {placement.instance: placement.visuals for placement in corn.placements()}
    crop_parts = {
        visuals_of[instance][visual]
        for instance, visual in zip(instances[labels == 1], layers["visuals"][labels == 1])
    }
    assert {"stem", "leavesm"} <= crop_parts
    assert not layers["visuals"][depth_m == np.inf].any()
    far = sim.depth_image(**eye, near_m=1.0)
    assert far.min() >= 1.0 > depth_m.min()
    # The middle of the picture looks along the world's -x: a plant's depth is about its distance in x.
    y, x = np.argwhere((labels == 1) & (depth_m < 3))[0]
    plant = plants[instances[y, x]]
    assert depth_m[y, x] == pytest.approx(-plant.xyz_m[0], abs=0.7)


def test_the_log_has_what_reading_a_model_said(sim: ardee_sim.Simulation) -> None:
    sim.log()
    sim.spawn("ball", BALL.replace("<mass>1</mass>", "<mass>1</mass><mas>2</mas>"), xyz_m=(0, 5, 1))
    (line,) = sim.log()
    assert line.level == "warning" and "<mas>" in line.text and "ball:2" in line.text
    assert sim.log() == []


def test_services_and_triggers_act(sim: ardee_sim.Simulation) -> None:
    sim.call("ardee/imu/custom/set_rate_bias", 0.5, 0.0, 0.0)
    sim.demand("ardee/imu/custom", keep=100)
    sim.step(200)
    rates = np.mean([reading.w_rad_s[0] for reading in sim.drain("ardee/imu/custom")])
    assert rates == pytest.approx(0.5, abs=0.05)
