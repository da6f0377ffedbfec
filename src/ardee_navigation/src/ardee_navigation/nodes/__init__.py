# SPDX-License-Identifier: MIT
"""The row follower as a ROS node, and as a process of a target computer."""
