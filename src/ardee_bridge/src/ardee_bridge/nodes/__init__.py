# SPDX-License-Identifier: MIT
"""The two ROS nodes."""
