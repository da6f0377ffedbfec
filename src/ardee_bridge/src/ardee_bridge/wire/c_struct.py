# SPDX-License-Identifier: MIT
"""Structs as C compilers lay them out on x86-64 and ARM: little-endian, each member at its natural alignment."""
import itertools
import math
import struct
from typing import Any, Dict, Iterator, List, NamedTuple, Tuple, Type, TypeVar, Union

from ardee_bridge.wire.scales import Scale, scale_of


class Scalar(NamedTuple):
    """An integer type of C: its code in Python's struct module, size, least and greatest value."""

    code: str
    size: int
    limits: Tuple[int, int]
    alignment = property(lambda self: self.size)


INT8 = Scalar("b", 1, (-(1 << 7), (1 << 7) - 1))
UINT8 = Scalar("B", 1, (0, (1 << 8) - 1))
UINT16 = Scalar("H", 2, (0, (1 << 16) - 1))
INT32 = Scalar("i", 4, (-(1 << 31), (1 << 31) - 1))

# An int32 field of this value has no value: NaN on the physical side.
NO_VALUE = -(1 << 31)


class Array(NamedTuple):
    """A C array of scalars."""

    item: Scalar
    length: int
    alignment = property(lambda self: self.item.alignment)
    size = property(lambda self: self.item.size * self.length)


class Leaf(NamedTuple):
    """A scalar or array somewhere in a struct: dotted path, place in bytes, type, scale."""

    path: str
    offset: int
    kind: Union[Scalar, Array]
    scale: Scale


S = TypeVar("S", bound="CStruct")


def _padded(offset: int, alignment: int) -> int:
    return -(-offset // alignment) * alignment


class CStruct:
    """A C struct. Its fields hold raw integers, as on the wire, or after to_si() physical values."""

    C_NAME = ""
    FIELDS: Tuple[Tuple[str, Any], ...] = ()
    size = 0
    alignment = 1
    leaves: Tuple[Leaf, ...] = ()

    def __init_subclass__(cls) -> None:
        offset, leaves = 0, []  # type: int, List[Leaf]
        cls.alignment = max(kind.alignment for _, kind in cls.FIELDS)
        for name, kind in cls.FIELDS:
            offset = _padded(offset, kind.alignment)
            if isinstance(kind, (Scalar, Array)):
                leaves.append(Leaf(name, offset, kind, scale_of(cls.C_NAME, name)))
            else:
                for inner in kind.leaves:
                    path = f"{name}.{inner.path}"
                    scale = scale_of(cls.C_NAME, path)
                    place = offset + inner.offset
                    leaves.append(inner._replace(path=path, offset=place, scale=scale))
            offset += kind.size
        cls.leaves, cls.size = tuple(leaves), _padded(offset, cls.alignment)
        cls._struct = struct.Struct(cls._format())

    @classmethod
    def _format(cls) -> str:
        text, offset = "<", 0
        for leaf in cls.leaves:
            text += "x" * (leaf.offset - offset)
            is_array = isinstance(leaf.kind, Array)
            text += f"{leaf.kind.length}{leaf.kind.item.code}" if is_array else leaf.kind.code
            offset = leaf.offset + leaf.kind.size
        return text + "x" * (cls.size - offset)

    def __init__(self, **values: Any) -> None:
        for name, kind in self.FIELDS:
            default = 0 if isinstance(kind, Scalar) else () if isinstance(kind, Array) else None
            value = values.pop(name, default)
            setattr(self, name, kind() if value is None else value)
        if values:
            known = ", ".join(name for name, _ in self.FIELDS)
            raise TypeError(f"{self.C_NAME} has no field {', '.join(values)}; it has {known}")

    def _values(self) -> Iterator[Any]:
        """Yields scalars and arrays in the order of the leaves."""
        for name, kind in self.FIELDS:
            value = getattr(self, name)
            if isinstance(kind, (Scalar, Array)):
                yield value
            else:
                yield from value._values()

    @classmethod
    def _from_values(cls: Type[S], values: Iterator[Any]) -> S:
        made = cls.__new__(cls)
        for name, kind in cls.FIELDS:
            is_leaf = isinstance(kind, (Scalar, Array))
            setattr(made, name, next(values) if is_leaf else kind._from_values(values))
        return made

    def pack(self) -> bytes:
        """Returns the bytes of the struct; arrays that are too short are filled up with zeros."""
        flat = []  # type: List[int]
        for leaf, value in zip(self.leaves, self._values()):
            if not isinstance(leaf.kind, Array):
                flat.append(value)
                continue
            missing = leaf.kind.length - len(value)
            if missing < 0:
                raise ValueError(f"{leaf.path}: {len(value)} values, at most {leaf.kind.length}")
            flat.extend(value)
            flat.extend((0,) * missing)
        try:
            return self._struct.pack(*flat)
        except struct.error as error:
            raise ValueError(f"{self.C_NAME}: {error}") from None

    @classmethod
    def unpack(cls: Type[S], data: bytes) -> S:
        """Returns the struct that these bytes are; ValueError when there are too few or too many."""
        if len(data) != cls.size:
            raise ValueError(f"{cls.C_NAME}: {len(data)} bytes, expected {cls.size}")
        flat = iter(cls._struct.unpack(data))
        values = (
            tuple(itertools.islice(flat, leaf.kind.length))
            if isinstance(leaf.kind, Array)
            else next(flat)
            for leaf in cls.leaves
        )
        return cls._from_values(values)

    def to_si(self: S) -> S:
        """Returns the same with physical values in the units of the table of scales; NO_VALUE becomes NaN."""

        def physical(leaf: Leaf, value: Any) -> Any:
            per_unit = leaf.scale.counts_per_unit
            if per_unit is None:
                return value
            if isinstance(leaf.kind, Array):
                return tuple(math.nan if raw == NO_VALUE else raw / per_unit for raw in value)
            return math.nan if value == NO_VALUE else value / per_unit

        return self._from_values(map(physical, self.leaves, self._values()))

    def to_raw(self: S) -> S:
        """Returns the same with integers, from physical values: rounded, saturated, NaN as NO_VALUE."""

        def raw(leaf: Leaf, value: Any) -> Any:
            per_unit = leaf.scale.counts_per_unit or 1
            if isinstance(leaf.kind, Array):
                return tuple(_to_count(each, per_unit, leaf.kind.item.limits) for each in value)
            return _to_count(value, per_unit, leaf.kind.limits)

        return self._from_values(map(raw, self.leaves, self._values()))

    def as_dict(self) -> Dict[str, Any]:
        """Returns each value by its dotted path."""
        return {leaf.path: value for leaf, value in zip(self.leaves, self._values())}

    def __eq__(self, other: object) -> bool:
        return type(other) is type(self) and self.as_dict() == other.as_dict()  # type: ignore

    def __repr__(self) -> str:
        fields = ", ".join(f"{path}={value}" for path, value in self.as_dict().items())
        return f"{type(self).__name__}({fields})"


def _to_count(value: float, per_unit: int, limits: Tuple[int, int]) -> int:
    least, greatest = limits
    if value != value:
        return least
    scaled_value = value * per_unit
    if scaled_value >= greatest:
        return greatest
    # the least int32 means "no value", so saturation stops one above it
    floor = least + 1 if least == NO_VALUE else least
    return floor if scaled_value <= floor else round(scaled_value)
