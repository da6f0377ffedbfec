# SPDX-License-Identifier: MIT
"""Command lines of controllers that are programs: parameters put into their words, and their end with a worker."""
import ctypes
import shutil
from typing import Any, List, Mapping, Sequence

from ardee_common.errors import GeneratorError

_PR_SET_PDEATHSIG = 1


def end_with_parent(number: int) -> None:
    """Makes the kernel send this child a signal when the worker that started it ends, however that ends."""
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, number)


def filled(command: Sequence[str], values: Mapping[str, Any]) -> List[str]:
    """Returns the words of a command with `{NAME}` replaced by a value."""
    try:
        return [word.format(**values) for word in command]
    except (KeyError, IndexError, ValueError) as error:
        expected = ", ".join(f"{{{name}}}" for name in values) or "no parameter"
        raise GeneratorError(
            f"command: found {error!r} in {' '.join(command)!r}, expected {expected}"
        ) from None


def check(command: Sequence[str], params: Mapping[str, Any], places: Sequence[str] = ()) -> None:
    """Raises GeneratorError unless the program is there and its words have all parameters; `places` may be there."""
    unused = [name for name in params if not any(f"{{{name}}}" in word for word in command)]
    if unused:
        raise GeneratorError(f"params: found {unused[0]!r}, expected {{{unused[0]}}} in command")
    program = filled(command, {**dict.fromkeys(places, ""), **params})[0]
    if not shutil.which(program):
        raise GeneratorError(f"command: found no program {program!r}, expected one")
