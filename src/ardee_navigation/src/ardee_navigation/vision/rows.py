# SPDX-License-Identifier: MIT
"""Crop rows in a picture: parallel, equally spaced lines on level ground.

Picture row v below the horizon h shows ground at a distance of 1 / (v - h), in units of focal length times camera
height. Crop row m passes it at u = u_c + heading + (v - h) (phase + m) spacing: the crop rows lie spacing (v - h)
pixels apart there, and meet at u_c + heading in the horizon. u_c is the middle of the picture; pixel i reaches from i
to i + 1.
"""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class RowModel:
    """Rows of a picture; pixels, and numbers as above."""

    horizon_px: float
    spacing: float
    phase: float
    heading_px: float

    def offset_px(self, row: float, v_px: np.ndarray) -> np.ndarray:
        """Returns where a crop row passes picture rows, to the right of the picture's middle."""
        return self.heading_px + (v_px - self.horizon_px) * (self.phase + row) * self.spacing

    def scaled(self, factor: float) -> "RowModel":
        """Returns the rows of the picture magnified by a factor."""
        return RowModel(
            self.horizon_px * factor, self.spacing, self.phase, self.heading_px * factor
        )
