# SPDX-License-Identifier: MIT
"""Runs xacro on files of this tree, built or not, and reads URDF."""
import os
import pathlib
import subprocess

import numpy as np

SOURCES = pathlib.Path(__file__).resolve().parents[2]
XACRO = SOURCES.parent / "compat/xacro/scripts/xacro"
STL_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])


def ros_environment() -> dict:
    """Returns an environment in which rospkg finds the packages of this tree, whatever is sourced."""
    paths = [os.environ.get("ROS_PACKAGE_PATH", ""), str(SOURCES), str(SOURCES.parent / "compat")]
    path = "/usr/bin" + os.pathsep + os.environ.get("PATH", "")
    return dict(os.environ, ROS_PACKAGE_PATH=os.pathsep.join(p for p in paths if p), PATH=path)


def run_xacro(file: pathlib.Path, **arguments: str) -> subprocess.CompletedProcess:
    """Runs xacro on the file with `name:=value` arguments."""
    command = ["/usr/bin/python3", str(XACRO), str(file)]
    command += [f"{name}:={value}" for name, value in arguments.items()]
    return subprocess.run(command, env=ros_environment(), capture_output=True, text=True)


def expand(file: pathlib.Path, **arguments: str) -> str:
    """Returns the URDF text that xacro makes of the file; any output on stderr is a failure."""
    done = run_xacro(file, **arguments)
    assert done.returncode == 0 and not done.stderr, f"code {done.returncode}: {done.stderr}"
    return done.stdout


def mesh_path(uri: str) -> pathlib.Path:
    """Returns the file of a package:// URI in this tree."""
    prefix = "package://"
    assert uri.startswith(prefix), f"{uri}: expected package://<package>/<path>"
    return SOURCES / uri[len(prefix) :]


def read_stl(path: pathlib.Path) -> np.ndarray:
    """Returns triangles (n, 3, 3) of a binary STL file, m."""
    data = path.read_bytes()
    records = np.frombuffer(data[84:], STL_RECORD)
    assert len(records) == int.from_bytes(data[80:84], "little"), f"{path}: wrong triangle count"
    return records["corners"].astype(float)
