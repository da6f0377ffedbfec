# SPDX-License-Identifier: MIT
"""Makes robots of macro calls, and lists the topics that their plugins would publish."""
import pathlib
import xml.etree.ElementTree as ElementTree
from typing import Dict, List

from xacro_runner import expand, run_xacro

ORIGIN = '<origin xyz="0 0 1" rpy="0 0 0" />'
ROBOT = """<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find ardee_sensors)/urdf/all_sensors.urdf.xacro" />
  <link name="base_footprint" />
  {calls}
</robot>"""
TOPIC_KEYS = (
    "topicName",
    "velocityTopicName",
    "encoderTopic",
    "batteryTopic",
    "batteryStateTopic",
    "dataTopicName",
    "regionsTopicName",
)
CAMERA_KEYS = (
    "imageTopicName",
    "cameraInfoTopicName",
    "depthImageTopicName",
    "depthImageCameraInfoTopicName",
    "pointCloudTopicName",
)


def call(device: str, name: str, arguments: str = "") -> str:
    """Returns the shortest call of a device's macro; an encoder has no origin and is given its topic."""
    if device == "encoder":
        return f'<xacro:sensor_encoder parent="base_footprint" name="{name}" topic="ardee/{name}" {arguments} />'
    macro = f"xacro:sensor_{device}"
    return f'<{macro} name="{name}" parent="base_footprint" {arguments}>{ORIGIN}</{macro}>'


def write_robot(folder: pathlib.Path, calls: str) -> pathlib.Path:
    """Writes a robot file of the calls."""
    file = folder / "robot.urdf.xacro"
    file.write_text(ROBOT.format(calls=calls))
    return file


def robot(folder: pathlib.Path, calls: str) -> ElementTree.Element:
    """Returns the URDF of a robot of the calls."""
    return ElementTree.fromstring(expand(write_robot(folder, calls)))


def complaint(folder: pathlib.Path, calls: str) -> str:
    """Returns xacro's message for a wrong call."""
    done = run_xacro(write_robot(folder, calls))
    assert done.returncode != 0 and not done.stdout
    return done.stderr


def of(root: ElementTree.Element, tag: str, name: str) -> List[ElementTree.Element]:
    """Returns elements of the tag whose name is `name` or begins with `name` and an underscore."""
    return [
        e
        for e in root.iter(tag)
        if e.get("name") == name or e.get("name", "").startswith(name + "_")
    ]


def camera_topics(sensor_cameras: List[str], plugin: ElementTree.Element) -> List[str]:
    """Returns topics of a camera's plugin; the cameras of a multicamera have their names before them."""
    multi = plugin.get("filename") == "libgazebo_ros_multicamera.so"
    stems = [f"/{name}" for name in sensor_cameras] if multi else [""]
    base = plugin.findtext("cameraName")
    return [
        f"{base}{stem}/{plugin.findtext(key)}"
        for stem in stems
        for key in CAMERA_KEYS
        if plugin.find(key) is not None
    ]


def topics(root: ElementTree.Element) -> Dict[str, str]:
    """Returns topics of the robot's plugins, each with the plugin that publishes it; no topic occurs twice."""
    found: Dict[str, str] = {}
    cameras = {
        plugin.get("name"): [camera.get("name") for camera in sensor.findall("camera")]
        for sensor in root.iter("sensor")
        for plugin in sensor.findall("plugin")
    }
    for plugin in root.iter("plugin"):
        mine = [plugin.findtext(key) for key in TOPIC_KEYS if plugin.find(key) is not None]
        if plugin.find("cameraName") is not None:
            mine += camera_topics(cameras[plugin.get("name")], plugin)
        for topic in mine:
            assert topic not in found, f"{topic}: of {found.get(topic)} and {plugin.get('name')}"
            found[topic] = plugin.get("name")
    return found
