# SPDX-License-Identifier: MIT
"""Pictures of cameras in motion, their white balance, and what hides what, against closed forms."""

import math
from pathlib import Path

import numpy as np
import pytest
from ardee_sim import ArdeeError, Simulation, World

EMPTY = (
    "<sdf version='1.6'><world name='w'><gravity>0 0 0</gravity><scene><background>0 0 0 1</background></scene>"
    "</world></sdf>"
)
LENS = {
    "width_px": 320,
    "height_px": 240,
    "horizontal_fov_rad": 2 * math.atan(0.8),
}  # 200 px of focal length
FOCAL_PX = 200.0
WALL = ((2.5, 4, 0), "1 8 8")  # ends in the middle of the picture, 2 m ahead
NEAR, BEHIND = ((2, 0.4, 0), "0.2 0.8 0.8"), ((4, 0, 0), "0.2 1.6 0.8")


def box(size: str) -> str:
    """A box that glows in one grey."""
    return (
        f"<sdf version='1.6'><model name='m'><link name='l'><visual name='v'><geometry><box><size>{size}</size></box>"
        "</geometry><material><ambient>0 0 0 1</ambient><diffuse>0 0 0 1</diffuse><emissive>0.4 0.4 0.4 1</emissive>"
        "</material></visual></link></model></sdf>"
    )


def simulation(*boxes: tuple) -> Simulation:
    sim = Simulation(World.from_string(EMPTY))
    for k, (xyz_m, size) in enumerate(boxes):
        sim.spawn(f"box{k}", box(size), xyz_m=xyz_m, is_static=True, label=k + 1)
    return sim


def test_a_camera_in_motion_sees_edges_lean_and_blur() -> None:
    sim, speed, time_s = simulation(WALL), 0.5, 0.4
    lean_px = speed * FOCAL_PX * time_s / 2.0
    moving = {"xyz_m": (0, 0, 0), "v_m_s": (0, speed, 0), "exposure": 1.0, **LENS}
    leaning = sim.picture(**moving, readout_time_s=time_s)
    rows = np.arange(240)
    for edge in ((leaning["labels"] == 1).sum(axis=1), (leaning["rgb"][:, :, 1] > 50).sum(axis=1)):
        assert np.abs(edge - (160 + lean_px * rows / 240)).max() <= 1.5
    blurred = sim.render(**moving, exposure_time_s=time_s)[100, :, 1]
    ramp = 102 * np.clip((160 + lean_px - np.arange(320) - 0.5) / lean_px, 0, 1)
    assert np.abs(blurred - ramp).max() <= 0.51 * 102 / lean_px + 1
    still = sim.render(**{**moving, "v_m_s": (0, 0, 0)}, exposure_time_s=0.1, readout_time_s=0.1)
    assert np.array_equal(still, sim.render((0, 0, 0), exposure=1.0, **LENS))


def test_a_model_that_moves_has_its_label() -> None:
    sim = Simulation(World.from_string(EMPTY))
    for name, y_m, label in (("ball", 0.5, 500), ("other", -0.5, 0)):
        sim.spawn(name, box("0.5 0.5 0.5"), xyz_m=(2, y_m, 0), label=label)
    assert np.unique(sim.label_image((0, 0, 0), **LENS)).tolist() == [0, 500]


def test_white_balance_is_a_gain() -> None:
    sim, eye = simulation(WALL), {"xyz_m": (0, 0, 0), "exposure": 1.0, **LENS}
    assert sim.render(**eye)[100, 10].tolist() == [102, 102, 102]
    gained = sim.render(**eye, white_balance=(1.5, 1, 0.5))[100, 10]
    assert gained.tolist() == [153, 102, 51]
    assert sim.render(**eye, white_balance=6504)[100, 10].tolist() == [102, 102, 102]
    warm = sim.render(**eye, white_balance=4500)[100, 10].astype(int)
    assert warm[0] < 102 < warm[2]
    assert sim.render(**{**eye, "exposure": 0.5})[100, 10].tolist() == [51, 51, 51]


