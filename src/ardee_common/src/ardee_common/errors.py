# SPDX-License-Identifier: MIT
"""The one error the generators raise for bad input."""

from pathlib import Path


class GeneratorError(Exception):
    """Bad input: says where, what was found and what was expected."""


def not_yaml(path: Path, error: Exception) -> GeneratorError:
    """Returns the error of a YAML reader in one line with file and line."""
    mark = getattr(error, "problem_mark", None)
    where = f"{path}:{mark.line + 1}" if mark else f"{path}"
    text = getattr(error, "problem", None) or str(error)
    start = getattr(error, "context_mark", None)
    if start:
        text += f" {error.context} from line {start.line + 1}"
    return GeneratorError(f"{where}: not valid YAML: {' '.join(text.split())}")
