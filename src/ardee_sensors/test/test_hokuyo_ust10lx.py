# SPDX-License-Identifier: MIT
"""Tests the UST-10LX macro: the effect of its arguments, and a scan plane free of obstacles."""
import pathlib
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
import yaml
from macro_calls import call
from macro_calls import robot as macro_robot
from xacro_runner import SOURCES, expand, mesh_path, read_stl, run_xacro

PACKAGE = SOURCES / "ardee_sensors"
DEVICE = yaml.safe_load((PACKAGE / "config/hokuyo_ust10lx.yaml").read_text())
ROBOT = """<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">
  <xacro:include filename="$(find ardee_sensors)/urdf/all_sensors.urdf.xacro" />
  {before}
  <link name="base_footprint" />
  <xacro:sensor_hokuyo_ust10lx name="hokuyo" {arguments}>
    <origin xyz="0.22 0 0.173" rpy="0 0 0" />
  </xacro:sensor_hokuyo_ust10lx>
</robot>"""
CALL = 'parent="base_footprint" color="black"'


def write(folder: pathlib.Path, arguments: str, before: str = "") -> pathlib.Path:
    """Writes a robot file with the lidar called with `arguments`."""
    file = folder / "robot.urdf.xacro"
    file.write_text(ROBOT.format(arguments=arguments, before=before))
    return file


def robot(folder: pathlib.Path, arguments: str = CALL, before: str = "") -> ElementTree.Element:
    """Returns the URDF of that robot."""
    return ElementTree.fromstring(expand(write(folder, arguments, before)))


def test_listing_4_1_alone_gives_the_device(tmp_path: pathlib.Path):
    root = robot(tmp_path)
    joint = root.find("joint[@name='hokuyo_joint']")
    assert (joint.get("type"), joint.find("parent").get("link")) == ("fixed", "base_footprint")
    assert joint.find("child").get("link") == "hokuyo_link"
    assert joint.find("origin").get("xyz") == "0.22 0 0.173"
    sensor = root.find("gazebo[@reference='hokuyo_link']/sensor")
    assert sensor.get("type") == "gpu_ray"
    horizontal = sensor.find("ray/scan/horizontal")
    values = [float(horizontal.findtext(k)) for k in ("samples", "min_angle", "max_angle")]
    assert values == [1081, -2.35619, 2.35619]
    assert [float(sensor.findtext(f"ray/range/{k}")) for k in ("min", "max")] == [0.02, 30]
    assert float(sensor.findtext("update_rate")) == 40
    assert float(sensor.findtext("ray/noise/stddev")) == 0.01
    plugin = sensor.find("plugin")
    assert plugin.get("filename") == "libgazebo_ros_gpu_laser.so"
    names = [plugin.findtext(k) for k in ("robotNamespace", "topicName", "frameName")]
    assert names == ["", "ardee/hokuyo", "hokuyo_link"]  # empty: the place of the spawn


@pytest.mark.parametrize(
    "gpu, kind, library",
    [
        ("true", "gpu_ray", "libgazebo_ros_gpu_laser.so"),
        ("false", "ray", "libgazebo_ros_laser.so"),
    ],
)
def test_gpu_chooses_what_the_rays_meet(tmp_path: pathlib.Path, gpu: str, kind: str, library: str):
    sensor = robot(tmp_path, f'{CALL} gpu="{gpu}"').find("gazebo/sensor")
    assert (sensor.get("type"), sensor.find("plugin").get("filename")) == (kind, library)


