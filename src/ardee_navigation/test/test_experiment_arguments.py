# SPDX-License-Identifier: MIT
"""Tests invalid arguments of run_experiment: one line, exit code 2."""
import sys

import pytest

from ardee_common.errors import GeneratorError
from ardee_navigation.evaluation import run_experiment, simulation

HINT = " (--help lists all arguments)"


@pytest.mark.parametrize(
    "words, message",
    [
        (
            ["--runs", "x"],
            "argument --runs: found 'x', expected a whole number from 1 to 10000" + HINT,
        ),
        (
            ["--runs", "0"],
            "argument --runs: found '0', expected a whole number from 1 to 10000" + HINT,
        ),
        (
            ["--seed", "1.5"],
            "argument --seed: found '1.5', expected a whole number from 0 to 2147483647" + HINT,
        ),
        (
            ["--runs", "2", "--seed", "2147483647"],
            "--seed and --runs: found a last seed above 2147483647, the largest" + HINT,
        ),
        (
            ["--output", __file__],
            f"--output: found {__file__!r}, expected a folder to write in: File exists",
        ),
    ],
)
def test_numbers(words, message, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["run_experiment", "--scenario", "corn", *words])
    assert exit_code() == 2
    assert capsys.readouterr().err == f"run_experiment: {message}\n"


def exit_code():
    try:
        return run_experiment.main()
    except SystemExit as ended:
        return ended.code


def test_a_robot_that_is_not_there():
    with pytest.raises(GeneratorError, match="^--bot-model: found 'nobody.xacro', .*nobody.xacro"):
        simulation.robot_urdf("nobody.xacro")
