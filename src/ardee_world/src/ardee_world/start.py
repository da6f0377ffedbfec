# SPDX-License-Identifier: MIT
"""The pose from which a robot starts in front of a field, kept in <name>.start.yaml beside the field."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Optional

import numpy as np

from ardee_common.config import build, read_yaml_lines
from ardee_common.options import bounded
from ardee_models.terrain.height_map import Ground
from ardee_world.curves import Line
from ardee_world.field_layout import Layout

STAND_M = 0.175  # height of a robot's base_footprint above the ground below its wheels
_REACH_M = 0.3  # half the length of a robot
_TEXT = """# Start pose of a robot: in the middle of the lane, before the first stalks, looking along the rows.
x_m: {x_m:.4f}
y_m: {y_m:.4f}
z_m: {z_m:.4f}
yaw_rad: {yaw_rad:.7f}
"""


@dataclass(frozen=True)
class Start:
    """Pose of base_footprint in the world; the default is that of launch_default_tsv1.launch."""

    x_m: float = bounded(-1e6, 1e6, 0.0)
    y_m: float = bounded(-1e6, 1e6, 0.0)
    z_m: float = bounded(-1e4, 1e4, STAND_M)
    yaw_rad: float = bounded(-7.0, 7.0, -3.14)

    def on(self, ground: Optional[Ground]) -> "Start":
        """Returns this pose on the highest ground within a robot's reach."""
        if ground is None:
            return dataclasses.replace(self, z_m=STAND_M)
        beside = np.linspace(-_REACH_M, _REACH_M, 13)
        dx, dy = (offsets.ravel() for offsets in np.meshgrid(beside, beside))
        heights = ground.height_at(self.x_m + dx, self.y_m + dy)
        return dataclasses.replace(self, z_m=STAND_M + float(heights.max()))

    def text(self) -> str:
        """Text of a .start.yaml file."""
        return _TEXT.format(**dataclasses.asdict(self))


def start_before(layout: Layout) -> Start:
    """Start pose at the field's origin, which lies in a lane, along the first direction of the rows."""
    x, y, turn = layout.config.world_pose
    line = Line(layout.config.shape, layout.config.plots.length_m())
    ahead = line.tangents(np.zeros(1))[0]
    yaw = turn + np.arctan2(ahead[1], ahead[0])
    return Start(x, y, yaw_rad=float((yaw + np.pi) % (2.0 * np.pi) - np.pi))


def start_file(field: Path) -> Path:
    """The file that goes with a field's .urdf.xacro."""
    return field.with_name(field.name.replace(".urdf.xacro", "") + ".start.yaml")


def read_start(path: Path) -> Start:
    """Reads the start pose of a file; returns the default without one."""
    if not path.is_file():
        return Start()
    return build(Start, read_yaml_lines(path))
