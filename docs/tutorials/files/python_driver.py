# SPDX-License-Identifier: MIT
"""Runs keep_middle in a simulation of its own, without ROS: python3 python_driver.py [WORLD]."""
import sys

import ardee_sim
from keep_middle import command

world = ardee_sim.World.from_file(
    sys.argv[1] if len(sys.argv) > 1 else "scenario_1_artificial.world"
)
with ardee_sim.Simulation(world, seed=1) as sim:
    sim.spawn("robot", ardee_sim.robot("tsv1_default"), **world.start)
    sim.demand("ardee/hokuyo")  # nothing is measured that nobody demands
    speed_m_s = 0.5
    while speed_m_s > 0.0:
        sim.step(5)  # 25 ms: the lidar's period
        scan = sim.latest("ardee/hokuyo")
        speed_m_s, turn_rad_s = command(scan.ranges_m, scan.angle_min_rad, scan.angle_increment_rad)
        sim.command("cmd_vel", ardee_sim.Twist(linear_x_m_s=speed_m_s, angular_z_rad_s=turn_rad_s))
    x_m, y_m, _ = sim.state("robot").xyz_m
    print(f"no row in sight at {sim.time_ns * 1e-9:.1f} s, x = {x_m:.2f} m, y = {y_m:.2f} m")
