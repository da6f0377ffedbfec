# SPDX-License-Identifier: MIT
"""A sweep of the lidar, as both simulations of a run give it."""
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Scan:
    """Ranges [m] at angles that grow counter-clockwise from the first; not finite without a return."""

    time_s: float
    ranges_m: np.ndarray
    angle_min_rad: float
    increment_rad: float
