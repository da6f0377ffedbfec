# SPDX-License-Identifier: MIT
"""The command `generate_terrain`: ground from a recipe, an image, an elevation model, or a mesh."""

import argparse
import dataclasses
import shlex
from pathlib import Path
from typing import Any, Optional, Sequence

import numpy as np

from ardee_common.cli import Parser, add_seed, run, say
from ardee_common.errors import GeneratorError
from ardee_common.options import check
from ardee_models.lookup import DEFAULT_OUTPUT, default_output, named_folder
from ardee_models.mesh_file import UP_RULE, UPS
from ardee_models.terrain.elevation import UNITS_M, dem_terrain
from ardee_models.terrain.height_map import Terrain, TerrainParams, generate_terrain
from ardee_models.terrain.image import image_terrain
from ardee_models.terrain.mesh_terrain import centred, check_lies, read_mesh
from ardee_models.terrain.recipe import Look, Surface, read_recipe, too_fine
from ardee_models.terrain.recipe_model import write_recipe
from ardee_models.terrain.terrain_model import write_terrain
from ardee_models.terrain.terrain_obj import write_mesh_terrain

_PLAIN = (
    ("--row-spacing-m", "row_spacing_m", "distance between ridges [m]"),
    ("--ridge-height-m", "ridge_height_m", "height of the ridge along each row [m], 0 for none"),
    ("--bump-sd-m", "bump_sd_m", "standard deviation of bumps [m], 0 for none"),
    ("--bump-length-m", "bump_length_m", "size of bumps [m]"),
)


def _say(text: str) -> None:
    say("generate_terrain", text)


def _warn(text: str) -> None:
    _say(f"warning: {text}")


def _source_arguments(parser: argparse.ArgumentParser) -> None:
    usual = TerrainParams()
    source = parser.add_mutually_exclusive_group()
    source.add_argument(
        "recipe", nargs="?", type=Path, metavar="RECIPE.yaml", help="recipe of the terrain"
    )
    source.add_argument(
        "--image", type=Path, metavar="IMAGE", help="square grey image, best of 16 bits"
    )
    source.add_argument(
        "--dem", type=Path, metavar="FILE", help="elevation model: GeoTIFF, or ESRI ASCII .asc"
    )
    source.add_argument("--mesh", type=Path, metavar="FILE", help="3D mesh: DAE, OBJ, STL, ...")
    plain = parser.add_argument_group(
        "ridges and bumps, used without recipe, image, elevation model or mesh"
    )
    for flag, name, text in _PLAIN:
        value = getattr(usual, name)
        plain.add_argument(
            flag, dest=name, type=float, metavar="M", help=f"{text} (default {value:g})"
        )


def _size_arguments(shape: Any) -> None:
    shape.add_argument(
        "--size-m",
        type=float,
        metavar="M",
        help=f"side of the square [m] (default {TerrainParams().size_m:g})",
    )
    shape.add_argument(
        "--samples",
        type=int,
        metavar="N",
        help="pixels a side, 2^n + 1 (default: enough for the source)",
    )
    shape.add_argument(
        "--image-height-m",
        type=float,
        default=1.0,
        metavar="M",
        help="height from black to white of the image [m] (default 1)",
    )
    shape.add_argument("--fill-holes", action="store_true", help="fill holes of an elevation model")
    shape.add_argument(
        "--dem-unit",
        choices=tuple(UNITS_M),
        help="unit of an elevation model's heights (default: as it says, else m)",
    )
    shape.add_argument(
        "--mesh-scale",
        type=float,
        metavar="X",
        help="length of the mesh's unit [m] (default: as a .dae says, else 1)",
    )
    shape.add_argument(
        "--mesh-up",
        choices=UPS,
        default="auto",
        help=f"axis of the mesh that points up (default auto: {UP_RULE})",
    )


def _surface_arguments(surface: Any) -> None:
    for flag, name, text in (
        ("--mu", "mu", "friction coefficient"),
        (
            "--mu2",
            "mu2",
            "friction coefficient in the second direction (default: that of --mu)",
        ),
        ("--kp", "kp", "stiffness of ground contacts [N/m]"),
        ("--kd", "kd", "damping of ground contacts [N s/m]"),
    ):
        value = "" if name == "mu2" else f" (default {getattr(Surface(), name):g})"
        surface.add_argument(flag, dest=name, type=float, metavar="X", help=text + value)


