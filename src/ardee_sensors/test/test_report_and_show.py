# SPDX-License-Identifier: MIT
"""Tests the report's page, and the post that show_sensor.launch puts into the room."""
import pathlib
import re
import signal
import subprocess
import xml.etree.ElementTree as ElementTree
from html.parser import HTMLParser

import pytest
import report_page
import yaml
from device_numbers import CONFIG, PACKAGE, Number, devices, load, read_numbers, sources
from PIL import Image
from report_page import chosen, contact_sheet, page, with_unit
from xacro_runner import expand, ros_environment, run_xacro

from ardee_common.errors import GeneratorError

POST = PACKAGE / "robots/show_sensor.urdf.xacro"
ONE_OF_A_KIND = sorted({load(device)["kind"]: device for device in devices()}.values()) + [
    "encoder"
]


class Page(HTMLParser):
    """Content of a page as a browser sees it: sections with pictures and rows, links and their targets."""

    def __init__(self, text: str):
        super().__init__()
        self.sections, self.links, self.places, self.open = {}, [], [], []
        self.feed(text)
        self.close()
        assert not self.open, f"never closed: {self.open}"

    def handle_starttag(self, tag: str, attributes: list) -> None:
        found = dict(attributes)
        self.places += [found["id"]] if "id" in found else []
        if tag == "section":
            self.here = self.sections.setdefault(found.get("id"), {"pictures": [], "rows": []})
        elif tag == "img":
            self.here["pictures"].append(found)
        elif tag == "tr":
            self.here["rows"].append([])
        elif tag in ("td", "th"):
            self.here["rows"][-1].append("")
        elif tag == "a":
            self.links.append(found)
        if tag not in ("img", "meta"):
            self.open.append(tag)

    def handle_startendtag(self, tag: str, attributes: list) -> None:
        self.handle_starttag(tag, attributes)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if "td" in self.open or "th" in self.open:
            self.here["rows"][-1][-1] += data


def test_the_page_has_every_number_with_unit_and_source():
    found = Page(page(devices()))
    assert [name for name in found.sections if name] == devices()
    for device in devices():
        rows = found.sections[device]["rows"][1:]
        numbers = read_numbers(CONFIG / f"{device}.yaml")
        assert [row[0] for row in rows] == [number.key for number in numbers]
        for row, number in zip(rows, numbers):
            assert row[1] == with_unit(number) and row[1].startswith(number.value)
            assert row[3] and all(mark.split()[0] in row[3] for mark in number.marks)


def test_the_page_s_links_lead_somewhere_and_each_source_is_there():
    found = Page(page(devices()))
    assert len(found.places) == len(set(found.places))
    assert {f"source-{mark}" for mark in sources()} <= set(found.places)
    assert all(link["href"][0] == "#" and link["href"][1:] in found.places for link in found.links)


@pytest.mark.parametrize(
    "key, value, shown",
    [
        ("rate_hz", "30", "30 Hz"),
        ("horizontal_fov_deg", "87", "87°"),
        ("min_angle_rad", "-1.5708", "-1.5708 rad (-90°)"),
        ("rate_noise_rad_s", "0 0 1", "0 0 1 rad/s"),
        ("vibration_std_accel_m_s2", "0 0 9", "0 0 9 m/s²"),
        ("depth_noise_quadratic_per_m", "0.0036", "0.0036 1/m"),
        ("damping_n_m_s_per_rad", "0.1", "0.1 N m s/rad"),
        ("samples", "7", "7"),
    ],
)
def test_a_number_has_the_unit_of_its_name(key: str, value: str, shown: str):
    assert with_unit(Number(key, value, "", [])) == shown


def test_the_report_has_a_picture_of_each_device_asked_for(tmp_path: pathlib.Path, monkeypatch):
    """The renderer belongs to another package; this test replaces it by pictures of the same size."""
    monkeypatch.setattr(
        report_page,
        "take_picture",
        lambda device, work, picture: Image.new("RGB", (640, 480), "red").save(picture),
    )
    (tmp_path / "work").mkdir()
    names = ["imu_terra", "imu", "zed2"]
    file = report_page.write_report(tmp_path / "report", names, tmp_path / "work")
    found = Page(file.read_text(encoding="utf-8"))
    for name in names:
        (picture,) = found.sections[name]["pictures"]
        assert load(name)["device"] in picture["alt"]
        with Image.open(file.parent / picture["src"]) as there:
            assert there.size == (int(picture["width"]), int(picture["height"]))


