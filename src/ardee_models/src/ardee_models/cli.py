# SPDX-License-Identifier: MIT
"""Command `generate_terrain`, and what commands share."""

import argparse
from pathlib import Path
from typing import Callable

import numpy as np

from ardee_models.errors import GeneratorError
from ardee_models.terrain import TerrainParams, generate_terrain
from ardee_models.writers.terrain import write_terrain


def seed_number(text: str) -> int:
    """argparse type: a whole number from 0."""
    value = int(text)
    if value < 0:
        raise ValueError(text)
    return value


def run(parser: argparse.ArgumentParser, work: Callable[[argparse.Namespace], Path]) -> int:
    """Parse, work, print the path written; one line and exit code 2 for bad input."""
    args = parser.parse_args()
    try:
        print(work(args))
    except GeneratorError as error:
        parser.exit(2, f"{parser.prog}: {error}\n")
    return 0


def _output_arguments(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--seed", type=seed_number, default=0, help="root of all random numbers (default 0)"
    )
    parser.add_argument("--name", required=True, help="name of the model")
    parser.add_argument(
        "--output", type=Path, required=True, help="folder of models to write it in"
    )


def _make_terrain(args: argparse.Namespace) -> Path:
    params = TerrainParams(
        size_m=args.size,
        samples=args.samples,
        row_spacing_m=args.row_spacing,
        ridge_height_m=args.ridge_height,
        bump_sd_m=args.bump_sd,
        bump_length_m=args.bump_length,
        friction_mu=args.friction,
    )
    terrain = generate_terrain(params, np.random.default_rng(args.seed))
    return write_terrain(terrain, params.friction_mu, args.name, args.image, args.output)


def generate_terrain_main() -> int:
    """`generate_terrain --name heightmap_ground --seed 1 --output DIR`."""
    parser = argparse.ArgumentParser(
        prog="generate_terrain",
        description="Write a field terrain as a Gazebo model directory. Rows run along x.",
    )
    usual = TerrainParams()
    numbers = (
        ("--size", usual.size_m, "side of the square [m]"),
        ("--row-spacing", usual.row_spacing_m, "distance between ridges [m]"),
        ("--ridge-height", usual.ridge_height_m, "ridge along each row [m], 0 for none"),
        ("--bump-sd", usual.bump_sd_m, "standard deviation of bumps [m], 0 for none"),
        ("--bump-length", usual.bump_length_m, "size of bumps [m]"),
        ("--friction", usual.friction_mu, "friction coefficient"),
    )
    for flag, value, text in numbers:
        parser.add_argument(flag, type=float, default=value, help=f"{text} (default {value:g})")
    parser.add_argument(
        "--samples", type=int, default=usual.samples, help="pixels a side, 2^n + 1 (default 257)"
    )
    parser.add_argument("--image", default="terrain", help="stem of the image's file name")
    _output_arguments(parser)
    return run(parser, _make_terrain)
