# SPDX-License-Identifier: MIT
"""Checks of arguments of environments. All raise ArdeeError: arguments stand in files of episodes, too."""

from collections.abc import Mapping as MappingABC
from contextlib import contextmanager
from typing import Any, Iterator, Mapping, Tuple

from ardee_sim import checks
from ardee_sim.errors import ArdeeError

MOST_SEED = 2**63 - 1


@contextmanager
def refusals() -> Iterator[None]:
    """Turns the TypeError of a check into an ArdeeError."""
    try:
        yield
    except TypeError as error:
        raise ArdeeError(str(error)) from error


def names(value: Any, name: str) -> Tuple[str, ...]:
    """Returns a list of texts."""
    if not isinstance(value, (list, tuple)):
        raise ArdeeError(f"{checks.found(value, name)}, expected a list of names")
    with refusals():
        return tuple(checks.text(each, name) for each in value)


def mapping(value: Any, name: str) -> Mapping[str, Any]:
    """Returns values by their names."""
    if not isinstance(value, MappingABC):
        raise ArdeeError(f"{checks.found(value, name)}, expected values by their names")
    return value


def a_seed(value: Any, name: str) -> int:
    """Returns a seed."""
    with refusals():
        return checks.whole(value, name, 0, MOST_SEED)
