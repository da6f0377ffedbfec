# SPDX-License-Identifier: MIT
"""Drives a TerraSentia down a row of corn, prints what its lidar saw, writes a picture: [WORLD] [PICTURE.png]."""

import sys

import ardee_sim
import numpy as np
from PIL import Image

SPEED = ardee_sim.Twist(linear_x_m_s=0.5)


def main() -> None:
    """Runs the example."""
    world = ardee_sim.World.from_file(sys.argv[1] if len(sys.argv) > 1 else "corn.world")
    picture = sys.argv[2] if len(sys.argv) > 2 else "first_drive.png"
    print(f"{world.path}: {len(world.plants())} plants")
    with ardee_sim.Simulation(world, seed=1) as sim:
        sim.spawn("robot", ardee_sim.robot("tsv1_default"), **world.start)
        sim.demand("ardee/hokuyo")
        for _ in range(50):
            sim.command("cmd_vel", SPEED)
            sim.step(round(0.1e9 / sim.step_ns))
            if sim.time_ns % 1_000_000_000 == 0:
                ranges_m = sim.latest("ardee/hokuyo").ranges_m
                met = ranges_m[np.isfinite(ranges_m)]
                place = sim.state("robot").xyz_m
                nearest = f", the nearest at {met.min():.2f} m" if met.size else ""
                print(
                    f"{sim.time_ns * 1e-9:.0f} s: x = {place[0]:.2f} m; "
                    f"{met.size} of {ranges_m.size} beams met something{nearest}"
                )
        sim.demand("ardee/camera/front/image_raw")
        sim.step(round(0.1e9 / sim.step_ns))
        Image.fromarray(sim.latest("ardee/camera/front/image_raw").pixels).save(picture)
    print(f"{picture}: what its front camera sees")


if __name__ == "__main__":
    main()
