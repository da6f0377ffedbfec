# SPDX-License-Identifier: MIT
"""A robot of a campaign in the node `simulator`, as robot.Driven is one in this process.

The evaluated node's commands reach the campaign, which passes them on between the steps, so that a command counts from
the same step on, however fast the machine is.
"""
import math
import queue
from pathlib import Path
from typing import Any, Optional

import numpy as np
import roslib.message
import rosparam
import rospy
import rostopic
from ardee_sim import BatteryStateReading, LidarReading
from sensor_msgs.msg import BatteryState, LaserScan

from ardee_campaigns.plan import Job
from ardee_campaigns.robot import SETTLE_S, Observation, Robot, describe, height_m
from ardee_campaigns.ros.simulator import RosSimulation
from ardee_common.ros_graph import wait_until
from ardee_world.row_truth import Pose
from ardee_world.trial import Trial

_UNKNOWN_S = SETTLE_S / 2  # period of a battery until two of its messages tell it
_LATE_S = 1.0  # wall time after which a message that seemed due is not waited for


def _lidar(scan: LaserScan) -> LidarReading:
    return LidarReading(
        scan.header.stamp.to_nsec(),
        scan.header.frame_id,
        scan.angle_min,
        scan.angle_max,
        scan.angle_increment,
        scan.time_increment,
        scan.scan_time,
        scan.range_min,
        scan.range_max,
        np.array(scan.ranges, np.float32),
        np.array(scan.intensities, np.float32),
    )


def _battery(state: BatteryState) -> BatteryStateReading:
    return BatteryStateReading(
        state.header.stamp.to_nsec(),
        state.header.frame_id,
        state.voltage,
        state.current,
        state.charge,
        state.capacity,
        state.design_capacity,
        state.percentage,
        state.location,
    )


class RosDriven:
    """A robot in a simulator node of its own, which starts and ends with this context manager.

    topics : use to topic, with a leading slash
    pace : topic of the pace's sensor, empty without one
    """

    def __init__(self, job: Job, trial: Trial, work: Path, *, is_relay: bool) -> None:
        name = job.cell.robot
        self._keys, self._urdf = job.campaign.robots[name], job.urdf.read_text()
        self._robot = describe(name, self._keys, self._urdf)
        step_s = job.files.step_s()
        self._steps = round(self._robot.period_s / step_s)
        self._settle_steps = math.ceil(SETTLE_S / step_s - 1e-6)
        self.topics = {use: f"/{topic.lstrip('/')}" for use, topic in self._robot.topics.items()}
        self.pace = self.topics[self._keys.pace] if self._keys.period_s is None else ""
        usual = self._commands = self.topics["command"]
        remap = []
        if is_relay:  # of the commands of an evaluated node
            self._commands = f"/campaign{usual}"
            remap = [f"{usual}:={self._commands}"]
        log = work / "simulator.log"
        self._simulator = RosSimulation(trial.world, job.seed, trial.models, log, words=remap)
        self._reading: Any = None
        self._charges: "queue.Queue[BatteryState]" = queue.Queue()
        self._charge: Optional[BatteryState] = None
        self._charge_period_s, self._charge_due_s = _UNKNOWN_S, math.inf

    def __enter__(self) -> "RosDriven":
        self._simulator.__enter__()
        return self

    def __exit__(self, *_: object) -> None:
        self._simulator.close()

    def spawn(self, pose: Pose, trial: Trial) -> Robot:
        """Puts the robot down at a pose, lets it come to rest; returns what a controller is told."""
        rosparam.upload_params("/", self._keys.parameters or {})
        self._simulator.place(self._urdf, pose, height_m(self._keys, pose, trial))
        self._simulator.start_controllers(self._keys.controllers)
        pace = None
        if self.pace:
            kind = rostopic.get_topic_type(self.pace)[0]
            pace = self.pace, roslib.message.get_message_class(kind)
        self._simulator.connect(pace, self._commands)
        if "battery" in self.topics:
            topic, self._charge_due_s = self.topics["battery"], 0.0
            told = rospy.Subscriber(topic, BatteryState, self._charges.put, tcp_nodelay=True)
            wait_until(told.get_num_connections, topic)
        self.settle()
        if self._charge_period_s == _UNKNOWN_S:  # a slow one: its messages count when they come
            self._charge_period_s = self._charge_due_s = math.inf
        return self._robot

    def settle(self) -> None:
        """Lets the robot come to rest."""
        self._simulator.command(0.0, 0.0)
        self._step(self._settle_steps)

    def _step(self, steps: int) -> float:
        """Takes physics steps, and the last reading of the pace's sensor in them; returns the time [s]."""
        end_s = self._simulator.step(steps)
        self._take_charge(end_s)
        while self.pace:
            self._reading = self._simulator.message()
            if self._reading.header.stamp.to_sec() > end_s - self._robot.period_s + 1e-6:
                break
        return end_s

    def _take_charge(self, end_s: float) -> None:
        """Takes the battery's messages up to a time, and waits for them: which have come already is chance."""
        while True:
            is_due = self._charge_due_s <= end_s + 1e-6
            try:
                state = self._charges.get(is_due, _LATE_S)
            except queue.Empty:
                return
            stamp_s = state.header.stamp.to_sec()
            if self._charge:
                apart_s = stamp_s - self._charge.header.stamp.to_sec()
                self._charge_period_s = min(self._charge_period_s, apart_s)
            self._charge, self._charge_due_s = state, stamp_s + self._charge_period_s

    def advance(self) -> int:
        """Steps to the next reading of the pace's sensor; returns its time [ns]."""
        end_s = self._step(self._steps)
        return self._reading.header.stamp.to_nsec() if self._reading else round(end_s * 1e9)

    def observation(self) -> Observation:
        """Returns the last readings that are recorded: of a lidar that is the pace's sensor, and of the battery."""
        seen: Observation = {}
        if isinstance(self._reading, LaserScan):
            seen[self._keys.pace] = _lidar(self._reading)
        if self._charge:
            seen["battery"] = _battery(self._charge)
        return seen

    def command(self, speed_m_s: float, turn_rad_s: float) -> None:
        """Commands the robot from the next step on."""
        self._pose = self._simulator.command(speed_m_s, turn_rad_s)

    def pose(self) -> Pose:
        """Returns the robot's true pose on the ground plan."""
        return self._pose

    def set_pose(self, pose: Pose, trial: Trial) -> None:
        """Sets the robot down at a pose, at rest."""
        self._simulator.set_pose(pose, height_m(self._keys, pose, trial))
