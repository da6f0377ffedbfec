# SPDX-License-Identifier: MIT
"""Ranges of a recipe, of which a value is drawn."""

import dataclasses
from typing import Tuple

from ardee_common.config import Mapping
from ardee_common.options import kind_of

Range = Tuple[float, float]


def check_ranges(cls: type, given: Mapping) -> None:
    """Raises GeneratorError, with file and line, for another value where an option wants [least, most].

    Such options have a pair as default, in a group of options too.
    """
    for field in dataclasses.fields(cls):
        key, kind = field.name, kind_of(cls, field)
        value = given.get(key)
        if dataclasses.is_dataclass(kind) and isinstance(value, Mapping):
            check_ranges(kind, value)
        is_range = isinstance(field.default, tuple) and len(field.default) == 2
        if is_range and key in given and not (isinstance(value, list) and len(value) == 2):
            raise given.error(key, f"{key}: found {value!r}, expected [least, most]")
