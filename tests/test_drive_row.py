# SPDX-License-Identifier: MIT
"""Tests the row that scripts/drive_row finds in a scan of two lines in known places."""
import pathlib
import subprocess
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader
from types import ModuleType

import numpy as np
import pytest

SCRIPT = pathlib.Path(__file__).resolve().parents[1] / "scripts" / "drive_row"
ANGLES_RAD = np.linspace(-2.35, 2.35, 1081)  # a UST-10LX


def load() -> ModuleType:
    loader = SourceFileLoader("drive_row", str(SCRIPT))
    module = module_from_spec(spec_from_loader("drive_row", loader))
    loader.exec_module(module)
    return module


drive_row = load()


def two_lines(offset_m: float, slope: float, half_width_m: float) -> np.ndarray:
    """Returns ranges to the nearer of y = offset + slope x +- half width."""
    ranges = np.full(ANGLES_RAD.shape, np.inf)
    for side in (1, -1):
        with np.errstate(divide="ignore"):
            r = (offset_m + side * half_width_m) / (np.sin(ANGLES_RAD) - slope * np.cos(ANGLES_RAD))
        ranges = np.where((r > 0) & (r < ranges) & (r < 10), r, ranges)
    return ranges


@pytest.mark.parametrize("offset_m, slope", [(0.0, 0.0), (0.1, 0.0), (-0.05, 0.1), (0.05, -0.15)])
def test_finds_the_middle_and_the_heading(offset_m: float, slope: float) -> None:
    row = drive_row.row_ahead(two_lines(offset_m, slope, 0.38), ANGLES_RAD)
    assert row == pytest.approx([offset_m, slope, 0.38], abs=5e-3)


def test_leaves_in_the_way_hardly_matter() -> None:
    rng = np.random.default_rng(7)
    ranges = two_lines(0.05, 0.0, 0.38)
    leaves = rng.random(ranges.size) < 0.15
    ranges[leaves] *= rng.uniform(0.6, 1.0, leaves.sum())
    row = drive_row.row_ahead(ranges, ANGLES_RAD)
    assert row[0] == pytest.approx(0.05, abs=0.02)
    assert row[1] == pytest.approx(0.0, abs=0.03)


def test_no_row_on_open_ground_or_on_one_side() -> None:
    nothing = np.full(ANGLES_RAD.shape, np.inf)
    assert drive_row.row_ahead(nothing, ANGLES_RAD) is None
    left = np.where(ANGLES_RAD > 0, two_lines(0.0, 0.0, 0.38), np.inf)
    assert drive_row.row_ahead(left, ANGLES_RAD) is None


def test_turns_towards_the_middle() -> None:
    assert drive_row.turn_rate(np.array([0.1, 0.0, 0.38]), 0.5) > 0
    assert drive_row.turn_rate(np.array([0.0, -0.1, 0.38]), 0.5) < 0
    assert drive_row.turn_rate(np.array([0.0, 0.0, 0.38]), 0.5) == 0


@pytest.mark.parametrize(
    "middle_m, place",
    [
        (0.032, "3 cm right of the middle"),  # the middle lies to the left of the robot
        (-0.05, "5 cm left of the middle"),
        (-0.001, "0 cm left of the middle"),
    ],
)
def test_it_says_on_which_side_of_the_middle_it_is(middle_m: float, place: str) -> None:
    assert drive_row.place_in(np.array([middle_m, 0.0, 0.38])) == place
    assert drive_row.place_in(None) == "no row in sight"


@pytest.mark.parametrize(
    "option, text", [("--speed-m-s", "nan"), ("--speed-m-s", "inf"), ("--distance-m", "nan")]
)
def test_a_speed_that_is_no_finite_number_is_refused(option: str, text: str) -> None:
    done = subprocess.run([str(SCRIPT), option, text], capture_output=True, text=True)
    assert done.returncode == 2
    assert f"argument {option}: found {text}, expected a" in done.stderr
