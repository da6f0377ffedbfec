#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Write the source of the documentation site: the pages of docs/ and reference pages made from the code."""
import argparse
import dataclasses
import inspect
import os
import re
import shutil
import subprocess
import sys
import typing
import xml.etree.ElementTree as xml
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any, Dict, Iterable, Iterator, List, Tuple

from ardee_bridge.nodes import settings
from ardee_common.options import kind_of, range_text, unit_of
from ardee_models.config_dir import config_dir
from ardee_models.plant.species import SpeciesFile
from ardee_models.terrain.recipe import Recipe
from ardee_navigation.evaluation.scenario_files import Scenario
from ardee_navigation.lbirnt import Parameters
from ardee_world import clutter_models
from ardee_world.request import groups
from ardee_world.start import Start

ROOT = Path(__file__).resolve().parents[1]
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)#\s]+)(#[^)\s]*)?\)")
# Files of the tree that are pages of the site, beside docs/ and the READMEs of packages.
PAGES = {
    "src/ardee_bridge/docs/wire_format.md": "reference/wire_format.md",
    "README.md": "index.md",
}
CPP_COMMANDS = ("simulator", "spawn_model", "render_world")  # others: scripts/ of packages
FOR_BUILDING = (
    "generate_wire_files",
)  # commands that write files of the tree and take no argument
HELP_SECONDS = 60
API = {
    "ardee_common": "src/ardee_common/src/ardee_common",
    "ardee_models": "src/ardee_models/src/ardee_models",
    "ardee_navigation.lbirnt": "src/ardee_navigation/src/ardee_navigation/lbirnt",
    "ardee_bridge.wire": "src/ardee_bridge/src/ardee_bridge/wire",
}
# Title, what the keys are of, and the dataclass that reads them.
FILES = (
    ("Start of a robot", "`<field>.start.yaml` and `<world>.start.yaml`", Start),
    ("Terrain", "a recipe of `rosrun ardee_models generate_terrain RECIPE.yaml`", Recipe),
    ("Species", "`config/species/*.yaml` of ardee_models, with the numbers' sources", SpeciesFile),
    ("Row follower", "`parameters:=FILE`, `--parameters FILE`", Parameters),
    ("Scenario", "an entry of `config/scenarios.yaml` of ardee_navigation", Scenario),
    ("Sensor server", "`config/sensor_server.yaml` of ardee_bridge", settings.ServerSettings),
    ("Sensor server: a GPS among its sources", "", settings.GpsSource),
    ("Sensor server: a camera among its sources", "", settings.ImageSource),
    ("Sensor server: a cloud among its sources", "", settings.CloudSource),
    ("Controls client", "`config/controls_client.yaml` of ardee_bridge", settings.ControlSettings),
)
NOTE = "<!-- Made by docs/generate_reference.py. -->\n\n"


