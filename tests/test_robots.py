# SPDX-License-Identifier: MIT
"""Tests the three TerraSentias side by side, each in a namespace: streams, frames, motion."""
import math
import time
import xml.etree.ElementTree as ElementTree
from typing import Any, Dict, List

import probes
import pytest

from ardee_common.ros_graph import Process, RosGraph, wait_until

# Half the wheelbase at rest and half the track (m), for the rate of turning in place by Coulomb's friction.
ROBOTS = {
    "tsv1": {"base": 0.170, "imu_hz": 50, "gps_hz": 10, "gimbals": 0, "cameras": ["front", "left"]},
    "tsv2": {
        "base": 0.170,
        "imu_hz": 50,
        "gps_hz": 10,
        "gimbals": 0,
        "cameras": ["front", "left", "right"],
    },
    "tsv3": {
        "base": 0.138,
        "imu_hz": 100,
        "gps_hz": 20,
        "gimbals": 3,
        "cameras": ["front", "left", "right"],
    },
}  # type: Dict[str, Dict[str, Any]]
TRACK_M = 0.2159
WHEELS = [f"{end}_{side}_wheel_link" for end in ("front", "rear") for side in ("left", "right")]
RATES_S = 1.0  # simulated time over which rates are counted
STEADY_S = 0.6  # simulated time until a motion is steady
SPEED_M_S, TURN_RAD_S = 0.5, 1.0
MIDDLE_M = 0.06  # greatest distance of a robot's turning point from its middle
START_S = 120.0  # wall time until three launch files have started everything on a busy machine


def streams(name: str) -> Dict[str, Any]:
    """Returns type and rate of every stream of a robot but its pictures."""
    robot = ROBOTS[name]
    found = {
        "odom": ("nav_msgs/Odometry", 50),
        "joint_states": ("sensor_msgs/JointState", 50 * (1 + robot["gimbals"])),
        "ardee/hokuyo": ("sensor_msgs/LaserScan", 40),
        "ardee/imu/custom": ("sensor_msgs/Imu", robot["imu_hz"]),
        "ardee/gps": ("sensor_msgs/NavSatFix", robot["gps_hz"]),
        "ardee/gps/fix_velocity": ("geometry_msgs/Vector3Stamped", robot["gps_hz"]),
        "ardee/battery": ("ardee_msgs/Battery", 100),
        "ardee/battery_state": ("sensor_msgs/BatteryState", 100),
    }  # type: Dict[str, Any]
    found.update(
        {f"ardee/encoder/{w}": ("ardee_msgs/Encoder", 50) for w in ("fr", "fl", "rr", "rl")}
    )
    if robot["gimbals"]:
        found["ardee/imu/mag"] = ("sensor_msgs/MagneticField", 100)
        imus = [f"ardee/camera/{camera}/imu" for camera in robot["cameras"]]
        found.update({imu: ("sensor_msgs/Imu", 100) for imu in imus})
    return found


