# SPDX-License-Identifier: MIT
"""What commands share."""

import argparse
from pathlib import Path
from typing import Callable

from ardee_models.errors import GeneratorError


def seed_number(text: str) -> int:
    """argparse type: a whole number from 0."""
    value = int(text)
    if value < 0:
        raise ValueError(text)
    return value


def run(parser: argparse.ArgumentParser, work: Callable[[argparse.Namespace], Path]) -> int:
    """Parse, work, print the path written; one line and exit code 2 for bad input."""
    args = parser.parse_args()
    try:
        print(work(args))
    except GeneratorError as error:
        parser.exit(2, f"{parser.prog}: {error}\n")
    return 0
