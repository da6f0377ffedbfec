#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes the meshes of the three TerraSentia: `make_meshes.py [folder]`, by default the package's meshes/.

The shapes are our own; their dimensions are those of config/ts*_config.urdf.xacro, which names the sources.
"""
import pathlib
from dataclasses import dataclass

import numpy as np
import robot_bodies as bodies
from robot_bodies import shapes

from ardee_common.cli import Parser

INCH_M = 0.0254
PACKAGE = pathlib.Path(__file__).resolve().parents[1]


@dataclass(frozen=True)
class Leg:
    """Leg of type 1 in its frame, m: the hinge at the origin, z along the hinge away from the robot."""

    wheel: tuple  # x y of the wheel's axle
    thickness: float
    hinge_radius: float
    axle_radius: float
    wall_z: float  # the chassis's side wall along the hinge
    wheel_z: float = 0.0254775  # the hub's inner face along the hinge
    gap: float = 0.002  # gap between the leg and the wheel's hub


@dataclass(frozen=True)
class Wheel:
    """Wheel about its centre, m."""

    depth: float
    lugs: int  # tread blocks in each of two rows
    lug_height: float
    lug_half_width: float
    lug_slant: float  # distance that a lug runs along the tread over half of its length
    rim: float  # inner radius of the tyre
    spokes: int
    spoke_width: float
    radius: float = 0.097


LEGS = {
    "v1": Leg((0.1601, 0.023246), 0.017, 0.026, 0.022, 0.00538),
    "v2": Leg((0.1601, 0.023246), 0.020, 0.034, 0.028, -0.0112),
    "v3": Leg((0.115, 0.0), 0.017, 0.024, 0.030, 0.0021),
}
WHEELS = {
    "v1": Wheel(0.03838, 20, 0.012, 0.0045, 0.008, 0.066, 6, 0.013),
    "v2": Wheel(0.03838, 16, 0.014, 0.0060, 0.004, 0.060, 8, 0.010),
    "v3": Wheel(0.055, 14, 0.017, 0.0055, 0.013, 0.056, 3, 0.034),
}


def leg(of: Leg) -> np.ndarray:
    """A tapered arm in the gap between chassis and wheel, a boss at each end."""
    top = of.wheel_z - of.gap
    bottom, edge = top - of.thickness, 0.003
    levels = [(edge, bottom), (0, bottom + edge), (0, top - edge), (edge, top)]
    arm = shapes.loft(
        [
            shapes.at_height(
                shapes.capsule(of.wheel, of.hinge_radius - cut, of.axle_radius - cut), z
            )
            for cut, z in levels
        ]
    )
    boss = shapes.lathe([(0.020, of.wall_z - 0.003), (0.020, bottom + 0.001)], 24)
    cap = shapes.lathe([(0.013, top - 0.001), (0.013, top + 0.0005), (0.010, top + 0.0015)], 24)
    axle = shapes.lathe([(0.009, top - 0.001), (0.009, of.wheel_z + 0.002)], 20)
    return np.concatenate([arm, boss, cap, axle + (*of.wheel, 0)])


def lug(of: Wheel, row: int) -> np.ndarray:
    """One tread block of a wheel turned about z, slanted like the others of its row (1 or -1)."""
    base, half_long = of.radius - of.lug_height, of.depth / 4 - 0.0002
    corners = []
    for radius, narrow in ((base, 0.0), (of.radius, 0.0015)):
        ring = []
        for along, across in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            z = row * (half_long + 0.0003) + along * (half_long - narrow / 3)
            offset = across * (of.lug_half_width - narrow) + row * of.lug_slant * z / half_long
            ring.append((np.sqrt(radius**2 - offset**2), -offset, z))
        corners.append(np.array(ring))
    return shapes.loft(corners)


def wheel(of: Wheel) -> np.ndarray:
    """Wheel about its centre, axle along y, outer face towards -y."""
    half, tyre = of.depth / 2, of.radius - of.lug_height + 0.005
    ring = [(of.rim, -half + 0.002), (tyre - 0.008, -half), (tyre, -half + 0.006)]
    ring += [(r, -z) for r, z in reversed(ring)]
    parts = [shapes.lathe(ring, 40, closed=True)]
    for number in range(of.lugs):
        for row in (1, -1):
            angle = 2 * np.pi * (number + (0.5 if row > 0 else 0.0)) / of.lugs
            parts.append(shapes.turn(lug(of, row), 2, angle))
    # spokes and hub; +z is the outer side until the wheel is laid down
    hub = [(0.020, -half), (0.022, -half + 0.002), (0.022, half - 0.008), (0.014, half - 0.003)]
    parts.append(shapes.lathe(hub, 24))
    inner, outer = 0.019, of.rim + 0.003
    for number in range(of.spokes):
        size = (outer - inner, of.spoke_width, 0.014)
        spoke = shapes.box(size, ((inner + outer) / 2, 0, 0.002), edge=0.002)
        parts.append(shapes.turn(spoke, 2, 2 * np.pi * number / of.spokes))
    return shapes.turn(np.concatenate(parts), 0, np.pi / 2)


def meshes() -> dict:
    """All meshes by generation and file name."""
    made = {
        "v1": {"base_link.STL": bodies.chassis_v1(), "lid.STL": bodies.lid_v1()},
        "v2": {"base_link.STL": bodies.chassis_v2(), "lid.STL": bodies.lid_v2()},
        "v3": {"base_link.STL": bodies.chassis_v3(), "lid.STL": bodies.lid_v3()},
    }
    made["v3"]["gimbal_bracket.STL"] = bodies.gimbal_bracket()
    for generation, parts in made.items():
        first = leg(LEGS[generation])
        parts["leg_type_1.STL"] = first
        parts["leg_type_2.STL"] = shapes.mirror_x(first)
        parts["wheel.STL"] = wheel(WHEELS[generation])
    # Listing A.13 has the first wheel in inches, its frame on the outer face
    outwards_m = (0, WHEELS["v1"].depth / 2, 0)
    made["v1"]["wheel.STL"] = (made["v1"]["wheel.STL"] + outwards_m) / INCH_M
    return made


def main() -> None:
    """Runs the command."""
    parser = Parser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=PACKAGE / "meshes")
    folder = parser.parse_args().folder
    for generation, parts in meshes().items():
        shapes.write_all(parts, folder / generation)


if __name__ == "__main__":
    main()
