# SPDX-License-Identifier: MIT
"""Hashes of what makes a data set beside its recipe: it is gone on with as long as all of it is the same."""

from pathlib import Path
from typing import Dict, Set

from ardee_sim import packages
from ardee_sim.identity import engine_digest

from ardee_common.digests import Digests, python_files
from ardee_datasets.field_options import IMAGES, POOLS
from ardee_datasets.recipe import Recipe
from ardee_models.lookup import find_model, search_path


def digests(recipe: Recipe) -> Dict[str, str]:
    """Returns hashes of the program and of each robot, model and image of a recipe, by what it is and its name."""
    found = {f"robot {name}": robot.digest() for name, robot in (recipe.robots or {}).items()}
    folders = search_path([Path(folder) for folder in packages.model_folders()])
    models: Set[str] = set()
    made = Digests()
    found["version of the program"] = made.of(python_files(Path(__file__))) + engine_digest()
    for field, keys in recipe.fields.items():
        options = keys.options or {}
        models.update(*(options.get(pool) or () for pool in POOLS))
        models.update(filter(None, [options.get("terrain")]))
        for key in IMAGES:
            if options.get(key):
                found[f"{key} of {field}"] = made.of([Path(options[key])])
    for name in models:
        found[f"model {name}"] = made.of([find_model(name, folders)])
    return found
