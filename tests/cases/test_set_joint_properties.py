# SPDX-License-Identifier: MIT
"""set_joint_properties gives a joint damping and a stop; a world's light answers and changes its colour."""
import pathlib

import probes
import pytest
from gazebo_calls import Call, call, empty, pose, simulate, spawn, step
from std_msgs.msg import ColorRGBA

from ardee_common.ros_graph import RosGraph
from gazebo_msgs.msg import ODEJointProperties

TURRET = (pathlib.Path(__file__).parent / "set-joint-properties/turret.sdf").read_text()
GET_PAN = ("/gazebo/get_joint_properties", "gazebo_msgs/GetJointProperties")
WORLD = """<sdf version="1.6"><world name="w">
  <scene><ambient>0 0 0 1</ambient></scene>
  <light name="sun" type="directional"><diffuse>0.8 0.8 0.8 1</diffuse><direction>1 0 -0.1</direction></light>
  <model name="board"><static>true</static><pose>2 0 1 0 0 0</pose><link name="l"><visual name="v">
    <geometry><box><size>0.1 9 9</size></box></geometry><material><diffuse>1 1 1 1</diffuse></material>
  </visual></link></model>
</world></sdf>"""
CAMERA = """<sdf version="1.6"><model name="post"><static>true</static><link name="mast">
<sensor name="eye" type="camera">
  <update_rate>20</update_rate>
  <camera><horizontal_fov>1</horizontal_fov><image><width>16</width><height>16</height></image></camera>
  <plugin name="eye" filename="libgazebo_ros_camera.so">
    <cameraName>cam</cameraName><exposure>1</exposure>
  </plugin>
</sensor></link></model></sdf>"""


def set_pan(**lists: list) -> Call:
    fields = {"joint_name": "turret::pan", "ode_joint_config": ODEJointProperties(**lists)}
    return "/gazebo/set_joint_properties", "gazebo_msgs/SetJointProperties", fields


def turn(effort_n_m: float) -> Call:
    import rospy

    fields = {"joint_name": "turret::pan", "effort": effort_n_m, "duration": rospy.Duration(-1)}
    return "/gazebo/apply_joint_effort", "gazebo_msgs/ApplyJointEffort", fields


def test_set_joint_properties(graph: RosGraph) -> None:
    simulate(graph)
    get = (*GET_PAN, {"joint_name": "turret::pan"})
    answers = call(
        graph,
        empty("pause_physics"),
        spawn("turret", TURRET, pose()),
        set_pan(damping=[0.5], hiStop=[0.2]),
        get,
        turn(1.0),
        step(3000),
        get,
    )
    assert answers[2].success, answers[2].status_message
    assert list(answers[3].damping) == [0.5]
    assert answers[6].position == pytest.approx([0.2], abs=1e-3)
    assert answers[6].rate == pytest.approx([0.0], abs=1e-3)


def light(service: str, **fields: object) -> Call:
    kind = "".join(word.capitalize() for word in service.split("_"))
    return f"/gazebo/{service}", f"gazebo_msgs/{kind}", {"light_name": "sun", **fields}


def test_a_light_answers_and_changes_its_colour(graph: RosGraph) -> None:
    simulate(graph, WORLD)
    spawned, found = call(graph, spawn("post", CAMERA, pose(z=1)), light("get_light_properties"))
    assert spawned.success, spawned.status_message
    assert found.success, found.status_message
    assert (found.diffuse.r, found.attenuation_constant) == pytest.approx((0.8, 1.0))

    def pixel() -> tuple:
        return tuple(
            graph.call(probes.collect, "/cam/image_raw", "sensor_msgs/Image", 2)[-1].data[:3]
        )

    grey = pixel()
    assert grey[0] == grey[1] == grey[2] > 100
    red = ColorRGBA(0.8, 0, 0, 1)
    answer, found = call(
        graph,
        light("set_light_properties", diffuse=red, attenuation_constant=1.0),
        light("get_light_properties"),
    )
    assert answer.success, answer.status_message
    assert (found.diffuse.r, found.diffuse.g) == pytest.approx((0.8, 0.0))
    assert pixel() == (grey[0], 0, 0)
    deleted, found = call(graph, light("delete_light"), light("get_light_properties"))
    assert deleted.success and not found.success
    assert "sun" in found.status_message
    assert pixel() == (0, 0, 0)
