# SPDX-License-Identifier: MIT
"""Tests runs and output of scripts/fuzz, in a checkout whose fuzzer is a shell script with findings in `bad`."""
import pathlib
import shutil
import signal
import subprocess
import time
from typing import Tuple

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[1]
FUZZER = """#!/bin/sh
echo $$ > fuzzer.pid
echo "#100 NEW cov: 12 ft: 34 corp: 1/1b exec/s: 50 rss: 1Mb"
case "$*" in
  *--target=bad*) echo "Test unit written to fuzz_output/findings/bad-crash-1"; exit 77 ;;
  *--target=slow*) exec sleep 60 ;;
esac
"""


@pytest.fixture
def checkout(tmp_path: pathlib.Path) -> pathlib.Path:
    """Returns a checkout in which no setup or build is needed."""
    shutil.copytree(ROOT / "scripts", tmp_path / "scripts")
    for name in ("setup", "build"):
        (tmp_path / "scripts" / name).write_text("#!/bin/sh\n")
    (tmp_path / "scripts/fuzz_seeds.py").write_text("")
    for name in ("bad", "good", "slow"):
        (tmp_path / "src/ardee_sim_cpp/fuzz/corpus" / name).mkdir(parents=True)
    fuzzer = tmp_path / "build_fuzz/fuzz/ardee_fuzzer"
    fuzzer.parent.mkdir(parents=True)
    fuzzer.write_text(FUZZER)
    fuzzer.chmod(0o755)
    return tmp_path


def run(checkout: pathlib.Path, *arguments: str) -> Tuple[int, str]:
    """Returns exit code and output of scripts/fuzz."""
    command = [str(checkout / "scripts/fuzz"), *arguments]
    done = subprocess.run(
        command, cwd=checkout, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
    )
    return done.returncode, done.stdout


def test_a_finding_is_named_and_fails(checkout: pathlib.Path) -> None:
    code, text = run(checkout, "bad", "good", "--duration-s", "1")
    assert code == 1
    assert "FOUND: fuzz_output/findings/bad-crash-1" in text
    assert "good: 100 inputs, 50 a second, 12 edges, 34 features" in text
    assert text.splitlines()[-1] == "1 passed, 1 failed"


def test_nothing_found_is_success(checkout: pathlib.Path) -> None:
    code, text = run(checkout, "good", "--seconds", "1")
    assert (code, text.splitlines()[-1]) == (0, "1 passed, 0 failed")


def test_the_list_and_what_is_not_on_it(checkout: pathlib.Path) -> None:
    listed = [f"{name} (ardee_sim_cpp)" for name in ("bad", "good", "slow")]
    assert run(checkout, "--list") == (0, "\n".join(listed) + "\n")
    expected = "fuzz: found target 'other', expected one of scripts/fuzz --list\n"
    assert run(checkout, "other") == (2, expected)


def test_an_end_by_signal_takes_the_fuzzer_along(checkout: pathlib.Path) -> None:
    command = [str(checkout / "scripts/fuzz"), "slow"]
    running = subprocess.Popen(command, cwd=checkout, stdout=subprocess.DEVNULL)
    pid_file = checkout / "fuzzer.pid"
    deadline = time.monotonic() + 20.0
    while not (pid_file.exists() and pid_file.read_text()):
        assert time.monotonic() < deadline
        time.sleep(0.05)
    running.send_signal(signal.SIGTERM)
    assert running.wait(timeout=20) == 130
    assert not pathlib.Path("/proc", pid_file.read_text().strip()).exists()
    assert not (checkout / "fuzz_output/tmp").exists()