def test_lone_pixels_are_those_of_a_world_without_the_others() -> None:
    sim, eye = simulation(NEAR, BEHIND), {"xyz_m": (0, 0, 0.1), **LENS}
    seen = sim.label_image(**eye)
    instances = [int(sim.instance_image(**eye)[seen == label][0]) for label in (1, 2)]
    lone = sim.lone_pixels(instances, **eye)
    alone = [int((simulation(each).label_image(**eye) > 0).sum()) for each in (NEAR, BEHIND)]
    assert lone.tolist() == alone
    assert (seen == 1).sum() == lone[0] and 0.2 < (seen == 2).sum() / lone[1] < 0.8
    leaning = {**eye, "v_m_s": (0, 1, 0), "readout_time_s": 0.5}
    moved = simulation(BEHIND).label_image(**leaning)
    assert sim.lone_pixels(instances[1:], **leaning).tolist() == [int((moved > 0).sum())]
    beside = simulation(((0, 0.5, 0), "6 0.2 2"))  # from behind the camera past it
    seen = beside.instance_image(**eye)
    assert beside.lone_pixels([int(seen.max())], **eye) == [(seen > 0).sum()] and seen.any()
    with pytest.raises(ArdeeError, match="found instance 9, expected one of the scenery"):
        sim.lone_pixels([9], **eye)


def mesh(path: Path, triangles: np.ndarray) -> Simulation:
    """A world of triangles [n, 3, 3], each seen from one side."""
    corners = "".join(f"v {x} {y} {z}\n" for x, y, z in triangles.reshape(-1, 3))
    faces = "".join(f"f {i} {i + 1} {i + 2}\n" for i in range(1, 3 * len(triangles), 3))
    path.write_text(corners + faces)
    sim = Simulation(World.from_string(EMPTY))
    shape = f"<geometry><mesh><uri>{path}</uri></mesh></geometry>"
    link = f"<link name='l'><visual name='v'>{shape}</visual></link>"
    model = f"<sdf version='1.6'><model name='m'>{link}</model></sdf>"
    sim.spawn("mesh", model, xyz_m=(0, 0, 0), is_static=True, label=1)
    return sim


def test_lone_pixels_of_a_square_are_counted_from_its_front(tmp_path: Path) -> None:
    """A square of 0.5 m at 2 m has sides of 50 pixels."""
    square = np.array([[2, -0.25, -0.25], [2, 0.25, -0.25], [2, 0.25, 0.25], [2, -0.25, 0.25]])
    eye = {"xyz_m": (0, 0, 0), **LENS}
    counts = [
        mesh(tmp_path / "square.obj", square[[corners]].reshape(-1, 3, 3)).lone_pixels([1], **eye)
        for corners in ([0, 1, 2, 0, 2, 3], [0, 2, 1, 0, 3, 2])
    ]
    assert sorted(int(count) for (count,) in counts) == [0, 2500]


@pytest.mark.parametrize("near_m", [0.0, 0.7])
def test_lone_pixels_of_a_mesh_are_those_of_its_picture(tmp_path: Path, near_m: float) -> None:
    rng = np.random.default_rng(4)
    shreds = rng.uniform((-0.5, -1, -1), (2, 1, 1), (200, 1, 3)) + rng.normal(0, 0.1, (200, 3, 3))
    plants = "<include><uri>model://corn_variant_8</uri><pose>1 0.3 -0.4 0 0 0</pose></include>"
    worlds = [
        mesh(tmp_path / "shreds.obj", shreds),
        Simulation(World.from_string(EMPTY.replace("</world>", plants + "</world>"))),
    ]
    eye = {"xyz_m": (0, 0, 0), "near_m": near_m, **LENS}
    for sim in worlds:
        seen = int((sim.instance_image(**eye) > 0).sum())
        assert seen > 2000 and sim.lone_pixels([1], **eye).tolist() == [seen]


@pytest.mark.parametrize(
    "given, message",
    [
        ({"exposure_time_s": 2}, "exposure_time_s: found 2, expected .*from 0 to 1"),
        ({"readout_time_s": -1}, "readout_time_s: found -1, expected .*from 0 to 1"),
        ({"exposure": 0}, "exposure: found 0, expected"),
        ({"white_balance": 100}, "white_balance: found '100.0', expected off, auto"),
        ({"v_m_s": (0, 1)}, "v_m_s: found .*expected 3 finite numbers"),
    ],
)
def test_bad_arguments_are_refused(given: dict, message: str) -> None:
    with pytest.raises(ArdeeError, match=message):
        simulation().render((0, 0, 0), **given)
