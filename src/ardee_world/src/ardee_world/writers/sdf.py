# SPDX-License-Identifier: MIT
"""Writes model.sdf of a Layout: one include per plant, with ARDEE's own scale and label, piece by piece."""

from typing import Iterator, Sequence, Tuple

from ardee_world.field_layout import Layout

# Model, kind, number, x y z [m], roll pitch yaw [rad], scale, label
Placed = Tuple[str, str, int, Sequence[float], Sequence[float], float, int]
EXTENSION_NAMESPACE = "urn:ardee:sdf"
_HEAD = """<?xml version="1.0"?>
<sdf version="1.5" xmlns:ardee="{namespace}">
  <model name="{name}">
    <static>true</static>
{pose}"""
POSE = "    <pose>{} {} 0 0 0 {}</pose>\n"
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


def pose_line(layout: Layout) -> str:
    """The model's own <pose>, used by a world that includes it without another pose."""
    return POSE.format(*(repr(float(value) + 0.0) for value in layout.config.world_pose))


def _scale_line(scale: float) -> str:
    return "" if scale == 1.0 else f"      <ardee:scale>{scale:.4f}</ardee:scale>\n"


def _plants(layout: Layout) -> Iterator[Placed]:
    names = [model.name for model in layout.pool]
    labels = [model.label for model in layout.pool]
    columns = (layout.number, layout.position_m, layout.angles_rad, layout.model, layout.scale)
    for number, place, angles, model, scale in zip(*(column.tolist() for column in columns)):
        yield names[model], "plant", number, place, angles, scale, labels[model]


def _clutter(layout: Layout) -> Iterator[Placed]:
    for items, heights in layout.clutter:
        columns = (items.xy_m, heights, items.yaw_rad, items.model, items.scale)
        rows = zip(*(column.tolist() for column in columns))
        for number, ((x, y), z, yaw, model, scale) in enumerate(rows):
            kind = items.pool[model]
            yield kind.name, items.kind, number, (x, y, z), (0.0, 0.0, yaw), scale, kind.label


def placed_items(layout: Layout) -> Iterator[Placed]:
    """All plants and items. A plant's number is its place in the plan, so it survives a change of emergence."""
    yield from _plants(layout)
    yield from _clutter(layout)


def sdf_text(layout: Layout, name: str) -> Iterator[str]:
    """Pieces of the file, in order."""
    yield _HEAD.format(namespace=EXTENSION_NAMESPACE, name=name, pose=pose_line(layout))
    for model, kind, number, (x, y, z), (roll, pitch, yaw), scale, label in placed_items(layout):
        tilt = "0 0" if roll == 0.0 and pitch == 0.0 else f"{roll:.4f} {pitch:.4f}"
        yield _ITEM % (model, kind, number, x, y, z, tilt, yaw, _scale_line(scale), label)
    yield _TAIL
