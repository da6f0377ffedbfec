# SPDX-License-Identifier: MIT
"""Data sets that were interrupted, changed, or made by other workers: in the end all files are the same."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from distributed import LocalCluster

from ardee_datasets.generate_dataset import main


def command(recipe: Path, folder: Path, workers: int) -> list:
    words = ["generate_dataset", str(recipe), "--output", str(folder), "--workers", str(workers)]
    return [sys.executable, "-m", "ardee_datasets", *words]


def until_there(folder: Path, pattern: str, child: subprocess.Popen) -> None:
    """Waits until there is a file of a pattern in a folder."""
    limit = time.monotonic() + 60
    while not list(folder.glob(pattern)):
        assert child.poll() is None and time.monotonic() < limit, pattern
        time.sleep(0.01)


def ended(recipe: Path, folder: Path, number: int, when: str) -> subprocess.Popen:
    """Sends all processes of the command a signal once there is a file of a pattern; returns the command at its end.

    Temporary files are in recipe.parent/scratch.
    """
    scratch = recipe.parent / "scratch"
    scratch.mkdir(exist_ok=True)
    pipes = {"stderr": subprocess.PIPE, "text": True, "process_group": 0}
    env = {**os.environ, "TMPDIR": str(scratch)}
    first = subprocess.Popen(command(recipe, folder, 2), env=env, **pipes)
    until_there(recipe.parent, when, first)
    os.killpg(first.pid, number)
    first.wait(60)
    return first


@pytest.mark.slow
def test_any_number_of_workers_and_an_end_give_the_same_manifest(recipe: Path, made: Path) -> None:
    folder = recipe.parent / "ended"
    folder.mkdir()
    for name in ("dataset.yaml", "inputs.json"):
        (folder / name).write_text("of a recipe that was refused")
    for number, when in (
        (signal.SIGINT, "scratch/ardee_workers_*/*"),  # while workers start
        (signal.SIGKILL, "scratch/ardee_workers_*/ardee_field_*/*"),
        (signal.SIGINT, "ended/*/samples/*.json"),
    ):
        command_ended = ended(recipe, folder, number, when)
        if number == signal.SIGINT:
            assert command_ended.returncode == 130
            warning, *_, last = command_ended.stderr.read().splitlines()
            assert "warning: ultralytics" in warning and last == "generate_dataset: interrupted"
            assert not list((recipe.parent / "scratch").iterdir())
        shutil.rmtree(recipe.parent / "scratch")
    assert not (folder / "manifest.json").exists()
    assert subprocess.run(command(recipe, folder, 2), check=False).returncode == 0
    assert (folder / "manifest.json").read_bytes() == (made / "manifest.json").read_bytes()


def test_what_was_changed_in_a_finished_set_is_made_again(
    recipe: Path, made: Path, capsys: pytest.CaptureFixture
) -> None:
    folder = recipe.parent / "changed"
    shutil.copytree(made, folder)
    (folder / "train/labels/corn_0000_000000.png").write_bytes(b"")
    (folder / "train/rgb/corn_0001_000001.png").unlink()
    (folder / "test/samples/late_0000_000000.json").write_bytes(b"")
    (folder / "test/poses.csv").unlink()
    assert main([str(recipe), "--output", str(folder), "--workers", "1"]) == 0
    said = capsys.readouterr().err
    assert "train/labels/corn_0000_000000.png: missing or changed, corn_0000 is made again" in said
    assert (folder / "manifest.json").read_bytes() == (made / "manifest.json").read_bytes()
    picture = Path("train", "corn_0001_000001.png")
    pair = [folder / "yolo/images" / picture, folder / "train/rgb" / picture.name]
    assert len({path.read_bytes() for path in pair}) == 1


def test_a_folder_with_a_recipe_of_its_own_is_left_alone(
    recipe: Path, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    (tmp_path / "dataset.yaml").write_text("mine")
    with pytest.raises(SystemExit):
        main([str(recipe), "--output", str(tmp_path)])
    assert "and no inputs.json, expected an empty folder" in capsys.readouterr().err
    assert (tmp_path / "dataset.yaml").read_text() == "mine"


def workers_of(parent: int) -> list:
    """Returns the worker processes of the command, which starts each in a thread of its own."""
    children = Path(f"/proc/{parent}/task").glob("*/children")
    pids = [int(pid) for file in children for pid in file.read_text().split()]
    return [pid for pid in pids if "spawn_main" in Path(f"/proc/{pid}/cmdline").read_text()]


@pytest.mark.slow
def test_killed_workers_cost_their_fields_another_attempt(recipe: Path, made: Path) -> None:
    folder = recipe.parent / "retried"
    with subprocess.Popen(command(recipe, folder, 4)) as child:
        until_there(folder, "*/samples/*.json", child)
        before = workers_of(child.pid)
        for pid in before:
            os.kill(pid, signal.SIGKILL)
        time.sleep(1.0)
        assert len(before) == 3 and not set(before) & set(workers_of(child.pid))
    assert child.returncode == 0
    assert (folder / "manifest.json").read_bytes() == (made / "manifest.json").read_bytes()


@pytest.mark.slow
def test_a_schedulers_workers_make_the_same_set(
    recipe: Path, made: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    local = {"host": "127.0.0.1", "dashboard_address": "127.0.0.1:0"}
    with LocalCluster(n_workers=1, threads_per_worker=1, **local) as cluster:
        monkeypatch.chdir(recipe.parent)  # which the workers do not know
        words = ["--output", "clustered", "--scheduler", cluster.scheduler_address]
        assert main([str(recipe), *words]) == 0
        assert cluster.scheduler.transition_counter > 0
    manifest = (recipe.parent / "clustered" / "manifest.json").read_bytes()
    assert manifest == (made / "manifest.json").read_bytes()
