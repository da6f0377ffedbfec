# SPDX-License-Identifier: MIT
"""Tests the demo ended by Ctrl-C on its way; test_install.py runs it to its end."""
import os
import pathlib
import signal
import subprocess
from typing import Set

from ardee_common.ros_graph import wait_until


def start(log: pathlib.Path) -> subprocess.Popen:
    env = {k: v for k, v in os.environ.items() if k not in ("DISPLAY", "ROS_MASTER_URI")}
    with log.open("wb") as output:
        return subprocess.Popen(
            ["rosrun", "ardee_bringup", "demo", "--output", str(log.parent / "output")],
            env=dict(
                env,
                ARDEE_DEMO_TEST=str(log),
                TMPDIR=str(log.parent),
                XDG_RUNTIME_DIR=str(log.parent.parent),  # else Qt makes one in TMPDIR
                PYTHONUNBUFFERED="1",
            ),
            stdout=output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )


def ours(log: pathlib.Path) -> Set[int]:
    """Returns processes of a demo started above, by the environment that they inherited."""
    found, marker = set(), f"ARDEE_DEMO_TEST={log}".encode()
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            if marker in (folder / "environ").read_bytes().split(b"\0"):
                found.add(int(folder.name))
        except OSError:
            continue
    return found


def test_ctrl_c_on_the_way_leaves_nothing(tmp_path: pathlib.Path) -> None:
    log = tmp_path / "demo.log"
    demo = start(log)
    wait_until(lambda: "m driven" in log.read_text(), "the robot on its way", 120.0)
    os.killpg(demo.pid, signal.SIGINT)
    assert demo.wait(60) == 128 + signal.SIGINT
    wait_until(lambda: not ours(log), "the demo's processes gone", 10.0)
    assert list(tmp_path.iterdir()) == [log]
