# SPDX-License-Identifier: MIT
"""The parser of all commands, types of arguments, and the handling of errors."""

import argparse
import contextlib
import importlib
import math
import os
import re
import sys
import threading
import time
from pathlib import Path
from typing import Any, Callable, Dict, Iterator, Mapping, NoReturn, Optional, Sequence

from ardee_common.errors import GeneratorError, WorkersError, known_names
from ardee_common.options import range_text
from ardee_common.process import Ended, end_by_signals, end_if_told, end_in_a_line

PROGRESS_S = 3.0  # longest time that a command works without a word
_CLEAR_LINE = "\r\033[K"  # of a terminal


class Help(argparse.HelpFormatter):
    """Help that ends the phrase of every argument with its default, unless the phrase speaks of it."""

    def _get_help_string(self, action: argparse.Action) -> Optional[str]:
        has_default = action.option_strings or action.nargs in ("?", "*")
        no_value = (None, False, argparse.SUPPRESS, "", [], ())
        if not has_default or action.default in no_value or "default" in (action.help or ""):
            return action.help
        return f"{action.help or ''} (default %(default)s)".strip()


class RawHelp(Help, argparse.RawDescriptionHelpFormatter):
    """Help that leaves the lines of the description as they are."""


class Parser(argparse.ArgumentParser):
    """Argument parser that reports an error in one line, without the usage, and understands old names of arguments."""

    def __init__(
        self, *args: Any, old_names: Optional[Dict[str, str]] = None, **kwargs: Any
    ) -> None:
        kwargs.setdefault("formatter_class", Help)
        super().__init__(*args, **kwargs)
        self._old_names = old_names or {}
        # argparse's own takes -1e-3 for the name of an argument
        self._negative_number_matcher = re.compile(r"-(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$")

    def parse_known_args(self, args: Any = None, namespace: Any = None) -> Any:
        """Parses the arguments by their present names, with a note for each old name."""
        words = [self._present(word) for word in (sys.argv[1:] if args is None else args)]
        self._refuse_unknown(words)
        return super().parse_known_args(words, namespace)

    def _refuse_unknown(self, words: Sequence[str]) -> None:
        """Ends with the nearest right names for a misspelt one, whose value argparse takes for another argument."""
        known = [flag for flag in self._option_string_actions if flag.startswith("--")]
        for word in words[: words.index("--")] if "--" in words else words:
            flag = word.partition("=")[0]
            if flag.startswith("--") and not any(name.startswith(flag) for name in known):
                self.error(f"unknown argument {flag!r}, {known_names(flag, known)}")

    def _present(self, word: str) -> str:
        """Returns an argument with its present name in the place of an old one."""
        flag, is_joined, value = word.partition("=")
        if flag not in self._old_names:
            return word
        name = self._old_names[flag]
        say(self.prog, f"note: {flag} is now {name}")
        return name + is_joined + value

    def error(self, message: str) -> NoReturn:
        """Prints the error and exits with code 2."""
        self.exit(2, f"{self.prog}: {message} (--help lists all arguments)\n")


def whole_in(least: int, most: float = math.inf) -> Callable[[str], int]:
    """Returns the argparse type of a whole number within limits."""
    expected = f"a whole number from {least}" + (f" to {most}" if most < math.inf else "")

    def read(text: str) -> int:
        is_number = re.fullmatch(r"[-+]?\d{1,40}", text, re.ASCII)
        if not is_number or not least <= int(text) <= most:
            raise argparse.ArgumentTypeError(f"found {text!r}, expected {expected}")
        return int(text)

    return read


def number_in(least: float, most: float = math.inf) -> Callable[[str], float]:
    """Returns the argparse type of a finite number within limits."""
    return _number(lambda value: least <= value <= most, range_text((least, most), ""))


def _number(is_good: Callable[[float], bool], expected: str) -> Callable[[str], float]:
    def read(text: str) -> float:
        try:
            value = float(text)
        except ValueError:
            value = math.nan
        if not (math.isfinite(value) and is_good(value)):
            raise argparse.ArgumentTypeError(f"found {text!r}, expected {expected}")
        return value

    return read


