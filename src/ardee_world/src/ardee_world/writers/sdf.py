# SPDX-License-Identifier: MIT
"""Layout to model.sdf: one include a plant, with ARDEE's own scale and label, written as a stream."""

from typing import Iterator

from ardee_world.layout import Layout

EXTENSION_NAMESPACE = "urn:ardee:sdf"
_HEAD = """<?xml version="1.0"?>
<sdf version="1.5" xmlns:ardee="{namespace}">
  <model name="{name}">
    <static>true</static>
"""
_ITEM = """    <include>
      <uri>model://%s</uri>
      <name>%s_%d</name>
      <pose>%.4f %.4f %.4f %s %.4f</pose>
      <static>true</static>
%s      <ardee:label>%d</ardee:label>
    </include>
"""
_TAIL = """  </model>
</sdf>
"""


def _scale_line(scale: float) -> str:
    return "" if scale == 1.0 else f"      <ardee:scale>{scale:.4f}</ardee:scale>\n"


def _plants(layout: Layout) -> Iterator[str]:
    names = [model.name for model in layout.pool]
    labels = [model.label for model in layout.pool]
    columns = (layout.number, layout.position_m, layout.angles_rad, layout.model, layout.scale)
    for number, (x, y, z), (roll, pitch, yaw), model, scale in zip(
        *(column.tolist() for column in columns)
    ):
        tilt = "0 0" if roll == 0.0 and pitch == 0.0 else f"{roll:.4f} {pitch:.4f}"
        line = _scale_line(scale)
        yield _ITEM % (names[model], "plant", number, x, y, z, tilt, yaw, line, labels[model])


def _clutter(layout: Layout) -> Iterator[str]:
    for items, heights in layout.clutter:
        columns = (items.xy_m, heights, items.yaw_rad, items.model, items.scale)
        rows = zip(*(column.tolist() for column in columns))
        for number, ((x, y), z, yaw, model, scale) in enumerate(rows):
            kind = items.pool[model]
            line = _scale_line(scale)
            yield _ITEM % (kind.name, items.kind, number, x, y, z, "0 0", yaw, line, kind.label)


def sdf_text(layout: Layout, name: str) -> Iterator[str]:
    """Pieces of the file in order. A plant's number is its place in the plan, so it survives a change of emergence."""
    yield _HEAD.format(namespace=EXTENSION_NAMESPACE, name=name)
    yield from _plants(layout)
    yield from _clutter(layout)
    yield _TAIL
