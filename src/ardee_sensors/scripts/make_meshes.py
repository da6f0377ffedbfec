#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes the meshes of the sensors: `make_meshes.py [folder]`, by default the package's meshes folder."""
import pathlib

import mesh_cameras
import mesh_lidars
import mesh_parts
from device_numbers import PACKAGE
from mesh_shapes import write_all

from ardee_common.cli import Parser


def meshes() -> dict:
    """All meshes of the package by file name."""
    return {**mesh_lidars.meshes(), **mesh_cameras.meshes(), **mesh_parts.meshes()}


def main() -> None:
    """Runs the command."""
    parser = Parser(description=__doc__)
    parser.add_argument("folder", nargs="?", type=pathlib.Path, default=PACKAGE / "meshes")
    write_all(meshes(), parser.parse_args().folder)


if __name__ == "__main__":
    main()
