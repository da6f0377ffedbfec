# SPDX-License-Identifier: MIT
"""Row following by a camera, without ROS: picture in, motion command out."""
from ardee_navigation.vision.camera import Camera, Sight
from ardee_navigation.vision.follower import Output, VisionFollower
from ardee_navigation.vision.parameters import VisionParameters

__all__ = ["Camera", "Output", "Sight", "VisionFollower", "VisionParameters"]