def table(head: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    """Returns a Markdown table."""
    lines = [list(head)] + [list(row) for row in rows]
    lines.insert(1, ["---"] * len(lines[0]))
    cells = (
        " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in row) for row in lines
    )
    return "\n".join(f"| {row} |" for row in cells) + "\n"


def code(text: Any) -> str:
    """Returns a text as code within a line, or nothing."""
    return f"`{text}`" if str(text) else ""


def page_of(file: Path) -> str:
    """Returns the page of the site that shows a file of the tree, or nothing."""
    name = file.relative_to(ROOT).as_posix() if ROOT in file.parents else ""
    if name.startswith("docs/"):
        return name[len("docs/") :]
    if re.fullmatch(r"(src|compat)/.*README\.md", name):
        return (
            "reference/packages/"
            + name[: -len("/README.md")].split("/", 1)[1].replace("/", "_")
            + ".md"
        )
    return PAGES.get(name, "")


def relinked(text: str, file: Path) -> str:
    """Returns the text of a Markdown file with links to pages of the site; others become plain names."""

    def replaced(link: "re.Match[str]") -> str:
        mark, words, target, anchor = link.groups()
        if ":" in target:
            return link[0]
        page = page_of(Path(os.path.normpath(file.parent / target)))
        here = Path(page_of(file)).parent
        if page:
            return f"{mark}[{words}]({os.path.relpath(page, here)}{anchor or ''})"
        return words if words.strip("`") in target else f"{words} (`{target}`)"

    return LINK.sub(replaced, text)


def documents() -> Iterator[Tuple[str, str]]:
    """Pages that are files of the tree: page, text."""
    readmes = sorted(ROOT.glob("src/ardee_*/**/README.md")) + sorted(
        ROOT.glob("src/terrasentia_*/README.md")
    )
    for file in [
        *readmes,
        *sorted(ROOT.glob("compat/*/README.md")),
        ROOT / "src/ardee_bridge/docs/wire_format.md",
    ]:
        yield page_of(file), relinked(file.read_text(), file)


def launch_files() -> str:
    """The page of launch files and their arguments."""
    parts = ["# Launch files\n\n`roslaunch PACKAGE FILE NAME:=VALUE ...`\n"]
    for file in sorted([*ROOT.glob("src/*/launch/*.launch"), *ROOT.glob("launch/*.launch")]):
        given = [
            arg
            for arg in xml.parse(file).getroot().iter("arg")
            if arg.get("doc") and not arg.get("value")
        ]
        package = file.relative_to(ROOT / "src").parts[0] if ROOT / "src" in file.parents else ""
        start = (
            f"roslaunch {package} {file.name}" if package else f"roslaunch {file.relative_to(ROOT)}"
        )
        rows = (
            (code(arg.get("name")), code(arg.get("default", "")), arg.get("doc")) for arg in given
        )
        parts.append(f"## {package or 'the workspace'}: {file.name}\n\n`{start}`\n\n")
        parts.append(table(("argument", "default", "meaning"), rows) + "\n")
    return "".join(parts)


def commands() -> Dict[str, List[str]]:
    """Commands of packages and of the workspace, by what a person types."""
    found = {}
    for package in sorted(path.parent for path in ROOT.glob("src/*/scripts")):
        if not package.is_symlink():
            for script in sorted((package / "scripts").iterdir()):
                if (
                    os.access(script, os.X_OK)
                    and script.is_file()
                    and "." not in script.name
                    and script.name not in FOR_BUILDING
                ):
                    found[f"rosrun {package.name} {script.name}"] = ["-h"]
    found.update({f"rosrun ardee_sim_cpp {name}": ["-h"] for name in CPP_COMMANDS})
    scripts = (
        path
        for path in sorted((ROOT / "scripts").iterdir())
        if path.is_file() and "." not in path.name
    )
    found.update({f"scripts/{script.name}": ["-h"] for script in scripts})
    return found


def help_of(command: str) -> str:
    """What a command prints with -h."""
    environment = dict(os.environ, COLUMNS="100")
    words = [*command.split(), "-h"]
    run = subprocess.run(
        words,
        cwd=ROOT,
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        stdin=subprocess.DEVNULL,
        timeout=HELP_SECONDS,
        check=False,
    )
    text = run.stdout.decode().strip("\n").replace(str(ROOT) + "/", "")
    if run.returncode != 0 or not text:
        raise SystemExit(
            f"{' '.join(words)}: found exit code {run.returncode}, expected help:\n{text}"
        )
    return text


def command_page() -> str:
    """The page of commands with their help."""
    parts = [
        "# Commands\n\nWhat each command prints with `-h`. Exit code 0: done; 2: a bad argument or file, in one line.\n"
    ]
    names = list(commands())
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, text in zip(names, pool.map(help_of, names)):
            parts.append(f"\n## {name}\n\n```text\n{text}\n```\n")
    return "".join(parts)


def messages() -> str:
    """The page of messages and services of ARDEE's own."""
    parts = [
        "# Messages and services\n\nThose of ARDEE's own, package `ardee_msgs`; all others are ROS's standard ones.\n"
    ]
    for file in [
        *sorted(ROOT.glob("src/ardee_msgs/msg/*")),
        *sorted(ROOT.glob("src/ardee_msgs/srv/*")),
    ]:
        parts.append(f"\n## ardee_msgs/{file.stem}\n\n```text\n{file.read_text().strip()}\n```\n")
    return "".join(parts)


def comment_of(cls: type, name: str) -> str:
    """Returns the comment behind a field in the class's source."""
    found = re.search(rf"^    {name}:.*?#\s*(.*)$", inspect.getsource(cls), re.MULTILINE)
    return found[1] if found else ""


def kind_text(kind: Any) -> str:
    """Returns the name of a field's type."""
    plain = {str: "text", float: "number", int: "whole number", bool: "true or false", Any: "any"}
    if typing.get_origin(kind) is tuple:
        items = typing.get_args(kind)
        return (
            "list of " + kind_text(items[0]) + ("" if items[-1] is Ellipsis else f", {len(items)}")
        )
    return plain.get(kind, getattr(kind, "__name__", str(kind)))


def rows_of(cls: type, prefix: str = "") -> Iterator[Tuple[str, str, str, str, str]]:
    """Rows of keys: name, default, values, unit, meaning; nested groups follow with their prefix."""
    for field in dataclasses.fields(cls):
        kind = kind_of(cls, field)
        nested = kind if dataclasses.is_dataclass(kind) else field.metadata.get("group")
        if inspect.isclass(nested):
            yield from rows_of(
                nested, f"{prefix}{field.name}{'[].' if nested is not kind else '.'}"
            )
            continue
        missing = field.default is dataclasses.MISSING
        default = (
            "" if missing or field.default in (None, ()) else code(str(field.default).strip("()"))
        )
        limits, choices = field.metadata.get("limits"), field.metadata.get("choices")
        values = field.metadata.get("expected") or kind_text(kind)
        if limits:
            values += ", " + range_text(limits, "")
        if choices:
            values = ", ".join(choices)
        text = field.metadata.get("text") or comment_of(cls, field.name)
        yield code(prefix + field.name), default, values, unit_of(field.name), text


def yaml_keys() -> str:
    """The page of keys of YAML files."""
    head = ("key", "default", "values", "unit", "meaning")
    parts = [
        "# Keys of YAML files\n\nAn unknown key or a value out of its limits is refused with file and line. ",
        "`a.b` is the key `b` of the mapping `a`; `a[].b` that of each entry of the list `a`. ",
        "A key without a default has to be given, or is off.\n\n## Field\n\n",
        "A file of `rosrun ardee_world generate_field FIELD.yaml`.\n\n",
    ]
    fields = [field for cls in groups().values() for field in rows_of(cls)]
    shown = {row[0]: row for row in fields if "." not in row[0]}
    parts.append(table(head, shown.values()))
    for title, what, cls in FILES:
        about = f"Keys of {what}. " if what else ""
        parts.append(f"\n## {title}\n\n{about}{inspect.getdoc(cls)}\n\n{table(head, rows_of(cls))}")
    return "".join(parts)


def labels() -> str:
    """The page of labels."""
    found = {0: "nothing"}
    for file in sorted((config_dir() / "species").glob("*.yaml")):
        found[int(re.search(r"^label: (\d+)", file.read_text(), re.MULTILINE)[1])] = file.stem
    for name, model in clutter_models.MODELS.items():
        found.setdefault(model.label, name.split("_")[0])
    rows = [(str(label), name) for label, name in sorted(found.items())]
    text = (
        "# Labels\n\nThe class of what a ray hits: in label images of cameras, the field `label` of lidar clouds, `truth.csv`, "
        "`clutter.csv`, and `<ardee:label>` of worlds.\n\n"
    )
    return text + table(
        ("label", "is"), [*rows, (f"{max(found) + 1} to 65535", "free for your own models")]
    )


def python_api() -> Iterator[Tuple[str, str]]:
    """Pages of the Python API, a package each."""
    for package, folder in API.items():
        modules = [package]
        for file in sorted((ROOT / folder).rglob("*.py")):
            name = ".".join(file.relative_to(ROOT / folder).with_suffix("").parts)
            if not name.endswith("__init__") and not name.endswith("build"):
                modules.append(f"{package}.{name}")
        parts = [f"# {package}\n"]
        for module in modules:
            title = f"\n## {module}\n" if module != package else ""
            parts.append(f"{title}\n```{{eval-rst}}\n.. automodule:: {module}\n   :members:\n```\n")
        yield f"reference/python/{package.replace('.', '_')}.md", "".join(parts)


def cpp_library() -> str:
    """The page of the C++ library's headers."""
    parts = [
        "# C++ library\n\n`find_package(ardee_sim)`, link `ardee_sim::ardee_sim`; no ROS in it. The first sentence of each header "
        "says what it holds; the header is the reference.\n"
    ]
    base = ROOT / "src/ardee_sim_cpp/ardee_sim"
    for module in sorted(path for path in base.iterdir() if path.is_dir()):
        rows = []
        for header in sorted(module.rglob("*.h")):
            said = re.search(
                r"^((?:///.*\n)+)(?:template.*\n)?(?:class|struct|enum|inline|\[\[|[\w:<>]+ \w)",
                header.read_text(),
                re.MULTILINE,
            )
            text = " ".join(line.strip("/ ") for line in said[1].splitlines()) if said else ""
            text = re.split(r"(?<=\.)\s", text)[0].replace("<", "\\<")
            rows.append((code(f"ardee_sim/{header.relative_to(base)}"), text))
        if rows:
            parts.append(f"\n## {module.name}\n\n{table(('header', 'holds'), rows)}")
    return "".join(parts)


def main() -> int:
    """Runs the command; returns its exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "folder", type=Path, metavar="FOLDER", help="folder to write, replaced if it is there"
    )
    folder = parser.parse_args().folder
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(
        ROOT / "docs",
        folder,
        ignore=shutil.ignore_patterns("conf.py", Path(__file__).name, "__pycache__"),
    )
    for page in sorted(folder.rglob("*.md")):
        source = ROOT / "docs" / page.relative_to(folder)
        page.write_text(relinked(source.read_text(), source))
    made = {
        "launch_files": launch_files(),
        "commands": command_page(),
        "messages": messages(),
        "yaml_keys": yaml_keys(),
        "labels": labels(),
        "cpp_library": cpp_library(),
    }
    for page, text in [
        *((f"reference/{name}.md", text) for name, text in made.items()),
        *documents(),
        *python_api(),
    ]:
        (folder / page).parent.mkdir(parents=True, exist_ok=True)
        (folder / page).write_text(NOTE + text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
