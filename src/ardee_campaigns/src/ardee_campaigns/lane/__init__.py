# SPDX-License-Identifier: MIT
"""A lane as a lidar sees it: scans of real and of simulated runs, their figures, and the command `judge_lane`."""
