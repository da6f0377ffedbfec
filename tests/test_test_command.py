# SPDX-License-Identifier: MIT
"""Tests the counts of scripts/test --unit, in a checkout of two packages, one with a slow test, and one C++ test."""
import pathlib
import shutil
import subprocess
from typing import Tuple

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[1]


@pytest.fixture
def checkout(tmp_path: pathlib.Path) -> pathlib.Path:
    """Returns a checkout in which no setup or build is needed."""
    shutil.copytree(ROOT / "scripts", tmp_path / "scripts")
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    for name in ("setup", "build"):
        (tmp_path / "scripts" / name).write_text("#!/bin/sh\n")
    for folder in ("compat", "devel", "build_core/ardee_sim_cpp", "src/one/test", "src/two/test"):
        (tmp_path / folder).mkdir(parents=True)
    (tmp_path / "devel/setup.bash").touch()
    (tmp_path / "build_core/ardee_sim_cpp/CTestTestfile.cmake").write_text(
        'add_test(any "/bin/true")\n'
    )
    (tmp_path / "src/one/test/test_one.py").write_text("def test_left():\n    pass\n")
    slow = "import pytest\n@pytest.mark.slow\ndef test_slow():\n    assert False\n"
    (tmp_path / "src/two/test/test_two.py").write_text(
        f"{slow}def test_right():\n    assert False\n"
    )
    return tmp_path


@pytest.mark.parametrize(
    "arguments, code, last_line",
    [
        ([], 1, "2 passed, 1 failed"),
        (["--", "-k", "left"], 0, "2 passed, 0 failed"),
        (["--", "-k", "right"], 1, "1 passed, 1 failed"),
        (["--", "-k", "nowhere"], 1, "1 passed, 1 failed"),
    ],
)
def test_a_package_in_which_nothing_matches_has_not_failed(
    checkout: pathlib.Path, arguments: list, code: int, last_line: str
) -> None:
    assert run(checkout, *arguments) == (code, last_line)


def test_a_package_without_a_test_has_failed(checkout: pathlib.Path) -> None:
    (checkout / "src/one/test/test_one.py").write_text("")
    assert run(checkout) == (1, "1 passed, 2 failed")


def run(checkout: pathlib.Path, *arguments: str) -> Tuple[int, str]:
    """Returns exit code and last line of scripts/test --unit."""
    command = [str(checkout / "scripts/test"), "--unit", "-j", "1", *arguments]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    return done.returncode, done.stdout.splitlines()[-1]
