# SPDX-License-Identifier: MIT
"""Tests the crop row detection accuracy, and what is found in pictures of rows drawn in known places."""
from pathlib import Path

import cv2
import numpy as np
import pytest

from ardee_navigation.evaluation import judge_vision
from ardee_navigation.evaluation.vision_sheet import Judged, sheet
from ardee_navigation.vision.field_fit import FieldRows

V_PX = np.arange(240) + 0.5


def rows_of(offset: float, heading: float, bend: float) -> FieldRows:
    """Returns rows 24 pixels apart at the picture's top and 96 at its bottom; offset, heading and bend in rows."""
    period_px = 24.0 + 0.3 * V_PX
    far = 24.0 / period_px
    return FieldRows((offset + heading * far + bend * far**2) * period_px, period_px)


def write(folder: Path, name: str, rows: FieldRows) -> None:
    """Writes a picture of rows a third as wide as their period, with noise and a weed, and its truth."""
    u_px = np.arange(320) + 0.5 - 160.0
    across = (u_px - rows.offset_px[:, None]) / rows.period_px[:, None]
    is_crop = np.abs(across - np.round(across)) < 1.0 / 6.0
    is_crop[100:120, 40:60] = True
    rgb = np.where(is_crop[..., None], (70, 120, 50), (120, 95, 75))
    noise = np.random.default_rng(7).normal(0.0, 12.0, rgb.shape)
    picture = np.clip(rgb + noise, 0, 255).astype(np.uint8)
    cv2.imwrite(str(folder / f"{name}.jpg"), np.ascontiguousarray(picture[:, :, ::-1]))
    np.savetxt(folder / f"{name}.crp", np.column_stack((rows.offset_px, rows.period_px))[2:])


def test_drawn_rows_are_found(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    for name, numbers in enumerate([(0.0, 0.0, 0.0), (0.3, -2.0, 0.0), (-0.2, 1.0, 0.8)]):
        write(tmp_path, str(name), rows_of(*numbers))
    output = tmp_path / "sheet.png"
    assert judge_vision.main([str(tmp_path), "--output", str(output)]) == 0
    *pictures, classical, learned = capsys.readouterr().out.splitlines()
    marks = np.array([line.split()[1:] for line in pictures], float)
    assert marks.shape == (3, 2) and marks[:, 0].min() > 0.9
    for way, line, mark in zip(("classical", "learned"), (classical, learned), marks.T):
        words = line.split()
        expected = f"{way}: crop row detection accuracy in 3 pictures"
        assert words[:5] + words[6:] == expected.split()
        assert float(words[5]) == pytest.approx(np.mean(mark), abs=0.0011)
    assert cv2.imread(str(output)).shape == (240, 3 * 2 * 320, 3)


def test_the_sheet_shows_true_rows_and_those_found() -> None:
    """Upright rows 40 pixels apart: the true ones at 160 + 40 m; one way found these, the other 10 pixels beside."""
    rows = FieldRows(np.zeros(240), np.full(240, 40.0))
    moved = FieldRows(np.full(240, 10.0), rows.period_px)
    grey = np.full((240, 320, 3), 90, np.uint8)
    moved.offset_px[:100] -= 40.0  # the same rows, counted from another one
    found, marks = {"one": rows, "other": moved}, {"one": 1.0, "other": 0.0}
    picture = sheet([Judged("a.jpg", grey, rows, found, marks)])[100, :640].astype(int)
    is_red = (picture[:, 0] - picture[:, 1] > 50).reshape(2, 320)
    is_white = (picture.min(axis=1) > 200).reshape(2, 320)
    assert not is_white[0].any() and set(np.flatnonzero(is_white[1]) % 40) == {0}
    assert [set(np.flatnonzero(one) % 40) for one in is_red] == [{0}, {10}]


@pytest.mark.parametrize("error, mark", [(0.0, 1.0), (0.05, 0.75), (0.1, 0.0), (0.5, 0.0)])
def test_the_accuracy_by_hand(error: float, mark: float) -> None:
    true = rows_of(0.1, 0.4, 0.0)
    moved = FieldRows(true.offset_px + error * true.period_px, true.period_px)
    assert judge_vision.accuracy(moved, true, 320) == pytest.approx(mark, abs=1e-9)


def test_a_bad_folder_is_one_line(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    assert judge_vision.main([str(tmp_path)]) == 2
    write(tmp_path, "a", rows_of(0.0, 0.0, 0.0))
    assert (
        judge_vision.main([str(tmp_path), "--output", str(tmp_path / "a.jpg" / "sheet.png")]) == 2
    )
    assert judge_vision.main([str(tmp_path), "--output", str(tmp_path)]) == 2
    said = capsys.readouterr()
    assert said.err.splitlines() == [
        f"judge_vision: {tmp_path}: found no NAME.jpg with NAME.crp, expected at least one",
        f"judge_vision: {tmp_path}/a.jpg/sheet.png: cannot be written: File exists",
        f"judge_vision: {tmp_path}: cannot be written: Is a directory",
    ]
    assert not said.out  # before any picture was judged


def test_names_in_upper_case_are_found_and_halves_named(
    tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    for name in "abc":
        write(tmp_path, name, rows_of(0.0, 0.0, 0.0))
    (tmp_path / "a.jpg").rename(tmp_path / "a.JPG")
    (tmp_path / "a.crp").write_text("\ufeff" + (tmp_path / "a.crp").read_text())
    (tmp_path / "b.jpg").unlink()
    (tmp_path / "c.crp").unlink()
    assert judge_vision.main([str(tmp_path)]) == 0
    said = capsys.readouterr()
    assert said.out.startswith("a.JPG ") and "in 1 pictures" in said.out
    assert said.err.splitlines() == [
        f"judge_vision: {tmp_path}/c.jpg: left out, found no c.crp",
        f"judge_vision: {tmp_path}/b.crp: left out, found no b.jpg",
    ]


def test_bad_pictures_are_one_line(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    write(tmp_path, "a", rows_of(0.0, 0.0, 0.0))
    picture = tmp_path / "a.jpg"
    whole = picture.read_bytes()
    flat = cv2.imencode(".jpg", np.zeros((3, 1000, 3), np.uint8))[1].tobytes()
    cases = (
        (whole[: len(whole) // 2], "image file is truncated"),
        (b"", "cannot identify image file"),
        (flat, "found a picture of 1000 x 3 pixels, expected at least 16 a side, and 1:4 to 4:1"),
    )
    for data, said in cases:
        picture.write_bytes(data)
        assert judge_vision.main([str(tmp_path)]) == 2
        (line,) = capsys.readouterr().err.splitlines()
        assert line.startswith(f"judge_vision: {picture}: {said}")


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize(
    "rows, said",
    [
        ("1 20\n1 2 3\n", "a.crp:2: found '1 2 3', expected an offset and a period of at least 1"),
        ("inf 20\n", "a.crp:1: found 'inf 20', expected"),
        ("\nnan nan\n", "a.crp:2: found 'nan nan', expected"),
        ("0 0.001\n", "a.crp:1: found '0 0.001', expected"),
        ("", "a.crp: found 0 lines, expected 1 to 240, each with an offset and a period"),
        ("1000 3000\n", "a.crp: found no crop row in the picture, expected at least one"),
    ],
)
def test_bad_rows_are_one_line(
    rows: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture
) -> None:
    write(tmp_path, "a", rows_of(0.0, 0.0, 0.0))
    (tmp_path / "a.crp").write_text(rows)
    assert judge_vision.main([str(tmp_path)]) == 2
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"judge_vision: {tmp_path}/{said}")
