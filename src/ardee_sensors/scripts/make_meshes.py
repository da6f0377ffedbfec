#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes the meshes of the sensors: `make_meshes.py [folder]`, by default the package's meshes folder."""
import pathlib

import mesh_cameras
import mesh_lidars
import mesh_parts
import numpy as np
from device_numbers import PACKAGE, load
from mesh_shapes import write_all

from ardee_common.cli import Parser
from ardee_models.collada_file import write_collada
from ardee_models.plant.plant import Mesh


def meshes() -> dict:
    """All meshes of the package by file name."""
    return {**mesh_lidars.meshes(), **mesh_cameras.meshes(), **mesh_parts.meshes()}


def encoder_in_colour() -> Mesh:
    """The encoder about its middle, a corner a vertex, for the COLLADA file that Listing A.5 names."""
    triangles = mesh_parts.encoder() - (0, 0, load("encoder")["size_z_m"] / 2)
    edges = np.diff(triangles, axis=1)
    normals = np.cross(edges[:, 0], edges[:, 1])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    count = 3 * len(triangles)
    return Mesh(
        triangles.reshape(-1, 3),
        np.repeat(normals, 3, axis=0),
        np.zeros((count, 2)),
        np.arange(count).reshape(-1, 3),
    )


def write_meshes(folder: pathlib.Path) -> None:
    """Writes all files of the meshes folder."""
    write_all(meshes(), folder)
    write_collada([("encoder", encoder_in_colour(), "")], folder / "rotary_encoder.dae")


def main() -> None:
    """Runs the command."""
    parser = Parser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=PACKAGE / "meshes")
    write_meshes(parser.parse_args().folder)


if __name__ == "__main__":
    main()
