# SPDX-License-Identifier: MIT
"""A robot of a campaign in a simulation: spawned, read and commanded by the uses of its topics."""
import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Mapping, Optional, Tuple

import ardee_sim
import numpy as np

from ardee_campaigns.campaign_file import RobotKeys
from ardee_campaigns.outline import outline_of, rectangle
from ardee_common.errors import GeneratorError, known_names
from ardee_world.row_truth import Pose
from ardee_world.trial import Trial

NAME = "robot"
TOPICS = {"command": "cmd_vel", "scan": "ardee/hokuyo", "battery": "ardee/battery_state"}
SETTLE_S = 1.0  # in which a robot comes to rest on its springs
_KEPT = 1000  # readings that may wait
Observation = Dict[str, Optional[ardee_sim.Reading]]


@dataclass(frozen=True)
class Robot:
    """A robot as a controller is told of it.

    topics : use to topic
    pace : use whose readings the controller answers
    period_s : between two of them
    outline_m : convex, (n, 2), in the robot's frame, counter-clockwise
    sensor_xyz_m : place [3] of the pace's sensor in the robot's frame
    """

    name: str
    topics: Mapping[str, str]
    pace: str
    period_s: float
    outline_m: np.ndarray
    sensor_xyz_m: np.ndarray


def topics_of(keys: RobotKeys) -> Dict[str, str]:
    """Returns the topics of a robot by use."""
    return dict(keys.topics if keys.topics is not None else TOPICS)


def model_path(keys: RobotKeys, folder: Path) -> Any:
    """Returns the robot's file, if it is one beside the campaign's file, or its name."""
    file = folder / Path(keys.model).expanduser()
    return file if file.is_file() else keys.model


def expand(keys: RobotKeys, factors: Mapping[str, Any], folder: Path) -> str:
    """Returns the URDF of a robot; `factors` are arguments of its xacro file."""
    arguments = {**(keys.xacro or {}), **factors}
    try:
        return ardee_sim.robot(model_path(keys, folder), **arguments)
    except ardee_sim.ArdeeError as error:
        raise GeneratorError(" ".join(str(error).split())) from None


def outline_m(keys: RobotKeys, urdf: str) -> np.ndarray:
    """Returns the robot's outline, as its keys say or of its collision bodies."""
    if keys.length_m is not None and keys.width_m is not None:
        return rectangle(keys.length_m, keys.width_m)
    return outline_of(urdf)


def height_m(keys: RobotKeys, pose: Pose, trial: Optional[Trial]) -> float:
    """Returns the height of the robot's origin where it is set down; without a trial the ground is at 0."""
    if trial is None:
        return keys.stand_m
    return trial.height_m(pose) + (keys.stand_m - RobotKeys().stand_m)


