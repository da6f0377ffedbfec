# SPDX-License-Identifier: MIT
"""A measure: how much a robot turns to and fro."""
import numpy as np


def turns_per_m(run, truth):
    """Returns the angle turned through on each metre of the way [rad/m]."""
    way_m = run.way_m().sum()
    turned_rad = np.abs(np.diff(np.unwrap(run["yaw_rad"]))).sum()
    return turned_rad / way_m if way_m else np.nan
