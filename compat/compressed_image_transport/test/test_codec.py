# SPDX-License-Identifier: MIT
"""Runs the tests of the codec, codec_test.cpp, as the workspace's build has made them."""
import pathlib
import re
import subprocess
from typing import List

import pytest

SOURCE = pathlib.Path(__file__).with_name("codec_test.cpp")
CASES = [
    "{}.{}".format(*case) for case in re.findall(r"^TEST\((\w+), (\w+)\)", SOURCE.read_text(), re.M)
]


@pytest.fixture(scope="module")
def command() -> List[str]:
    """The program; where ROS has a package of this name, this one is not built."""
    found = subprocess.run(
        ["catkin_find", "--libexec", "compressed_image_transport", "compressed_image_codec_test"],
        capture_output=True,
        text=True,
    ).stdout.split()
    link = SOURCE.parents[3] / "src" / "compressed_image_transport"
    if not found and not link.is_symlink():
        pytest.skip("ROS has a compressed_image_transport of its own")
    return found[:1]


@pytest.mark.parametrize("case", CASES)
def test_case(command: List[str], case: str) -> None:
    run = subprocess.run([*command, f"--gtest_filter={case}"], capture_output=True, text=True)
    assert run.returncode == 0 and "[  PASSED  ] 1 test." in run.stdout, run.stdout + run.stderr


def test_there_are_cases() -> None:
    assert len(CASES) >= 11
