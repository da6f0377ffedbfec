#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Write the meshes of TerraSentia v1: `make_meshes.py [folder]`, by default the package's meshes/v1.

The shapes are our own; their dimensions are those of config/tsv1_config.urdf.xacro, where the sources are.
"""
import argparse
import pathlib
import sys

import numpy as np

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PACKAGE.parent / "ardee_sensors/scripts"))

import mesh_shapes as shapes  # noqa: E402

CHASSIS_SIZE = (0.508, 0.35322, 0.13136)
LID_SIZE = (0.508, 0.35322, 0.015)
WHEEL_RADIUS, WHEEL_DEPTH = 0.097, 0.03838
LEG_WHEEL = (0.1601, 0.023246)  # the wheel's axle in the leg's frame, the hinge at the origin
LEG_WHEEL_Z = 0.0254775  # the hub's inner face along the hinge
LEG_THICKNESS = 0.017
LEG_GAP = 0.002  # between the leg and the wheel's hub
CHASSIS_WALL_Z = 0.00538  # the chassis's side wall along the hinge
LUGS = 20


def chassis() -> np.ndarray:
    """Shell about the centre of the chassis, with a bumper in front and one behind."""
    length, width, height = CHASSIS_SIZE
    bumper_depth, proud = 0.03, 0.006
    parts = [shapes.box((length - 2 * proud, width, height), corner=0.02, edge=0.012)]
    for end in (1, -1):
        x = end * (length - bumper_depth) / 2
        parts.append(
            shapes.box((bumper_depth, 0.26, 0.045), (x, 0, -0.025), corner=0.008, edge=0.004)
        )
    # camera port in front: a ring around the place of the front camera
    ring = shapes.lathe(
        [(0.018, 0), (0.027, 0), (0.027, 0.004), (0.024, 0.006), (0.018, 0.006)], 24, True
    )
    front = length / 2 - proud
    parts.append(shapes.turn(ring, 1, np.pi / 2) + (front, 0, 0.0245))
    return np.concatenate(parts)


def lid() -> np.ndarray:
    """Plate about its centre with a raised hatch and the lidar's pad in front."""
    length, width, height = LID_SIZE
    plate, raised = 0.010, 0.006
    bottom = -height / 2
    parts = [
        shapes.box((length, width, plate), (0, 0, bottom + plate / 2), corner=0.02, edge=0.003)
    ]
    z = height / 2 - raised / 2
    parts.append(shapes.box((0.30, 0.24, raised), (-0.05, 0, z), corner=0.02, edge=0.002))
    parts.append(shapes.box((0.064, 0.064, raised), (0.22, 0, z), corner=0.008, edge=0.001))
    return np.concatenate(parts)


def leg() -> np.ndarray:
    """Leg of type 1: a tapered arm in the gap between chassis and wheel, a boss at each end."""
    top = LEG_WHEEL_Z - LEG_GAP
    bottom, edge = top - LEG_THICKNESS, 0.003
    levels = [(edge, bottom), (0, bottom + edge), (0, top - edge), (edge, top)]
    arm = shapes.loft(
        [
            shapes.at_height(shapes.capsule(LEG_WHEEL, 0.026 - cut, 0.022 - cut), z)
            for cut, z in levels
        ]
    )
    boss = shapes.lathe([(0.020, CHASSIS_WALL_Z - 0.003), (0.020, bottom + 0.001)], 24)
    cap = shapes.lathe([(0.013, top - 0.001), (0.013, top + 0.0005), (0.010, top + 0.0015)], 24)
    axle = shapes.lathe([(0.009, top - 0.001), (0.009, LEG_WHEEL_Z + 0.002)], 20)
    return np.concatenate([arm, boss, cap, axle + (*LEG_WHEEL, 0)])


def lug(row: int) -> np.ndarray:
    """One tread block of a wheel turned about z, slanted like the others of its row (1 or -1)."""
    base, tip = WHEEL_RADIUS - 0.012, WHEEL_RADIUS
    half_long, half_wide, slant = 0.0094, 0.0045, 0.008
    corners = []
    for radius, narrow in ((base, 0.0), (tip, 0.0015)):
        ring = []
        for along, across in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            z = row * (half_long + 0.0003) + along * (half_long - narrow / 3)
            offset = across * (half_wide - narrow) + row * slant * z / half_long
            ring.append((np.sqrt(radius**2 - offset**2), -offset, z))
        corners.append(np.array(ring))
    return shapes.loft(corners)


def wheel() -> np.ndarray:
    """Wheel about its centre, axle along y, outer face towards -y."""
    half, tyre = WHEEL_DEPTH / 2, WHEEL_RADIUS - 0.007
    rim = 0.066
    ring = [(rim, -half + 0.002), (tyre - 0.008, -half), (tyre, -half + 0.006)]
    ring += [(r, -z) for r, z in reversed(ring)]
    parts = [shapes.lathe(ring, 40, closed=True)]
    for number in range(LUGS):
        for row in (1, -1):
            angle = 2 * np.pi * (number + (0.5 if row > 0 else 0.0)) / LUGS
            parts.append(shapes.turn(lug(row), 2, angle))
    # spokes and hub; +z is the outer side until the wheel is laid down
    hub = [(0.020, -half), (0.022, -half + 0.002), (0.022, half - 0.008), (0.014, half - 0.003)]
    parts.append(shapes.lathe(hub, 24))
    for number in range(6):
        spoke = shapes.box((0.050, 0.013, 0.014), (0.044, 0, 0.002), edge=0.002)
        parts.append(shapes.turn(spoke, 2, np.pi * number / 3))
    return shapes.turn(np.concatenate(parts), 0, np.pi / 2)


def meshes() -> dict:
    """Every mesh of the robot by its file name."""
    leg_1 = leg()
    return {
        "base_link.STL": chassis(),
        "lid.STL": lid(),
        "leg_type_1.STL": leg_1,
        "leg_type_2.STL": shapes.mirror_x(leg_1),
        "wheel.STL": wheel(),
    }


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=PACKAGE / "meshes/v1")
    shapes.write_all(meshes(), parser.parse_args().folder)


if __name__ == "__main__":
    main()
