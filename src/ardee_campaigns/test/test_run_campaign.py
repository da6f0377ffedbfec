# SPDX-License-Identifier: MIT
"""Tests the command on small campaigns: the same bytes however it is worked off, and what fails."""
import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Callable, Dict, List

import pytest
import small_campaign
from distributed import LocalCluster
from small_campaign import run, write

from ardee_campaigns import tables, workers
from ardee_campaigns.attempts import STALLED, Attempts
from ardee_campaigns.campaign_file import read_campaign
from ardee_campaigns.plan import Job, Planner
from ardee_campaigns.replay import note_file
from ardee_campaigns.run import failed
from ardee_common.output import locked


@pytest.fixture(scope="module")
def reference(tmp_path_factory: pytest.TempPathFactory) -> bytes:
    """Returns runs.parquet of the small campaign, worked off by one process."""
    folder = tmp_path_factory.mktemp("reference")
    run(write(folder), "--output", folder / "out")
    return (folder / "out" / tables.RUNS).read_bytes()


def rows(output: Path) -> List[dict]:
    return tables.read_runs(output).to_pylist()


@pytest.mark.slow
@pytest.mark.parametrize("count", [2, 4])
def test_any_number_of_workers_gives_the_same_bytes(
    tmp_path: Path, count: int, reference: bytes
) -> None:
    done = run(write(tmp_path, workers=count), "--output", tmp_path / "out", "--csv")
    assert (tmp_path / "out" / tables.RUNS).read_bytes() == reference
    assert done.stdout.strip() == str(tmp_path / "out" / tables.RUNS)
    assert "4 runs, 0 of them failed" in done.stderr
    found = rows(tmp_path / "out")
    assert [row["status"] for row in found] == [tables.OK] * 4
    assert all(0.3 < row["distance_m"] < 0.8 for row in found)
    assert (tmp_path / "out" / "runs.csv").read_text().count("\n") == 5
    again = run(tmp_path / "campaign.yaml", "--output", tmp_path / "out")
    assert "4 of 4 runs are done already" in again.stderr


def until(condition: Callable[[], object], what: str, seconds: float = 60.0) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"waited in vain for {what}"
        time.sleep(0.02)


def finished(output: Path) -> Dict[str, float]:
    """Returns the finished runs and when their files were written."""
    return {path.name: path.stat().st_mtime for path in (output / "runs").glob("[!.]*.parquet")}


def begun(output: Path) -> List[str]:
    return [path.name for path in (output / "attempts").glob("*.txt") if path.stat().st_size]


@pytest.fixture
def scratch(tmp_path: Path) -> Path:
    """Returns the folder for temporary files of the children of `start`."""
    folder = tmp_path / "scratch"
    folder.mkdir()
    return folder


@pytest.fixture
def start(scratch: Path) -> Callable[..., subprocess.Popen]:
    """Returns a function that starts a child of the test; what is left of it is ended."""
    children: List[subprocess.Popen] = []

    def started(*words: object) -> subprocess.Popen:
        made = subprocess.Popen(
            [str(word) for word in words],
            env={**small_campaign.environment(), "TMPDIR": str(scratch)},
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        children.append(made)
        return made

    yield started
    for child in children:
        if child.poll() is None:
            os.killpg(child.pid, signal.SIGKILL)
        child.communicate()


def worker_of(output: Path) -> int:
    """Returns the process of the run that was begun."""
    return int((output / "attempts" / begun(output)[0]).read_text().split()[1])


@pytest.mark.slow
def test_a_killed_worker_costs_its_run_a_retry_and_a_line(
    tmp_path: Path, reference: bytes, start: Callable[..., subprocess.Popen]
) -> None:
    output = tmp_path / "out"
    child = start(*small_campaign.command(write(tmp_path), "--output", output))
    until(lambda: begun(output), "the first run")
    os.kill(worker_of(output), signal.SIGKILL)
    assert child.wait(60) == 0
    assert (output / tables.RUNS).read_bytes() == reference
    timings = tables.read_timings(output).to_pylist()
    assert sorted(timing["attempts"] for timing in timings) == [1, 1, 1, 2]
    assert [timing["lost"] for timing in timings if timing["lost"]] == ["its worker ended"]


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGINT])
def test_a_campaign_that_was_ended_goes_on(
    tmp_path: Path,
    reference: bytes,
    number: int,
    start: Callable[..., subprocess.Popen],
    scratch: Path,
) -> None:
    output, file = tmp_path / "out", write(tmp_path)
    child = start(*small_campaign.command(file, "--output", output))
    until(lambda: finished(output), "the first finished run")
    os.kill(child.pid, number)
    assert child.wait(30) == (130 if number == signal.SIGINT else -number)
    assert number == signal.SIGKILL or not list(scratch.iterdir())
    kept = finished(output)
    assert 0 < len(kept) < 4
    run(file, "--output", output)
    assert (output / tables.RUNS).read_bytes() == reference
    assert kept.items() <= finished(output).items()


