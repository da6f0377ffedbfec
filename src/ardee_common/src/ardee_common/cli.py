# SPDX-License-Identifier: MIT
"""The parser of all commands, types of arguments, and the handling of errors."""

import argparse
import math
import re
from typing import Any, Callable, NoReturn, Optional, Sequence

from ardee_common.errors import GeneratorError
from ardee_common.options import range_text


class Parser(argparse.ArgumentParser):
    """Argument parser that reports an error in one line, without the usage."""

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


seed_number = whole_in(0)
positive_number = _number(lambda value: value > 0.0, "a number above 0")


def run(
    parser: argparse.ArgumentParser,
    work: Callable[[argparse.Namespace], Any],
    arguments: Optional[Sequence[str]] = None,
) -> int:
    """Parses, works, prints the result if there is one; returns 0, or exits with one line and 2 for bad input."""
    args = parser.parse_args(arguments)
    try:
        result = work(args)
    except (GeneratorError, OSError) as error:
        parser.exit(2, f"{parser.prog}: {error}\n")
    if result is not None:
        print(result)
    return 0
