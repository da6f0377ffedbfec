# SPDX-License-Identifier: MIT
"""Writers: plain data to the files of a Gazebo model directory."""
