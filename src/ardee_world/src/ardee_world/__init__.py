# SPDX-License-Identifier: MIT
"""Random crop fields as Gazebo model directories, with their ground truth."""