CHANGED = {  # argument: (another value, place in the URDF)
    "rate_hz": ("20", "update_rate"),
    "samples": ("541", "ray/scan/horizontal/samples"),
    "min_angle_rad": ("-1.5", "ray/scan/horizontal/min_angle"),
    "max_angle_rad": ("1.5", "ray/scan/horizontal/max_angle"),
    "range_min_m": ("0.1", "ray/range/min"),
    "range_max_m": ("20", "ray/range/max"),
    "range_resolution_m": ("0.01", "ray/range/resolution"),
    "noise_std_m": ("0.03", "ray/noise/stddev"),
    "noise_growth_m_per_m": ("0.004", "plugin/noiseGrowth"),
    "reflectivity_range_m": ("5", "plugin/reflectivityRange"),
    "detection_noise": ("0.1", "plugin/detectionNoise"),
    "beam_divergence_rad": ("0.009", "plugin/beamDivergence"),
    "sub_rays": ("7", "plugin/subRays"),
    "topic": ("front/scan", "plugin/topicName"),
    "robot_namespace": ("/robot2", "plugin/robotNamespace"),
}


def test_every_number_is_an_argument(tmp_path: pathlib.Path):
    calls = [call("hokuyo_ust10lx", k, f'{k}="{value}"') for k, (value, _) in CHANGED.items()]
    root = macro_robot(tmp_path, "\n".join([call("hokuyo_ust10lx", "default"), *calls]))
    sensors = {sensor.get("name"): sensor for sensor in root.iter("sensor")}
    for argument, (value, path) in CHANGED.items():
        default = sensors["default_sensor"].findtext(path)
        assert sensors[f"{argument}_sensor"].findtext(path) == value != default, argument


def test_the_namespace_of_the_robot_is_the_default(tmp_path: pathlib.Path):
    before = '<xacro:property name="robot_namespace" value="/robot2" />'
    plugin = robot(tmp_path, CALL, before).find("gazebo/sensor/plugin")
    assert plugin.findtext("robotNamespace") == "/robot2"


def test_prefix_goes_before_every_name(tmp_path: pathlib.Path):
    root = robot(tmp_path, f'{CALL} prefix="left_"')
    assert root.find("link[@name='left_hokuyo_link']") is not None
    assert root.find("joint").get("name") == "left_hokuyo_joint"
    assert root.find(".//sensor/plugin/frameName").text == "left_hokuyo_link"
    assert {block.get("reference") for block in root.findall("gazebo")} == {"left_hokuyo_link"}


def test_mass_and_inertia_are_those_of_a_box(tmp_path: pathlib.Path):
    inertial = robot(tmp_path).find("link[@name='hokuyo_link']/inertial")
    assert float(inertial.find("mass").get("value")) == 0.13
    moments = [float(inertial.find("inertia").get(k)) for k in ("ixx", "iyy", "izz")]
    expected = 0.13 / 12 * np.array([0.05**2 + 0.07**2, 0.05**2 + 0.07**2, 2 * 0.05**2])
    assert moments == pytest.approx(expected)


def test_nothing_of_the_device_is_in_its_own_scan_plane(tmp_path: pathlib.Path):
    link = robot(tmp_path).find("link[@name='hokuyo_link']")
    for collision in link.findall("collision"):
        z = float(collision.find("origin").get("xyz").split()[2])
        half = float(collision.find("geometry/box").get("size").split()[2]) / 2
        assert abs(z) - half > 0.005
    visual = link.find("visual")
    lift = float(visual.find("origin").get("xyz").split()[2])
    mesh = read_stl(mesh_path(visual.find("geometry/mesh").get("filename"))) + (0, 0, lift)
    in_plane = mesh[(mesh[:, :, 2].min(axis=1) < 0) & (mesh[:, :, 2].max(axis=1) > 0)]
    assert len(in_plane) > 0  # the pillar that carries the dome
    bearing = np.abs(np.arctan2(in_plane[:, :, 1], in_plane[:, :, 0]))
    assert bearing.min() > DEVICE["max_angle_rad"] + 0.05


@pytest.mark.parametrize(
    "arguments, message",
    [
        ('color="black"', "parent"),
        ('parent="base_footprint" color="mauve"', 'unknown color "mauve"'),
        (f'{CALL} ranges="3"', "ranges"),
    ],
)
def test_a_wrong_call_is_refused(tmp_path: pathlib.Path, arguments: str, message: str):
    done = run_xacro(write(tmp_path, arguments))
    assert done.returncode != 0 and message in done.stderr and not done.stdout
