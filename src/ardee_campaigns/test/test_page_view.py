# SPDX-License-Identifier: MIT
"""Tests a run that is replayed in a page."""
import math
import socket
from pathlib import Path
from typing import Any, List

import pytest
from small_campaign import write

from ardee_campaigns import run_campaign, tables

view = pytest.importorskip("ardee_sim.view", reason="found no viser, which shows pages")


@pytest.fixture
def words(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> List[str]:
    """Returns the words that replay a run of a campaign that was not worked off."""
    monkeypatch.setattr(run_campaign, "end_by_signals", lambda: None)
    file, output = write(tmp_path, replicates=1, limit_sim_s=2), tmp_path / "out"
    session = run_campaign.Session(run_campaign.read_campaign(file), output)
    (output / tables.FOLDER).mkdir(parents=True)
    run_id = session.jobs(1)[0].run_id
    return [str(file), "--output", str(output), "--replay", run_id]


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


def test_a_view_needs_a_run_of_a_python_controller(
    words: List[str], tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    with pytest.raises(SystemExit):
        run_campaign.main([words[0], "--view"])
    assert "--view: found no --replay" in capsys.readouterr().err
    controllers = {"far": {"kind": "udp", "command": ["true"]}}
    file = write(tmp_path, replicates=1, controllers=controllers)
    session = run_campaign.Session(run_campaign.read_campaign(file), tmp_path / "out")
    run_id = session.jobs(1)[0].run_id
    assert run_campaign.main([*words[:-1], run_id, "--view"]) == 2
    assert "found controller far of kind udp, expected" in capsys.readouterr().err
