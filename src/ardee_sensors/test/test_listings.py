# SPDX-License-Identifier: MIT
"""Tests the macro calls of the thesis's listings, word for word."""
import pathlib
import xml.etree.ElementTree as ElementTree

import pytest
from macro_calls import call, robot, topics
from xacro_runner import SOURCES, expand, mesh_path

LISTINGS = SOURCES.parent / "tests/data/listings"
LISTING_A_9 = """<xacro:sensor_imu name="imu" parent="base_footprint" color="red"
  update_rate="50.0"
  noise="0.005"
  yaw_offset="0.0"
  yaw_drift="0.02"
  yaw_noise="0.01"
  rate_offset="0.0 0.0 0.0"
  rate_drift="0.002 0.002 0.002"
  rate_noise="0.001 0.001 0.001"
  accel_offset="0.0 0.0 0.0"
  accel_drift="0.005 0.005 0.005"
  accel_noise="0.005 0.005 0.005">
<origin xyz="0 0 0" rpy="0 0 0"/>
</xacro:sensor_imu>"""
LISTING_A_12 = """
<xacro:sensor_hokuyo_ust10lx name="hokuyo" parent="base_footprint" color="black">
  <origin xyz="0.22 0 0.173" rpy="0 0 0"/>
</xacro:sensor_hokuyo_ust10lx>
<xacro:sensor_ueye_cp_gige name="camera" parent="base_footprint" color="purple">
  <origin xyz="0.23 0 0.06" rpy="0 0 0"/>
</xacro:sensor_ueye_cp_gige>
<xacro:sensor_ueye_cp_gige name="camera_left" parent="base_footprint" color="purple">
  <origin xyz="0 0.16 0.06" rpy="0 0.349066 1.5708"/>
</xacro:sensor_ueye_cp_gige>
<xacro:sensor_imu_ardee name="imu" parent="base_footprint" color="red"
  update_rate="50.0"
  noise="0.005"
  yaw_offset="0.0"
  yaw_drift="0.02"
  yaw_noise="0.01"
  rate_offset="0.0 0.0 0.0"
  rate_drift="0.002 0.002 0.002"
  rate_noise="0.001 0.001 0.001"
  accel_offset="0.0 0.0 0.0"
  accel_drift="0.005 0.005 0.005"
  accel_noise="0.005 0.005 0.005">
  <origin xyz="0 0 0" rpy="0 0 0"/>
</xacro:sensor_imu_ardee>
<xacro:sensor_gps_with_dropout name="gps" parent="base_footprint" color="white"
  ref_lat="40.1021496545"
  ref_long="-88.2267974168"
  ref_head="90.0"
  update_rate="10.0"
  drift="0.0"
  noise="0.001"
  vel_drift="0.00001"
  vel_noise="0.00001">
  <origin xyz="-0.14 0 0.12" rpy="0 0 0"/>
</xacro:sensor_gps_with_dropout>"""
CONFIGURED = {
    "updateRate": "50.0",
    "yawDrift": "0.02",
    "yawGaussianNoise": "0.01",
    "rateOffset": "0.0 0.0 0.0",
    "rateDrift": "0.002 0.002 0.002",
    "rateGaussianNoise": "0.001 0.001 0.001",
    "accelDrift": "0.005 0.005 0.005",
    "accelGaussianNoise": "0.005 0.005 0.005",
}


def texts(plugin: ElementTree.Element) -> dict:
    return {child.tag: child.text for child in plugin}


def test_the_sensors_of_listing_a_12(tmp_path: pathlib.Path):
    root = robot(tmp_path, LISTING_A_12)
    assert set(topics(root)) == {
        "ardee/hokuyo",
        "ardee/camera/image_raw",
        "ardee/camera/camera_info",
        "ardee/camera_left/image_raw",
        "ardee/camera_left/camera_info",
        "ardee/imu/custom",
        "ardee/gps",
        "ardee/gps/fix_velocity",
        "ardee/gps/data",
        "ardee/gps/regions",
    }
    imu, gps = root.find(".//plugin[@name='imu_controller']"), root.find(
        ".//plugin[@name='gps_controller']"
    )
    assert imu.get("filename") == "libhector_gazebo_ros_imu.so"
    assert CONFIGURED.items() <= texts(imu).items()
    assert gps.get("filename") == "libgazebo_ros_gps_with_dropout.so"
    wanted = {
        "referenceLatitude": "40.1021496545",
        "referenceLongitude": "-88.2267974168",
        "referenceHeading": "90.0",
        "updateRate": "10.0",
        "drift": "0.0",
        "gaussianNoise": "0.001",
        "velocityDrift": "0.00001",
        "velocityGaussianNoise": "0.00001",
    }
    assert {k: float(v) for k, v in wanted.items()} == {k: float(gps.findtext(k)) for k in wanted}
    left = root.find("joint[@name='camera_left_joint']")
    assert left.find("origin").get("rpy") == "0 0.349066 1.5708"


