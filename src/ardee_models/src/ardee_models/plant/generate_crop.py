# SPDX-License-Identifier: MIT
"""The command `generate_crop`."""

import argparse
import os
from pathlib import Path
from typing import Optional, Sequence

from ardee_common.cli import Parser, run, seed_number
from ardee_models.lookup import own_models, search_path
from ardee_models.plant.crops import make_crop
from ardee_models.plant.species import known_species, load_species
from ardee_models.plant.stages import describe_stages


def stages_help() -> str:
    """Help text: the known species and their stages."""
    lines = ["stages:"]
    for species in known_species():
        data, path = load_species(species)
        lines.append(f"  {species}: {describe_stages(data.stages, data.counters, str(path))}")
    return "\n".join(lines)


def default_output() -> Path:
    """The first writable folder of GAZEBO_MODEL_PATH that no build made, else the one in the user's home.

    Models are found in both at once. A catkin space, marked by its file .catkin, goes when it is built anew.
    """
    for folder in search_path():
        is_built = any((parent / ".catkin").exists() for parent in folder.resolve().parents)
        if folder.is_dir() and os.access(folder, os.W_OK) and not is_built:
            return folder
    return own_models()


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog="generate_crop",
        description="Write a crop plant as a Gazebo model directory.",
        epilog=stages_help(),
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--species", default="corn", help=f"one of {', '.join(known_species())} (default corn)"
    )
    parser.add_argument("--stage", required=True, help="growth stage, see the list below")
    parser.add_argument(
        "--params", type=Path, help="species' parameter file (default: the package's own)"
    )
    parser.add_argument(
        "--seed", type=seed_number, default=0, help="root of all random numbers (default 0)"
    )
    parser.add_argument("--name", required=True, help="name of the model")
    parser.add_argument(
        "--output",
        type=Path,
        help="folder of models to write it in (default: the first of GAZEBO_MODEL_PATH that can be"
        " written and that no build made, else ~/.gazebo/models)",
    )
    return parser


def _make(args: argparse.Namespace) -> Path:
    output = args.output or default_output()
    return make_crop(args.species, args.stage, args.seed, args.name, output, args.params)


def generate_crop_main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs `generate_crop --species corn --stage V8 --seed 7 --name my_corn`; prints the path written."""
    return run(_parser(), _make, arguments)
