# SPDX-License-Identifier: MIT
"""The page of `sensor_report`: pictures by render_world, text from config/."""
import html
import math
import pathlib
import re
import subprocess
from typing import List, Tuple

from device_numbers import CONFIG, MARKS, PACKAGE, Number, devices, load, read_numbers, sources
from PIL import Image, ImageDraw

from ardee_common.cli import steps
from ardee_common.errors import GeneratorError
from ardee_common.output import output_folder, write_file

POST_HEIGHT_M = 0.6
WORLD = """<?xml version="1.0"?>
<sdf version="1.5"><world name="table">
  <light name="sun" type="directional">
    <cast_shadows>1</cast_shadows><pose>0 0 10 0 0 0</pose>
    <diffuse>1 1 1 1</diffuse><direction>-0.6 0.3 -0.8</direction>
  </light>
  <model name="ground"><static>true</static><link name="link"><visual name="floor">
    <geometry><plane><normal>0 0 1</normal><size>20 20</size></plane></geometry>
    <material><ambient>0.8 0.8 0.8 1</ambient><diffuse>0.8 0.8 0.8 1</diffuse></material>
  </visual></link></model>
</world></sdf>
"""
STYLE = """body{font:15px/1.4 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em;overflow-wrap:break-word}
section{display:grid;align-items:start;grid-template-columns:320px minmax(0,1fr);gap:.7em 2em}
section{border-top:1px solid #ccc;padding:1em 0}
h2,section>p{grid-column:1/-1;margin:0} img{width:100%;height:auto}
table{border-collapse:collapse;width:100%} td:nth-child(4){width:24%}
td,th{text-align:left;padding:1px 12px 1px 0;vertical-align:top} code{background:#eee;padding:0 3px}
td:nth-child(2){white-space:nowrap} dt{font-weight:bold} dt,dd{margin:0 0 .2em}
dl{display:grid;grid-template-columns:max-content 1fr;gap:0 1em}
@media(max-width:900px){section{grid-template-columns:minmax(0,1fr)} img{max-width:320px}}
@media(max-width:600px){thead{display:none} tr{display:block;padding:.3em 0;border-top:1px solid #eee}
td{display:inline;padding:0 .4em 0 0;white-space:normal!important} td:first-child{font-weight:bold}}"""
# ending of a number's name, longest first, and its unit
UNITS = {
    "_n_m_s_per_rad": "N m s/rad",
    "_a_s_per_rad": "A s/rad",
    "_a_s_per_m": "A s/m",
    "_m_per_m": "m/m",
    "_per_m": "1/m",
    "_rad_s2": "rad/s²",
    "_m_s2": "m/s²",
    "_rad_s": "rad/s",
    "_m_s": "m/s",
    "_n_m": "N m",
    "_a_h": "A h",
    "_ohm": "Ω",
    "_rad": "rad",
    "_deg": "°",
    "_hz": "Hz",
    "_kg": "kg",
    "_px": "px",
    "_m": "m",
    "_v": "V",
    "_s": "s",
    "_a": "A",
}


def _run(command: List[str]) -> str:
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        raise GeneratorError(f"{' '.join(command[:3])} failed: {done.stderr.strip()}")
    return done.stdout


def size_m(device: str) -> Tuple[float, float]:
    """Width and height of the device in a picture, m."""
    numbers = dict(load(device))
    for other in numbers.get("also", "").split():
        numbers = {**load(other), **numbers}
    if "tilt_axis_z_m" in numbers:
        return numbers["base_size_x_m"], numbers["tilt_axis_z_m"] + numbers["head_size_z_m"] / 2
    width = max(numbers["size_x_m"], numbers["size_y_m"])
    return width, numbers["size_z_m"] + numbers.get("mast_height_m", 0)


def take_picture(device: str, work: pathlib.Path, picture: pathlib.Path) -> None:
    """Renders the device on its post from the front, its left and above, at a distance that fits its size."""
    urdf, world = work / f"{device}.urdf", work / "table.world"
    post = str(PACKAGE / "robots/show_sensor.urdf.xacro")
    sensor = [f"sensor:={device}", f"height:={POST_HEIGHT_M}"]
    urdf.write_text(_run(["rosrun", "xacro", "xacro", post, *sensor]))
    world.write_text(WORLD)
    width, height = size_m(device)
    away = 2.7 * math.hypot(width, height)
    # the pendulum of an encoder hangs in front of it
    side = -1 if device == "encoder" else 1
    middle_z = POST_HEIGHT_M + height / 2
    eye = [side * 0.75 * away, 0.5 * away, middle_z + 0.4 * away]
    view = ["--look-from", *map(str, eye), "--look-at", "0", "0", str(middle_z), "--fov-deg", "35"]
    robot = ["--robot", str(urdf), "--size", "640x480", "--output", str(picture)]
    _run(["rosrun", "ardee_sim_cpp", "render_world", str(world), *robot, *view])


