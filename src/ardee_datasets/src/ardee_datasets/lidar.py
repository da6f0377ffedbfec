# SPDX-License-Identifier: MIT
"""A 3D lidar above the camera: labelled clouds in the form of SemanticKITTI."""

import functools
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Dict, List
from xml.etree import ElementTree

import numpy as np
from ardee_sim import Simulation
from ardee_sim.robots import robot
from scipy.spatial.transform import Rotation

from ardee_datasets.recipe import LidarKeys
from ardee_datasets.scenery import CameraPose, Item

# Measures at each step of 1 ms, so that a pose has its cloud at once
_RIG = """<robot name="rig" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find ardee_sensors)/urdf/all_sensors.urdf.xacro" />
  <link name="rig" />
  <xacro:sensor_{sensor} name="{name}" parent="rig" rate_hz="1000" topic="{name}/points">
    <origin xyz="0 0 0" rpy="0 0 0" />
  </xacro:sensor_{sensor}>
  <gazebo reference="rig"><turnGravityOff>true</turnGravityOff></gazebo>
</robot>
"""


_STEEP = 1e-3  # horizontal part of a direction that has no heading


@functools.lru_cache
def _rig(name: str, sensor: str) -> str:
    """Returns the URDF of a lidar without a body."""
    with tempfile.NamedTemporaryFile("w", suffix=".xacro") as file:
        file.write(_RIG.format(name=name, sensor=sensor))
        file.flush()
        rig = ElementTree.fromstring(robot(Path(file.name)))
    for link in rig.iter("link"):
        for tag in ("visual", "collision"):
            for element in link.findall(tag):
                link.remove(element)
    return ElementTree.tostring(rig, encoding="unicode")


@dataclass(frozen=True)
class Cloud:
    """A cloud with its labels, and the truth_id of each of its instances, which are numbered from 1."""

    points: np.ndarray  # float32 [n, 4]: x, y, z [m], x ahead, y left, z up; intensity
    labels: np.ndarray  # uint32 [n]: category id, instance << 16
    instances: List[str]


class Lidar:
    """A lidar in a simulation; it has no body, so that no picture shows it."""

    def __init__(self, simulation: Simulation, name: str, keys: LidarKeys) -> None:
        self._simulation, self._name, self._topic = simulation, name, f"{name}/points"
        self._above_m = keys.above_m
        simulation.spawn(name, _rig(name, keys.sensor))
        simulation.demand(self._topic)

    def pose_above(self, camera: CameraPose) -> CameraPose:
        """Returns its pose, upright, above a camera, whose left tells the heading where it looks straight down."""
        ahead, left = camera.rotation.apply(((1, 0, 0), (0, 1, 0)))
        if np.hypot(*ahead[:2]) < _STEEP:
            ahead = np.array((left[1], -left[0]))
        upright = Rotation.from_euler("z", np.arctan2(ahead[1], ahead[0]))
        return CameraPose(camera.xyz_m + (0, 0, self._above_m), upright)

    def measure(self, pose: CameraPose, items: Dict[int, Item]) -> Cloud:
        """Returns the cloud at a pose; `items` are those of the simulation, by their instance."""
        self._simulation.set_state(self._name, xyz_m=pose.xyz_m, quat_xyzw=pose.rotation.as_quat())
        self._simulation.step()
        found = self._simulation.latest(self._topic).points
        seen = [int(number) for number in np.unique(found["instance"]) if int(number) in items]
        place = np.searchsorted(seen, found["instance"])
        is_item = np.isin(found["instance"], seen)
        number = np.where(is_item, place + 1, 0).astype(np.uint32)
        return Cloud(
            np.stack([found[key] for key in ("x", "y", "z", "intensity")], axis=1),
            np.where(is_item, found["label"], 0).astype(np.uint32) | number << 16,
            [items[instance].truth_id for instance in seen],
        )
