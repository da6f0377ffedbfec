# SPDX-License-Identifier: MIT
"""Long work shows on a terminal how far it is; Ctrl-C there ends it in a line and leaves nothing half-made behind."""
import os
import pathlib
import pty
import re
import select
import signal
import subprocess
from typing import Dict, NamedTuple

import pytest

from ardee_common.ros_graph import RosGraph, wait_until

ROOT = pathlib.Path(__file__).resolve().parents[1]
LATEST_S = 120.0  # until the work shows how far it is
END_S = 30.0
FIELD = "--models corn_variant_1 --rows-per-plot 700 --row-length-m 100 --name f --output ."


class Case(NamedTuple):
    """A command, what its terminal shows while it works, and its last line after Ctrl-C."""

    command: str
    progress: str
    last_line: str = "{name}: interrupted"
    exit_code: int = 130

    @property
    def name(self) -> str:
        words = self.command.split()
        return pathlib.Path(words[2] if words[0] == "rosrun" else words[0]).name


CASES = [
    Case(f"rosrun ardee_world generate_field {FIELD}", r"generate_field: \d+ s"),
    Case("tests/bench/latency_benchmark", r"latency_benchmark: \d+ s"),
    Case("rosrun ardee_models crop_report --output report", r"sheet: \d+ of 40"),
    Case("rosrun ardee_sensors sensor_report --output report", r"sensor_report: \d+ of \d+"),
    Case("scripts/camera_figure --output cameras.png", r"camera_figure: \d+ of \d+"),
    Case(
        "rosrun ardee_navigation run_experiment --scenario energy_farm --runs 2 --output report",
        r"run_experiment: \d+ s",
        "run_experiment: no run had ended, none is reported",
    ),
    Case(
        "rosrun ardee_navigation judge_lane tobacco --runs 2 --output report",
        r"run 0: +[1-9]\d*%",
        "judge_lane: no run had ended",
    ),
    Case(
        f"rosrun ardee_sim_cpp render_world {ROOT}/src/ardee_world/worlds/corn.world"
        " --output x.png --size 6000x4000",
        r"drawing: +\d+ %",
        "render_world: interrupted; nothing is written",
    ),
]


class Terminal:
    """A command on a terminal of its own."""

    def __init__(self, case: Case, folder: pathlib.Path, env: Dict[str, str]) -> None:
        self.output = ""
        self._terminal, slave = pty.openpty()
        words = case.command.split()
        if words[0] != "rosrun":
            words[0] = str(ROOT / words[0])

        def take_terminal() -> None:
            os.login_tty(slave)
            signal.signal(signal.SIGINT, signal.SIG_DFL)

        self.process = subprocess.Popen(words, cwd=folder, env=env, preexec_fn=take_terminal)
        os.close(slave)

    def read(self) -> str:
        """Returns all output so far."""
        while select.select([self._terminal], [], [], 0.0)[0]:
            try:
                self.output += os.read(self._terminal, 4096).decode(errors="replace")
            except OSError:  # the last process has closed it
                break
        return self.output

    def press_ctrl_c(self) -> None:
        """Has the terminal interrupt its foreground processes."""
        os.write(self._terminal, b"\x03")

    def close(self) -> None:
        self.process.kill()
        self.process.wait()
        os.close(self._terminal)


@pytest.fixture
def folder(tmp_path: pathlib.Path) -> pathlib.Path:
    """An empty working folder."""
    (tmp_path / "work").mkdir()
    return tmp_path / "work"


@pytest.mark.parametrize("case", CASES, ids=[case.name for case in CASES])
def test_ctrl_c_ends_long_work(case: Case, graph: RosGraph, folder: pathlib.Path) -> None:
    temporary = graph.folder / "tmp"
    temporary.mkdir()
    terminal = Terminal(case, folder, dict(graph.env, TMPDIR=str(temporary), TERM="xterm"))
    try:
        wait_until(lambda: re.search(case.progress, terminal.read()), "progress", LATEST_S)
        shown = len(terminal.output)
        terminal.press_ctrl_c()
        wait_until(lambda: terminal.process.poll() is not None, "its end", END_S)
        said = re.sub(r"\r|\^C|\x1b\[[0-9;]*[A-Za-z]", "\n", terminal.read()[shown:]).split("\n")
    finally:
        terminal.close()
        print(terminal.output)
    assert terminal.process.returncode == case.exit_code
    assert [line for line in said if line][-1] == case.last_line.format(name=case.name), said
    assert not any("Traceback" in line for line in said)
    assert not list(folder.iterdir()) and not list(temporary.iterdir())
    wait_until(lambda: not graph.alive(), f"all ended; left: {graph.alive()}", 10.0)
