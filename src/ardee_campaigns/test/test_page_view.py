# SPDX-License-Identifier: MIT
"""Tests a run that is replayed in a page."""
import math
import socket
import sys
from pathlib import Path
from typing import Any, Dict, List, Tuple

import pytest
from small_campaign import HERE, run, write

from ardee_campaigns import rerun, run_campaign, tables

view = pytest.importorskip("ardee_sim.view", reason="found no viser, which shows pages")


@pytest.fixture(autouse=True)
def signals(monkeypatch: pytest.MonkeyPatch) -> None:
    """Leaves the signals of this process alone."""
    monkeypatch.setattr(run_campaign, "end_by_signals", lambda: None)


def replay(folder: Path, **changes: Any) -> List[str]:
    """Returns the words that replay a run of a campaign that was not worked off."""
    file, output = write(folder, replicates=1, **changes), folder / "out"
    session = run_campaign.Session(run_campaign.read_campaign(file), output)
    (output / tables.FOLDER).mkdir(parents=True)
    return [str(file), "--output", str(output), "--replay", session.jobs(1)[0].run_id]


@pytest.fixture
def words(tmp_path: Path) -> List[str]:
    """Returns the words of a replay of a controller in Python."""
    return replay(tmp_path, limit_sim_s=2)


@pytest.mark.slow
def test_a_replay_is_shown_paused_at_its_ends_and_is_the_same(
    words: List[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
) -> None:
    assert run_campaign.main(words) == 0
    csv = Path(capsys.readouterr().out.strip())
    without = csv.read_bytes()
    pauses: List[bool] = []
    shown = view.Viewer.update

    def update(viewer: Any) -> None:
        """Plays on as a person would."""
        pauses.append(viewer.wanted.is_paused)
        viewer.wanted.is_paused, viewer.wanted.pace = False, math.inf
        shown(viewer)

    monkeypatch.setattr(view.Viewer, "update", update)
    assert run_campaign.main([*words, "--view", "0"]) == 0
    assert capsys.readouterr().out.startswith("http://127.0.0.1:")
    assert pauses[0] and pauses[-1] and not any(pauses[1:-1])
    assert len(pauses) == len(without.splitlines()) - 1 > 20
    assert csv.read_bytes() == without


def test_a_port_in_use_is_told_and_nothing_written(
    words: List[str], tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        with pytest.raises(SystemExit) as ended:
            run_campaign.main([*words, "--view", str(taken.getsockname()[1])])
    assert ended.value.code == 2 and "--view: " in capsys.readouterr().err
    assert not list((tmp_path / "out").glob("*.csv"))


def test_a_view_needs_a_replay(words: List[str], capsys: pytest.CaptureFixture) -> None:
    with pytest.raises(SystemExit):
        run_campaign.main([words[0], "--view"])
    assert "--view: found no --replay" in capsys.readouterr().err


def program(kind: str) -> Dict[str, Any]:
    """Returns a controller that is a program in real time."""
    places = ["{bind}", "{controls}"] if kind == "udp" else []
    command = [sys.executable, str(HERE / f"{kind}_program.py"), *places, "0.5", "1000"]
    return {"kind": kind, "command": command, **({"realtime": True} if kind == "ros" else {})}


@pytest.fixture
def shown(monkeypatch: pytest.MonkeyPatch) -> List[Tuple[int, float, float]]:
    """Returns when and where the robot is shown, as it goes on."""
    places: List[Tuple[int, float, float]] = []

    def update(viewer: Any) -> None:
        x_m, y_m, _ = viewer._sim.state("robot").xyz_m
        places.append((viewer._sim.time_ns, x_m, y_m))

    monkeypatch.setattr(view.Viewer, "update", update)
    return places


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["udp", "ros"])
def test_a_run_in_real_time_is_shown_as_it_was_recorded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kind: str, shown: List[Any]
) -> None:
    if kind == "ros":
        pytest.importorskip("rospy", reason="found no ROS")
    task = {"stuck_within_m": 9.0, "stuck_after_s": 1.0}  # a person steps in once
    words = replay(tmp_path, controllers={"far": program(kind)}, task=task)
    run(*words[:3])
    samples = tables.read_run(tmp_path / "out", words[-1]).samples
    assert samples["event"].to_pylist().count("stuck") == 1
    monkeypatch.setattr(rerun, "run_one", None)  # calling it raises TypeError
    assert run_campaign.main([*words, "--view", "0"]) == 0
    columns = (samples[name].to_pylist() for name in ("time_ns", "x_m", "y_m"))
    assert shown == list(zip(*columns))
    lines = (tmp_path / "out" / f"{words[-1]}.csv").read_text().splitlines()[1:]
    assert [int(line.split(",")[0]) for line in lines] == samples["time_ns"].to_pylist()


def test_a_program_without_record_drives_before_it_is_shown(
    tmp_path: Path, shown: List[Any]
) -> None:
    words = replay(tmp_path, controllers={"far": program("udp")})
    assert run_campaign.main([*words, "--view", "0"]) == 0
    assert len(shown) == 62 and math.dist(shown[0][1:], shown[-1][1:]) > 0.3
