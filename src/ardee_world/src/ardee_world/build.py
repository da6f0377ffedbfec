# SPDX-License-Identifier: MIT
"""Generates the models of the build: clutter, terrains of recipes, fields; each YAML file makes a model of its name."""

import argparse
from pathlib import Path
from typing import Dict, List, Sequence

from ardee_common.cli import Parser, run
from ardee_common.errors import GeneratorError
from ardee_common.output import write_file
from ardee_models.lookup import find_model
from ardee_models.terrain.recipe import read_recipe
from ardee_models.terrain.recipe_model import write_recipe
from ardee_world.clutter_models import MODELS, write_clutter_model
from ardee_world.generate_field import make_configured
from ardee_world.request import yaml_values
from ardee_world.start import start_file
from ardee_world.urdf_file import EMPTY


def build_terrains(recipes: Path, models: Path) -> None:
    """Writes the terrains of all recipes in a folder."""
    for path in sorted(recipes.glob("*.yaml")):
        write_recipe(read_recipe(path), path.stem, path.stem, models)


def missing_models(values: Dict[str, object], folders: Sequence[Path]) -> List[str]:
    """Crop models that a field names and that are in none of the folders."""
    missing = []
    for name in values.get("models", ()):
        try:
            find_model(name, folders)
        except GeneratorError:
            missing.append(name)
    return missing


def build_fields(plans: Path, models: Path, urdf: Path, folders: Sequence[Path]) -> None:
    """Writes the fields of all plans in a folder. A field whose crop models are missing is left out with a message."""
    for plan in sorted(plans.glob("*.yaml")):
        values = yaml_values(plan)
        missing = missing_models(values, folders)
        if missing:
            print(f"{plan.stem}: left out, there is no model {', '.join(missing)}")
            continue
        # Includes: the .urdf.xacro is copied to where no table lies beside it
        values.update(name=plan.stem, output=str(models), format="sdf")
        values.update(model_path=tuple(map(str, folders)))
        field = make_configured(values) / f"{plan.stem}.urdf.xacro"
        for path in (field, start_file(field)):
            write_file(urdf / path.name, path.read_bytes())
    write_file(urdf / "empty.urdf.xacro", EMPTY.encode())


def _build(args: argparse.Namespace) -> None:
    models = args.share / "models"
    for name in MODELS:
        write_clutter_model(name, models)
    build_terrains(args.source / "terrains", models)
    folders = [models, *args.model_path]
    build_fields(args.source / "fields", models, args.share / "urdf", folders)


def main() -> int:
    """Runs `python3 -m ardee_world.build --source DIR --share DIR --model-path DIR`."""
    parser = Parser(prog="ardee_world.build", description=__doc__)
    parser.add_argument(
        "--source", type=Path, required=True, help="folder that holds terrains/ and fields/"
    )
    parser.add_argument(
        "--share", type=Path, required=True, help="folder to fill with models/ and urdf/"
    )
    parser.add_argument(
        "--model-path", type=Path, nargs="+", required=True, help="folders of crop models"
    )
    return run(parser, _build)


if __name__ == "__main__":
    raise SystemExit(main())