def test_ctrl_c_while_workers_start_ends_in_a_line(
    tmp_path: Path, start: Callable[..., subprocess.Popen], scratch: Path
) -> None:
    """All processes of a terminal get it."""
    child = start(*small_campaign.command(write(tmp_path), "--output", tmp_path / "out"))
    until(lambda: list(scratch.glob("ardee_workers_*/*")), "the first worker")
    os.killpg(child.pid, signal.SIGINT)
    _, said = child.communicate(timeout=60)
    assert (child.returncode, said.count("\n")) == (130, 1) and "interrupted" in said, said
    assert not list(scratch.iterdir())


def test_ctrl_c_during_the_imports_ends_in_a_line(tmp_path: Path) -> None:
    (tmp_path / "pyarrow.py").write_text(
        "import time; print('importing', flush=True); time.sleep(60)"
    )
    env = small_campaign.environment()
    env["PYTHONPATH"] = f"{tmp_path}:{env['PYTHONPATH']}"
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
    with subprocess.Popen(small_campaign.command("small", "--list"), env=env, **pipes) as child:
        assert child.stdout.readline() == "importing\n"
        child.send_signal(signal.SIGINT)
        assert child.communicate(timeout=30)[1] == "run_campaign: interrupted\n"
    assert child.returncode == 130


@pytest.mark.slow
def test_a_lost_scheduler_ends_the_campaign_which_goes_on_with_another(
    tmp_path: Path, reference: bytes, start: Callable[..., subprocess.Popen]
) -> None:
    output, file = tmp_path / "out", write(tmp_path, workers=None)

    def cluster(name: str) -> List[object]:
        place = tmp_path / name
        dask = [sys.executable, "-m", "distributed.cli"]
        scheduler = start(
            *dask[:2], "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", 0,
            "--no-dashboard", "--scheduler-file", place,
        )  # fmt: skip
        until(lambda: place.is_file() and place.read_text().endswith("\n}"), "the scheduler")
        start(
            *dask[:2], "distributed.cli.dask_worker", "--scheduler-file", place,
            "--nthreads", 1, "--no-dashboard", "--local-directory", tmp_path,
        )  # fmt: skip
        address = json.loads(place.read_text())["address"]
        return [scheduler, address]

    scheduler, address = cluster("one")
    child = start(*small_campaign.command(file, "--output", output, "--scheduler", address))
    until(lambda: finished(output), "the first finished run")
    scheduler.kill()
    _, said = child.communicate(timeout=60)
    assert child.returncode == 1, said
    assert said.strip().splitlines()[-1].startswith("run_campaign: the scheduler was lost"), said
    kept = finished(output)
    _, address = cluster("other")
    run(file, "--output", output, "--scheduler", address)
    assert (output / tables.RUNS).read_bytes() == reference
    assert kept.items() <= finished(output).items()


@pytest.mark.slow
def test_controllers_that_misbehave_fail_their_runs_and_the_rest_goes_on(tmp_path: Path) -> None:
    ways = ("raises", "returns_nan", "returns_none", "eats_memory", "hangs", "dies", "dies_once")
    controllers: dict = {
        way: {"factory": "misbehaving:make", "params": {"how": way, "marks": str(tmp_path)}}
        for way in ways
    }
    controllers["good"] = small_campaign.CAMPAIGN["controllers"]["straight"]
    limits = {"watchdog_wall_s": 4, "memory_mb": 1000, "replicates": 1, "workers": 2}
    measures = ["distance_m", "misbehaving:samples"]
    file = write(tmp_path, controllers=controllers, measures=measures, **limits)
    run(file, "--output", tmp_path / "out")
    found = {row["controller"]: row for row in rows(tmp_path / "out")}
    errors = {name: row["error"] for name, row in found.items() if row["status"] == "failed"}
    assert errors == {
        "raises": "KeyError: 'no such\\nrow'",
        "returns_nan": "controller's command: found nan and 0.0, expected finite",
        "returns_none": "controller's command: found NoneType, expected a Twist, or speed and"
        " turn rate",
        "eats_memory": "MemoryError",
        "hangs": "lost each time it was tried: stalled: took longer than watchdog_wall_s",
        "dies": "lost each time it was tried: its worker ended",
    }
    assert found["dies_once"]["samples"] == found["good"]["samples"] == 62
    assert found["raises"]["sim_s"] == pytest.approx(0.075)  # 4 samples before it
    timings = {row["run_id"]: row for row in tables.read_timings(tmp_path / "out").to_pylist()}
    assert timings[found["dies_once"]["run_id"]]["attempts"] == 2
    assert timings[found["hangs"]["run_id"]]["attempts"] == 3


