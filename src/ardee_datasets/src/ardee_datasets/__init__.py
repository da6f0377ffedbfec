# SPDX-License-Identifier: MIT
"""Labelled pictures of generated fields; no ROS."""
