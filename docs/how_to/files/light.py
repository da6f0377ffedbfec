# SPDX-License-Identifier: MIT
"""Renders a field in four lights: light.py OUTPUT.png"""

import sys
from datetime import datetime, timezone

import ardee_sim
import numpy as np
from PIL import Image

LATITUDE_DEG, LONGITUDE_DEG = 40.06, -88.20  # Urbana, Illinois


def at(hour_utc: int, **air: float) -> ardee_sim.Daylight:
    time = datetime(2026, 7, 15, hour_utc, 15, tzinfo=timezone.utc)
    return ardee_sim.Daylight.at(LATITUDE_DEG, LONGITUDE_DEG, time, **air)


lights = [at(18), at(23), at(11, turbidity=6), at(18, cloud=1.0)]
with ardee_sim.Simulation(ardee_sim.World.from_file("corn.world")) as sim:
    pictures = []
    for light in lights:
        sim.set_light(light)
        pictures.append(
            sim.render((2.5, -1.6, 1.3), (0.0, 0.1, 0.95, 0.3), width_px=320, height_px=240)
        )
sheet = np.vstack([np.hstack(pictures[:2]), np.hstack(pictures[2:])])
Image.fromarray(sheet).save(sys.argv[1])