def make_parser() -> argparse.ArgumentParser:
    """Makes the parser of the command's arguments."""
    parser = Parser(
        prog="generate_terrain",
        description="Write a field terrain as a Gazebo model directory. Rows run along x.",
    )
    _source_arguments(parser)
    _size_arguments(parser.add_argument_group("size"))
    _surface_arguments(parser.add_argument_group("surface"))
    add_seed(parser).default = None  # to know whether it was given
    parser.add_argument(
        "--image-name", default="terrain", help="stem of the written image's file name"
    )
    parser.add_argument("--name", required=True, help="name of the model")
    parser.add_argument(
        "--output",
        type=named_folder,
        default=default_output(),
        help=f"folder of models to write it in (default: {DEFAULT_OUTPUT})",
    )
    return parser


def _refuse(args: argparse.Namespace, names: tuple, source: str) -> None:
    for name in names:
        if getattr(args, name) is not None:
            flag = "--" + name.replace("_", "-")
            raise GeneratorError(f"found {flag} with {source}, expected it alone")


def _surface(args: argparse.Namespace, usual: Surface) -> Surface:
    given = {n: getattr(args, n) for n in ("mu", "mu2", "kp", "kd") if getattr(args, n) is not None}
    if "mu" in given:
        given.setdefault("mu2", given["mu"])
    made = dataclasses.replace(usual, **given)
    check(made, "terrain surface ")
    return made


def _size(args: argparse.Namespace) -> float:
    size = TerrainParams().size_m if args.size_m is None else args.size_m
    if not (np.isfinite(size) and 1.0 <= size <= 2000.0):
        raise GeneratorError(f"terrain size: found {size}, expected 1 to 2000 m")
    return size


def _plain_terrain(args: argparse.Namespace) -> Terrain:
    names = {n: getattr(args, n) for _, n, _ in _PLAIN if getattr(args, n) is not None}
    samples = TerrainParams().samples if args.samples is None else args.samples
    params = TerrainParams(size_m=_size(args), samples=samples, **names)
    pixel_m, spacing_m = params.size_m / max(params.samples - 1, 1), params.row_spacing_m
    if params.ridge_height_m > 0.0 and pixel_m > 0.5 * spacing_m:
        expected = f"expected at least two pixels of {pixel_m:g} m, or more samples"
        _warn(f"terrain ridges spacing: found {spacing_m:g} m, {expected}")
    return generate_terrain(params, np.random.default_rng(args.seed or 0))


def make_terrain(args: argparse.Namespace) -> Path:
    """Writes the terrain that the arguments describe; returns its path."""
    plain = tuple(name for _, name, _ in _PLAIN)
    felt = _surface(args, Surface())
    if args.mesh:
        _refuse(args, (*plain, "size_m", "samples", "seed"), "--mesh")
        ground = read_mesh(args.mesh, args.mesh_up, args.mesh_scale, _say)
        check_lies(ground, args.mesh)
        return write_mesh_terrain(centred(ground), felt, args.name, args.output)
    about: Any = "Field terrain, procedural heightmap"
    if args.recipe:
        _refuse(args, plain, "a recipe")
        recipe = read_recipe(args.recipe)
        given = {"size_m": args.size_m, "samples": args.samples, "seed": args.seed}
        given["surface"] = _surface(args, recipe.surface)
        recipe = dataclasses.replace(recipe, **{k: v for k, v in given.items() if v is not None})
        for text in too_fine(recipe):
            _warn(text)
        return write_recipe(recipe, args.name, args.image_name, args.output)
    if args.image:
        _refuse(args, (*plain, "seed"), "--image")
        terrain = image_terrain(args.image, _size(args), args.image_height_m, args.samples, _warn)
        about = "Field terrain, heightmap from an image"
    elif args.dem:
        _refuse(args, (*plain, "seed", "size_m"), "--dem")
        terrain = dem_terrain(args.dem, args.samples, args.fill_holes, args.dem_unit, _warn)
        about = "Field terrain, heightmap from an elevation model"
    else:
        terrain = _plain_terrain(args)
    names = args.name, args.image_name
    return write_terrain(terrain, felt.mu, *names, args.output, felt, Look(), description=about)


def _make(args: argparse.Namespace) -> Path:
    path = make_terrain(args)
    ground = shlex.quote(str(path))
    _say(f"to drive on it: rosrun ardee_bringup run_custom_world FIELD {ground}")
    return path


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs `generate_terrain RECIPE.yaml --name my_ground --output DIR`."""
    return run(make_parser(), _make, arguments)
