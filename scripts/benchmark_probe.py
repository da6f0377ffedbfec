# SPDX-License-Identifier: MIT
"""ROS node of scripts/benchmark: spawns the robot early, drives it up and down its lane, and counts messages.

Speaks JSON, an object a line: {"ready"}, {"first_scan_s"}, {"drive"}. Messages are counted as they come off the network
and decoded only if needed, so that the figures are the simulator's and not this node's.
"""
import json
import math
import pathlib
import threading
import time
from typing import Any, Dict, Optional, Sequence

import rospy
from geometry_msgs.msg import Pose, Twist
from nav_msgs.msg import Odometry

from ardee_common.cli import Parser
from gazebo_msgs.srv import SpawnModel

SPAWN = "/gazebo/spawn_urdf_model"
SCAN, ODOM, JOINTS, COMMAND = "/ardee/hokuyo", "/odom", "/joint_states", "/cmd_vel"
SETTLE_S = 2.0  # simulated: at rest on the springs, then on the way
LEAST_SIMULATED_S = 20.0
LONGEST_WALL_S = 120.0
HEADING_GAIN_PER_S, OFFSET_GAIN_RAD_PER_M_S, MAX_TURN_RAD_S = 1.0, 0.8, 0.5
COMMAND_EVERY = 5  # odometry messages


def say(**what: Any) -> None:
    """Prints one line of answer."""
    print(json.dumps(what), flush=True)


def yaw_of(q: Any) -> float:
    """Heading [rad] of a quaternion message."""
    return math.atan2(2 * (q.w * q.z + q.x * q.y), 1 - 2 * (q.y * q.y + q.z * q.z))


class Driver:
    """Counts messages, and keeps the robot on its lane: the straight line from its place of rest after the start."""

    def __init__(self, start: Sequence[float], lane_m: float, speed_m_s: float) -> None:
        self.start, self.lane_m, self.speed_m_s = start, lane_m, speed_m_s
        self.counts = {SCAN: 0, ODOM: 0, JOINTS: 0}
        self.bytes, self.distance_m, self.farthest_off_m = 0, 0.0, 0.0
        self.first_scan_s = None  # type: Optional[float]
        self.got_scan = threading.Event()
        self._last_m, self._direction = None, 1.0
        self._commands = rospy.Publisher(COMMAND, Twist, queue_size=1, tcp_nodelay=True)
        for topic, callback in (
            (SCAN, self._on_scan),
            (ODOM, self._on_odom),
            (JOINTS, self._on_joints),
        ):
            rospy.Subscriber(topic, rospy.AnyMsg, callback, tcp_nodelay=True, buff_size=2**20)

    def _count(self, topic: str, message: rospy.AnyMsg) -> None:
        self.counts[topic] += 1
        self.bytes += len(message._buff)

    def _on_scan(self, message: rospy.AnyMsg) -> None:
        if self.first_scan_s is None:
            self.first_scan_s = time.monotonic()
            self.got_scan.set()
        self._count(SCAN, message)

    def _on_joints(self, message: rospy.AnyMsg) -> None:
        self._count(JOINTS, message)

    def _on_odom(self, message: rospy.AnyMsg) -> None:
        self._count(ODOM, message)
        if self.counts[ODOM] % COMMAND_EVERY == 0:
            self._steer(Odometry().deserialize(message._buff).pose.pose)

    def _steer(self, here: Pose) -> None:
        """Steers along the lane at the wanted speed by odometry in the world's frame; reverses at its ends."""
        x0, y0, _, yaw0 = self.start
        dx, dy = here.position.x - x0, here.position.y - y0
        ahead = math.cos(yaw0) * dx + math.sin(yaw0) * dy
        aside = -math.sin(yaw0) * dx + math.cos(yaw0) * dy
        turned = math.remainder(yaw_of(here.orientation) - yaw0, math.tau)
        if self._last_m is not None:
            self.distance_m += abs(ahead - self._last_m)
        self._last_m = ahead
        self.farthest_off_m = max(self.farthest_off_m, abs(aside))
        if ahead > self.lane_m:
            self._direction = -1.0
        elif ahead < 0.0:
            self._direction = 1.0
        turn = -HEADING_GAIN_PER_S * turned - OFFSET_GAIN_RAD_PER_M_S * self._direction * aside
        command = Twist()
        command.linear.x = self._direction * self.speed_m_s
        command.angular.z = max(-MAX_TURN_RAD_S, min(MAX_TURN_RAD_S, turn))
        self._commands.publish(command)