@pytest.mark.parametrize("place", ["a_file", "a_file/below"])
def test_a_place_that_cannot_be_written_is_said_before_any_picture(
    place: str, tmp_path: pathlib.Path, monkeypatch
):
    drawn = []
    monkeypatch.setattr(report_page, "take_picture", lambda *arguments: drawn.append(arguments))
    (tmp_path / "a_file").write_text("")
    folder = tmp_path / place
    expected = re.escape(f"found --output {folder} (") + ".*expected a folder that can be written"
    with pytest.raises(GeneratorError, match=expected):
        report_page.write_report(folder, ["sonar"], tmp_path)
    assert not drawn


def test_what_others_have_stands_with_its_source_beside_the_devices_own():
    found = Page(page(["vlp16", "imu_terra", "imu"]))
    rows = {row[0]: row for row in found.sections["vlp16"]["rows"]}
    assert rows["noise_std_m"][3] == "webots; the macro of velodyne_simulator has 0.008 velodyne"
    assert {"href": "#source-webots", "title": sources()["webots"]} in found.links
    assert {"href": "#imu"} in found.links


def test_what_is_asked_for_is_checked_first():
    assert chosen([]) == devices()
    assert chosen(["sonar"]) == ["sonar"]
    assert chosen(["imu_terra", "gps_with_mast"]) == ["imu_terra", "gps_with_mast", "imu", "gps"]
    with pytest.raises(GeneratorError, match=r"unknown sensor 'sonnar', nearest of \d+: sonar"):
        chosen(["sonnar"])


def test_the_sheet_has_a_place_for_each(tmp_path: pathlib.Path):
    one = contact_sheet([], width_px=40)
    assert one.size == (240, 0)
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
    # KDL warns of a root with mass
    assert root.find("link[@name='base_footprint']/inertial") is None
    on_it = [j for j in root.findall("joint") if j.find("child").get("link").startswith("sensor")]
    z = float(on_it[0].find("origin").get("xyz").split()[2])
    assert 0.6 <= z < 0.8


def test_a_sensor_that_is_not_there_is_refused():
    done = run_xacro(POST, sensor="sonnar")
    assert done.returncode != 0
    assert f'unknown sensor "sonnar"; expected one of: {", ".join(devices())}' in done.stderr


def test_two_words_for_a_sensor_are_refused_as_one_name():
    file = str(PACKAGE / "launch/show_sensor.launch")
    command = ["roslaunch", "--dump-params", file, "sensor:=sonar axis"]
    done = subprocess.run(command, env=ros_environment(), capture_output=True, text=True)
    assert 'unknown sensor "sonar axis"; expected one of: ' in done.stdout + done.stderr


@pytest.mark.parametrize("script", ["show_readings", "watch_sensor"])
def test_ctrl_c_amid_the_imports_ends_it_without_a_word(script: str, tmp_path: pathlib.Path):
    """A module that each script imports is replaced by one that sends it the signal."""
    interrupt = "import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\ntime.sleep(60)\n"
    for name in ("roslib", "ardee_common"):
        (tmp_path / f"{name}.py").write_text(interrupt)
    command = ["/usr/bin/python3", str(PACKAGE / "scripts" / script), "sonar"]
    environment = dict(ros_environment(), PYTHONPATH=str(tmp_path))
    done = subprocess.run(command, env=environment, capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (-signal.SIGINT, "", "")


def test_the_launch_file_has_no_argument_that_nobody_can_give():
    launch = ElementTree.parse(PACKAGE / "launch/show_sensor.launch")
    names = {argument.get("name") for argument in launch.getroot().findall("arg")}
    assert names == {"sensor", "world", "rviz", "rtf", "seed"}


@pytest.mark.parametrize(
    "sensor, code, said", [("kinect", 0, "/ardee/sensor/depth/points"), ("kinekt", 2, "kinect")]
)
def test_watch_sensor_names_the_topics(sensor: str, code: int, said: str):
    command = ["/usr/bin/python3", str(PACKAGE / "scripts/watch_sensor"), sensor, "__name:=watch"]
    done = subprocess.run(command, env=ros_environment(), capture_output=True, text=True)
    assert done.returncode == code
    assert said in done.stdout + done.stderr and "Traceback" not in done.stderr


@pytest.mark.parametrize("device", devices())
def test_rviz_shows_topics_that_there_are(device: str):
    """Checks the device's own configuration, else that of its kind, else the one with markers only."""
    names = (device, load(device)["kind"], "robot")
    file = next(f for f in (PACKAGE / f"rviz/{name}.rviz" for name in names) if f.is_file())
    displays = yaml.safe_load(file.read_text())["Visualization Manager"]["Displays"]
    shown = {d[key] for d in displays for key in ("Topic", "Image Topic") if key in d}
    marks = {d["Marker Topic"] for d in displays if "Marker Topic" in d}
    published = {"/" + topic.format(name="sensor") for topic in load(device)["topics"]}
    assert shown <= published
    assert bool(shown) == (file.stem not in ("robot", "gps"))
    assert shown or "/ardee/sensor/readings" in marks
