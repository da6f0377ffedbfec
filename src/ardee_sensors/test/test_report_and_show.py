# SPDX-License-Identifier: MIT
"""The report's page, and the post that show_sensor.launch puts into the room."""
import pathlib
import subprocess
import xml.etree.ElementTree as ElementTree

import pytest
import yaml
from device_numbers import CONFIG, PACKAGE, devices, load, read_numbers, sources
from report_page import chosen, contact_sheet, page
from xacro_runner import expand, ros_environment, run_xacro

POST = PACKAGE / "robots/show_sensor.urdf.xacro"
ONE_OF_A_KIND = sorted({load(device)["kind"]: device for device in devices()}.values()) + [
    "encoder"
]


def test_the_page_has_every_number_and_every_source():
    root = ElementTree.fromstring(page(devices()).split("\n", 1)[1])
    sections = {section.get("id"): section for section in root.iter("section")}
    assert sorted(sections) == devices()
    for device, section in sections.items():
        rows = [["".join(cell.itertext()) for cell in row] for row in section.iter("tr")][1:]
        numbers = read_numbers(CONFIG / f"{device}.yaml")
        assert [row[0] for row in rows] == [number.key for number in numbers]
        for row, number in zip(rows, numbers):
            assert row[1].split(" (")[0] == number.value
            assert all(mark.split()[0] in row[3] for mark in number.marks)
        assert section.find("img").get("src") == f"{device}.png"
    known = ["".join(item.itertext()) for item in root.iter("li")]
    assert [item.split()[0] for item in known] == list(sources())


def test_what_others_have_stands_with_its_source_beside_the_devices_own():
    root = ElementTree.fromstring(page(["vlp16", "imu_terra", "imu"]).split("\n", 1)[1])
    rows = {row[0].text: row for row in root.iter("tr")}
    text = "".join(rows["noise_std_m"][3].itertext())
    assert text == "webots; the macro of velodyne_simulator has 0.008 velodyne"
    assert rows["noise_std_m"][3].find("abbr").get("title") == sources()["webots"]
    links = [a.get("href") for a in root.find(".//section[@id='imu_terra']").iter("a")]
    assert links == ["#imu"]


def test_what_is_asked_for_is_checked_first():
    assert chosen([]) == devices()
    assert chosen(["sonar"]) == ["sonar"]
    assert chosen(["imu_terra", "gps_with_mast"]) == ["imu_terra", "gps_with_mast", "imu", "gps"]
    with pytest.raises(ValueError, match="unknown sensor 'sonnar'"):
        chosen(["sonnar"])


def test_the_sheet_has_a_place_for_each(tmp_path: pathlib.Path):
    one = contact_sheet([], width_px=40)
    assert one.size == (240, 0)
    from PIL import Image

    paths = [tmp_path / f"{name}.png" for name in "abcdefg"]
    for path in paths:
        Image.new("RGB", (8, 6), "red").save(path)
    sheet = contact_sheet(paths, width_px=40)
    assert sheet.size == (240, 60)
    assert sheet.getpixel((20, 55)) == (255, 0, 0) and sheet.getpixel((60, 55)) == (255, 255, 255)


@pytest.mark.parametrize("device", ONE_OF_A_KIND)
def test_every_kind_stands_on_its_post(device: str):
    root = ElementTree.fromstring(expand(POST, sensor=device))
    assert root.find("link[@name='sensor_link']") is not None
    assert root.find("link[@name='base_footprint']/inertial") is None  # KDL warns of that
    on_it = [j for j in root.findall("joint") if j.find("child").get("link").startswith("sensor")]
    z = float(on_it[0].find("origin").get("xyz").split()[2])
    assert 0.6 <= z < 0.8


def test_a_sensor_that_is_not_there_is_refused():
    done = run_xacro(POST, sensor="sonnar")
    assert done.returncode != 0
    assert f'unknown sensor "sonnar"; expected one of: {", ".join(devices())}' in done.stderr


def test_the_launch_file_has_no_argument_that_nobody_can_give():
    launch = ElementTree.parse(PACKAGE / "launch/show_sensor.launch")
    names = {argument.get("name") for argument in launch.getroot().findall("arg")}
    assert names == {"sensor", "world", "rviz", "rtf", "seed"}


@pytest.mark.parametrize(
    "sensor, code, said", [("kinect", 0, "/ardee/sensor/depth/points"), ("x", 2, "kinect")]
)
def test_watch_sensor_names_the_topics(sensor: str, code: int, said: str):
    command = ["/usr/bin/python3", str(PACKAGE / "scripts/watch_sensor"), sensor, "__name:=watch"]
    done = subprocess.run(command, env=ros_environment(), capture_output=True, text=True)
    assert done.returncode == code
    assert said in done.stdout + done.stderr and "Traceback" not in done.stderr


@pytest.mark.parametrize("device", devices())
def test_rviz_shows_topics_that_there_are(device: str):
    """Of the device's own configuration, else of its kind's, else one with marks alone."""
    names = (device, load(device)["kind"], "robot")
    file = next(f for f in (PACKAGE / f"rviz/{name}.rviz" for name in names) if f.is_file())
    displays = yaml.safe_load(file.read_text())["Visualization Manager"]["Displays"]
    shown = {d[key] for d in displays for key in ("Topic", "Image Topic") if key in d}
    marks = {d["Marker Topic"] for d in displays if "Marker Topic" in d}
    published = {"/" + topic.format(name="sensor") for topic in load(device)["topics"]}
    assert shown <= published
    assert bool(shown) == (file.stem not in ("robot", "gps"))
    assert shown or "/ardee/sensor/readings" in marks
