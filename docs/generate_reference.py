#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Write the source of the documentation site: the pages of docs/ and reference pages made from the code."""
import argparse
import inspect
import os
import re
import shutil
import signal
import subprocess
import sys
import xml.etree.ElementTree as xml
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Iterator, List, Tuple

import yaml_keys
from markdown_text import code, table

from ardee_models.config_dir import config_dir
from ardee_world import clutter_models

ROOT = Path(__file__).resolve().parents[1]
LINK = re.compile(r"(!?)\[([^\]]*)\]\(([^)#\s]+)(#[^)\s]*)?\)")
# Files of the tree that are pages of the site, beside docs/ and the READMEs of packages.
PAGES = {
    "src/ardee_bridge/docs/wire_format.md": "reference/wire_format.md",
    "README.md": "index.md",
}
CPP_COMMANDS = ("simulator", "spawn_model", "render_world")  # others: scripts/ of packages
FOR_BUILDING = ("generate_wire_files",)  # takes no argument
HELP_SECONDS = 60
API = {
    "ardee_sim": "src/ardee_sim_py/src/ardee_sim",
    "ardee_common": "src/ardee_common/src/ardee_common",
    "ardee_models": "src/ardee_models/src/ardee_models",
    "ardee_navigation.lane_following": "src/ardee_navigation/src/ardee_navigation/lane_following",
    "ardee_navigation.lbirnt": "src/ardee_navigation/src/ardee_navigation/lbirnt",
    "ardee_navigation.vision": "src/ardee_navigation/src/ardee_navigation/vision",
    "ardee_datasets": "src/ardee_datasets/src/ardee_datasets",
    "ardee_campaigns": "src/ardee_campaigns/src/ardee_campaigns",
    "ardee_bridge.wire": "src/ardee_bridge/src/ardee_bridge/wire",
}
NOT_PAGES = ("conf.py", "generate_reference.py", "yaml_keys.py", "markdown_text.py", "__pycache__")
ENVIRONMENTS = "envs.environments"  # has a page of its own
COMMANDS = """# Commands

What each command prints with `-h`. The commands speak one language: an argument ends in its unit
(`--row-spacing-m`, `--speed-m-s`), and where a YAML file can give it too, the key is the same with underscores
(`row_spacing_m`). `--output` is the file or folder to write, `--seed` the root of all random numbers, `--model-path` a
folder of models before those of `GAZEBO_MODEL_PATH`. What a command made, or its path, is on standard output; progress,
warnings and what to do next are on standard error.

| exit code | means |
|---|---|
| 0 | it is done; or a node was told to end, by Ctrl-C too |
| 1 | good arguments, but what was measured or run was not: a value outside its range, a robot that does not answer |
| 2 | an argument or file is not usable: one line says where, what was found and expected; nothing is written |
| 3 | the ROS master was started anew and knows the node no more |
| 130 | Ctrl-C ended the work before it was done: what was complete stays, what was half-made is removed |

Work of more than three seconds shows on standard error how far it is.
"""
LABELS = """# Labels

The class of what a ray hits: in label images of cameras, the field `label` of lidar clouds, `truth.csv`,
`clutter.csv`, and `<ardee:label>` of worlds.

"""
ENVIRONMENTS_HEAD = """# Environments

`import gymnasium, ardee_sim.envs` registers them; needs Gymnasium (`scripts/setup` installs it for this workspace).
Arguments of `gymnasium.make` that all of them take are those of
[FieldEnv](python/ardee_sim.md). [Tutorial 8](../tutorials/8_learn_to_drive.md) uses one.
"""
CAMPAIGN_TABLES = """# Tables of a campaign

Parquet files in the output folder of `rosrun ardee_campaigns run_campaign`, read by `ardee_campaigns.tables`, pandas
and others. `runs.parquet` has a column `factor_NAME` for each factor before `replicate`, and one for each measure at
its end. `runs/RUN_ID.parquet` is all that one run left: its samples without `run_id`, and the lidar's returns abeam,
`raw_along_m` and `raw_lateral_m`. A number that is not known is NaN.
"""
CPP_LIBRARY = """# C++ library

`find_package(ardee_sim)`, link `ardee_sim::ardee_sim`; no ROS in it. The first sentence of each header says what it
holds; the header is the reference.
"""
# The comment above the first type or function of a header.
CPP_COMMENT = re.compile(
    r"^((?:///.*\n)+)(?:template.*\n)?(?:class|struct|enum|inline|\[\[|[\w:<>]+ \w)", re.MULTILINE
)
NOTE = "<!-- Made by docs/generate_reference.py. -->\n\n"


