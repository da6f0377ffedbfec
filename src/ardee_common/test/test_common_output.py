# SPDX-License-Identifier: MIT
"""Tests that a model directory is written whole or left unchanged."""
import os
import tempfile
from pathlib import Path

import pytest

from ardee_common.errors import GeneratorError
from ardee_common.output import (
    check_file,
    locked,
    model_directory,
    output_folder,
    remove_stale,
    scratch_folder,
    write_file,
)


def write(parent: Path, name: str, text: str) -> None:
    """Writes a model of one file."""
    with model_directory(parent, name) as folder:
        (folder / "model.config").write_text(text)


@pytest.mark.parametrize("name", ["../x", "", ".hidden", "a/b", "a b", "<x>"])
def test_unsafe_names_are_refused(tmp_path: Path, name: str) -> None:
    with pytest.raises(GeneratorError, match="name"):
        write(tmp_path / "out", name, "new")
    assert not (tmp_path / "out").exists()


def test_a_failure_keeps_the_earlier_model(tmp_path: Path) -> None:
    write(tmp_path, "x", "first")
    with pytest.raises(RuntimeError):
        with model_directory(tmp_path, "x") as folder:
            (folder / "model.config").write_text("half")
            raise RuntimeError("interrupted")
    assert (tmp_path / "x" / "model.config").read_text() == "first"
    write(tmp_path, "x", "second")
    assert (tmp_path / "x" / "model.config").read_text() == "second"
    assert [path.name for path in tmp_path.iterdir()] == ["x"]


def test_a_folder_that_is_no_model_is_not_overwritten(tmp_path: Path) -> None:
    (tmp_path / "x").mkdir()
    (tmp_path / "x" / "thesis.tex").write_text("years of work")
    with pytest.raises(GeneratorError, match="not a model directory"):
        write(tmp_path, "x", "new")
    assert (tmp_path / "x" / "thesis.tex").read_text() == "years of work"


def test_a_parent_that_is_a_file(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(GeneratorError, match="cannot be written"):
        write(tmp_path / "file", "x", "new")


def test_a_file_that_cannot_be_written_is_known_before(tmp_path: Path) -> None:
    check_file(tmp_path / "new" / "x")
    assert list((tmp_path / "new").iterdir()) == []
    (tmp_path / "file").touch()
    for path, why in ((tmp_path, "Is a directory"), (tmp_path / "file" / "x", "File exists")):
        with pytest.raises(GeneratorError, match=f"^{path}: cannot be written: {why}$"):
            check_file(path)


def test_a_folder_goes_again_if_nothing_came_into_it(tmp_path: Path) -> None:
    def interrupt(write_first: bool) -> None:
        with pytest.raises(KeyboardInterrupt), output_folder(tmp_path / "out") as folder:
            if write_first:
                write_file(folder / "whole", b"text")
            raise KeyboardInterrupt

    interrupt(write_first=False)
    assert not (tmp_path / "out").exists()
    interrupt(write_first=True)
    assert [path.name for path in (tmp_path / "out").iterdir()] == ["whole"]


def test_ctrl_c_amid_a_file_leaves_the_earlier_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def half(path: Path, data: bytes) -> None:
        path.touch()
        raise KeyboardInterrupt

    write_file(tmp_path / "x", b"first")
    monkeypatch.setattr(Path, "write_bytes", half)
    with pytest.raises(KeyboardInterrupt):
        write_file(tmp_path / "x", b"second")
    assert [path.read_bytes() for path in tmp_path.iterdir()] == [b"first"]


def test_what_killed_programs_left_is_removed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    names = (".a.host.1.new", ".b.host.2.new", "run_left", "run_in_use", "run_new", "other")
    for name in names:
        path = tmp_path / name
        path.touch() if name[0] == "." else path.mkdir()
        if name not in (".b.host.2.new", "run_new"):
            os.utime(path, (0, 0))
    with locked(tmp_path / "run_in_use"), scratch_folder("run_") as mine:
        remove_stale(tmp_path)
        there = {path.name for path in tmp_path.iterdir()}
        assert there == {*names, mine.name} - {".a.host.1.new", "run_left"}
        with pytest.raises(GeneratorError), locked(mine):
            pass
    assert not mine.exists()
