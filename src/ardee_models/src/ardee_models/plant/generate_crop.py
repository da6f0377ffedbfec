# SPDX-License-Identifier: MIT
"""The command `generate_crop`."""

import argparse
import shlex
from pathlib import Path
from typing import Optional, Sequence

from ardee_common.cli import Parser, RawHelp, add_seed, run, say
from ardee_models.lookup import DEFAULT_OUTPUT, default_output, named_folder
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


def say_how_to_plant(prog: str, models: Sequence[Path]) -> None:
    """Says how to plant a field of the crop models that a command has written."""
    names = " ".join(path.name for path in models)
    say(
        prog,
        f"to plant a field: rosrun ardee_world generate_field --models {names}"
        f" --model-path {shlex.quote(str(models[0].parent))} --name my_field",
    )


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog="generate_crop",
        description="Write a crop plant as a Gazebo model directory.",
        epilog=stages_help(),
        formatter_class=RawHelp,
    )
    parser.add_argument(
        "--species", default="corn", help=f"one of {', '.join(known_species())} (default corn)"
    )
    parser.add_argument("--stage", required=True, help="growth stage, see the list below")
    parser.add_argument(
        "--params", type=Path, help="species' parameter file (default: the package's own)"
    )
    add_seed(parser)
    parser.add_argument("--name", required=True, help="name of the model")
    parser.add_argument(
        "--output",
        type=named_folder,
        help=f"folder of models to write it in (default: {DEFAULT_OUTPUT})",
    )
    return parser


def _make(args: argparse.Namespace) -> Path:
    output = args.output or default_output()
    path = make_crop(args.species, args.stage, args.seed, args.name, output, args.params)
    say_how_to_plant("generate_crop", [path])
    return path


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs `generate_crop --species corn --stage V8 --seed 7 --name my_corn`; prints the path written."""
    return run(_parser(), _make, arguments)
