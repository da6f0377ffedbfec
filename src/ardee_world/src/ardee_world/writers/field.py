# SPDX-License-Identifier: MIT
"""Layout to a Gazebo model directory with its ground truth."""

import shutil
from pathlib import Path

from ardee_models.output import model_directory
from ardee_models.writers.metadata import model_config
from ardee_world.layout import Layout
from ardee_world.urdf_file import SEPARATOR
from ardee_world.writers.map_png import draw_map
from ardee_world.writers.plots_file import plots_text
from ardee_world.writers.sdf import sdf_text
from ardee_world.writers.truth import clutter_columns, csv_text, json_text, plant_columns


def _write_model(layout: Layout, name: str, folder: Path) -> None:
    """model.sdf, plots.xacro, and both in <name>.urdf.xacro: the plants first, then the separator, then the plots."""
    with (folder / "model.sdf").open("w") as file:
        file.writelines(sdf_text(layout, name))
    plots = plots_text(layout)
    (folder / "plots.xacro").write_text(plots)
    with (folder / f"{name}.urdf.xacro").open("w") as whole, (folder / "model.sdf").open() as model:
        shutil.copyfileobj(model, whole, 1 << 20)
        whole.write(f"{SEPARATOR}\n{plots}")


def write_field(layout: Layout, name: str, parent: Path) -> Path:
    """Write parent/name, replacing an earlier model of that name; returns its path."""
    columns, clutter = plant_columns(layout), clutter_columns(layout)
    with model_directory(parent, name) as folder:
        text = f"Crop field of {layout.count()} plants, procedural, seed {layout.seed}"
        (folder / "model.config").write_text(model_config(name, text))
        _write_model(layout, name, folder)
        with (folder / "truth.csv").open("w") as file:
            file.writelines(csv_text(columns))
        if clutter:
            with (folder / "clutter.csv").open("w") as file:
                file.writelines(csv_text(clutter))
        (folder / "truth.json").write_text(json_text(layout, columns, clutter, name))
        draw_map(layout).save(folder / "map.png")
    return parent / name
