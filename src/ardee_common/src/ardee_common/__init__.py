# SPDX-License-Identifier: MIT
"""Code that the Python packages share. Nothing here imports ROS."""
