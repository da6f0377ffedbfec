# SPDX-License-Identifier: MIT
"""Tests the camera gimbal: balanced on its axis, led by a spring of half a hertz."""
import numpy as np
import pytest
from conftest import PACKAGE
from robot_urdf import Robot, numbers, pose
from xacro_runner import expand


@pytest.fixture(scope="module")
def v3() -> Robot:
    """Returns the third generation, which has gimbals."""
    return Robot(expand(PACKAGE / "robots/tsv3_default.urdf.xacro"))


@pytest.mark.parametrize("place", ["front", "left", "right"])
def test_the_camera_is_balanced_and_led_slowly(v3: Robot, place: str):
    axle = v3.frame(f"camera_{place}_gimbal_link")
    axis = numbers(v3.joints[f"camera_{place}_gimbal_joint"].find("axis").get("xyz"))
    moment, inertia = np.zeros(3), 0.0  # about the axis
    for link in (f"camera_{place}_gimbal_link", f"camera_{place}_link", f"camera_{place}_imu_link"):
        arm = axle[:3, :3].T @ (v3.center_of_mass(link) - axle[:3, 3])
        arm -= axis * (axis @ arm)
        turned = (
            axle[:3, :3].T @ v3.frame(link)[:3, :3] @ pose(v3.links[link].find("inertial"))[:3, :3]
        )
        moment += v3.mass(link) * arm
        inertia += axis @ turned @ v3.inertia(link) @ turned.T @ axis + v3.mass(link) * arm @ arm
    assert moment == pytest.approx(np.zeros(3), abs=1e-9)

    joint = f"camera_{place}_gimbal_joint"
    (spring,) = [
        s for s in v3.plugins("libTorsionalSpringPlugin.so") if s.findtext("joint_handle") == joint
    ]
    stiffness, damping = (float(spring.findtext(f"spring_{k}")) for k in ("stiffness", "damping"))
    assert np.sqrt(stiffness / inertia) / (2 * np.pi) == pytest.approx(0.5, rel=0.05)
    assert damping / (2 * np.sqrt(stiffness * inertia)) == pytest.approx(0.7, rel=0.05)


@pytest.mark.parametrize("place", ["front", "left", "right"])
def test_it_is_told_where_to_look(v3: Robot, place: str):
    topics = [s.findtext("referenceTopic") for s in v3.plugins("libTorsionalSpringPlugin.so")]
    assert topics.count(f"ardee/camera/{place}/tilt_position_controller/command") == 1


def test_side_cameras_look_to_their_sides(v3: Robot):
    for place, direction in (("front", [1, 0, 0]), ("left", [0, 1, 0]), ("right", [0, -1, 0])):
        view = v3.frame(f"camera_{place}_optical_frame")[:3, 2]
        assert view == pytest.approx(direction, abs=1e-5)


@pytest.mark.parametrize("place", ["front", "left", "right"])
def test_its_imu_turns_with_the_camera(v3: Robot, place: str):
    """The IMU's axes are the lens's at any angle of the gimbal: x along the view."""
    turned = {f"camera_{place}_gimbal_joint": 0.4}
    imu, lens = (v3.frame(f"camera_{place}_{name}", turned) for name in ("imu_link", "link"))
    assert imu[:3, :3] == pytest.approx(lens[:3, :3], abs=1e-12)
    topics = [p.findtext("topicName") for p in v3.plugins("libhector_gazebo_ros_imu.so")]
    assert topics.count(f"ardee/camera/{place}/imu") == 1
