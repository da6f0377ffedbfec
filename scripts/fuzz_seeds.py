# SPDX-License-Identifier: MIT
"""Writes the seeds of the fuzzers of scripts/fuzz: inputs from the repository's files, and dictionaries of names.

fuzz_seeds.py FOLDER makes FOLDER/seeds/TARGET/* and FOLDER/cpp.dict, FOLDER/python.dict.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import xml.etree.ElementTree as tree
from typing import Dict, Iterable, Iterator, List, Tuple

ROOT = pathlib.Path(__file__).resolve().parents[1]
LONGEST_BYTES = 16_000  # a larger input takes the fuzzer longer, without finding more

# Small stand-ins among the test data, which every target finds, for the files that seeds refer to.
STAND_INS = (
    (re.compile(r"(?:package|model|file)://[^\s\"'<>]*\.stl"), "model://meshes/cube.stl"),
    (re.compile(r"(?:package|model|file)://[^\s\"'<>]*\.dae"), "model://meshes/parts_z_up.dae"),
    (re.compile(r"(?:package|model|file)://[^\s\"'<>]*\.(?:png|jpg)"), "model://images/grey8.png"),
    (re.compile(r"(?<=<uri>)model://(?!sun|ground_plane)\w+(?=</uri>)"), "model://valid.xml"),
)
MESH_LETTERS = {".stl": b"s", ".obj": b"o", ".dae": b"d", ".ply": b"p", ".gltf": b"g", ".glb": b"b"}
IMAGES = (".png", ".jpg", ".tif", ".tga", ".bmp")

# Endings of files, and the targets whose seeds they are.
BY_ENDING: Tuple[Tuple[str, Tuple[str, ...]], ...] = (
    (".world", ("world", "simulate")),
    (".sdf", ("model", "simulate")),
    (".urdf", ("urdf", "simulate")),
    (".material", ("material",)),
    (".geofence", ("gps",)),
    ("plots.xacro", ("gps",)),
    *((ending, ("mesh",)) for ending in MESH_LETTERS),
    *((ending, ("image",)) for ending in IMAGES),
)
# Folders of YAML files, and the targets that read them.
YAML_FOLDERS = {
    "ardee_bridge/config": ("settings",),
    "ardee_models/config": ("yaml",),
    "ardee_models/config/species": ("yaml",),
    "ardee_world/fields": ("field", "yaml"),
    "ardee_world/terrains": ("recipe", "yaml"),
}


def repository_files() -> Iterator[pathlib.Path]:
    """Returns files of the packages and of the system tests, without earlier findings of the fuzzers."""
    for top in ("src", "tests"):
        for path in sorted((ROOT / top).rglob("*")):
            is_corpus = "fuzz" in path.relative_to(ROOT).parts
            if path.is_file() and not path.is_symlink() and not is_corpus:
                yield path


def small_xml(data: bytes) -> bytes:
    """Returns XML without comments and white space, with stand-ins for referenced files; unchanged if broken."""
    try:
        root = tree.fromstring(data)
    except tree.ParseError:
        return data
    for element in root.iter():
        element.text = (element.text or "").strip()
        element.tail = None
    text = tree.tostring(root, encoding="unicode")
    for pattern, stand_in in STAND_INS:
        text = pattern.sub(stand_in, text)
    return text.encode()


def from_files() -> Iterator[Tuple[str, str, bytes]]:
    """Yields target, name and bytes of each seed that is a file of the repository."""
    for path in repository_files():
        for ending, targets in BY_ENDING:
            if path.name.endswith(ending):
                data = MESH_LETTERS.get(path.suffix, b"") + path.read_bytes()
                data = data if path.suffix in (*MESH_LETTERS, *IMAGES) else small_xml(data)
                yield from ((target, path.name, data) for target in targets)
    for folder, targets in YAML_FOLDERS.items():
        for path in sorted((ROOT / "src" / folder).glob("*.yaml")):
            yield from ((target, path.name, path.read_bytes()) for target in targets)


def expanded(path: pathlib.Path, *arguments: str) -> bytes:
    """Returns the URDF that a xacro file gives."""
    xacro = shutil.which("xacro") or str(ROOT / "compat/xacro/scripts/xacro")
    environment = {**os.environ, "ROS_PACKAGE_PATH": str(ROOT / "src")}
    command = [xacro, str(path), *arguments]
    return subprocess.run(command, env=environment, check=True, stdout=subprocess.PIPE).stdout


def robots() -> Iterator[Tuple[str, bytes]]:
    """Yields the shipped robots, and each sensor on a post."""
    for path in sorted(ROOT.glob("src/terrasentia_description/robots/*.xacro")):
        yield path.name, expanded(path)
    sensors = ROOT / "src/ardee_sensors"
    for path in sorted(sensors.glob("urdf/*.urdf.xacro")):
        name = path.name.partition(".")[0]
        if name != "all_sensors":
            post = sensors / "robots/show_sensor.urdf.xacro"
            yield name, expanded(post, f"sensor:={name}")


def from_robots() -> Iterator[Tuple[str, str, bytes]]:
    """Yields the same for robots; the output of their macros is cut to the plugins, once for each."""
    for name, data in robots():
        small = small_xml(data)
        yield "urdf", name, small
        yield "simulate", name, small
        for number, plugin in enumerate(tree.fromstring(small).iter("plugin")):
            if "gps" in plugin.get("filename", ""):
                yield "gps", f"{name}_{number}", tree.tostring(plugin)


def words_of_cpp() -> Iterable[str]:
    """Returns names in the string literals of the readers and devices: elements, attributes, plugins, words."""
    for folder in ("readers", "devices", "controllers"):
        for path in sorted((ROOT / "src/ardee_sim_cpp/ardee_sim" / folder).glob("*.cpp")):
            text = path.read_text()
            yield from re.findall(r"\"([A-Za-z_][\w.:]+)\"", text)
            for table in re.findall(r"R\"\((.*?)\)\"", text, re.DOTALL):
                yield from re.findall(r"[A-Za-z_][\w:]*\w", table)


def words_of_python() -> Iterable[str]:
    """Returns keys of YAML files: fields that are options, and keys that a reader looks up."""
    for path in sorted(ROOT.glob("src/*/src/**/*.py")):
        text = path.read_text()
        yield from re.findall(r"^    (\w+): .* = (?:option|group)\(", text, re.MULTILINE)
        yield from re.findall(r"reader\.\w+\(\"(\w+)\"", text)


def dictionary(words: Iterable[str]) -> str:
    """Returns the words in libFuzzer's form, each once."""
    return "".join(f'"{word}"\n' for word in sorted(set(words)))


def write(folder: pathlib.Path) -> Dict[str, int]:
    """Writes all seeds; returns how many seeds each target has."""
    counts: Dict[str, int] = {}
    for target, name, data in (*from_files(), *from_robots()):
        if len(data) <= LONGEST_BYTES:
            path = folder / "seeds" / target / f"{counts.get(target, 0):03}_{name}"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
            counts[target] = counts.get(target, 0) + 1
    (folder / "cpp.dict").write_text(dictionary(words_of_cpp()))
    (folder / "python.dict").write_text(dictionary(words_of_python()))
    return counts


def main(arguments: List[str]) -> int:
    """Writes the seeds into the folder of the command line."""
    if len(arguments) != 1:
        print(__doc__)
        return 2
    for target, count in sorted(write(pathlib.Path(arguments[0])).items()):
        print(f"{target}: {count}")
    return 0


if __name__ == "__main__":
    raise SystemExit(main(sys.argv[1:]))
