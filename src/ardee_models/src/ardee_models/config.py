# SPDX-License-Identifier: MIT
"""Strict YAML to frozen dataclasses: an unknown, missing or out-of-range key is an error that names it."""

import dataclasses
import sys
import typing
from pathlib import Path
from typing import Any, Optional

import yaml

from ardee_common.errors import GeneratorError, not_yaml


def bounded(low: float, high: float, default: Any = dataclasses.MISSING) -> Any:
    """Dataclass field whose value must lie in [low, high]; it may be left out where it has a default."""
    return dataclasses.field(default=default, metadata={"range": (low, high)})


def config_dir() -> Path:
    """Folder of the YAML files, in the source tree or in an installed workspace."""
    here = Path(__file__).resolve().parent
    candidates = (here.parents[1] / "config", here.parents[3] / "share" / "ardee_models" / "config")
    for candidate in candidates:
        if candidate.is_dir():
            return candidate
    raise GeneratorError(
        f"no config folder of ardee_models, looked in {candidates[0]} and {candidates[1]}"
    )


def read_yaml(path: Path) -> dict:
    """A YAML mapping, or an error with the file's name and line."""
    try:
        data = yaml.load(path.read_text(encoding="utf-8"), Loader=_LOADER)
    except OSError as error:
        raise GeneratorError(f"{path}: cannot be read: {error.strerror}") from error
    except (yaml.YAMLError, UnicodeDecodeError) as error:
        raise not_yaml(path, error) from error
    if not isinstance(data, dict):
        raise GeneratorError(
            f"{path}: found {type(data).__name__}, expected a mapping of keys to values"
        )
    return data


# libyaml's safe loader where PyYAML was built with it: ten times as fast, the same data
_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def _number(value: Any, kind: type, where: str, limits: Optional[tuple]) -> Any:
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    is_finite = is_number and abs(value) <= sys.float_info.max  # compares integers beyond it too
    if not is_finite or (kind is int and int(value) != value):
        raise GeneratorError(f"{where}: found {value!r}, expected a finite {kind.__name__}")
    if limits and not limits[0] <= value <= limits[1]:
        raise GeneratorError(
            f"{where}: found {value!r}, expected a value in [{limits[0]}, {limits[1]}]"
        )
    return kind(value)


def _convert(value: Any, kind: Any, where: str, limits: Optional[tuple]) -> Any:
    if typing.get_origin(kind) is typing.Union:  # Optional[X]
        kind = typing.get_args(kind)[0]
    if kind in (int, float):
        return _number(value, kind, where, limits)
    if dataclasses.is_dataclass(kind):
        return from_mapping(kind, value, where)
    if typing.get_origin(kind) is tuple:
        if not isinstance(value, (list, tuple)) or not value:
            raise GeneratorError(f"{where}: found {value!r}, expected a list")
        item = typing.get_args(kind)[0]
        return tuple(_convert(v, item, f"{where}[{i}]", limits) for i, v in enumerate(value))
    if not isinstance(value, kind):
        raise GeneratorError(f"{where}: found {value!r}, expected {kind.__name__}")
    return value


def from_mapping(cls: type, data: Any, where: str) -> Any:
    """Build frozen dataclass `cls` from a mapping that has its keys and no others."""
    if not isinstance(data, dict):
        raise GeneratorError(f"{where}: found {data!r}, expected a mapping of keys to values")
    fields = {f.name: f for f in dataclasses.fields(cls)}
    needed = {name for name, f in fields.items() if f.default is dataclasses.MISSING}
    hints = typing.get_type_hints(cls)
    unknown = sorted(str(k) for k in data.keys() - fields.keys())
    missing = sorted(needed - data.keys())
    if unknown:
        raise GeneratorError(
            f"{where}: unknown key {unknown[0]!r}, known: {', '.join(sorted(fields))}"
        )
    if missing:
        raise GeneratorError(f"{where}: missing key {missing[0]!r}")
    values = {
        name: _convert(
            data[name], hints[name], f"{where}.{name}", fields[name].metadata.get("range")
        )
        for name in fields
        if name in data
    }
    try:
        return cls(**values)
    except GeneratorError as error:  # from a check of its own
        raise GeneratorError(f"{where}: {error}") from error
