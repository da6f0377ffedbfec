# SPDX-License-Identifier: MIT
"""Tests the hash by which runs and data sets know the simulator."""
from pathlib import Path
from types import SimpleNamespace

import pytest
from ardee_sim import identity


def test_the_digest_is_that_of_the_build_and_its_code(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    core, sower = tmp_path / "_core.so", tmp_path / "sower" / "trial.py"
    sower.parent.mkdir()
    monkeypatch.setattr(identity, "find_spec", lambda name: SimpleNamespace(origin=str(core)))
    monkeypatch.setattr(identity.trial, "__file__", str(sower))
    found = []
    for build, code in ((b"1", "x = 1"), (b"2", "x = 1"), (b"2", "x = 2"), (b"1", "x = 1")):
        core.write_bytes(build)
        sower.write_text(code)
        found.append(identity.engine_digest.__wrapped__())
    assert len(set(found)) == 3 and found[0] == found[3]
