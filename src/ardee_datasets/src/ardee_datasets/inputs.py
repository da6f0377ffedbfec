# SPDX-License-Identifier: MIT
"""What a recipe refers to: an unfinished data set is gone on with as long as all of it is the same."""

import hashlib
from pathlib import Path
from typing import Dict, List, Set

from ardee_sim import packages

from ardee_datasets.field_options import IMAGES, POOLS
from ardee_datasets.recipe import Recipe
from ardee_models.lookup import find_model, search_path


def digests(recipe: Recipe) -> Dict[str, str]:
    """Returns the sha256 of each robot, model and image of a recipe, by what it is and its name."""
    found = {f"robot {name}": robot.digest() for name, robot in (recipe.robots or {}).items()}
    folders = search_path([Path(folder) for folder in packages.model_folders()])
    models: Set[str] = set()
    for keys in recipe.fields.values():
        options = keys.options or {}
        models.update(*(options.get(pool) or () for pool in POOLS))
        models.update(filter(None, [options.get("terrain")]))
        for key in IMAGES:
            if options.get(key):
                image = Path(options[key])
                found[f"{key} {image.name}"] = _digest([image], image.parent)
    for name in models:
        folder = find_model(name, folders)
        found[f"model {name}"] = _digest([each for each in folder.rglob("*")], folder)
    return found


def _digest(files: List[Path], folder: Path) -> str:
    """Returns the sha256 of the names and contents of files."""
    made = hashlib.sha256()
    for file in sorted(file for file in files if file.is_file()):
        made.update(f"{file.relative_to(folder).as_posix()}\0{file.stat().st_size}\0".encode())
        made.update(file.read_bytes())
    return made.hexdigest()
