# SPDX-License-Identifier: MIT
"""What the Python packages share. Nothing here imports ROS."""
