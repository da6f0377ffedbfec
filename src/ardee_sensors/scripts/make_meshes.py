#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Write the meshes of the sensors: `make_meshes.py [folder]`, by default the package's meshes folder."""
import argparse
import pathlib

import numpy as np
import yaml
from mesh_shapes import at_height, box, circle, lathe, loft, rectangle, write_all

PACKAGE = pathlib.Path(__file__).resolve().parents[1]


def hokuyo_ust10lx() -> np.ndarray:
    """UST-10LX on its mounting face z = 0, the scan's centre at x = y = 0.

    The slot at scan height is the window: nothing is in the way of a beam inside the 270 degrees; the
    pillar that carries the dome stands in the blind quarter behind.
    """
    device = yaml.safe_load((PACKAGE / "config/hokuyo_ust10lx.yaml").read_text())
    side, height = device["size_x_m"], device["size_z_m"]
    slot_low = device["scan_height_m"] - device["window_height_m"] / 2
    slot_high = slot_low + device["window_height_m"]
    radius = 0.48 * side
    body = box((side, side, 0.026), (0, 0, 0.013), corner=0.006, edge=0.0015)
    levels = [
        (rectangle(side - 0.003, side - 0.003, 0.006, 8), 0.026),
        (circle(radius, 36, (0, 0)), 0.031),
        (circle(radius, 36, (0, 0)), slot_low),
    ]
    # both outlines have 36 points that start on different headings: line the rectangle up with the circle
    neck = loft([at_height(_by_heading(outline), z) for outline, z in levels])
    dome = lathe(
        [
            (radius * 0.94, slot_high),
            (radius, slot_high + 0.002),
            (radius, height - 0.006),
            (radius * 0.93, height - 0.002),
            (radius * 0.80, height),
        ],
        36,
    )
    pillar_height = slot_high - slot_low
    pillar = box((0.005, 0.024, pillar_height), (-0.0205, 0, slot_low + pillar_height / 2))
    return np.concatenate([body, neck, dome, pillar])


def _by_heading(outline: np.ndarray) -> np.ndarray:
    """The outline's points, the one of the smallest non-negative heading first."""
    heading = np.arctan2(outline[:, 1], outline[:, 0])
    return np.roll(outline, -int(np.argmin(np.where(heading < -1e-9, np.inf, heading))), axis=0)


def meshes() -> dict:
    """Every mesh of the package by its file name."""
    return {"hokuyo_ust10lx.stl": hokuyo_ust10lx()}


def main() -> None:
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=PACKAGE / "meshes")
    write_all(meshes(), parser.parse_args().folder)


if __name__ == "__main__":
    main()
