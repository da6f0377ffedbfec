# SPDX-License-Identifier: MIT
"""Controllers that are ROS nodes. Only process.py can be imported without ROS."""
