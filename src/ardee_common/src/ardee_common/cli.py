# SPDX-License-Identifier: MIT
"""What commands share."""

import argparse
from pathlib import Path
from typing import Callable, NoReturn

from ardee_common.errors import GeneratorError


class Parser(argparse.ArgumentParser):
    """Says what is wrong in one line: the usage would bury it."""

    def error(self, message: str) -> NoReturn:
        """Exit 2."""
        self.exit(2, f"{self.prog}: {message} (--help lists all arguments)\n")


def seed_number(text: str) -> int:
    """argparse type: a whole number from 0."""
    if not (text.isascii() and text.isdigit()):
        raise argparse.ArgumentTypeError(f"found {text!r}, expected a whole number from 0")
    return int(text)


def positive_number(text: str) -> float:
    """argparse type: a finite number above 0."""
    try:
        value = float(text)
    except ValueError:
        value = 0.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"found {text!r}, expected a number above 0")
    return value


def run(parser: argparse.ArgumentParser, work: Callable[[argparse.Namespace], Path]) -> int:
    """Parse, work, print the path written; one line and exit code 2 for bad input."""
    args = parser.parse_args()
    try:
        print(work(args))
    except GeneratorError as error:
        parser.exit(2, f"{parser.prog}: {error}\n")
    return 0
