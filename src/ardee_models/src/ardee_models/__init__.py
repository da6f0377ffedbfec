# SPDX-License-Identifier: MIT
"""Procedural crops and terrains, written as Gazebo model directories."""
