# SPDX-License-Identifier: MIT
"""Options of a generator: dataclass fields that know limits, unit and meaning, for commands and YAML alike."""

import dataclasses
import functools
import math
import re
import sys
import typing
from typing import Any, Callable, Dict, Iterator, Optional, Tuple

from ardee_common.errors import GeneratorError

_NONE = type(None)
_KINDS = {str: "a text", bool: "true or false", dict: "a mapping of keys to values"}
# Names of the ROS graph (wiki.ros.org/Names), relative ones among them.
_ROS_NAME = re.compile(r"[~/]?[A-Za-z]\w*(/\w+)*", re.ASCII)
# Suffix of a name to the unit in messages and help; the longest that fits counts.
_UNITS = (
    ("_per_m2", "1/m^2"),
    ("_m2", "m^2"),
    ("_deg", "deg"),
    ("_rad", "rad"),
    ("_percent", "%"),
    ("_m", "m"),
)


def option(
    default: Any,
    text: str = "",
    limits: Optional[Tuple[float, float]] = None,
    choices: Tuple[str, ...] = (),
) -> Any:
    """Dataclass field with its help text, inclusive limits or choices."""
    metadata = {"text": text, "limits": limits, "choices": choices}
    return dataclasses.field(default=default, metadata=metadata)


def bounded(low: float, high: float, default: Any = dataclasses.MISSING) -> Any:
    """Returns an option with inclusive limits, which a file must give where it has no default."""
    return option(default, limits=(low, high))


def converted(
    convert: Callable[[Any], Any], expected: str, default: Any = dataclasses.MISSING
) -> Any:
    """Dataclass field that `convert` makes of the value in a file; it raises ValueError unless that is `expected`."""
    return dataclasses.field(default=default, metadata={"convert": convert, "expected": expected})


def ros_name(default: Any = dataclasses.MISSING) -> Any:
    """Dataclass field for the name of a topic or a service, or the default."""

    def checked(value: Any) -> str:
        if value != default and not (isinstance(value, str) and _ROS_NAME.fullmatch(value)):
            raise ValueError(value)
        return value

    return converted(checked, "a ROS name such as ardee/gps", default)


def unit_of(name: str) -> str:
    """Unit that the name of an option ends in, or nothing."""
    return next((unit for suffix, unit in _UNITS if name.endswith(suffix)), "")


def plain_name(name: str) -> str:
    """The name without its unit."""
    return next((name[: -len(suffix)] for suffix, _ in _UNITS if name.endswith(suffix)), name)


def spoken(name: str) -> str:
    """The name for a message: without its unit, with blanks."""
    return plain_name(name).replace("_", " ")


def kind_of(cls: type, field: dataclasses.Field) -> Any:
    """Type of a field; Optional[X] is X."""
    kind = _hints(cls)[field.name]
    if typing.get_origin(kind) is typing.Union:
        kind = next(k for k in typing.get_args(kind) if k is not _NONE)
    return kind


@functools.lru_cache(maxsize=None)
def _hints(cls: type) -> Dict[str, Any]:
    return typing.get_type_hints(cls)


def range_text(limits: Tuple[float, float], unit: str) -> str:
    """Returns the limits as text for a message."""
    low, high = limits
    text = f"at least {low:.15g}" if math.isinf(high) else f"{low:.15g} to {high:.15g}"
    return f"{text} {unit}".strip()


def _number_problem(
    value: Any, kind: type, limits: Optional[Tuple[float, float]], unit: str
) -> Optional[str]:
    expected = "a whole number" if kind is int else "a finite number"
    if limits:
        expected = ("a whole number, " if kind is int else "") + range_text(limits, unit)
    good = isinstance(value, (int, float)) and not isinstance(value, bool)
    good = good and abs(value) <= sys.float_info.max  # compares integers beyond it too
    good = good and (kind is not int or int(value) == value)
    good = good and (limits is None or limits[0] <= value <= limits[1])
    return None if good else expected


def problem(cls: type, field: dataclasses.Field, value: Any) -> Optional[str]:
    """Returns what a field's value should have been, or None if the value is valid."""
    if value is None and field.default is None:
        return None
    kind, metadata = kind_of(cls, field), field.metadata
    limits, unit = metadata.get("limits"), unit_of(field.name)
    if kind in (int, float):
        return _number_problem(value, kind, limits, unit)
    if typing.get_origin(kind) is tuple:
        items = typing.get_args(kind)
        if not isinstance(value, (list, tuple)):
            return "a list"
        if items[-1] is not Ellipsis and len(items) != len(value):
            return f"{len(items)} values"
        if not value and field.default is dataclasses.MISSING:
            return "a list that is not empty"
        if items[0] in (int, float):
            problems = (_number_problem(v, items[0], limits, unit) for v in value)
            return next((p for p in problems if p), None)
        return None if all(isinstance(v, items[0]) for v in value) else "a list of texts"
    if metadata.get("choices") and value not in metadata["choices"]:
        return "one of " + ", ".join(metadata["choices"])
    return None if isinstance(value, kind) else _KINDS.get(kind, kind.__name__)


def scalar_fields(cls: type) -> Iterator[dataclasses.Field]:
    """Fields that are options, not groups of options."""
    return (f for f in dataclasses.fields(cls) if not dataclasses.is_dataclass(kind_of(cls, f)))


def check(config: Any, prefix: str = "") -> None:
    """Raises GeneratorError for the first option of a dataclass that is out of its limits."""
    for field in scalar_fields(type(config)):
        if "limits" in field.metadata:
            value = getattr(config, field.name)
            expected = problem(type(config), field, value)
            if expected:
                raise GeneratorError(
                    f"{prefix}{spoken(field.name)}: found {value}, expected {expected}"
                )


def defaults(cls: type) -> Dict[str, Any]:
    """Name to default of the options of a dataclass."""
    return {f.name: f.default for f in scalar_fields(cls)}
