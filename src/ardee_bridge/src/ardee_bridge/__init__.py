# SPDX-License-Identifier: MIT
"""UDP bridge between a simulated robot and target hardware without ROS."""
