# SPDX-License-Identifier: MIT
"""Checks of arguments. Each returns the value, or raises TypeError or ArdeeError with what was found and expected."""

import math
import numbers
import operator
import os
from collections.abc import Mapping
from typing import Any, Dict, Sequence, Union

import numpy as np
from ardee_sim.errors import ArdeeError

MOST_WHOLE = 2**64 - 1
Vector = Union[Sequence[float], np.ndarray]


def found(value: Any, name: str) -> str:
    """Returns the beginning of a message, in one line."""
    shown = " ".join(repr(value).split())
    return f"{name}: found {shown if len(shown) <= 80 else shown[:77] + '...'}"


def text(value: Any, name: str) -> str:
    """Returns a text."""
    if not isinstance(value, str):
        raise TypeError(f"{found(value, name)}, expected a text")
    if "\0" in value or value != value.encode(errors="replace").decode():
        raise ArdeeError(f"{found(value, name)}, expected a text without NUL that UTF-8 can hold")
    return value


def path(value: Any, name: str) -> str:
    """Returns a path as a text."""
    if not isinstance(value, (str, os.PathLike)):
        raise TypeError(f"{found(value, name)}, expected a path")
    if not os.fspath(value):
        raise ArdeeError(f"{found(value, name)}, expected a path")
    return text(os.fspath(value), name)


def flag(value: Any, name: str) -> bool:
    """Returns a truth value."""
    if not isinstance(value, (bool, np.bool_)):
        raise TypeError(f"{found(value, name)}, expected True or False")
    return bool(value)


def number(value: Any, name: str, least: float = -math.inf, most: float = math.inf) -> float:
    """Returns a finite number within limits."""
    if not isinstance(value, numbers.Real):
        raise TypeError(f"{found(value, name)}, expected a number")
    try:
        made = float(value)
    except OverflowError:
        made = math.inf
    if not (math.isfinite(made) and least <= made <= most):
        within = f" from {least:g} to {most:g}" if math.isfinite(most - least) else ""
        raise ArdeeError(f"{found(value, name)}, expected a finite number{within}")
    return made


def named_numbers(values: Any, name: str) -> Dict[str, float]:
    """Returns finite numbers by their names."""
    if not isinstance(values, Mapping):
        raise TypeError(f"{found(values, name)}, expected a mapping of names to numbers")
    return {text(key, name): number(each, f"{name}[{key!r}]") for key, each in values.items()}


def whole(value: Any, name: str, least: int = 0, most: int = MOST_WHOLE) -> int:
    """Returns a whole number within limits."""
    try:
        index = operator.index(value)
    except TypeError:
        raise TypeError(f"{found(value, name)}, expected a whole number") from None
    if not least <= index <= most:
        limit = "2^64 - 1" if most == MOST_WHOLE else str(most)
        raise ArdeeError(f"{found(index, name)}, expected {least} to {limit}")
    return index


def vector(values: Vector, name: str, size: int = 3) -> np.ndarray:
    """Returns finite numbers, float64[size]."""
    try:
        given = np.asarray(values)
        if given.dtype.kind in "USc":
            raise TypeError("text or complex")
        made = given.astype(float)
    except (TypeError, ValueError, OverflowError):
        raise ArdeeError(f"{found(values, name)}, expected {size} numbers") from None
    if made.shape != (size,) or not np.isfinite(made).all():
        raise ArdeeError(f"{found(values, name)}, expected {size} finite numbers")
    return made


def quaternion(values: Vector, name: str = "quat_xyzw") -> np.ndarray:
    """Returns a quaternion, float64[4]."""
    made = vector(values, name, 4)
    if not 1e-6 < np.linalg.norm(made) < 1e6:
        raise ArdeeError(f"{found(values, name)}, expected a quaternion of about length 1")
    return made
