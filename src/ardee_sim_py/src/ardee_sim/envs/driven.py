# SPDX-License-Identifier: MIT
"""The robot of an environment: expanded, spawned with its controllers, commanded."""

from pathlib import Path
from typing import Any, Mapping, Optional, Sequence

from ardee_sim import checks
from ardee_sim.envs.arguments import mapping, names, refusals
from ardee_sim.envs.randomise import with_noise
from ardee_sim.errors import ArdeeError
from ardee_sim.parameters import Parameters
from ardee_sim.robots import robot as robot_text
from ardee_sim.simulation import Simulation
from ardee_sim.state import Twist
from ardee_sim.world import PathLike

from ardee_common.errors import known_names
from ardee_world.start import STAND_M

ROBOT = "robot"  # its name in the simulation


class DrivenRobot:
    """A robot that obeys speed and turn rate. Its arguments are FieldEnv's of the same names."""

    def __init__(
        self,
        robot: PathLike,
        *,
        xacro: Optional[Mapping[str, Any]],
        parameters: Optional[Parameters],
        controllers: Sequence[str],
        command_topic: str,
        stand_m: float,
    ) -> None:
        self._text = robot_text(robot, **mapping({} if xacro is None else xacro, "xacro"))
        self._parameters = parameters or {}
        self._controllers = names(controllers, "controllers")
        with refusals():
            self._topic = checks.text(command_topic, "command_topic")
            self.rise_m = checks.number(stand_m, "stand_m") - STAND_M  # above a TerraSentia's

    def spawn(self, sim: Simulation, file: Path, noise_scale: float) -> None:
        """Spawns the robot in the origin, by way of a file, and starts its controllers."""
        file.write_text(with_noise(self._text, noise_scale))
        sim.set_parameters(self._parameters)
        sim.spawn(ROBOT, file)
        if self._controllers:
            sim.start_controllers(ROBOT, *self._controllers)
        obeyed = [name.lstrip("/") for name, info in sim.topics().items() if info.kind == "Twist"]
        if self._topic.lstrip("/") not in obeyed:
            found = f"command_topic: found '{self._topic}'"
            raise ArdeeError(f"{found}, {known_names(self._topic, obeyed)}")

    def command(self, sim: Simulation, v_m_s: float = 0.0, w_rad_s: float = 0.0) -> None:
        """Commands speed and turn rate from the next step on."""
        sim.command(self._topic, Twist(linear_x_m_s=v_m_s, angular_z_rad_s=w_rad_s))
