# SPDX-License-Identifier: MIT
"""Layout to a Gazebo model directory with its ground truth."""

from pathlib import Path

from ardee_models.output import model_directory
from ardee_models.writers.metadata import model_config
from ardee_world.layout import Layout
from ardee_world.writers.map_png import draw_map
from ardee_world.writers.sdf import sdf_text
from ardee_world.writers.truth import csv_text, json_text, plant_columns


def write_field(layout: Layout, name: str, parent: Path, from_file: bool = False) -> Path:
    """Write parent/name, replacing an earlier model of that name; returns its path."""
    columns = plant_columns(layout)
    with model_directory(parent, name) as folder:
        text = f"Crop field of {layout.count()} plants, procedural, seed {layout.seed}"
        (folder / "model.config").write_text(model_config(name, text))
        with (folder / "model.sdf").open("w") as file:
            file.writelines(sdf_text(layout, name))
        with (folder / "truth.csv").open("w") as file:
            file.writelines(csv_text(columns))
        (folder / "truth.json").write_text(json_text(layout, columns, name, from_file))
        draw_map(layout).save(folder / "map.png")
    return parent / name
