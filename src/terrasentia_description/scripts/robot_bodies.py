# SPDX-License-Identifier: MIT
"""Chassis and lids of the three generations, each about its centre, m; x forward, y left, z up.

Lengths are those of config/ts*_config.urdf.xacro, which names the sources; all else is our own design.
"""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "ardee_sensors/scripts"))

import mesh_shapes as shapes  # noqa: E402

V1_CHASSIS_SIZE = (0.508, 0.35322, 0.13136)
V1_LID_SIZE = (0.508, 0.35322, 0.015)
V2_CHASSIS_SIZE = (0.528, 0.32, 0.19)  # the hull; the mudguards reach further out
V2_MUDGUARD_WIDTH = 0.465
V2_LID_SIZE = (0.44, 0.28, 0.02)
V3_CHASSIS_SIZE = (0.44, 0.33, 0.14)
V3_LID_SIZE = (0.46, 0.35322, 0.03)


def ring(inner: float, outer: float, depth: float) -> np.ndarray:
    """Ring about z that stands on the plane z = 0: the frame of a lens."""
    profile = [(inner, 0), (outer, 0), (outer, 0.7 * depth), (outer - 0.003, depth), (inner, depth)]
    return shapes.lathe(profile, 24, True)


def hull(size: tuple, levels: list) -> np.ndarray:
    """Skin through round rectangles: levels of (height as a share of size z, cut in x, cut in y, corner radius)."""
    return shapes.loft(
        [
            shapes.at_height(
                shapes.rectangle(size[0] - 2 * cut_x, size[1] - 2 * cut_y, corner),
                size[2] * (share - 0.5),
            )
            for share, cut_x, cut_y, corner in levels
        ]
    )


def chassis_v1() -> np.ndarray:
    """Shell with a bumper in front and one behind, and a port for the front camera."""
    length, width, height = V1_CHASSIS_SIZE
    bumper_depth, proud = 0.03, 0.006
    parts = [shapes.box((length - 2 * proud, width, height), corner=0.02, edge=0.012)]
    for end in (1, -1):
        x = end * (length - bumper_depth) / 2
        parts.append(
            shapes.box((bumper_depth, 0.26, 0.045), (x, 0, -0.025), corner=0.008, edge=0.004)
        )
    front = length / 2 - proud
    parts.append(shapes.turn(ring(0.018, 0.027, 0.006), 1, np.pi / 2) + (front, 0, 0.0245))
    return np.concatenate(parts)


def lid_v1() -> np.ndarray:
    """Plate with a raised hatch and the lidar's pad in front."""
    length, width, height = V1_LID_SIZE
    plate, raised = 0.010, 0.006
    bottom = -height / 2
    parts = [
        shapes.box((length, width, plate), (0, 0, bottom + plate / 2), corner=0.02, edge=0.003)
    ]
    z = height / 2 - raised / 2
    parts.append(shapes.box((0.30, 0.24, raised), (-0.05, 0, z), corner=0.02, edge=0.002))
    parts.append(shapes.box((0.064, 0.064, raised), (0.22, 0, z), corner=0.008, edge=0.001))
    return np.concatenate(parts)


def mudguard(inner_y: float, outer_y: float) -> np.ndarray:
    """Arch of flat plates over a wheel whose axle is the y axis, between two distances along it."""
    radius, thickness, pieces = 0.138, 0.006, 7
    step = np.radians(76.0) / pieces
    plates = []
    for number in range(pieces):
        angle = (number - (pieces - 1) / 2) * step
        size = (2 * radius * np.tan(step / 2) + 0.004, outer_y - inner_y, thickness)
        plate = shapes.box(size, (0, (inner_y + outer_y) / 2, radius + thickness / 2), edge=0.001)
        plates.append(shapes.turn(plate, 1, angle))
    return np.concatenate(plates)


def chassis_v2() -> np.ndarray:
    """Boat-shaped hull with a raked nose, side boxes for the batteries, and a mudguard over each wheel."""
    half_width = V2_CHASSIS_SIZE[1] / 2
    levels = [(0.0, 0.075, 0.04, 0.02), (0.08, 0.06, 0.012, 0.03), (0.42, 0.0, 0.0, 0.03)]
    levels += [(0.62, 0.0, 0.0, 0.03), (0.94, 0.035, 0.012, 0.04), (1.0, 0.042, 0.018, 0.04)]
    parts = [hull(V2_CHASSIS_SIZE, levels)]
    axle = (0.172, 0.0, -0.078 - 0.02175)  # axle of a wheel at rest, from the centre of the chassis
    arch = mudguard(half_width - 0.01, V2_MUDGUARD_WIDTH / 2)
    for end in (1, -1):
        for side in (0.0, np.pi):
            parts.append(shapes.turn(arch, 2, side) + (end * axle[0], 0, axle[2]))
        # tow bar between the mudguards of an end, and a grille below it
        bar = shapes.turn(shapes.lathe([(0.008, -0.12), (0.008, 0.12)], 16), 0, np.pi / 2)
        parts.append(bar + (end * 0.2555, 0, 0.03))
        for row in range(3):
            slat = shapes.box((0.02, 0.18, 0.006), (end * 0.245, 0, -0.026 + 0.014 * row))
            parts.append(slat)
    parts.append(shapes.turn(ring(0.016, 0.024, 0.006), 1, np.pi / 2) + (0.257, 0, 0.006))
    return np.concatenate(parts)


