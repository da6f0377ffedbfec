# SPDX-License-Identifier: MIT
"""Tests cameras over ROS: topics, types, encodings, frames and calibration as users of Gazebo's plugins expect them."""
from typing import Any, Dict

import numpy as np
import probes

from ardee_common.ros_graph import RosGraph, wait_until

WIDTH, HEIGHT, FOV_RAD, WALL_M = 64, 48, 1.5707963, 3.0
CAMERA = f"""
  <horizontal_fov>{FOV_RAD}</horizontal_fov>
  <image><width>{WIDTH}</width><height>{HEIGHT}</height><format>{{format}}</format></image>
  <clip><near>0.05</near><far>50</far></clip>"""
SENSOR = """
<sensor name="{name}" type="{type}"><update_rate>20</update_rate>{cameras}
  <plugin name="{name}" filename="libgazebo_ros_{plugin}.so">
    <robotNamespace>rig</robotNamespace><cameraName>{name}</cameraName>
    <frameName>{name}_optical</frameName>{keys}
  </plugin></sensor>"""


def sensor(name: str, plugin: str, kind: str, keys: str = "", pixel: str = "R8G8B8") -> str:
    """Returns a sensor with one camera, or two of a multicamera."""
    block = CAMERA.format(format=pixel)
    names = ("left", "right") if kind == "multicamera" else (name,)
    cameras = "".join(f'<camera name="{each}">{block}</camera>' for each in names)
    return SENSOR.format(name=name, type=kind, cameras=cameras, plugin=plugin, keys=keys)


def world() -> str:
    """Yields a rig of cameras that look at a wall."""
    sensors = (
        sensor("color", "camera", "camera", "<segmentation>true</segmentation>")
        + sensor("grey", "camera", "camera", pixel="L8")
        + sensor("stereo", "multicamera", "multicamera", "<hackBaseline>0.1</hackBaseline>")
        + sensor("depth", "depth_camera", "depth")
        + sensor(
            "kinect",
            "openni_kinect",
            "depth",
            "<useDepth16UC1Format>true</useDepth16UC1Format>"
            "<imageTopicName>rgb/image_raw</imageTopicName>",
        )
        + sensor("asked", "camera", "camera", "<triggered>true</triggered>")
        + sensor("broken", "camera", "camera", "<exposure>-1</exposure>")
    )
    box = "<geometry><box><size>1 40 40</size></box></geometry>"
    return (
        '<sdf version="1.6"><world name="default">'
        '<model name="wall"><static>true</static><pose>3.5 0 0 0 0 0</pose>'
        f'<link name="link"><visual name="v">{box}</visual></link></model>'
        '<model name="rig"><static>true</static>'
        f'<link name="mast">{sensors}</link></model></world></sdf>'
    )


def one_of_each(kinds: Dict[str, str], ask: str) -> Dict[str, Any]:
    """Returns, as a probe, a message of each topic; sends one on `ask` once it has a subscriber."""
    import rospy
    from std_msgs.msg import Empty

    probes._start()
    found = {}  # type: Dict[str, Any]
    for topic, kind in kinds.items():
        rospy.Subscriber(
            topic, probes._type(kind), lambda message, name: found.setdefault(name, message), topic
        )
    trigger = rospy.Publisher(ask, Empty, queue_size=1)

    def complete() -> bool:
        if set(kinds) - set(found) == {"/rig/asked/image_raw"} and trigger.get_num_connections():
            trigger.publish(Empty())
        return len(found) == len(kinds)

    wait_until(complete, f"a message of each of {sorted(kinds)}", 60.0)
    return found


IMAGES = {
    "/rig/color/image_raw": "rgb8",
    "/rig/color/segmentation/label": "16UC1",
    "/rig/color/segmentation/instance": "32SC1",
    "/rig/grey/image_raw": "mono8",
    "/rig/stereo/left/image_raw": "rgb8",
    "/rig/stereo/right/image_raw": "rgb8",
    "/rig/depth/ir/image_raw": "rgb8",
    "/rig/depth/depth/image_raw": "32FC1",
    "/rig/kinect/rgb/image_raw": "rgb8",
    "/rig/kinect/depth/image_raw": "16UC1",
    "/rig/asked/image_raw": "rgb8",
}
INFOS = [
    "/rig/color/camera_info",
    "/rig/stereo/right/camera_info",
    "/rig/depth/depth/camera_info",
    "/rig/kinect/ir/camera_info",
]
CLOUDS = ["/rig/depth/points", "/rig/kinect/points"]


def test_every_camera_publishes_what_its_plugin_promises(graph: RosGraph) -> None:
    file = graph.folder / "rig.world"
    file.write_text(world())
    simulator = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(file))
    kinds = {topic: "sensor_msgs/Image" for topic in IMAGES}
    kinds.update({topic: "sensor_msgs/CameraInfo" for topic in INFOS})
    kinds.update({topic: "sensor_msgs/PointCloud2" for topic in CLOUDS})
    found = graph.call(one_of_each, kinds, "/rig/asked/image_trigger")
    for topic, encoding in IMAGES.items():
        image = found[topic]
        assert (image.encoding, image.width, image.height) == (encoding, WIDTH, HEIGHT), topic
    for topic, message in found.items():
        assert message.header.frame_id == f"rig/{topic.split('/')[2]}_optical", topic
    focal_px = 0.5 * WIDTH / np.tan(0.5 * FOV_RAD)
    for topic in INFOS:
        info = found[topic]
        middle = ((WIDTH - 1) / 2, (HEIGHT - 1) / 2)
        expected = [focal_px, 0, middle[0], 0, focal_px, middle[1], 0, 0, 1]
        np.testing.assert_allclose(info.K, expected, atol=1e-4)
        assert info.distortion_model == "plumb_bob" and tuple(info.D) == (0.0,) * 5
    np.testing.assert_allclose(found[INFOS[1]].P[3], -0.1 * focal_px, rtol=1e-6)
    metres = np.frombuffer(found["/rig/depth/depth/image_raw"].data, np.float32)
    np.testing.assert_allclose(metres, WALL_M, atol=1e-5)
    assert set(np.frombuffer(found["/rig/kinect/depth/image_raw"].data, np.uint16)) == {3000}
    for topic in CLOUDS:
        cloud = found[topic]
        assert [(f.name, f.offset) for f in cloud.fields] == [
            ("x", 0),
            ("y", 4),
            ("z", 8),
            ("rgb", 16),
        ]
        assert (cloud.point_step, cloud.width, cloud.height) == (32, WIDTH, HEIGHT)
        assert not cloud.is_dense
    names = graph.call(probes.topics, "/rig")
    assert not any(name.startswith("/rig/broken") for name in names)
    simulator.stop()
    assert "expected a number in [0" in simulator.output()