def _source_text(number: Number, known: dict) -> str:
    """HTML of a comment from its first mark on: source of the value, and other values. Marks link to their meaning."""

    def explained(match: re.Match) -> str:
        return ", ".join(
            _explained_mark(number, mark.strip(), known) for mark in match[1].split(",")
        )

    said = html.escape(number.comment[number.comment.index("[") :])
    return MARKS.sub(explained, said)


def _explained_mark(number: Number, mark: str, known: dict) -> str:
    first, _, rest = mark.partition(" ")
    if first not in known:
        raise GeneratorError(
            f"{number.key}: unknown mark [{mark}]; expected one of {sorted(known)}"
        )
    meaning = html.escape(known[first])
    return f'<a href="#source-{first}" title="{meaning}">{html.escape(first)}</a> {rest}'.strip()


def with_unit(number: Number) -> str:
    """Value and unit of a number, angles in degrees too; plain numbers have no unit."""
    ending = next((ending for ending in UNITS if number.key.endswith(ending)), "")
    value = f"{number.value} {UNITS[ending]}" if ending else number.value
    if ending == "_rad":
        return f"{value} ({math.degrees(float(number.value)):.5g}°)"
    return value.replace(" °", "°")


def section(device: str) -> str:
    """One device's part of the page."""
    known, numbers = sources(), load(device)
    rows = "".join(
        f"<tr><td>{n.key}</td><td>{html.escape(with_unit(n))}</td>"
        f"<td>{html.escape(n.comment.split('[')[0].strip())}</td><td>{_source_text(n, known)}</td></tr>"
        for n in read_numbers(CONFIG / f"{device}.yaml")
    )
    topics = "; ".join(f"<code>{t}</code> {kind}" for t, (kind, _) in numbers["topics"].items())
    others = numbers.get("also", "").split()
    more = "".join(f" For what is not here see <a href='#{o}'>{o}</a>." for o in others)
    name = html.escape(numbers["device"])
    return (
        f"<section id='{device}'><h2>{name}</h2>"
        f"<p>Macro <code>{numbers['macro']}</code>. Topics: {topics}.{more}</p>"
        f"<div><img src='{device}.png' alt='{name}, on a post' width='640' height='480'/></div>"
        "<table><thead><tr><th>number</th><th>value</th><th>what it is</th><th>source</th></tr></thead>"
        f"<tbody>{rows}</tbody></table></section>"
    )


def page(shown: List[str]) -> str:
    """HTML of the whole page."""
    marks = "".join(
        f"<dt id='source-{mark}'>{mark}</dt><dd>{html.escape(text)}</dd>"
        for mark, text in sources().items()
    )
    links = " · ".join(f"<a href='#{d}'>{d}</a>" for d in shown)
    body = "\n".join(section(device) for device in shown)
    return (
        "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'/><title>Sensors</title>"
        "<meta name='viewport' content='width=device-width, initial-scale=1'/>"
        f"<style>{STYLE}</style></head><body><h1>Sensors</h1><p>{links}</p>\n"
        "<p>Topics stand below the robot's namespace, <code>{name}</code> is the macro's argument. "
        f"A source's mark leads to <a href='#sources'>what it means</a>.</p>\n{body}\n"
        f"<section><h2 id='sources'>Sources</h2></section><dl>{marks}</dl></body></html>\n"
    )


def write_report(folder: pathlib.Path, shown: List[str], work: pathlib.Path) -> pathlib.Path:
    """Writes the pictures, a sheet of all of them and index.html into the folder; returns the page's path."""
    with output_folder(folder):
        for device in steps("sensor_report", shown):
            take_picture(device, work, work / f"{device}.png")
        text = page(shown)
        pictures = [folder / f"{device}.png" for device in shown]
        for picture in pictures:
            write_file(picture, (work / picture.name).read_bytes())
        sheet = work / "sensors_sheet.png"
        contact_sheet(pictures).save(sheet)
        write_file(folder / sheet.name, sheet.read_bytes())
        write_file(folder / "index.html", text.encode())
    return folder / "index.html"


def contact_sheet(
    pictures: List[pathlib.Path], columns: int = 6, width_px: int = 240
) -> Image.Image:
    """Sheet of all pictures, each with the stem of its file's name."""
    height_px = width_px * 3 // 4
    rows = math.ceil(len(pictures) / columns)
    sheet = Image.new("RGB", (columns * width_px, rows * height_px), "white")
    pen = ImageDraw.Draw(sheet)
    for index, path in enumerate(pictures):
        corner = (index % columns * width_px, index // columns * height_px)
        with Image.open(path) as picture:
            sheet.paste(picture.convert("RGB").resize((width_px, height_px)), corner)
        pen.text((corner[0] + 5, corner[1] + 3), path.stem, fill="black")
    return sheet


def chosen(names: List[str]) -> List[str]:
    """Devices of the names and those whose numbers they share; all devices for no names; an unknown name is refused."""
    others = [other for name in names for other in load(name).get("also", "").split()]
    return list(dict.fromkeys(names + others)) or devices()
