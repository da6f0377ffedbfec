# SPDX-License-Identifier: MIT
"""The command `prepare_crop`, which makes crop models of a user's mesh."""

import argparse
import json
import sys
from pathlib import Path
from typing import List, Optional, Sequence

from ardee_common.cli import Parser, positive_number, run, whole_in
from ardee_models.lookup import DEFAULT_OUTPUT, default_output, named_folder
from ardee_models.mesh_file import UP_RULE, UPS
from ardee_models.plant.generate_crop import say_how_to_plant
from ardee_models.plant.plant_metrics import METRICS_FILE
from ardee_models.plant.species import known_species, load_species
from ardee_models.prepare.read import read_mesh
from ardee_models.prepare.write import split_plants, write_plants

_FLAT = 2.0  # sideways reach over height, above which a plant is suspected to lie


def prepare(args: argparse.Namespace) -> List[Path]:
    """Reads, splits and writes the plants; returns the model directories."""
    label = args.label
    if label is None:
        label = load_species(args.species)[0].label if args.species in known_species() else 0
    parts = read_mesh(args.mesh, args.mesh_up, args.mesh_scale, _say)
    plants = [parts] if args.whole else split_plants(parts, args.gap_m)
    facts = {
        "species": args.species,
        "stage": args.stage,
        "season": "unknown",
        "label": label,
        "source": args.mesh.name,
    }
    return write_plants(plants, args.name, args.output or default_output(), args.stem, facts)


def _say(text: str) -> None:
    print(f"prepare_crop: {text}", file=sys.stderr)


def warn_if_lying(model: Path, given: str) -> None:
    """Warns of a plant much wider than high, which has most likely been read with the wrong axis up."""
    metrics = json.loads((model / METRICS_FILE).read_text(encoding="utf-8"))
    height_m, extent_m = metrics["height_m"], metrics["lateral_extent_m"]
    if extent_m > _FLAT * height_m:
        _say(
            f"warning: {model.name} is {height_m:g} m high and reaches {extent_m:g} m to the side;"
            f" if it lies, turn it by another --mesh-up than {given}"
        )


def _parser() -> argparse.ArgumentParser:
    parser = Parser(
        prog="prepare_crop",
        description="Make crop models of a mesh file: one for each stalk that stands on the ground,"
        " drawn from both sides, with a cylinder fitted to its stalk and PNG copies of its textures.",
    )
    parser.add_argument("mesh", type=Path, help="mesh file (.dae, .obj, .stl, .ply, .glb, ...)")
    parser.add_argument(
        "--name", required=True, help="name of the model; several stalks become NAME_1, NAME_2, ..."
    )
    parser.add_argument(
        "--output",
        type=named_folder,
        help=f"folder of models to write in (default: {DEFAULT_OUTPUT})",
    )
    parser.add_argument(
        "--mesh-up",
        choices=UPS,
        default="auto",
        help=f"the file's up axis (default auto: {UP_RULE})",
    )
    parser.add_argument(
        "--mesh-scale",
        type=positive_number,
        help="length of the mesh's unit [m] (default: as a .dae says, else 1)",
    )
    parser.add_argument(
        "--gap-m",
        type=positive_number,
        default=0.06,
        help="stalks whose feet are nearer than this are one plant [m] (default 0.06)",
    )
    parser.add_argument(
        "--whole", action="store_true", help="make one model of the whole mesh, do not split it"
    )
    parser.add_argument(
        "--stem", help="name of the part that is the stalk (default: one called stem, stalk, trunk)"
    )
    parser.add_argument("--species", default="unknown", help="species to note in metrics.json")
    parser.add_argument("--stage", default="unknown", help="growth stage to note in metrics.json")
    parser.add_argument(
        "--label", type=whole_in(0, 65535), help="class id in segmentation (default: the species')"
    )
    return parser


def _prepare_all(args: argparse.Namespace) -> None:
    paths = prepare(args)
    for path in paths:
        print(path)
        warn_if_lying(path, args.mesh_up)
    say_how_to_plant("prepare_crop", paths)


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs `prepare_crop MESH --name N`; prints the paths written."""
    return run(_parser(), _prepare_all, arguments)
