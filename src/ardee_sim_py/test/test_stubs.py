# SPDX-License-Identifier: MIT
"""Tests that the types of the extension, _core.pyi, name what it has."""
import os
import pathlib
import subprocess
import sys

import pytest

# pybind11 gives its classes a metaclass, and those that Python cannot make an __init__ that raises.
CLASSES = ("Description", "Model", "Simulation", "World")
ALLOWED = (*CLASSES, *(f"{name}.__init__" for name in CLASSES if name != "Simulation"))


PACKAGES = pathlib.Path(__file__).resolve().parents[2]
CONFIG = PACKAGES.parent / "pyproject.toml"  # missing types of libraries are no error
SOURCES = os.pathsep.join(str(PACKAGES / name / "src") for name in ("ardee_sim_py", "ardee_common"))


@pytest.mark.slow
def test_the_stubs_agree_with_the_extension(tmp_path: pathlib.Path) -> None:
    allowed = tmp_path / "allowed"
    allowed.write_text("".join(f"ardee_sim._core.{name}\n" for name in ALLOWED))
    command = [sys.executable, "-m", "mypy.stubtest", "ardee_sim._core", "--allowlist", allowed]
    command += ["--mypy-config-file", CONFIG]
    env = {**os.environ, "MYPYPATH": SOURCES}
    pipes = dict(stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    done = subprocess.run(command, env=env, **pipes)
    assert done.returncode == 0, done.stdout
