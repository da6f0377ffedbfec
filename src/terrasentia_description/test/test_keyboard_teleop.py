# SPDX-License-Identifier: MIT
"""Tests the keys of keyboard_teleop; a system test covers driving, stopping and restoring its terminal."""
import importlib.machinery
import importlib.util
import os
import pathlib
import subprocess

import pytest

from ardee_common.config import from_values
from ardee_common.errors import GeneratorError

SCRIPT = pathlib.Path(__file__).resolve().parents[1] / "scripts/keyboard_teleop"


@pytest.fixture(scope="module")
def teleop():
    """Returns the script as a module."""
    loader = importlib.machinery.SourceFileLoader("keyboard_teleop", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("sys.dont_write_bytecode", True)
        loader.exec_module(module)
    return module


@pytest.mark.parametrize(
    "key, x, yaw",
    [
        ("u", 0.5, 1.0),
        ("i", 0.5, 0.0),
        ("o", 0.5, -1.0),
        ("j", 0.0, 1.0),
        ("k", 0.0, 0.0),
        ("l", 0.0, -1.0),
        ("m", -0.5, -1.0),
        (",", -0.5, 0.0),
        (".", -0.5, 1.0),
    ],
)
def test_nine_keys_drive(teleop, key: str, x: float, yaw: float):
    keyboard = teleop.Keyboard(0.5, 1.0)
    assert keyboard.press(key)
    assert keyboard.velocity() == (x, 0, 0, yaw)


def test_every_other_key_stops(teleop):
    for code in range(256):
        key = chr(code)
        keyboard = teleop.Keyboard(0.5, 1.0, move=(1, 0, 0, 1))
        if key not in teleop.MOVES and key not in teleop.SPEEDS:
            assert keyboard.press(key) and keyboard.velocity() == (0, 0, 0, 0)


def test_speeds_change_by_a_tenth_and_the_move_goes_on(teleop):
    keyboard = teleop.Keyboard(0.5, 1.0)
    keyboard.press("u")
    for key in "qwe":
        assert not keyboard.press(key)
    assert keyboard.velocity() == pytest.approx((0.5 * 1.1**2, 0, 0, 1.1**2))
    for key in "zxc":
        keyboard.press(key)
    assert keyboard.velocity() == pytest.approx((0.5 * (1.1 * 0.9) ** 2, 0, 0, (1.1 * 0.9) ** 2))


def test_without_a_key_there_is_none(teleop):
    reader, writer = os.pipe()
    assert teleop.next_key(reader, 0.0) == ""
    os.write(writer, b"iq")
    assert [teleop.next_key(reader, 1.0), teleop.next_key(reader, 1.0)] == ["i", "q"]
    os.close(writer)
    assert teleop.next_key(reader, 1.0) is None
    os.close(reader)


@pytest.mark.parametrize("value", ["fast", -0.1, float("nan"), float("inf"), None])
def test_a_parameter_that_is_no_number_is_named(teleop, value):
    assert from_values(teleop.Settings, {"speed": 1}) == teleop.Settings(speed=1.0)
    with pytest.raises(GeneratorError, match="speed: found .*, expected at least 0"):
        from_values(teleop.Settings, {"speed": value})


@pytest.mark.parametrize("word", ["-h", "--help"])
def test_help_needs_neither_terminal_nor_master(word):
    done = subprocess.run(
        ["/usr/bin/python3", str(SCRIPT), "_speed:=0.6", word],
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0 and not done.stderr
    assert done.stdout.startswith("usage: keyboard_teleop [-h]")
    assert "~key_timeout" in done.stdout and "faster / slower by 10 %" in done.stdout


def test_without_a_terminal_it_says_so():
    done = subprocess.run(
        ["/usr/bin/python3", str(SCRIPT)], stdin=subprocess.DEVNULL, capture_output=True, text=True
    )
    assert done.returncode == 1
    assert done.stderr == "keyboard_teleop: standard input is no terminal\n"
