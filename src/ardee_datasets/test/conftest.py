# SPDX-License-Identifier: MIT
"""The small recipe, and its data set."""

from pathlib import Path

import pytest
from small_sets import RECIPE

from ardee_datasets.generate_dataset import main


@pytest.fixture(scope="session")
def recipe(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("recipe") / "recipe.yaml"
    path.write_text(RECIPE)
    return path


@pytest.fixture(scope="session")
def made(recipe: Path) -> Path:
    folder = recipe.parent / "made"
    assert main([str(recipe), "--output", str(folder), "--workers", "1"]) == 0
    return folder
