# SPDX-License-Identifier: MIT
"""Draws what both ways see where the classical one leaves the lane, in gaps.world: lost_in_a_gap.py CAMPAIGN OUTPUT.png

CAMPAIGN is the folder of a campaign vision.yaml that has been run.
"""

import math
import sys
import tempfile
from pathlib import Path

import ardee_sim
import numpy as np
from ardee_sim.packages import find_package
from PIL import Image

from ardee_campaigns import tables
from ardee_navigation.vision import VisionFollower, VisionParameters
from ardee_navigation.vision.overlay import drawn
from ardee_world import trial

BEFORE = (60, 44, 15)  # pictures before a person steps in, of 20 a second
folder = Path(sys.argv[1])
runs = (tables.read_run(folder, run_id) for run_id in tables.finished(folder))
run = next(
    run
    for run in runs
    if (run.row.world, run.row.controller) == ("gaps", "classical")
    and "off the lane" in run.samples["event"].to_pylist()
)
path = run.samples.to_pydict()
end = path["event"].index("off the lane")
usual = VisionParameters()
share = find_package("ardee_world")
seen = []
with tempfile.TemporaryDirectory() as models:
    sown = trial.prepare(
        share / "worlds" / "gaps.world",
        share / "fields" / "gaps-field.yaml",
        run.row.seed >> 33,
        Path(models) / "models",
    )
    followers = [
        VisionFollower(VisionParameters(estimator=way)) for way in ("classical", "learned")
    ]
    with ardee_sim.Simulation(
        ardee_sim.World.from_file(sown.world, model_paths=sown.models)
    ) as sim:
        for at in range(end - max(BEFORE) - 10, end - min(BEFORE) + 1):
            yaw = path["yaw_rad"][at]
            x = path["x_m"][at] + usual.camera_ahead_m * math.cos(yaw)
            y = path["y_m"][at] + usual.camera_ahead_m * math.sin(yaw)
            ground_m = sown.height_m(trial.Pose(x, y, yaw)) - trial.STAND_M
            rgb = sim.render(
                (x, y, ground_m + usual.camera_height_m),
                (0.0, 0.0, math.sin(yaw / 2), math.cos(yaw / 2)),
                width_px=320,
                height_px=240,
                horizontal_fov_rad=math.radians(usual.horizontal_fov_deg),
            )
            answers = [follower.update(rgb, path["time_ns"][at] / 1e9) for follower in followers]
            if end - at in BEFORE:
                seen.append(np.vstack([drawn(rgb, answer, usual) for answer in answers]))
sheet = Image.fromarray(np.hstack(seen))
sheet.resize((sheet.width // 2, sheet.height // 2)).save(sys.argv[2])
