# SPDX-License-Identifier: MIT
"""Writes plots.xacro of a Layout: the regions of the variable-accuracy GPS (thesis Listing A.7)."""

from typing import Any, Dict, List

import numpy as np

from ardee_world.curves import left_of
from ardee_world.field_layout import Layout, to_world

_HEAD = """<?xml version="1.0" ?>
<robot xmlns:xacro="http://ros.org/wiki/xacro">
  <!-- In the world's frame: x y z is the middle of a plot on the ground [m]; rotation the direction of its rows
       [rad]; it is row_length long and row_count times row_width wide [m]; average_height in m, average_density in
       plants a m^2. -->
"""
_PLOT = """  <plot>
    <plot_id>{plot_id}</plot_id>
    <plot_range_index>{range_index}</plot_range_index>
    <plot_crossrange_index>{crossrange_index}</plot_crossrange_index>
    <x>{x:.4f}</x>
    <y>{y:.4f}</y>
    <z>{z:.4f}</z>
    <rotation>{rotation:.4f}</rotation>
    <row_count>{row_count}</row_count>
    <row_width>{row_width:.4f}</row_width>
    <row_length>{row_length:.4f}</row_length>
    <average_height>{average_height:.4f}</average_height>
    <average_density>{average_density:.4f}</average_density>
  </plot>
"""
_TAIL = "</robot>\n"


def _region(layout: Layout, plot: int, rows: list, members: np.ndarray) -> Dict[str, Any]:
    """Returns the values of one plot: the rectangle around its rows, half a row spacing wider on each side."""
    chords = np.array([row.line_m[-1] - row.line_m[0] for row in rows])
    longest = chords[np.argmax((chords**2).sum(axis=1))]
    against = chords @ longest < 0.0  # a row may be listed from its other end
    chord = np.where(against[:, None], -chords, chords).sum(axis=0)
    if np.linalg.norm(chord) < 1e-9:
        chord = np.array([0.0, -1.0])
    forward = chord / np.linalg.norm(chord)
    across = left_of(forward)
    points = np.concatenate([row.line_m for row in rows])
    along, beside = points @ forward, points @ across
    middle = 0.5 * (along.min() + along.max()) * forward
    middle = middle + 0.5 * (beside.min() + beside.max()) * across
    pose, plots = layout.config.world_pose, layout.config.plots
    world = to_world(middle[None], pose)[0]
    width = (np.ptp(beside) + plots.row_spacing_m) / len(rows)
    # rows of a single plant have a length too
    length = max(float(np.ptp(along)), plots.stalk_spacing_m)
    heights = layout.height_m[members]
    area = width * len(rows) * length
    turn = np.arctan2(forward[1], forward[0]) + pose[2]
    return dict(
        plot_id=plot,
        range_index=plot // plots.plots_x,  # along the rows
        crossrange_index=plot % plots.plots_x,
        x=float(world[0]),
        y=float(world[1]),
        z=float(layout.position_m[members, 2].mean()) if len(members) else 0.0,
        rotation=float((turn + np.pi) % (2 * np.pi) - np.pi),
        row_count=len(rows),
        row_width=float(width),
        row_length=length,
        average_height=float(heights.mean()) if len(heights) else 0.0,
        average_density=len(members) / area,
    )


def plot_regions(layout: Layout) -> List[Dict[str, Any]]:
    """Regions of all plots, cross rows of a headland counting as one."""
    by_plot: dict = {}
    for row in layout.planned.rows:
        by_plot.setdefault(row.plot, []).append(row)
    plot_of = layout.planned.plot[layout.index]
    order = np.argsort(plot_of, kind="stable")
    counts = np.bincount(plot_of, minlength=max(by_plot) + 1)
    members = np.split(order, np.cumsum(counts)[:-1])
    return [_region(layout, plot, rows, members[plot]) for plot, rows in sorted(by_plot.items())]


def plots_text(layout: Layout) -> str:
    """Text of plots.xacro."""
    return _HEAD + "".join(_PLOT.format(**r) for r in plot_regions(layout)) + _TAIL
