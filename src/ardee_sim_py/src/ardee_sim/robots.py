# SPDX-License-Identifier: MIT
"""Robots' descriptions: expands xacro without ROS."""

import os
import re
import subprocess
import sys
from pathlib import Path
from typing import List, Union

from ardee_sim import checks
from ardee_sim.errors import ArdeeError
from ardee_sim.packages import find_package
from ardee_sim.world import PathLike, read_text

_FILE = re.compile(r"""(\bfilename\s*=\s*["']|<uri>)([^"'<:]+)(?=["'<])""")


def _xacro_file(name_or_path: PathLike) -> Path:
    path = Path(checks.path(name_or_path, "name_or_path"))
    if os.path.isfile(path):  # False of a name that is too long, too
        return path
    robots = find_package("terrasentia_description") / "robots"
    shipped = robots / f"{name_or_path}.urdf.xacro"
    if os.path.isfile(shipped):
        return shipped
    names = ", ".join(sorted(file.name[: -len(".urdf.xacro")] for file in robots.glob("*.xacro")))
    raise ArdeeError(f"found no robot '{name_or_path}', expected a file or one of: {names}")


def robot(name_or_path: PathLike, **xacro_arguments: Union[str, float, bool]) -> str:
    """Returns the URDF of a shipped robot, such as tsv1_default, or of an .urdf, .sdf or .xacro file of yours.

    xacro_arguments : values of the file's <xacro:arg>, as name:=value on a command line.
    Raises ArdeeError with xacro's message if the file cannot be expanded, or has no such argument.
    """
    path = _xacro_file(name_or_path)
    if path.suffix != ".xacro":
        if xacro_arguments:
            raise ArdeeError(f"{path}: found xacro arguments for a file that is not .xacro")
        return _with_whole_paths(read_text(path), path.resolve().parent)
    arguments = [f"{key}:={_text(value)}" for key, value in xacro_arguments.items()]
    return _with_whole_paths(_expand(path, arguments), path.resolve().parent)


def _with_whole_paths(text: str, folder: Path) -> str:
    """Returns a description that can be read anywhere: files beside that of the robot are given by their paths."""

    def whole(found: "re.Match[str]") -> str:
        file = folder / found[2].strip()
        return f"{found[1]}{file}" if os.path.isfile(file) else found[0]

    return _FILE.sub(whole, text)


def _text(value: Union[str, float, bool]) -> str:
    text = str(value).lower() if isinstance(value, bool) else str(value)
    return checks.text(text, "xacro argument")


def _expand(path: Path, arguments: List[str]) -> str:
    # xacro keeps its state in globals of its module: each file has a process of its own, which imports what this one
    # does, and nothing from the current folder
    command = [sys.executable, "-P", "-m", "ardee_sim._expand_xacro", str(path), *arguments]
    env = {**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    done = subprocess.run(command, capture_output=True, text=True, env=env)
    if done.returncode != 0:
        raise ArdeeError(done.stderr.strip() or f"{path}: xacro failed")
    return done.stdout
