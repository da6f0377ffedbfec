# SPDX-License-Identifier: MIT
"""Tests that commands answer bad input in one line and exit with 2."""
import subprocess
from argparse import Namespace
from pathlib import Path
from typing import Optional

import pytest

from ardee_common.cli import (
    Parser,
    add_model_path,
    add_seed,
    number_in,
    positive_number,
    run,
    seed_number,
    steps,
    whole_in,
)
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


def test_a_misspelt_argument_is_named_and_not_its_value(capsys: pytest.CaptureFixture) -> None:
    parser = Parser(prog="cut")
    parser.add_argument("recipe", nargs="?")
    parser.add_argument("--row-length-m", type=float)
    parser.add_argument("--seed", type=int)
    assert parser.parse_args(["--row-len", "2"]).row_length_m == 2.0
    assert parser.parse_args(["--", "--row-lenght"]).recipe == "--row-lenght"
    with pytest.raises(SystemExit) as ended:
        parser.parse_args(["--row-lenght-m", "2", "--seed", "x"])
    assert ended.value.code == 2
    assert capsys.readouterr().err == (
        "cut: unknown argument '--row-lenght-m', known: --row-length-m, --help, --seed;"
        " did you mean '--row-length-m'? (--help lists all arguments)\n"
    )


@pytest.mark.parametrize("words", [("--length", "2"), ("--length=2",)])
def test_an_old_name_is_understood_with_a_note(words, capsys: pytest.CaptureFixture) -> None:
    parser = Parser(prog="cut", old_names={"--length": "--row-length-m"})
    parser.add_argument("--row-length-m", type=float)
    assert parser.parse_args(words).row_length_m == 2.0
    assert capsys.readouterr().err == "cut: note: --length is now --row-length-m\n"


def test_help_ends_with_the_default_unless_it_says_it() -> None:
    parser = Parser(prog="cut")
    parser.add_argument("--speed-m-s", type=float, default=0.5, help="speed")
    parser.add_argument("--name", help="name")
    parser.add_argument("--dry", action="store_true", help="cut nothing")
    add_seed(parser)
    text = parser.format_help()
    assert "speed (default 0.5)" in text and "random numbers (default 0)\n" in text
    assert text.count("default") == 2


def test_model_path_may_be_given_again() -> None:
    parser = Parser(prog="find")
    parser.add_argument("models", nargs="*")
    add_model_path(parser)
    args = parser.parse_args(["--model-path", "a", "--model-path", "b", "corn"])
    assert args.model_path == [Path("a"), Path("b")] and args.models == ["corn"]


def test_long_work_says_every_few_seconds_where_it_is(capsys: pytest.CaptureFixture) -> None:
    times = iter([0.0, 1.0, 2.0, 3.5, 4.0])  # of the start, then of each item
    assert list(steps("draw", ["a", "b", "c", "d"], lambda: next(times))) == ["a", "b", "c", "d"]
    assert capsys.readouterr().err == "draw: 3 of 4: c\n"


def test_short_work_is_silent(capsys: pytest.CaptureFixture) -> None:
    assert list(steps("draw", range(3))) == [0, 1, 2]
    assert capsys.readouterr().err == ""


def test_a_reader_that_has_seen_enough_is_no_error() -> None:
    program = "from ardee_common.cli import Parser, run; run(Parser(prog='p'), lambda args: 'x' * 200_000, [])"
    source = Path(__file__).resolve().parents[1] / "src"
    line = f'set -o pipefail; PYTHONPATH={source} /usr/bin/python3 -c "{program}" | head -c 1'
    done = subprocess.run(["bash", "-c", line], capture_output=True, text=True)
    assert (done.returncode, done.stdout, done.stderr) == (0, "x", "")


def test_a_small_negative_number_is_no_name() -> None:
    parser = Parser()
    parser.add_argument("--pose", type=float, nargs=3)
    assert parser.parse_args(["--pose", "-1e-1", "-.5", "-2"]).pose == [-0.1, -0.5, -2.0]
