# SPDX-License-Identifier: MIT
"""Tests that commands answer bad input in one line and exit with 2."""
from argparse import Namespace
from typing import Optional

import pytest

from ardee_common.cli import Parser, number_in, positive_number, run, seed_number, whole_in
from ardee_common.errors import GeneratorError


def work(args: Namespace) -> Optional[int]:
    """Halves an even count; prints nothing for 0."""
    if args.count % 2:
        raise GeneratorError(f"count: found {args.count}, expected an even one")
    return args.count // 2 or None


def halve(*arguments: str) -> int:
    """Returns the exit code of a command."""
    parser = Parser(prog="halve")
    parser.add_argument("count", type=whole_in(0, 9))
    return run(parser, work, arguments)


def test_the_result_is_printed(capsys: pytest.CaptureFixture) -> None:
    assert halve("8") == 0 and halve("0") == 0
    assert capsys.readouterr().out == "4\n"


@pytest.mark.parametrize(
    "argument, message",
    [
        ("3", "halve: count: found 3, expected an even one\n"),
        (
            "10",
            "halve: argument count: found '10', expected a whole number from 0 to 9"
            " (--help lists all arguments)\n",
        ),
    ],
)
def test_bad_input(argument: str, message: str, capsys: pytest.CaptureFixture) -> None:
    with pytest.raises(SystemExit) as ended:
        halve(argument)
    assert ended.value.code == 2
    assert capsys.readouterr().err == message


@pytest.mark.parametrize(
    "kind, good, bad",
    [
        (seed_number, {"0": 0, "007": 7}, ["-1", "1.0", "", "x", "1_0"]),
        (whole_in(-2, 2), {"-2": -2, "+2": 2}, ["3", "-3"]),
        (number_in(0.5, 2.0), {"0.5": 0.5, "2e0": 2.0}, ["0.4", "nan", "inf", "x"]),
        (number_in(0.0), {"0": 0.0, "1e9": 1e9}, ["-1", "inf"]),
        (positive_number, {"1e-9": 1e-9}, ["0", "-1", "nan", "inf", ""]),
    ],
)
def test_types_of_arguments(kind, good, bad) -> None:
    assert {text: kind(text) for text in good} == good
    for text in bad:
        with pytest.raises(Exception, match=f"found '{text}', expected "):
            kind(text)