def say(prog: str, text: str) -> None:
    """Prints a line for the user beside the output, which another program may read."""
    clear = _CLEAR_LINE if sys.stderr.isatty() else ""
    print(f"{clear}{prog}: {text}", file=sys.stderr, flush=True)


@contextlib.contextmanager
def seconds_shown(prog: str) -> Iterator[None]:
    """Shows the seconds that the work in the block has taken, from PROGRESS_S on, in the last line of a terminal."""
    if not sys.stderr.isatty():
        yield
        return
    began, has_ended = time.monotonic(), threading.Event()

    def show() -> None:
        wait_s = PROGRESS_S
        while not has_ended.wait(wait_s):
            wait_s = 1.0
            text = f"{_CLEAR_LINE}{prog}: {time.monotonic() - began:.0f} s "
            print(text, end="", file=sys.stderr, flush=True)
        print(_CLEAR_LINE, end="", file=sys.stderr, flush=True)

    shower = threading.Thread(target=show, daemon=True)
    shower.start()
    try:
        yield
    finally:
        has_ended.set()
        shower.join()


def steps(
    prog: str, items: Sequence[Any], clock: Callable[[], float] = time.monotonic
) -> Iterator[Any]:
    """Yields the items of some long work, and says every few seconds at which it is."""
    said = clock()
    for number, item in enumerate(items, 1):
        end_if_told()
        now = clock()
        if now - said >= PROGRESS_S:
            say(prog, f"{number} of {len(items)}: {item}")
            said = now
        yield item


def add_seed(
    parser: Any, default: int = 0, text: str = "root of all random numbers"
) -> argparse.Action:
    """Adds --seed, a whole number from 0; returns its action."""
    return parser.add_argument(
        "--seed", type=seed_number, metavar="N", default=default, help=f"{text} (default {default})"
    )


def add_model_path(parser: Any) -> None:
    """Adds --model-path, which may be given more than once."""
    parser.add_argument(
        "--model-path",
        type=Path,
        action="append",
        default=[],
        metavar="DIR",
        help="folder of models to search before GAZEBO_MODEL_PATH; may be given again",
    )


seed_number = whole_in(0)
positive_number = _number(lambda value: value > 0.0, "a number above 0")


def dispatch(
    prog: str,
    modules: Mapping[str, str],
    description: str,
    arguments: Optional[Sequence[str]] = None,
) -> int:
    """Runs the main(arguments) of the module whose command the first argument names; returns its exit code."""
    words = sys.argv[1:] if arguments is None else arguments
    parser = Parser(prog=prog, description=description)
    parser.add_argument("command", metavar="COMMAND", help=", ".join(modules))
    name = parser.parse_args(words[:1]).command
    if name not in modules:
        parser.error(f"unknown command {name!r}, {known_names(name, modules)}")
    end_in_a_line(name)
    return importlib.import_module(modules[name]).main(words[1:])


def run(
    parser: argparse.ArgumentParser,
    work: Callable[[argparse.Namespace], Any],
    arguments: Optional[Sequence[str]] = None,
) -> int:
    """Parses, works, prints the result if there is one; returns 0.

    Exits with one line: with 2 for bad input, 1 if the work cannot go on, and 130 after Ctrl-C, once it has cleaned up.
    """
    args = parser.parse_args(arguments)
    end_by_signals()
    try:
        with seconds_shown(parser.prog):
            result = work(args)
    except Ended as ended:
        parser.exit(ended.code, f"{parser.prog}: interrupted\n")
    except (GeneratorError, OSError) as error:
        parser.exit(2, f"{parser.prog}: {error}\n")
    except WorkersError as error:
        parser.exit(1, f"{parser.prog}: {error}\n")
    if result is not None:
        _print(result)
    return 0


def _print(result: Any) -> None:
    try:
        print(result, flush=True)
    except BrokenPipeError:  # its reader, such as head, has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