def spawn(urdf: pathlib.Path, start: list) -> None:
    """Spawns the robot at x, y, z, yaw as soon as the simulator answers."""
    text = urdf.read_text()
    pose = Pose()
    pose.position.x, pose.position.y, pose.position.z = start[:3]
    pose.orientation.z, pose.orientation.w = math.sin(start[3] / 2), math.cos(start[3] / 2)
    rospy.wait_for_service(SPAWN)
    answer = rospy.ServiceProxy(SPAWN, SpawnModel)("robot", text, "/", pose, "world")
    if not answer.success:
        raise RuntimeError(f"{SPAWN}: {answer.status_message}")


def cpu_s(pid: int) -> float:
    """Processor time [s] that a process has used, of all its threads."""
    fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / 100.0  # utime, stime in ticks of 1/100 s


def measure(driver: Driver, pid: int, window_s: float) -> Dict[str, Any]:
    """Measures a window of wall time, and at least 20 s of simulated time."""
    settled = rospy.get_time() + SETTLE_S
    while rospy.get_time() < settled:
        time.sleep(0.01)
    counts, data, way = dict(driver.counts), driver.bytes, driver.distance_m
    wall, simulated, cpu = time.monotonic(), rospy.get_time(), cpu_s(pid)
    while True:
        time.sleep(0.05)
        wall_s, simulated_s = time.monotonic() - wall, rospy.get_time() - simulated
        if wall_s >= window_s and simulated_s >= LEAST_SIMULATED_S or wall_s > LONGEST_WALL_S:
            break
    return {
        "real_time_factor": simulated_s / wall_s,
        "simulated_s": simulated_s,
        "cpu_s_per_simulated_s": (cpu_s(pid) - cpu) / simulated_s,
        "scans_per_simulated_s": (driver.counts[SCAN] - counts[SCAN]) / simulated_s,
        "odom_per_simulated_s": (driver.counts[ODOM] - counts[ODOM]) / simulated_s,
        "megabytes_per_s": (driver.bytes - data) / wall_s / 1e6,
        "speed_m_s": (driver.distance_m - way) / simulated_s,
        "farthest_off_m": driver.farthest_off_m,
    }


def main() -> None:
    """Reports ready, spawns, awaits the first scan, and drives if --pid-file names the simulator's process."""
    parser = Parser()
    parser.add_argument("--urdf", type=pathlib.Path, required=True)
    parser.add_argument(
        "--start", type=float, nargs=4, required=True, help="start pose x y z yaw [m, rad]"
    )
    parser.add_argument("--lane-m", type=float, required=True)
    parser.add_argument("--speed-m-s", type=float, default=0.5)
    parser.add_argument(
        "--window-s",
        type=float,
        default=0.0,
        help="duration of the drive in wall time [s]; 0: no drive",
    )
    parser.add_argument("--pid-file", type=pathlib.Path, required=True)
    found = parser.parse_args()
    rospy.init_node("benchmark", anonymous=True)
    driver = Driver(found.start, found.lane_m, found.speed_m_s)
    say(ready=True)
    spawn(found.urdf, found.start)
    while not driver.got_scan.wait(0.1):
        if rospy.is_shutdown():
            return
    say(first_scan_s=driver.first_scan_s)
    if found.window_s > 0.0:
        say(drive=measure(driver, int(found.pid_file.read_text()), found.window_s))


if __name__ == "__main__":
    main()
