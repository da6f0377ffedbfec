# SPDX-License-Identifier: MIT
"""Writes a Layout as a Gazebo model directory with its ground truth."""

import shutil
from pathlib import Path
from typing import Optional

from ardee_common.output import model_directory
from ardee_models.metadata import model_config
from ardee_models.terrain.height_map import Ground
from ardee_world.field_layout import Layout
from ardee_world.request import LARGEST_SDF
from ardee_world.start import start_before
from ardee_world.urdf_file import SEPARATOR
from ardee_world.writers.instances import FILE_NAME, model_text, table_text
from ardee_world.writers.map_png import draw_map
from ardee_world.writers.plots_file import plots_text
from ardee_world.writers.sdf import sdf_text
from ardee_world.writers.truth_files import clutter_columns, csv_text, json_text, plant_columns


def is_stream(form: str, layout: Layout) -> bool:
    """Tells whether a field of the form `auto`, `sdf` or `stream` keeps its plants in a table."""
    count = layout.count() + sum(len(heights) for _, heights in layout.clutter)
    return form == "stream" or (form == "auto" and count > LARGEST_SDF)


def _write_model(layout: Layout, name: str, folder: Path, form: str) -> None:
    """Writes model.sdf, plots.xacro, and both in <name>.urdf.xacro: plants, separator line, plots."""
    stream = is_stream(form, layout)
    with (folder / "model.sdf").open("w") as file:
        file.writelines([model_text(layout, name)] if stream else sdf_text(layout, name))
    if stream:
        with (folder / FILE_NAME).open("w") as file:
            file.writelines(table_text(layout))
    plots = plots_text(layout)
    (folder / "plots.xacro").write_text(plots)
    with (folder / f"{name}.urdf.xacro").open("w") as whole, (folder / "model.sdf").open() as model:
        shutil.copyfileobj(model, whole, 1 << 20)
        whole.write(f"{SEPARATOR}\n{plots}")


def write_field(
    layout: Layout,
    name: str,
    parent: Path,
    form: str = "auto",
    terrain: Optional[Ground] = None,
    *,
    has_map: bool = True,
) -> Path:
    """Writes parent/name, replacing an earlier model of that name; returns its path."""
    columns, clutter = plant_columns(layout), clutter_columns(layout)
    with model_directory(parent, name) as folder:
        text = f"Crop field of {layout.count()} plants, procedural, seed {layout.seed}"
        (folder / "model.config").write_text(model_config(name, text))
        _write_model(layout, name, folder, form)
        start = start_before(layout).on(terrain)
        (folder / f"{name}.start.yaml").write_text(start.text())
        with (folder / "truth.csv").open("w") as file:
            file.writelines(csv_text(columns))
        if clutter:
            with (folder / "clutter.csv").open("w") as file:
                file.writelines(csv_text(clutter))
        (folder / "truth.json").write_text(json_text(layout, columns, clutter, name))
        if has_map:
            draw_map(layout).save(folder / "map.png")
    return parent / name
