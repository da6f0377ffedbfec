# SPDX-License-Identifier: MIT
"""The errors that every command prints in one line."""

import difflib
from pathlib import Path
from typing import Iterable

_NAMES_SHOWN = 5


class GeneratorError(Exception):
    """Bad input: says where, what was found and what was expected."""


class WorkersError(Exception):
    """Error of worker processes or the disk: the work cannot go on, what is finished stays."""


def known_names(name: str, known: Iterable[str]) -> str:
    """Returns for a message the names that there are, those nearest to a wrong one first, of many only these."""
    names = list(known)
    if not names:
        return "known: none"

    def likeness(other: str) -> float:
        one, two = sorted((name.lower(), other.lower()), key=len)
        is_telling = len(one) >= 3  # a letter or two are a part of many names
        is_part, is_begin = is_telling and one in two, is_telling and two.startswith(one)
        return is_part + is_begin + difflib.SequenceMatcher(None, name, other).ratio()

    near = sorted(names, key=likeness, reverse=True)[:_NAMES_SHOWN]
    which = "known" if len(near) == len(names) else f"nearest of {len(names)}"
    guess = f"; did you mean {near[0]!r}?" if likeness(near[0]) >= 0.6 else ""
    return f"{which}: {', '.join(near)}{guess}"


def not_yaml(path: Path, error: Exception) -> GeneratorError:
    """Returns the error of a YAML reader in one line with file and line."""
    mark = getattr(error, "problem_mark", None)
    where = f"{path}:{mark.line + 1}" if mark else f"{path}"
    text = getattr(error, "problem", None) or str(error)
    start = getattr(error, "context_mark", None)
    if start:
        text += f" {getattr(error, 'context', '')} from line {start.line + 1}"
    return GeneratorError(f"{where}: not valid YAML: {' '.join(text.split())}")
