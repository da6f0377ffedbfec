# SPDX-License-Identifier: MIT
"""Makes the packages importable from the source tree, and a few models for all tests."""

import re
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PACKAGE / "src"))
sys.path.insert(0, str(PACKAGE.parent / "ardee_common" / "src"))
sys.path.insert(0, str(PACKAGE.parent / "ardee_models" / "src"))

import numpy as np  # noqa: E402

from ardee_models.lookup import CropModel  # noqa: E402
from ardee_models.plant.crops import make_crop  # noqa: E402
from ardee_models.terrain.height_map import TerrainParams, generate_terrain  # noqa: E402
from ardee_models.terrain.terrain_model import write_terrain  # noqa: E402

# The line that says what to do with what was written
NEXT = re.compile(r"^\w+: to (drive|plant) .*\n", re.MULTILINE)


@pytest.fixture(scope="session")
def package() -> Path:
    """Returns the source folder of ardee_world."""
    return PACKAGE


@pytest.fixture(scope="session")
def models(tmp_path_factory) -> Path:
    """Returns a folder with two crops and a terrain."""
    folder = tmp_path_factory.mktemp("models")
    make_crop("corn", "V6", 1, "corn_a", folder)
    make_crop("corn", "V8", 2, "corn_b", folder)
    ground = TerrainParams()
    terrain = generate_terrain(ground, np.random.default_rng(1))
    write_terrain(terrain, ground.friction_mu, "ground", "rows", folder)
    return folder


@pytest.fixture()
def pool() -> tuple:
    """Returns two crop models that need no files."""
    return (CropModel("corn_a", 0.8, 0.01, 1), CropModel("corn_b", 1.2, 0.012, 1))


@pytest.fixture()
def run_main(monkeypatch, capsys):
    """Returns a function that runs a command's main() on words; it returns exit code and standard error."""

    def run(main, *words) -> tuple:
        monkeypatch.setattr(sys, "argv", [main.__module__, *map(str, words)])
        try:
            code = main()
        except SystemExit as ended:
            code = ended.code
        return code, NEXT.sub("", capsys.readouterr().err)

    return run


@pytest.fixture()
def generate_field(models, monkeypatch, run_main):
    """Runs the command with arguments; returns exit code and standard error."""
    from ardee_world import generate_field

    def call(*arguments) -> tuple:
        monkeypatch.setenv("GAZEBO_MODEL_PATH", str(models))
        return run_main(generate_field.main, *arguments)

    return call