class Driven:
    """A robot in a simulation."""

    def __init__(self, sim: ardee_sim.Simulation, name: str, keys: RobotKeys, urdf: str) -> None:
        self.sim, self._keys = sim, keys
        self._topics = topics_of(keys)
        self._name, self._urdf = name, urdf
        self._has_pace_sensor = keys.period_s is None

    def spawn(self, pose: Pose, trial: Optional[Trial]) -> Robot:
        """Puts the robot down at a pose, lets it come to rest; returns what a controller is told."""
        place = (pose.x_m, pose.y_m, height_m(self._keys, pose, trial))
        self.sim.set_parameters(self._keys.parameters or {})
        self.sim.spawn(NAME, self._urdf, xyz_m=place, rpy_rad=(0.0, 0.0, pose.yaw_rad))
        self._start_controllers()
        self._check_topics()
        for use, topic in self._topics.items():
            if use != "command":
                self.sim.demand(topic, keep=_KEPT if use == self._keys.pace else 1)
        readings = self.settle()
        period_s = self._period_s(readings)
        sensor = self._sensor_xyz_m(readings[-1].frame_id) if readings else np.zeros(3)
        outline = outline_m(self._keys, self._urdf)
        self.robot = Robot(
            self._name, dict(self._topics), self._keys.pace, period_s, outline, sensor
        )
        return self.robot

    def _start_controllers(self) -> None:
        if not self._keys.controllers:
            return
        try:
            self.sim.start_controllers(NAME, *self._keys.controllers)
        except ardee_sim.ArdeeError as error:
            raise GeneratorError(f"robot {self._name}: controllers: {error}") from None

    def _check_topics(self) -> None:
        known = {name.lstrip("/"): info for name, info in self.sim.topics().items()}
        for use, topic in self._topics.items():
            role = "command" if use == "command" else "reading"
            info = known.get(topic.lstrip("/"))
            if info is None or info.role != role:
                names = [name for name, info in known.items() if info.role == role]
                place = f"robot {self._name}: topics: {use}"
                raise GeneratorError(f"{place}: found {topic!r}, {known_names(topic, names)}")
        uses = [use for use in self._topics if use != "command"]
        if "command" not in self._topics:
            raise GeneratorError(f"robot {self._name}: topics: found no use 'command'")
        is_needed = self._has_pace_sensor or self._keys.pace != RobotKeys().pace
        if is_needed and self._keys.pace not in uses:
            found = f"pace: found {self._keys.pace!r}"
            raise GeneratorError(
                f"robot {self._name}: {found}, {known_names(self._keys.pace, uses)}"
            )

    def settle(self) -> List[ardee_sim.Reading]:
        """Lets the robot come to rest; returns the readings of the pace's sensor in that time."""
        self.command(0.0, 0.0)
        self.sim.step(math.ceil(SETTLE_S * 1e9 / self.sim.step_ns))
        return self.sim.drain(self._topics[self._keys.pace]) if self._has_pace_sensor else []

    def _period_s(self, readings: List[ardee_sim.Reading]) -> float:
        """Returns the control period; sets its physics steps."""
        if self._has_pace_sensor:
            if len(readings) < 2:
                found = (
                    f"{len(readings)} readings of {self._topics[self._keys.pace]} in {SETTLE_S} s"
                )
                raise GeneratorError(f"robot {self._name}: found {found}, expected 2 or more")
            period_ns = readings[-1].stamp_ns - readings[-2].stamp_ns
        else:
            period_ns = round(self._keys.period_s * 1e9)
        self._steps, rest = divmod(period_ns, self.sim.step_ns)
        if rest or not self._steps:
            found = f"a period of {period_ns * 1e-9:g} s"
            step = f"{self.sim.step_ns * 1e-9:g} s"
            raise GeneratorError(
                f"robot {self._name}: found {found}, expected a whole number of steps of {step}"
            )
        return period_ns * 1e-9

    def _sensor_xyz_m(self, frame: str) -> np.ndarray:
        entity = next(e for e in self.sim.entities() if e.name == NAME)
        link = frame.rpartition("/")[2]
        if link not in entity.links:
            return np.zeros(3)
        return self.sim.state(f"{NAME}::{link}", relative_to=NAME).xyz_m

    def advance(self) -> int:
        """Steps to the next reading of the pace's sensor; returns its time [ns]."""
        self.sim.step(self._steps)
        if not self._has_pace_sensor:
            return self.sim.time_ns
        self._paced = self.sim.drain(self._topics[self._keys.pace])
        if not self._paced:
            topic = self._topics[self._keys.pace]
            raise GeneratorError(f"found no reading of {topic}, expected one of every period")
        return self._paced[-1].stamp_ns

    def observation(self) -> Observation:
        """Returns the last reading of each use; None before its first."""
        seen: Observation = {}
        for use, topic in self._topics.items():
            if use == self._keys.pace and self._has_pace_sensor:
                seen[use] = self._paced[-1]
            elif use != "command":
                seen[use] = self.sim.latest(topic)
        return seen

    def command(self, speed_m_s: float, turn_rad_s: float) -> None:
        """Commands the robot from the next step on."""
        twist = ardee_sim.Twist(linear_x_m_s=speed_m_s, angular_z_rad_s=turn_rad_s)
        self.sim.command(self._topics["command"], twist)

    def pose(self) -> Pose:
        """Returns the robot's true pose on the ground plan."""
        state = self.sim.state(NAME)
        return Pose(float(state.xyz_m[0]), float(state.xyz_m[1]), state.yaw_rad)

    def tilt(self) -> Tuple[float, float]:
        """Returns the robot's roll and pitch [rad], about the fixed axes turned by its yaw."""
        x, y, z, w = (float(value) for value in self.sim.state(NAME).quat_xyzw)
        roll = math.atan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y))
        return roll, math.asin(max(-1.0, min(1.0, 2 * (w * y - z * x))))

    def set_pose(self, pose: Pose, trial: Trial) -> None:
        """Sets the robot down at a pose, at rest."""
        place = (pose.x_m, pose.y_m, height_m(self._keys, pose, trial))
        turn = (0.0, 0.0, math.sin(pose.yaw_rad / 2), math.cos(pose.yaw_rad / 2))
        self.sim.set_state(NAME, xyz_m=place, quat_xyzw=turn)


def describe(name: str, keys: RobotKeys, urdf: str) -> Robot:
    """Returns what a controller is told of a robot, found out in an empty world."""
    with ardee_sim.Simulation(ardee_sim.World.from_file("empty.world")) as sim:
        return Driven(sim, name, keys, urdf).spawn(Pose(0.0, 0.0, 0.0), None)
