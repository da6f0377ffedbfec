# SPDX-License-Identifier: MIT
"""Driving along the middle of a lane that some sensor has found, without ROS: centre line in, motion command out."""
from ardee_navigation.lane_following.follower import LaneFollower, State
from ardee_navigation.lane_following.line import Line
from ardee_navigation.lane_following.parameters import LaneParameters

__all__ = ["LaneFollower", "LaneParameters", "Line", "State"]
