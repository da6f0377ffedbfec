# SPDX-License-Identifier: MIT
"""Generates the models of the build: crop variants, terrains, textures, and the static models beside them."""

import argparse
import io
import shutil
from pathlib import Path

import numpy as np
from PIL import Image

from ardee_common.cli import Parser, run
from ardee_common.output import model_directory, write_file
from ardee_models.plant.variants import build_crops
from ardee_models.terrain.ground_textures import media_textures
from ardee_models.terrain.height_map import TerrainParams, generate_terrain
from ardee_models.terrain.terrain_model import write_terrain

_TERRAIN_SEED = 1
_MEDIA_SEED = 1


def build_terrains(models: Path) -> None:
    """Writes the terrains heightmap_ground (ridges and bumps) and heightmap_flat."""
    ground, flat = TerrainParams(), TerrainParams(ridge_height_m=0.0, bump_sd_m=0.0)
    for params, name, image in (
        (ground, "heightmap_ground", "corn_rows"),
        (flat, "heightmap_flat", "flat"),
    ):
        terrain = generate_terrain(params, np.random.default_rng(_TERRAIN_SEED))
        write_terrain(terrain, params.friction_mu, name, image, models)


def build_media(media: Path) -> None:
    """Writes the textures that terrain models name."""
    for stem, pixels in media_textures(np.random.default_rng(_MEDIA_SEED)).items():
        buffer = io.BytesIO()
        Image.fromarray(pixels).save(buffer, format="PNG", optimize=True)
        write_file(media / "materials" / "textures" / f"{stem}.png", buffer.getvalue())


def copy_static(source: Path, models: Path) -> None:
    """Copies the models that are kept by hand (ground_plane, sun)."""
    for model in sorted(path for path in source.iterdir() if path.is_dir()):
        with model_directory(models, model.name) as folder:
            shutil.copytree(model, folder, dirs_exist_ok=True)


def _build(args: argparse.Namespace) -> None:
    copy_static(args.static, args.share / "models")
    build_crops(args.share / "models")
    build_terrains(args.share / "models")
    build_media(args.share / "media")


def main() -> int:
    """Runs `python3 -m ardee_models.build --share DIR --static DIR`."""
    parser = Parser(prog="ardee_models.build", description=__doc__)
    parser.add_argument(
        "--share", type=Path, required=True, help="folder to fill with models/ and media/"
    )
    parser.add_argument("--static", type=Path, required=True, help="folder of hand-kept models")
    return run(parser, _build)


if __name__ == "__main__":
    raise SystemExit(main())
