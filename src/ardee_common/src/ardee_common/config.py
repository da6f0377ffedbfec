# SPDX-License-Identifier: MIT
"""YAML to data that remembers its lines, and to dataclasses: an unknown key is an error with file and line."""

import dataclasses
import re
from pathlib import Path
from typing import Any, Dict, Iterable, List, Union

import yaml  # type: ignore[import]

from ardee_common.errors import GeneratorError, known_names, not_yaml
from ardee_common.options import kind_of, problem

# libyaml's safe loader where PyYAML was built with it: ten times as fast, the same data
_LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_MAX_BYTES = 64 << 20
_MAX_REPEATED = 100_000  # values that aliases may stand for, beside those that are written out
# YAML 1.1 takes 1e-4 (without a dot) for a text; people mean the number.
_EXPONENT = re.compile(r"[-+]?\d+[eE][-+]?\d+")
# Numbers of YAML 1.1 that people do not mean: 1:30 is 90 to it, and 010 is 8.
_NUMBERS = ("tag:yaml.org,2002:int", "tag:yaml.org,2002:float")
_NOT_DECIMAL = re.compile(r".*:.*|[-+]?0[0-7_]+")
_MERGE = "tag:yaml.org,2002:merge"  # of the key <<


class Mapping(dict):
    """A mapping that knows its place: a file, where `line[key]` is the line of a key, or a path of keys."""

    def __init__(self, place: Union[Path, str], own_line: int = 0) -> None:
        super().__init__()
        self.place, self.own_line = place, own_line
        self.line: Dict[str, int] = {}

    def error(self, key: str, message: str) -> GeneratorError:
        """Returns an error at a key, or about the whole mapping."""
        line = self.line.get(key, self.own_line)
        where = f"{self.place}:{line}: " if line else f"{self.place}: " if self.place else ""
        return GeneratorError(f"{where}{message}")


class _Converter:
    """Makes plain data of the nodes of a file; aliases may stand for a bounded number of values."""

    def __init__(self, path: Path, loader: yaml.SafeLoader, most_values: int) -> None:
        self._path, self._loader, self._values_left = path, loader, most_values

    def convert(self, node: yaml.Node, depth: int = 0) -> Any:
        """Returns the data of a node."""
        line = node.start_mark.line + 1
        if depth > 20:
            raise GeneratorError(f"{self._path}:{line}: found more than 20 levels, expected fewer")
        self._values_left -= 1
        if self._values_left < 0:
            found = f"found aliases that stand for more than {_MAX_REPEATED} values"
            raise GeneratorError(f"{self._path}:{line}: {found}, expected fewer")
        if isinstance(node, yaml.MappingNode):
            return self._mapping(node, depth)
        if isinstance(node, yaml.SequenceNode):
            return [self.convert(item, depth + 1) for item in node.value]
        if not node.style and _EXPONENT.fullmatch(node.value):
            return float(node.value)
        return self._plain(node)

    def _plain(self, node: yaml.Node) -> Any:
        """Returns the data of a node that is a value or a key."""
        made = self._loader.construct_object(node)
        if node.tag in _NUMBERS and _NOT_DECIMAL.fullmatch(node.value):
            where = f"{self._path}:{node.start_mark.line + 1}"
            found = f"found {node.value}, which YAML takes for {made}"
            raise GeneratorError(f"{where}: {found}, expected a decimal number or a text in quotes")
        return made

    def _mapping(self, node: yaml.MappingNode, depth: int) -> Mapping:
        made = Mapping(self._path, node.start_mark.line + 1)
        merged: List[Mapping] = []
        for key_node, value_node in node.value:
            if key_node.tag == _MERGE:
                merged += self._merged(value_node, depth)
                continue
            key, at = str(self._plain(key_node)), key_node.start_mark.line + 1
            if key in made:
                raise GeneratorError(
                    f"{self._path}:{at}: found key {key!r} a second time, first in line {made.line[key]}"
                )
            made.line[key] = at
            made[key] = self.convert(value_node, depth + 1)
        for other in merged:
            for key in [key for key in other if key not in made]:
                made[key], made.line[key] = other[key], other.line[key]
        return made

    def _merged(self, node: yaml.Node, depth: int) -> List[Mapping]:
        """Returns the mappings whose keys a `<<` adds, the first of them before the others."""
        value = self.convert(node, depth + 1)
        found = value if isinstance(value, list) else [value]
        if not all(isinstance(each, Mapping) for each in found):
            where = f"{self._path}:{node.start_mark.line + 1}"
            raise GeneratorError(
                f"{where}: <<: found {value!r}, expected a mapping or a list of them"
            )
        return found


