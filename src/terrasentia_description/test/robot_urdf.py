# SPDX-License-Identifier: MIT
"""Reads a URDF: joints, frames, inertials, plugins."""
import xml.etree.ElementTree as ElementTree
from typing import Dict, Optional

import numpy as np


def numbers(text: Optional[str]) -> np.ndarray:
    """Returns blank-separated numbers; three zeros if there is no text."""
    return np.array([float(word) for word in (text or "0 0 0").split()])


def rotation(rpy: np.ndarray) -> np.ndarray:
    """Returns the rotation matrix of URDF's fixed-axis roll, pitch, yaw (rad)."""
    return (
        turn(np.array([0, 0, 1]), rpy[2])
        @ turn(np.array([0, 1, 0]), rpy[1])
        @ turn(np.array([1, 0, 0]), rpy[0])
    )


def turn(axis: np.ndarray, angle_rad: float) -> np.ndarray:
    """Returns the rotation matrix about a unit axis (Rodrigues)."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle_rad) * cross + (1 - np.cos(angle_rad)) * cross @ cross


def pose(element: Optional[ElementTree.Element]) -> np.ndarray:
    """Returns the 4 x 4 pose of the <origin> inside an element."""
    origin = element.find("origin") if element is not None else None
    matrix = np.eye(4)
    if origin is not None:
        matrix[:3, :3] = rotation(numbers(origin.get("rpy")))
        matrix[:3, 3] = numbers(origin.get("xyz"))
    return matrix


class Robot:
    """A parsed URDF with its kinematics."""

    def __init__(self, text: str):
        self.text = text
        self.root = ElementTree.fromstring(text)
        self.links = {link.get("name"): link for link in self.root.findall("link")}
        self.joints = {joint.get("name"): joint for joint in self.root.findall("joint")}
        self.bodies = [
            name for name, link in self.links.items() if link.find("inertial") is not None
        ]
        self.joint_of = {joint.find("child").get("link"): joint for joint in self.joints.values()}

    def plugins(self, filename: str) -> list:
        """Returns plugin elements of a library, wherever they are."""
        return [p for p in self.root.iter("plugin") if p.get("filename") == filename]

    def spring_reference(self, joint: str) -> float:
        """Returns the angle at which the torsional spring on a joint has no torque, rad."""
        springs = self.plugins("libTorsionalSpringPlugin.so")
        (spring,) = [s for s in springs if s.findtext("joint_handle") == joint]
        return float(spring.findtext("spring_reference"))

    def frame(self, link: str, positions: Optional[Dict[str, float]] = None) -> np.ndarray:
        """Returns the pose of a link in the root link, joints at `positions` (rad), 0 by default."""
        joint = self.joint_of.get(link)
        if joint is None:
            return np.eye(4)
        moved = np.eye(4)
        if joint.get("type") in ("revolute", "continuous"):
            angle = (positions or {}).get(joint.get("name"), 0.0)
            moved[:3, :3] = turn(numbers(joint.find("axis").get("xyz")), angle)
        return self.frame(joint.find("parent").get("link"), positions) @ pose(joint) @ moved

    def mass(self, link: str) -> float:
        """Returns the mass of a link, kg; 0 for a mere frame."""
        mass = self.links[link].find("inertial/mass")
        return 0.0 if mass is None else float(mass.get("value"))

    def inertia(self, link: str) -> np.ndarray:
        """Returns the inertia matrix of a link about its centre of mass, kg m^2."""
        values = self.links[link].find("inertial/inertia").attrib
        i = {key: float(value) for key, value in values.items()}
        return np.array(
            [
                [i["ixx"], i["ixy"], i["ixz"]],
                [i["ixy"], i["iyy"], i["iyz"]],
                [i["ixz"], i["iyz"], i["izz"]],
            ]
        )

    def center_of_mass(self, link: str, positions: Optional[Dict[str, float]] = None) -> np.ndarray:
        """Returns the centre of mass of a link in the root link, m."""
        return (self.frame(link, positions) @ pose(self.links[link].find("inertial")))[:3, 3]
