# SPDX-License-Identifier: MIT
"""Writes a Layout as plants.csv, one line per plant, read as a stream, and the model.sdf that names it."""

from typing import Iterable, Iterator

from ardee_world.field_layout import Layout
from ardee_world.writers.sdf import EXTENSION_NAMESPACE, Placed, placed_items, pose_line

FILE_NAME = "plants.csv"
HEADER = "model,name,x_m,y_m,z_m,roll_rad,pitch_rad,yaw_rad,scale,label\n"
_MODEL = """<?xml version="1.0"?>
<sdf version="1.5" xmlns:ardee="{namespace}">
  <model name="{name}">
    <static>true</static>
{pose}    <ardee:instances>{file}</ardee:instances>
  </model>
</sdf>
"""
_ROW = "model://%s,%s_%d,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%.4f,%d\n"


def model_text(layout: Layout, name: str) -> str:
    """Text of model.sdf."""
    return _MODEL.format(
        namespace=EXTENSION_NAMESPACE, name=name, pose=pose_line(layout), file=FILE_NAME
    )


def _rows(items: Iterable[Placed]) -> Iterator[str]:
    for model, kind, number, (x, y, z), (roll, pitch, yaw), scale, label in items:
        yield _ROW % (model, kind, number, x, y, z, roll, pitch, yaw, scale, label)


def table_text(layout: Layout) -> Iterator[str]:
    """Lines of plants.csv: metres and radians in the field's frame, plants in the order of the SDF form."""
    yield HEADER
    yield from _rows(placed_items(layout))