def read_yaml_lines(path: Path) -> Mapping:
    """The mapping that a YAML file holds."""
    try:
        if path.stat().st_size > _MAX_BYTES:
            raise GeneratorError(f"{path}: found more than {_MAX_BYTES} bytes, expected fewer")
        text = path.read_text(encoding="utf-8")
        loader = _LOADER(text)
        try:
            node = loader.get_single_node()
            converter = _Converter(path, loader, len(text) + _MAX_REPEATED)
            data = converter.convert(node) if node is not None else None
        finally:
            loader.dispose()
    except OSError as error:
        raise GeneratorError(f"{path}: cannot be read: {error.strerror}") from error
    except (yaml.YAMLError, UnicodeDecodeError, ValueError, RecursionError) as error:
        raise not_yaml(path, error) from error
    except (KeyError, AttributeError) as error:  # of a tag such as !!bool with another text
        raise GeneratorError(
            f"{path}: found a value that its !!tag does not allow: {error}"
        ) from error
    if not isinstance(data, Mapping):
        found = "nothing" if data is None else type(data).__name__
        raise GeneratorError(f"{path}: found {found}, expected a mapping of keys to values")
    return data


def unknown_key(mapping: Mapping, key: str, known: Iterable[str]) -> GeneratorError:
    """Returns the error for a key that is not one of the known ones, with the nearest of them."""
    return mapping.error(key, f"unknown key {key!r}, {known_names(key, known)}")


def value_of(cls: type, field: dataclasses.Field, mapping: Mapping, key: str) -> Any:
    """Returns the value of a key, checked against the field that it is for, and converted."""
    value = mapping[key]
    if "convert" in field.metadata:
        try:
            return field.metadata["convert"](value)
        except ValueError:
            expected = field.metadata["expected"]
            raise mapping.error(key, f"{key}: found {value!r}, expected {expected}") from None
        except GeneratorError as error:  # which says itself what was expected
            raise mapping.error(key, f"{key}: {error}") from None
    expected = problem(cls, field, value)
    if expected:
        raise mapping.error(key, f"{key}: found {value!r}, expected {expected}")
    kind = kind_of(cls, field)
    if isinstance(value, list):
        return tuple(value)
    return kind(value) if kind in (int, float) and value is not None else value


def build(cls: type, mapping: Mapping) -> Any:
    """A dataclass of options from a mapping with any of its keys; groups nest, tuples of groups are lists."""
    fields = {f.name: f for f in dataclasses.fields(cls)}
    values = {}
    for key in mapping:
        if key not in fields:
            raise unknown_key(mapping, key, fields)
        kind = kind_of(cls, fields[key])
        group = fields[key].metadata.get("group", kind if dataclasses.is_dataclass(kind) else None)
        if group is None:
            values[key] = value_of(cls, fields[key], mapping, key)
        elif isinstance(fields[key].default, tuple):
            values[key] = build_list(group, mapping, key)
        else:
            values[key] = build_group(group, mapping, key)
    for name, field in fields.items():
        is_needed = field.default is field.default_factory is dataclasses.MISSING
        if is_needed and name not in values:
            raise mapping.error("", f"missing key {name!r}")
    try:
        return cls(**values)
    except (GeneratorError, ValueError) as error:  # from a check of its own
        raise mapping.error("", str(error)) from error


def from_values(cls: type, values: Any) -> Any:
    """Returns a dataclass of options from values that stand in no file, such as ROS parameters."""
    if not isinstance(values, dict):
        raise GeneratorError(f"found {values!r}, expected a mapping of keys to values")
    return build(cls, _placed(values, ""))


def _placed(value: Any, place: str) -> Any:
    """Returns the value with all its mappings told their places, such as peers[0]."""
    if isinstance(value, dict):
        made = Mapping(place)
        for key, item in value.items():
            made[str(key)] = _placed(item, f"{place}.{key}" if place else str(key))
        return made
    if isinstance(value, list):
        return [_placed(item, f"{place}[{number}]") for number, item in enumerate(value)]
    return value


def build_group(group: type, mapping: Mapping, key: str) -> Any:
    """Returns the dataclass of options that the mapping below a key gives."""
    return _group(group, mapping, key, mapping[key])


def build_list(group: type, mapping: Mapping, key: str) -> tuple:
    """Returns the dataclasses of options that the list below a key gives."""
    return tuple(_group(group, mapping, key, item) for item in _items(mapping, key))


def _items(mapping: Mapping, key: str) -> list:
    if not isinstance(mapping[key], list):
        raise mapping.error(key, f"{key}: found {mapping[key]!r}, expected a list")
    return mapping[key]


def _group(group: type, mapping: Mapping, key: str, value: Any) -> Any:
    if not isinstance(value, Mapping):
        raise mapping.error(key, f"{key}: found {value!r}, expected a mapping of keys to values")
    return build(group if isinstance(group, type) else group(value), value)