def page_of(file: Path) -> str:
    """Returns the page of the site that shows a file of the tree, or nothing."""
    name = file.relative_to(ROOT).as_posix() if ROOT in file.parents else ""
    if name.startswith("docs/"):
        return name[len("docs/") :]
    if re.fullmatch(r"(src|compat)/.*README\.md", name):
        folder = name.split("/", 1)[1].rpartition("/")[0]
        return f"reference/packages/{folder.replace('/', '_')}.md"
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
    patterns = ("src/ardee_*/**/README.md", "src/terrasentia_*/README.md", "compat/*/README.md")
    found = [file for pattern in patterns for file in sorted(ROOT.glob(pattern))]
    for file in [*found, ROOT / "src/ardee_bridge/docs/wire_format.md"]:
        yield page_of(file), relinked(file.read_text(), file)


def launch_files() -> str:
    """The page of launch files and their arguments."""
    parts = ["# Launch files\n\n`roslaunch PACKAGE FILE NAME:=VALUE ...`\n"]
    for file in sorted(ROOT.glob("src/*/launch/*.launch")):
        place = file.relative_to(ROOT)
        start = f"{place.parts[1]} {file.name}"
        rows = []
        for arg in xml.parse(file).getroot().iter("arg"):
            if arg.get("doc") and not arg.get("value"):
                rows.append((code(arg.get("name")), arg.get("doc"), code(arg.get("default", ""))))
        parts.append(f"\n## {start}\n\n{table(('argument', 'meaning', 'default'), rows)}")
    return "".join(parts)


def is_command(file: Path) -> bool:
    """Returns whether a file is a program that a person calls by name."""
    is_named = "." not in file.name and file.name not in FOR_BUILDING
    return is_named and file.is_file() and os.access(file, os.X_OK)


def commands() -> List[str]:
    """Commands of packages and of the workspace, as a person types them."""
    scripts = [file for file in sorted(ROOT.glob("src/*/scripts/*")) if is_command(file)]
    ours = {f.name: f for f in reversed(scripts) if not f.parents[1].is_symlink()}  # once a name
    found = [f"rosrun {f.parents[1].name} {f.name}" for f in sorted(ours.values())]
    found += [f"rosrun ardee_sim_cpp {name}" for name in CPP_COMMANDS]
    return found + [f"scripts/{f.name}" for f in sorted(ROOT.glob("scripts/*")) if is_command(f)]


def help_of(command: str) -> str:
    """Returns what a command prints with -h."""
    words, env = [*command.split(), "-h"], dict(os.environ, COLUMNS="100")
    if words[0] == "rosrun":  # which looks for the program for a second
        _, package, program, flag = words
        script = ROOT / "src" / package / "scripts" / program
        built = ROOT / "devel" / "lib" / package / program
        words = [str(script if script.is_file() else built), flag]
    out, err, none = subprocess.PIPE, subprocess.STDOUT, subprocess.DEVNULL
    run = subprocess.run(
        words, cwd=ROOT, env=env, stdout=out, stderr=err, stdin=none, timeout=HELP_SECONDS
    )
    text = run.stdout.decode().strip("\n").replace(f"{ROOT}/", "")
    if run.returncode != 0 or not text:
        raise SystemExit(f"{command} -h: found exit code {run.returncode}, expected help: {text}")
    return text


def command_page() -> str:
    """The page of commands with their help."""
    parts = [COMMANDS]
    names = commands()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        for name, text in zip(names, pool.map(help_of, names)):
            parts.append(f"\n## {name}\n\n```text\n{text}\n```\n")
    return "".join(parts)


def messages() -> str:
    """The page of messages and services of ARDEE's own."""
    parts = [
        "# Messages and services\n\nThose of ARDEE's own, package `ardee_msgs`; all others are "
    ]
    parts.append("ROS's standard ones.\n")
    for file in sorted([*ROOT.glob("src/ardee_msgs/msg/*"), *ROOT.glob("src/ardee_msgs/srv/*")]):
        parts.append(f"\n## ardee_msgs/{file.stem}\n\n```text\n{file.read_text().strip()}\n```\n")
    return "".join(parts)


def labels() -> str:
    """The page of labels."""
    found = {0: "nothing"}
    for file in sorted((config_dir() / "species").glob("*.yaml")):
        found[int(re.search(r"^label: (\d+)", file.read_text(), re.MULTILINE)[1])] = file.stem
    for name, model in clutter_models.MODELS.items():
        found.setdefault(model.label, name.split("_")[0])
    rows = [(str(label), name) for label, name in sorted(found.items())]
    rows.append((f"{max(found) + 1} to 65535", "free for your own models"))
    return LABELS + table(("label", "is"), rows)