class Survey:
    """Messages of all robots, received at once in a probe's process."""

    def __init__(self) -> None:
        import rospy
        import tf2_ros
        from geometry_msgs.msg import Twist

        probes._start()
        self.heard = {name: {} for name in ROBOTS}  # type: Dict[str, Dict[str, List[Any]]]
        for name in ROBOTS:
            for topic, (kind, _) in streams(name).items():
                self._listen(name, topic, kind)
        self._buffer = tf2_ros.Buffer()
        self._tf = tf2_ros.TransformListener(self._buffer)
        self._command = Twist()
        self._commands = [rospy.Publisher(f"/{n}/cmd_vel", Twist, queue_size=1) for n in ROBOTS]
        try:
            wait_until(self._complete, "every stream of every robot", START_S)
        except TimeoutError as error:
            raise TimeoutError(f"{error}; missing {self._silent()}") from None

    def _silent(self) -> List[str]:
        """Returns streams without messages, and topics of commands without subscribers."""
        silent = [f"{n}/{t}" for n, robot in self.heard.items() for t, m in robot.items() if not m]
        return silent + [c.name for c in self._commands if not c.get_num_connections()]

    def _listen(self, name: str, topic: str, kind: str) -> None:
        import rospy

        messages = self.heard[name].setdefault(topic, [])
        kind_class = probes._type(kind)
        rospy.Subscriber(f"/{name}/{topic}", kind_class, messages.append, queue_size=1000)

    def _complete(self) -> bool:
        return not self._silent()

    def now_s(self) -> float:
        """Returns the simulated time of the last odometry of all robots."""
        return min(robot["odom"][-1].header.stamp.to_sec() for robot in self.heard.values())

    def wait(self, seconds: float) -> None:
        """Lets simulated time pass."""
        end_s = self.now_s() + seconds

        def has_passed() -> bool:
            for publisher in self._commands:  # again and again: the robots stop soon after the last
                publisher.publish(self._command)
            return self.now_s() >= end_s

        wait_until(has_passed, f"{seconds} s of simulated time")

    def command(self, forward_m_s: float, turn_rad_s: float) -> None:
        """Sets what all robots are told from now on."""
        self._command.linear.x, self._command.angular.z = forward_m_s, turn_rad_s

    def rates(self) -> Dict[str, Dict[str, float]]:
        """Returns messages a simulated second of each stream, by their stamps."""
        begin_s = self.now_s()
        end_s = begin_s + RATES_S
        wait_until(lambda: self.heard_until(end_s), f"every stream's messages until {end_s} s")
        return {
            name: {
                topic: sum(begin_s <= m.header.stamp.to_sec() < end_s for m in messages) / RATES_S
                for topic, messages in robot.items()
            }
            for name, robot in self.heard.items()
        }

    def heard_until(self, end_s: float) -> bool:
        """Tells whether every stream has come as far as this simulated time: each has a thread of its own."""
        streams_heard = [messages for robot in self.heard.values() for messages in robot.values()]
        return all(messages[-1].header.stamp.to_sec() >= end_s for messages in streams_heard)

    def frames(self) -> Dict[str, Dict[str, str]]:
        """Returns the frames by stream; none for streams without one."""
        return {
            name: {topic: messages[-1].header.frame_id for topic, messages in robot.items()}
            for name, robot in self.heard.items()
        }

    def missing_links(self, name: str) -> List[str]:
        """Returns links of a robot that tf does not lead to."""
        import rospy

        root = ElementTree.fromstring(rospy.get_param(f"/{name}/robot_description"))
        links = [link.get("name") for link in root.findall("link")]
        zero = rospy.Time(0)
        return [
            link
            for link in links
            if not self._buffer.can_transform(f"{name}/odom", f"{name}/{link}", zero)
        ]

    def missing_once_known(self) -> Dict[str, List[str]]:
        """Returns missing links by robot, once there are none or the wait is over: the nodes of tf start last."""
        deadline = time.monotonic() + START_S
        while True:
            missing = {name: self.missing_links(name) for name in ROBOTS}
            if not any(missing.values()) or time.monotonic() > deadline:
                return missing
            time.sleep(0.1)

    def height_m(self, name: str) -> float:
        """Returns the height of base_footprint above the wheels' lowest points, by tf."""
        import rospy

        base, zero = f"{name}/base_footprint", rospy.Time(0)
        wheels = [self._buffer.lookup_transform(base, f"{name}/{w}", zero) for w in WHEELS]
        return 0.097 - sum(w.transform.translation.z for w in wheels) / len(wheels)

    def motion(self, forward_m_s: float, turn_rad_s: float) -> Dict[str, List[List[float]]]:
        """Returns x, y, yaw, stamp of each robot at the begin and the end of a steady motion."""
        self.command(forward_m_s, turn_rad_s)
        self.wait(STEADY_S)
        begin = {name: planar(robot["odom"][-1]) for name, robot in self.heard.items()}
        self.wait(1.0)
        end = {name: planar(robot["odom"][-1]) for name, robot in self.heard.items()}
        self.command(0.0, 0.0)
        self.wait(STEADY_S)
        return {name: [begin[name], end[name]] for name in ROBOTS}


def planar(odometry: Any) -> List[float]:
    """Returns x, y (m), yaw (rad), time (s)."""
    pose = odometry.pose.pose
    yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
    return [pose.position.x, pose.position.y, yaw, odometry.header.stamp.to_sec()]


def survey() -> Dict[str, Any]:
    """Surveys all robots at once: at rest, straight on, turning."""
    found = Survey()
    missing = found.missing_once_known()
    found.wait(max(0.0, 1.0 - found.now_s()))
    return {
        "missing": missing,
        "height": {name: found.height_m(name) for name in ROBOTS},
        "rates": found.rates(),
        "frames": found.frames(),
        "straight": found.motion(SPEED_M_S, 0.0),
        "turn": found.motion(0.0, TURN_RAD_S),
    }