def test_attempts_are_counted_by_lines_and_within_a_command(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    attempts = Attempts(tmp_path, "a")
    for _ in range(2):
        with attempts.begin() as log:
            print('Timeout (0:15:00)!\n  File "attempts.py", line 27 in begin', file=log)
    assert attempts.lost() == [STALLED, STALLED]
    with workers.Workers(tmp_path, None, 1) as pool:  # of the next command
        monkeypatch.setattr(pool, "_work_off", lambda jobs, told: None)
        pool.work_off([SimpleNamespace(run_id="a")], print)
    assert attempts.lost() == []


def test_each_folder_on_a_scheduler_gets_its_own_files(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    planner = Planner(read_campaign(write(tmp_path)))
    job = planner.job(planner.cells[0], 0, tmp_path)
    one, other, nowhere = (tmp_path / name for name in ("one", "other", "nowhere"))

    def work(job: Job, folder: Path) -> str:
        if folder != nowhere:
            tables.write_run(folder, failed(job, "done"))
        return "done"

    def work_off(folder: Path, told: Callable[[Job, str], None]) -> None:
        with workers.Workers(folder, cluster.scheduler_address, 1) as pool:
            pool.work_off([job], told)

    monkeypatch.setattr(workers, "work", work)
    errors: List[str] = []
    with LocalCluster(1, processes=False, threads_per_worker=1, dashboard_address=None) as cluster:
        # The other begins while the scheduler still has the result of the first.
        work_off(one, lambda *_: work_off(other, lambda _, error: errors.append(error)))
        work_off(nowhere, lambda _, error: errors.append(error))
    assert len(finished(one)) == len(finished(other)) == 1 and errors[0] == "done"
    assert f"its worker left no file in {nowhere}, expected one" in errors[1]


@pytest.mark.slow
def test_a_world_or_measure_that_fails_is_a_failed_row(tmp_path: Path) -> None:
    world = '<sdf version="1.6"><world name="w"><include>'
    (tmp_path / "bad.world").write_text(f"{world}<uri>model://no</uri></include></world></sdf>")
    worlds = {"bad": "bad.world", "tiny": "tiny.yaml"}
    names = {"replicates": 1, "measures": ["misbehaving:endless"]}
    run(write(tmp_path, worlds=worlds, **names), "--output", tmp_path / "out")
    errors = {row["world"]: row["error"] for row in rows(tmp_path / "out")}
    assert "bad.world: found 0 fields with truth.json" in errors["bad"]
    assert errors["tiny"] == "ValueError: no measure"
    assert all(row["status"] == tables.FAILED for row in rows(tmp_path / "out"))
    again = run(tmp_path / "campaign.yaml", "--output", tmp_path / "out", "--retry-failed")
    assert "4 runs, 4 of them failed" in again.stderr and "already" not in again.stderr


def test_two_campaigns_do_not_share_a_folder(tmp_path: Path) -> None:
    output = tmp_path / "out"
    (tmp_path / "other.yaml").touch()
    note_file(output, tmp_path / "other.yaml")
    (output / "runs").mkdir()
    (output / "runs" / "0123456789abcdef.parquet").touch()
    done = run(write(tmp_path), "--output", output, code=2)
    assert f"found the runs of {tmp_path}/other.yaml in {output}, expected" in done.stderr


def test_two_campaigns_do_not_work_in_a_folder_at_a_time(tmp_path: Path) -> None:
    output = tmp_path / "out"
    output.mkdir()
    with locked(output):
        done = run(write(tmp_path), "--output", output, code=2)
    assert done.stderr.count("\n") == 1 and "another program is at work" in done.stderr
    assert not finished(output)


@pytest.mark.slow
def test_a_full_disk_ends_the_campaign_in_one_line(tmp_path: Path) -> None:
    file, output = write(tmp_path), tmp_path / "out"
    output.mkdir()
    mount = ["unshare", "--mount", *(["--map-root-user"] * (os.geteuid() != 0)), "sh", "-ec"]
    if subprocess.run([*mount, "true"], capture_output=True).returncode:
        pytest.skip("this kernel lets no one mount")
    words = " ".join(small_campaign.command(file, "--output", output))
    script = f"mount -t tmpfs -o size=72k small {output}; exec {words}"
    env = small_campaign.environment()
    done = subprocess.run([*mount, script], env=env, capture_output=True, text=True, timeout=60)
    last = done.stderr.strip().splitlines()[-1]
    assert done.returncode == 1, done.stderr
    assert "No space left on device; free some and start again" in last


def test_the_plan_is_listed_and_nothing_run(tmp_path: Path) -> None:
    done = run(
        write(tmp_path, factors={"speed_m_s": [0.2, 0.5]}), "--output", tmp_path / "o", "--list"
    )
    lines = done.stdout.splitlines()
    assert lines[0].endswith("replicate,seed,is_done,factor_speed_m_s") and len(lines) == 9
    assert "8 runs, 8 of them to do" in done.stderr
    assert not (tmp_path / "o").exists()


@pytest.mark.parametrize(
    "words, message",
    [
        (["--list", "--csv"], "--csv: found it with --list, "),
        (["--replay", "x", "--retry-failed"], "--retry-failed: found it with --replay, "),
        (["--list", "--replay", "x"], "--replay: found it with --list, "),
        (["--scheduler", "tcp://x:1"], "campaign.yaml:4: workers: found it with --scheduler"),
    ],
)
def test_what_has_no_effect_is_refused(tmp_path: Path, words: List[str], message: str) -> None:
    said = run(write(tmp_path), *words, code=2).stderr
    assert message in said and said.count("\n") == 1


@pytest.mark.slow
def test_replicates_are_added_until_the_interval_is_narrow(tmp_path: Path) -> None:
    plan = {"kind": "until", "measure": "lateral_rms_m", "half_width": 1e-12, "most_replicates": 3}
    controllers = {"straight": small_campaign.CAMPAIGN["controllers"]["straight"]}
    limit = {"limit_sim_s": 3.0}
    file = write(tmp_path, plan=plan, controllers=controllers, **limit)
    run(file, "--output", tmp_path / "out")
    assert sorted(row["replicate"] for row in rows(tmp_path / "out")) == [0, 1, 2]
    wide = {**plan, "half_width": 10.0}
    run(write(tmp_path, plan=wide, controllers=controllers, **limit), "--output", tmp_path / "out")
    assert sorted(row["replicate"] for row in rows(tmp_path / "out")) == [0, 1]


@pytest.mark.slow
def test_a_run_is_replayed_by_its_id(tmp_path: Path) -> None:
    file, output = write(tmp_path, replicates=1), tmp_path / "out"
    run(file, "--output", output)
    run_id = rows(output)[0]["run_id"]
    done = run(file, "--output", output, "--replay", run_id)
    assert done.stdout.strip() == str(output / f"{run_id}.csv")
    x_m = tables.read_run(output, run_id).samples.column("x_m").to_pylist()
    lines = (output / f"{run_id}.csv").read_text().splitlines()[1:]
    assert [float(line.split(",")[1]) for line in lines] == x_m
    assert "known: " in run(file, "--output", output, "--replay", "x", code=2).stderr


@pytest.mark.slow
def test_a_replay_shows_where_a_controller_raised(tmp_path: Path) -> None:
    raises = {"factory": "misbehaving:make", "params": {"how": "raises"}}
    file = write(tmp_path, replicates=1, controllers={"raises": raises})
    run_id = run(file, "--list").stdout.splitlines()[1].split(",")[0]
    said = run(file, "--output", tmp_path, "--replay", run_id).stderr
    assert "misbehaving.py" in said and "run_campaign: failed, KeyError" in said


@pytest.mark.slow
def test_a_replay_heeds_a_ctrl_c_that_its_controller_has_lost(tmp_path: Path) -> None:
    loses = {"factory": "misbehaving:make", "params": {"how": "loses_ctrl_c"}}
    file = write(tmp_path, replicates=1, controllers={"loses": loses})
    run_id = run(file, "--list").stdout.splitlines()[1].split(",")[0]
    assert "interrupted" in run(file, "--output", tmp_path, "--replay", run_id, code=130).stderr
