# SPDX-License-Identifier: MIT
"""A PTZ camera through the interface of the driver axis_camera: degrees to the right and up, zoom 1 to 9999."""
import math
import time
from typing import Any, Dict, List

import probes
import pytest

from ardee_common.ros_graph import RosGraph, wait_until

BASE = "/ardee/sensor"
WIDTH_PX, WIDE_DEG, TELE_DEG = 704, 52, 4.7
CLOSE_DEG = 0.06
PAN, TILT = "sensor_pan_joint", "sensor_tilt_joint"


class Camera:
    """Messages of the camera that a probe's process receives."""

    def __init__(self) -> None:
        import rospy

        probes._start()
        self.axis_type = probes._type("axis_camera/Axis")
        self.joints_deg: Dict[str, float] = {}
        self.states: List[Any] = []
        self.infos: List[Any] = []
        self.cmd = rospy.Publisher(f"{BASE}/cmd", self.axis_type, queue_size=10)
        rospy.Subscriber("/joint_states", probes._type("sensor_msgs/JointState"), self._on_joints)
        rospy.Subscriber(f"{BASE}/state", self.axis_type, self.states.append)
        rospy.Subscriber(
            f"{BASE}/camera_info", probes._type("sensor_msgs/CameraInfo"), self.infos.append
        )
        wait_until(lambda: self.states and self.infos and self.joints_deg, "the camera", 60.0)
        wait_until(self.cmd.get_num_connections, "the driver's subscriber")

    def _on_joints(self, message: Any) -> None:
        self.joints_deg.update(zip(message.name, map(math.degrees, message.position)))

    def send(self, **fields: Any) -> None:
        """Sends one command."""
        self.cmd.publish(self.axis_type(**fields))

    def is_at(self, pan_deg: float, tilt_deg: float) -> bool:
        """Returns whether the state has this position."""
        state = self.states[-1]
        return abs(state.pan - pan_deg) < CLOSE_DEG and abs(state.tilt - tilt_deg) < CLOSE_DEG

    def joints_are_at(self, pan_deg: float, tilt_deg: float) -> bool:
        """Returns whether the joints, on another topic than the state, agree with it."""
        pan, tilt = self.joints_deg[PAN], self.joints_deg[TILT]
        return abs(pan - pan_deg) < CLOSE_DEG and abs(tilt - tilt_deg) < CLOSE_DEG

    def hears_states(self, count: int) -> None:
        """Waits for this many more states."""
        wanted = len(self.states) + count
        wait_until(lambda: len(self.states) >= wanted, f"{count} states")


def follows_commands() -> None:
    """Checks, as a probe, that commands turn and zoom it up to its limits, and that non-finite ones do nothing."""
    camera = Camera()
    first = camera.states[-1]
    assert camera.is_at(0, 0) and first.autofocus, f"at rest: {first}"
    assert first.zoom == pytest.approx(1)

    camera.send(pan=30, tilt=-10, zoom=5000, focus=42, brightness=7, iris=3)
    wait_until(lambda: camera.is_at(30, -10), "pan 30, tilt -10")
    wait_until(lambda: camera.joints_are_at(-30, 10), "joints 30 to the right, 10 down")
    state = camera.states[-1]
    assert (state.focus, state.brightness, state.iris, state.autofocus) == (42, 7, 3, False)
    wait_until(lambda: abs(camera.states[-1].zoom - 5000) < 0.1, "zoom 5000")
    wide, tele = (1 / math.tan(math.radians(fov) / 2) for fov in (WIDE_DEG, TELE_DEG))
    half_zoomed = pytest.approx(WIDTH_PX / 2 * (wide + tele) / 2, rel=1e-6)
    wait_until(lambda: camera.infos[-1].K[0] == half_zoomed, "half of the zoom in camera_info")

    for bad in ({"pan": math.nan}, {"zoom": math.inf}, {"focus": -math.inf}):
        camera.send(**{"pan": 60, "tilt": 60, "zoom": 1, **bad})
        time.sleep(0.2)  # the driver takes the latest command only
    camera.hears_states(10)
    state = camera.states[-1]
    assert camera.is_at(30, -10) and state.focus == 42, f"after nonsense: {state}"
    assert state.zoom == pytest.approx(5000, abs=0.1)

    camera.send(pan=200, tilt=-100, zoom=99999)
    wait_until(lambda: camera.is_at(180, -90), "the limits")
    wait_until(lambda: abs(camera.states[-1].zoom - 9999) < 0.1, "zoom 9999")


def test_the_camera_follows_axis_commands(graph: RosGraph) -> None:
    graph.launch("ardee_sensors", "show_sensor.launch", "sensor:=axis", "rviz:=false")
    graph.call(probes.wait_for_topics, ["/joint_states"], [])  # two launch files at once collide
    driver = graph.launch("axis_camera", "axis.launch", "camera_name:=sensor")
    graph.call(follows_commands, timeout_s=200.0)
    warnings = [line for line in driver.output().splitlines() if "cmd: found" in line]
    assert len(warnings) == 1, driver.output()
    assert "cmd: found pan nan, expected a finite number; ignored" in warnings[0]


@pytest.mark.parametrize(
    "parameter, message",
    [
        ("_rate_hz:=0", "~rate_hz: 0; expected a number above 0, at most 1000"),
        ("_speed_control:=true", "~speed_control: true; the simulated camera has only false"),
    ],
)
def test_a_parameter_that_cannot_be_ends_the_driver(
    graph: RosGraph, parameter: str, message: str
) -> None:
    driver = graph.spawn("rosrun", "axis_camera", "axis_ptz.py", parameter)
    assert driver.wait() == 1
    assert message in driver.output()
