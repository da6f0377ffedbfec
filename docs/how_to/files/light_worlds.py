# SPDX-License-Identifier: MIT
"""Renders the start of a robot in a field in three lights: light_worlds.py OUTPUT.png"""

import sys

import ardee_sim
import numpy as np
from PIL import Image

EYE_M = (-1.5, 0.0, 0.45)  # between the first plants
AHEAD = (-0.1045, 0.0, 0.9945, 0.0)  # along the lane, to the west, 12 degrees down
pictures = []
for world in ("early_corn", "low_sun", "overcast"):
    with ardee_sim.Simulation(ardee_sim.World.from_file(f"{world}.world")) as sim:
        pictures.append(sim.render(EYE_M, AHEAD, width_px=320, height_px=240))
Image.fromarray(np.hstack(pictures)).save(sys.argv[1])
