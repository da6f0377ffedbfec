# SPDX-License-Identifier: MIT
"""The lidar-based in-row navigation technique of thesis chapter 5, without ROS: scan in, motion command out."""
from ardee_navigation.lbirnt.follower import Output, RowFollower, State
from ardee_navigation.lbirnt.parameters import Parameters

__all__ = ["Output", "Parameters", "RowFollower", "State"]
