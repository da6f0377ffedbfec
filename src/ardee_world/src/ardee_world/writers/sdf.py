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
_PLANT = """    <include>
      <uri>model://%s</uri>
      <name>plant_%d</name>
      <pose>%.4f %.4f %.4f 0 0 %.4f</pose>
      <static>true</static>
%s      <ardee:label>%d</ardee:label>
    </include>
"""
_TAIL = """  </model>
</sdf>
"""


def sdf_text(layout: Layout, name: str) -> Iterator[str]:
    """Pieces of the file in order. A plant's number is its place in the plan, so it survives a change of emergence."""
    yield _HEAD.format(namespace=EXTENSION_NAMESPACE, name=name)
    names = [model.name for model in layout.pool]
    labels = [model.label for model in layout.pool]
    columns = (layout.index, layout.position_m, layout.yaw_rad, layout.model, layout.scale)
    for index, (x, y, z), yaw, model, scale in zip(*(column.tolist() for column in columns)):
        scale_line = "" if scale == 1.0 else f"      <ardee:scale>{scale:.4f}</ardee:scale>\n"
        yield _PLANT % (names[model], index, x, y, z, yaw, scale_line, labels[model])
    yield _TAIL
