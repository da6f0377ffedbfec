# SPDX-License-Identifier: MIT
"""The node `simulator` on a world with one robot, driven step by step.

Nothing depends on the machine's speed: a command has reached the simulator before the next step is
asked for. It is written to its socket in the calling thread (no queue), and the pose is asked for between command
and step: when that answer is there, the simulator has read the command, for it reads everything that has arrived
before it serves a later request.
"""
import math
import os
import queue
import time
import warnings
from pathlib import Path
from typing import Any, Dict, List, Optional, Sequence, Tuple

import rospy
import rosservice
from geometry_msgs.msg import Pose as RosPose
from geometry_msgs.msg import Twist

from ardee_campaigns.robot import NAME
from ardee_common.process import start_child, stop_child
from ardee_common.ros_node import is_connected
from ardee_msgs.srv import Step
from ardee_world.row_truth import Pose
from controller_manager_msgs.srv import LoadController, SwitchController, SwitchControllerRequest
from gazebo_msgs.msg import ModelState
from gazebo_msgs.srv import GetModelState, SetModelState, SpawnModel

_PATIENCE_S = 60.0  # wall time; a scenery of 200,000 plants loads in less


class SimulationError(RuntimeError):
    """Error of a simulator that did not do what was asked."""


def to_ros(pose: Pose, z_m: float) -> RosPose:
    """A pose on the ground plan, level, at a height."""
    made = RosPose()
    made.position.x, made.position.y, made.position.z = pose.x_m, pose.y_m, z_m
    made.orientation.z, made.orientation.w = math.sin(pose.yaw_rad / 2), math.cos(pose.yaw_rad / 2)
    return made


def from_ros(pose: RosPose) -> Pose:
    """The pose on the ground plan."""
    q = pose.orientation
    yaw = math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))
    return Pose(pose.position.x, pose.position.y, yaw)


def _until(condition, what: str, patience_s: float = _PATIENCE_S) -> None:
    deadline = time.monotonic() + patience_s
    while not condition():
        if time.monotonic() > deadline:
            raise SimulationError(f"waited {patience_s:.0f} s in vain for {what}")
        time.sleep(0.005)


class RosSimulation:
    """The simulator on a world with one robot; a context manager, so that nothing outlives it."""

    def __init__(
        self,
        world: Path,
        seed: int,
        models: List[Path],
        log: Path,
        words: Sequence[str] = (),
    ) -> None:
        folders = [*map(str, models), os.environ.get("GAZEBO_MODEL_PATH", "")]
        environment = dict(os.environ, GAZEBO_MODEL_PATH=os.pathsep.join(folders))
        command = ["rosrun", "ardee_sim_cpp", "simulator", str(world), "--paused"]
        command += ["--seed", str(seed), "_real_time_factor:=0", *words]
        self._log, self._messages = log, queue.Queue()  # type: Path, queue.Queue
        self._services = {}  # type: Dict[str, rospy.ServiceProxy]
        self._commands = None  # type: Optional[rospy.Publisher]
        self._subscriber = None  # type: Optional[rospy.Subscriber]
        self._process = start_child(command, environment, log)

    def __enter__(self) -> "RosSimulation":
        try:
            self._wait_for_service("/ardee/step")
        except BaseException:
            self.close()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Ends the simulator and leaves its topics."""
        for service in self._services.values():
            service.close()
        for port in (self._commands, self._subscriber):
            if port is not None:
                port.unregister()
        stop_child(self._process)

    def _check_alive(self) -> None:
        if self._process.poll() is not None:
            last = self._log.read_text(errors="replace").strip().splitlines()[-3:]
            raise SimulationError("the simulator has ended: " + " | ".join(last))

    def _wait_for_service(self, name: str) -> None:
        def there() -> bool:
            self._check_alive()
            try:
                rospy.wait_for_service(name, timeout=0.2)
                return True
            except rospy.ROSException:
                return False

        _until(there, name)

    def call(self, name: str, kind: type, *arguments: object, **fields: object):
        """Calls a service; returns its answer, raises SimulationError unless it succeeds."""
        if name not in self._services:
            self._services[name] = rospy.ServiceProxy(name, kind, persistent=True)
        try:
            answer = self._services[name](*arguments, **fields)
        except rospy.ServiceException as error:
            self._check_alive()
            raise SimulationError(f"{name}: {error}") from error
        if not getattr(answer, "success", True):  # std_srvs/Empty has none
            raise SimulationError(f"{name}: {answer.status_message}")
        return answer

    def place(self, urdf: str, pose: Pose, z_m: float) -> None:
        """Spawns the robot."""
        fields = (NAME, urdf, "/", to_ros(pose, z_m), "world")
        self.call("/gazebo/spawn_urdf_model", SpawnModel, *fields)

    def start_controllers(self, names: Sequence[str]) -> None:
        """Loads and starts controllers of ros_control."""
        if not names:
            return
        ending = "/controller_manager/load_controller"
        (load,) = (name for name in rosservice.get_service_list() if name.endswith(ending))
        switch = load.replace("load_controller", "switch_controller")
        requests: List[Tuple[str, type, Any]] = [(load, LoadController, (name,)) for name in names]
        strict = SwitchControllerRequest.STRICT
        requests.append((switch, SwitchController, (names, [], strict, False, 0.0)))
        for service, kind, fields in requests:
            if not self.call(service, kind, *fields).ok:
                raise SimulationError(f"{service}: refused {fields[0]}")

    def connect(self, readings: Optional[Tuple[str, type]], commands: str) -> None:
        """Connects a sensor's topic of a type, and the topic of commands."""
        if readings:
            self._subscriber = rospy.Subscriber(
                *readings, self._messages.put, tcp_nodelay=True, buff_size=1 << 20
            )
        with warnings.catch_warnings():
            warnings.simplefilter(
                "ignore"
            )  # it recommends a queue, whose thread would race the step
            self._commands = rospy.Publisher(commands, Twist, queue_size=None)
        _until(self._commands.get_num_connections, "the robot's topic of commands")
        if self._subscriber:
            _until(lambda: is_connected(self._subscriber), "the robot's readings")

    def step(self, steps: int) -> float:
        """Takes this many physics steps; returns the simulated time [s] after them."""
        return self.call("/ardee/step", Step, steps).sim_time.to_sec()

    def message(self, patience_s: float = 20.0) -> Any:
        """Returns the next message of the connected sensor."""
        try:
            return self._messages.get(timeout=patience_s)
        except queue.Empty:
            self._check_alive()
            raise SimulationError(f"no reading in {patience_s:.0f} s") from None

    def command(self, speed_m_s: float, turn_rad_s: float) -> Pose:
        """Sends a command; when the pose is returned, the simulator has it."""
        twist = Twist()
        twist.linear.x, twist.angular.z = speed_m_s, turn_rad_s
        self._commands.publish(twist)
        return self.pose()

    def pose(self) -> Pose:
        """Returns the pose of the robot in the world frame."""
        answer = self.call("/gazebo/get_model_state", GetModelState, NAME, "world")
        return from_ros(answer.pose)

    def set_pose(self, pose: Pose, z_m: float) -> None:
        """Sets the robot down at a pose, at rest."""
        state = ModelState(model_name=NAME, pose=to_ros(pose, z_m), reference_frame="world")
        self.call("/gazebo/set_model_state", SetModelState, state)