def pictures(topics: List[str]) -> Dict[str, Any]:
    """Returns width, height, frame and camera_info of one picture of each camera."""
    import rospy
    from sensor_msgs.msg import CameraInfo, Image

    probes._start()
    images, infos = {}, {}  # type: Dict[str, Any], Dict[str, Any]
    for topic in topics:
        rospy.Subscriber(f"{topic}/image_raw", Image, lambda m, t=topic: images.update({t: m}))
        rospy.Subscriber(
            f"{topic}/camera_info", CameraInfo, lambda m, t=topic: infos.update({t: m})
        )
    wait_until(lambda: len(images) == len(infos) == len(topics), f"a picture of each of {topics}")
    return {
        t: (
            images[t].width,
            images[t].height,
            images[t].header.frame_id,
            infos[t].width,
            infos[t].height,
            infos[t].header.frame_id,
            len(set(images[t].data)),
        )
        for t in topics
    }


@pytest.fixture(scope="module")
def world(shared_graph: RosGraph) -> Process:
    """Yields an empty world with all robots in it."""
    process = shared_graph.launch(
        "ardee_world", "custom_world.launch", "world:=empty.world", "rtf:=2"
    )
    shared_graph.call(probes.clock_at_least, 0.1)
    for index, name in enumerate(ROBOTS):
        shared_graph.launch(
            "terrasentia_description",
            "launch_default_tsv1.launch",
            f"bot_model:={name}_default.urdf.xacro",
            f"ns:={name}",
            f"y:={3 * index}",
            "yaw:=0",
            "command_timeout:=0",  # a busy machine may hold a command up for longer
        )
    return process


@pytest.fixture(scope="module")
def surveyed(shared_graph: RosGraph, world: Process) -> Dict[str, Any]:
    """Returns the survey's results."""
    return shared_graph.call(survey, timeout_s=3 * START_S)


@pytest.fixture(scope="module")
def seen(shared_graph: RosGraph, surveyed: Dict[str, Any]) -> Dict[str, Any]:
    """Returns a picture of each camera."""
    topics = [f"/{n}/ardee/camera/{c}" for n, robot in ROBOTS.items() for c in robot["cameras"]]
    return shared_graph.call(pictures, topics)


@pytest.mark.parametrize("name", ROBOTS)
def test_every_stream_comes_at_its_rate_from_its_own_frame(
    surveyed: Dict[str, Any], name: str
) -> None:
    expected = {topic: rate for topic, (_, rate) in streams(name).items()}
    # A stream of n publishers may have n stamps more, because both ends of the second count.
    assert surveyed["rates"][name] == pytest.approx(expected, rel=0.025, abs=1)
    frames = surveyed["frames"][name]
    frames.pop("joint_states")  # has none
    assert [t for t, frame in frames.items() if not frame.startswith(f"{name}/")] == []


@pytest.mark.parametrize("name", ROBOTS)
def test_tf_leads_to_every_link_and_it_stands(surveyed: Dict[str, Any], name: str) -> None:
    assert surveyed["missing"][name] == []
    assert surveyed["height"][name] == pytest.approx(0.175, abs=0.005)


@pytest.mark.parametrize("name", ROBOTS)
def test_it_drives_straight(surveyed: Dict[str, Any], name: str) -> None:
    (x0, y0, yaw0, t0), (x1, y1, yaw1, t1) = surveyed["straight"][name]
    assert x1 - x0 == pytest.approx(SPEED_M_S * (t1 - t0), rel=0.02)
    assert (y1 - y0, yaw1 - yaw0) == pytest.approx((0, 0), abs=5e-3)


@pytest.mark.parametrize("name", ROBOTS)
def test_it_turns_about_its_middle_as_coulombs_friction_lets_it(
    surveyed: Dict[str, Any], name: str
) -> None:
    (x0, y0, yaw0, t0), (x1, y1, yaw1, t1) = surveyed["turn"][name]
    share = TRACK_M**2 / (TRACK_M**2 + ROBOTS[name]["base"] ** 2)
    assert (yaw1 - yaw0) / (t1 - t0) == pytest.approx(TURN_RAD_S * share, abs=0.05)
    # The centre of mass lies up to 11 mm behind the wheels' middle, and the legs yield.
    assert math.hypot(x1 - x0, y1 - y0) < MIDDLE_M * (yaw1 - yaw0)


@pytest.mark.parametrize("name", ROBOTS)
def test_every_camera_sees_something(seen: Dict[str, Any], name: str) -> None:
    for camera in ROBOTS[name]["cameras"]:
        *sizes, shades = seen[f"/{name}/ardee/camera/{camera}"]
        width, height, frame, *info = sizes
        assert (width, height) == (640, 480) and info == [width, height, frame]
        assert frame.startswith(f"{name}/camera")
        assert shades > 20


def test_the_simulator_has_nothing_to_complain_of(world: Process, seen: Dict[str, Any]) -> None:
    complaints = [line for line in world.output().splitlines() if "WARN" in line or "ERROR" in line]
    assert complaints == []
