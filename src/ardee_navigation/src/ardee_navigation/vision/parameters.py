# SPDX-License-Identifier: MIT
"""Parameters of the row follower by camera, with units, limits and where they come from.

[robot] the TerraSentia. [own] chosen here.
"""
from dataclasses import dataclass

from ardee_common.options import bounded, option
from ardee_navigation.lane_following.parameters import LaneParameters


@dataclass(frozen=True)
class VisionParameters(LaneParameters):
    """Numbers of the camera, and of the checks of what it sees, beside those of any lane. Frame: the camera's."""

    estimator: str = option("learned", choices=("classical", "learned"))  # [own]
    camera_ahead_m: float = bounded(-2.0, 2.0, 0.23)  # before the turning centre [robot]
    camera_height_m: float = bounded(0.02, 5.0, 0.235)  # above the ground [robot]
    camera_pitch_deg: float = bounded(-60.0, 60.0, 0.0)  # below the horizon [robot]
    horizontal_fov_deg: float = bounded(5.0, 170.0, 80.0)  # of view [robot]
    blend: float = bounded(0.01, 1.0, 0.3)  # weight of a new line against the one before [own]
    # Between what is seen past a row's end, at most 0.39 (low sun), and between rows of corn and sorghum, 0.49 or more
    min_confidence: float = bounded(0.0, 1.0, 0.45)  # less shows no lane [own]
    end_confidence: float = bounded(0.0, 1.0, 0.45)  # less shows that no row lies ahead [own]