def python_api() -> Iterator[Tuple[str, str]]:
    """Pages of the Python API, a package each."""
    for package, folder in API.items():
        modules = [package]
        for file in sorted((ROOT / folder).rglob("*.py")):
            name = ".".join(file.relative_to(ROOT / folder).with_suffix("").parts)
            is_private = file.name.startswith("_")
            if not is_private and not name.endswith("build") and name != ENVIRONMENTS:
                modules.append(f"{package}.{name}")
        parts = [f"# {package}\n"]
        for module in modules:
            title = f"\n## {module}\n" if module != package else ""
            parts.append(f"{title}\n```{{eval-rst}}\n.. automodule:: {module}\n   :members:\n```\n")
        yield f"reference/python/{package.replace('.', '_')}.md", "".join(parts)


def environments() -> str:
    """The page of Gymnasium's environments: their docstrings, which are Markdown."""
    from ardee_sim.envs import environments as module

    parts = [ENVIRONMENTS_HEAD]
    for env in vars(module).values():
        text = inspect.getdoc(env) or ""
        if text.startswith("ardee/"):
            name, _, about = text.partition(": ")
            parts.append(
                re.sub(r"^(.+)\n-{3,}$", r"### \1", f"\n## {name}\n\n{about}\n", flags=re.M)
            )
    return "".join(parts)


def campaign_tables() -> str:
    """The page of a campaign's tables and measures."""
    from ardee_campaigns import measures, tables

    parts, source = [CAMPAIGN_TABLES], inspect.getsource(tables)
    schemas = {
        tables.RUNS: tables.runs_schema({}, (), {}),
        tables.TIMINGS: tables.TIMING_SCHEMA,
        tables.SAMPLES: tables.SAMPLE_SCHEMA,
    }
    for name, schema in schemas.items():
        rows = []
        for field in schema:
            found = re.search(rf'\("{field.name}", .*?\),?  # (.*)$', source, re.MULTILINE)
            rows.append((code(field.name), str(field.type), found[1] if found else ""))
        parts.append(f"\n## {name}\n\n{table(('column', 'type', 'is'), rows)}")
    shipped = ((code(name), meaning) for name, (_, meaning) in measures.MEASURES.items())
    parts.append(f"\n## Measures\n\n{table(('name', 'is'), shipped)}")
    return "".join(parts)


def cpp_library() -> str:
    """The page of the C++ library's headers."""
    parts, base = [CPP_LIBRARY], ROOT / "src/ardee_sim_cpp/ardee_sim"
    for module in sorted(path for path in base.iterdir() if path.is_dir()):
        rows = []
        for header in sorted(module.rglob("*.h")):
            said = CPP_COMMENT.search(header.read_text())
            text = " ".join(line.strip("/ ") for line in said[1].splitlines()) if said else ""
            text = re.split(r"(?<=\.)\s", text)[0].replace("<", "\\<")
            rows.append((code(f"ardee_sim/{header.relative_to(base)}"), text))
        if rows:
            parts.append(f"\n## {module.name}\n\n{table(('header', 'holds'), rows)}")
    return "".join(parts)


def main() -> int:
    """Runs the command; returns its exit code. Ctrl-C ends it without a word."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument(
        "folder", type=Path, metavar="FOLDER", help="folder to write, replaced if it is there"
    )
    folder = parser.parse_args().folder
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(ROOT / "docs", folder, ignore=shutil.ignore_patterns(*NOT_PAGES))
    for page in sorted(folder.rglob("*.md")):
        source = ROOT / "docs" / page.relative_to(folder)
        page.write_text(relinked(source.read_text(), source))
    made = {
        "reference/launch_files.md": launch_files(),
        "reference/commands.md": command_page(),
        "reference/messages.md": messages(),
        "reference/yaml_keys.md": yaml_keys.page(),
        "reference/labels.md": labels(),
        "reference/cpp_library.md": cpp_library(),
        "reference/environments.md": environments(),
        "reference/campaign_tables.md": campaign_tables(),
    }
    for page, text in [*made.items(), *documents(), *python_api()]:
        (folder / page).parent.mkdir(parents=True, exist_ok=True)
        (folder / page).write_text(NOTE + text)
    return 0


if __name__ == "__main__":
    sys.exit(main())
