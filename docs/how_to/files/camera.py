# SPDX-License-Identifier: MIT
"""Renders a field as a real camera would take it: camera.py OUTPUT.png"""

import sys

import ardee_sim
import numpy as np
from PIL import Image

from ardee_datasets.lens import LensKeys

SIZE = {"width_px": 320, "height_px": 240}
AT = (2.5, -1.6, 0.6), (0.0, 0.1, 0.95, 0.3)  # beside the first row
SIDEWAYS = {"v_m_s": (3.0, -4.0, 0.0)}  # a sprayer's 5 m/s
dirt = LensKeys(dust=(25, 25), drops=(4, 4))

with ardee_sim.Simulation(ardee_sim.World.from_file("corn.world")) as sim:
    still = sim.render(*AT, **SIZE)
    pictures = [
        still,
        sim.render(*AT, **SIZE, **SIDEWAYS, exposure_time_s=0.02),
        sim.render(*AT, **SIZE, **SIDEWAYS, readout_time_s=0.05),
        sim.render(*AT, **SIZE, white_balance=10000),
        sim.render(*AT, **SIZE, white_balance="auto"),
        dirt.draw(np.random.default_rng(0), (320, 240)).applied(still),
    ]
sheet = np.vstack([np.hstack(pictures[:3]), np.hstack(pictures[3:])])
Image.fromarray(sheet).save(sys.argv[1])