def lid_v2() -> np.ndarray:
    """Domed plate with two rails to carry it by and the lidar's pad in front."""
    length, width, height = V2_LID_SIZE
    bottom, top = -height / 2, height / 2
    parts = [
        shapes.box((length, width, 0.012), (0, 0, bottom + 0.006), corner=0.05, edge=0.004),
        shapes.box((0.07, 0.07, 0.01), (0.17, 0, top - 0.005), corner=0.01, edge=0.001),
        shapes.box((0.08, 0.08, 0.01), (-0.14, 0, top - 0.005), corner=0.03, edge=0.001),
    ]
    for side in (1, -1):
        rail = shapes.box((0.26, 0.012, 0.01), (-0.02, side * 0.11, top - 0.005), corner=0.005)
        parts.append(rail)
    return np.concatenate(parts)


def chassis_v3() -> np.ndarray:
    """Rounded tub with a chin, lamps in front and cooling ribs along its sides."""
    length, width, height = V3_CHASSIS_SIZE
    levels = [(0.0, 0.06, 0.03, 0.05), (0.1, 0.035, 0.01, 0.06), (0.5, 0.012, 0.004, 0.07)]
    levels += [(0.92, 0.0035, 0.004, 0.08), (1.0, 0.0035, 0.004, 0.08)]
    parts = [hull(V3_CHASSIS_SIZE, levels)]
    for end in (1, -1):
        chin = shapes.box((0.02, 0.15, 0.035), (end * (length / 2 - 0.01), 0, -0.02), 0.008, 0.004)
        parts.append(chin)
    for side in (1, -1):
        lamp = shapes.turn(ring(0.010, 0.019, 0.010), 1, np.pi / 2)
        parts.append(lamp + (length / 2 - 0.012, side * 0.105, 0.03))
        for number in range(5):
            x = -0.05 + 0.025 * number
            rib = shapes.box((0.009, 0.01, 0.05), (x, side * (width / 2 - 0.005), 0.03), edge=0.002)
            parts.append(rib)
    return np.concatenate(parts)


def lid_v3() -> np.ndarray:
    """Deck that overhangs the tub, swept up to a hood, with the lidar's recess in front and an antenna foot behind."""
    length, width, height = V3_LID_SIZE
    bottom, top = -height / 2, height / 2
    deck = shapes.box((length, width, 0.014), (0, 0, bottom + 0.007), corner=0.09, edge=0.005)
    hood_levels = [(0.010, 0.0), (0.022, 0.012), (0.028, 0.03)]
    hood = shapes.loft(
        [
            shapes.at_height(shapes.rectangle(0.26 - cut, 0.26 - cut, 0.06), bottom + z)
            for z, cut in hood_levels
        ]
    )
    parts = [deck, hood + (-0.05, 0, 0)]
    parts.append(shapes.box((0.07, 0.07, 0.018), (0.16, 0, top - 0.009), corner=0.012, edge=0.002))
    foot = shapes.lathe([(0.04, top - 0.008), (0.04, top - 0.003), (0.03, top)], 28)
    parts.append(foot + (-0.15, 0, 0))
    return np.concatenate(parts)


def gimbal_bracket() -> np.ndarray:
    """Fork about a tilting axis, y: a foot 0.04 m behind it, two arms, and the motor on the left one."""
    parts = [shapes.box((0.006, 0.072, 0.03), (-0.037, 0, 0), edge=0.002)]
    for side in (1, -1):
        parts.append(shapes.box((0.04, 0.004, 0.014), (-0.016, side * 0.024, 0), edge=0.001))
    motor = shapes.lathe(
        [(0.013, -0.026), (0.015, -0.028), (0.015, -0.036), (0.012, -0.038)][::-1], 24
    )
    parts.append(shapes.turn(motor, 0, np.pi / 2))
    return np.concatenate(parts)