def test_the_imu_of_listing_a_9_drifts(tmp_path: pathlib.Path):
    plugin = robot(tmp_path, LISTING_A_9).find(".//plugin")
    assert plugin.get("filename") == "libhector_gazebo_ros_imu.so"
    assert CONFIGURED.items() <= texts(plugin).items()


@pytest.mark.parametrize(
    "arguments, rate, accel",
    [
        ("", "0.001 0.001 0.001", "0.005 0.005 0.005"),
        ('noise="0.3"', "0.3", "0.3"),
        ('noise="0.3" rate_noise="0.2"', "0.2", "0.3"),
    ],
)
def test_noise_of_an_imu_stands_in_for_what_is_not_given(
    tmp_path: pathlib.Path, arguments: str, rate: str, accel: str
):
    plugin = robot(tmp_path, call("imu_hector", "a", arguments)).find(".//plugin")
    assert (plugin.findtext("rateGaussianNoise"), plugin.findtext("accelGaussianNoise")) == (
        rate,
        accel,
    )


def test_the_model_of_listing_a_1_ships():
    """The listing is the shipped model, comments apart, and has its mesh."""
    model = SOURCES / "ardee_sensors/models/simple_gps_model"
    printed, ours = (
        ElementTree.canonicalize(file.read_text(), strip_text=True)
        for file in (LISTINGS / "a_1.sdf", model / "model.sdf")
    )
    assert printed == ours
    assert (model / "meshes/antenna_3GO16.stl").read_bytes() == mesh_path(
        "package://ardee_sensors/meshes/antenna_3GO16.stl"
    ).read_bytes()


def listing(folder: pathlib.Path, text: str, calls: str) -> ElementTree.Element:
    """Returns a robot of a wheel on an axle, the text of a listing with its macro, and calls of it."""
    file = folder / "listing.urdf.xacro"
    file.write_text(
        '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">'
        f'<link name="base_footprint"/><link name="wheel"/>{text}{calls}</robot>'
    )
    return ElementTree.fromstring(expand(file))


def test_the_receiver_of_listing_a_2(tmp_path: pathlib.Path):
    include = f'<xacro:include filename="{LISTINGS / "a_2.urdf.xacro"}"/>'
    root = listing(
        tmp_path,
        include,
        '<xacro:sensor_gps name="gps" parent="base_footprint" color="white" ref_lat="40" ref_long="-88" ref_head="0" '
        'drift="0" vel_drift="0" noise="0" vel_noise="0" update_rate="5"><origin xyz="0 0 1"/></xacro:sensor_gps>',
    )
    plugin = root.find(".//plugin[@name='gps_controller']")
    assert plugin.get("filename") == "libgazebo_ros_gps.so"
    assert texts(plugin)["referenceLatitude"] == "40.1105875"
    for mesh in root.iter("mesh"):
        assert mesh_path(mesh.get("filename")).is_file()
    assert root.find("joint[@name='gps_joint']/origin").get("xyz") == "0 0 1"


@pytest.mark.parametrize("of", ["the listing", "this package"])
def test_the_encoder_of_listing_a_5(tmp_path: pathlib.Path, of: str):
    """The listing's own macro, and ours, called with the parent alone have the listing's defaults."""
    text = (LISTINGS / "a_5.txt").read_text()
    if of == "this package":
        text = '<xacro:include filename="$(find ardee_sensors)/urdf/encoder.urdf.xacro"/>'
    root = listing(tmp_path, text, '<xacro:sensor_encoder parent="wheel"/>')
    plugin = root.find(".//plugin[@name='wheel_encoder_plugin']")
    assert plugin.get("filename") == "libardee_ros_encoder.so"
    numbers = {"wheelDiameter": 0.15, "pulsesPR": 150, "updateRate": 100}
    assert {key: float(plugin.findtext(key)) for key in numbers} == numbers
    assert (plugin.findtext("joint"), plugin.findtext("encoderTopic")) == (
        "front_left_wheel_rev",
        "/encoder",
    )
    assert mesh_path(root.find(".//mesh").get("filename")).is_file()
    assert root.find("joint[@name='wheel_encoder_joint']/child").get("link") == "wheel_encoder_link"


def test_the_arguments_of_listing_a_5(tmp_path: pathlib.Path):
    calls = (
        '<xacro:sensor_encoder ns="/" parent="wheel" joint="axle" d="0.2" '
        'topic="/encoder" update_rate="50.0" ppr="300"/>'
    )
    root = robot(tmp_path, '<link name="wheel"/>' + calls)
    plugin = root.find(".//plugin[@name='wheel_encoder_plugin']")
    assert plugin.get("filename") == "libardee_ros_encoder.so"
    expected = {
        "robotNamespace": "/",
        "joint": "axle",
        "wheelDiameter": "0.2",
        "pulsesPR": "300",
        "encoderTopic": "/encoder",
        "updateRate": "50.0",
    }
    assert expected.items() <= texts(plugin).items()
    assert root.find("joint[@name='wheel_encoder_joint']/child").get("link") == "wheel_encoder_link"
