# SPDX-License-Identifier: MIT
"""Structs as C compilers lay them out on x86-64 and ARM: little-endian, each member at its natural alignment."""
import math
import operator
import struct
from typing import (
    Any,
    Dict,
    Iterable,
    Iterator,
    List,
    NamedTuple,
    Sequence,
    Tuple,
    Type,
    TypeVar,
    Union,
)

from ardee_bridge.scales import Scale, scale_of


class Scalar(NamedTuple):
    """An integer type of C and its code in Python's struct module."""

    c_name: str
    code: str
    size: int

    @property
    def alignment(self) -> int:
        return self.size

    @property
    def limits(self) -> Tuple[int, int]:
        """Least and greatest value."""
        bits = 8 * self.size
        return (
            (-(1 << bits - 1), (1 << bits - 1) - 1) if self.code.islower() else (0, (1 << bits) - 1)
        )


INT8 = Scalar("int8_t", "b", 1)
UINT8 = Scalar("uint8_t", "B", 1)
UINT16 = Scalar("uint16_t", "H", 2)
INT32 = Scalar("int32_t", "i", 4)

# An int32 field of this value has no value: NaN on the physical side.
NO_VALUE = -(1 << 31)


class Array(NamedTuple):
    """So many scalars in a row."""

    item: Scalar
    length: int

    @property
    def alignment(self) -> int:
        return self.item.alignment

    @property
    def size(self) -> int:
        return self.item.size * self.length


class Leaf(NamedTuple):
    """A scalar or array somewhere in a struct: dotted path, place in bytes, type, scale."""

    path: str
    offset: int
    kind: Union[Scalar, Array]
    scale: Scale
    limits: Tuple[int, int]


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
                limits = kind.limits if isinstance(kind, Scalar) else kind.item.limits
                leaves.append(Leaf(name, offset, kind, scale_of(cls.C_NAME, name), limits))
            else:
                for inner in kind.leaves:
                    path = f"{name}.{inner.path}"
                    scale = scale_of(cls.C_NAME, path)
                    place = offset + inner.offset
                    leaves.append(inner._replace(path=path, offset=place, scale=scale))
            offset += kind.size
        cls.leaves, cls.size = tuple(leaves), _padded(offset, cls.alignment)
        cls._struct = struct.Struct(cls._format())
        cls._plain = {
            name: 0 if isinstance(kind, Scalar) else ()
            for name, kind in cls.FIELDS
            if isinstance(kind, (Scalar, Array))
        }
        cls._structs = tuple(field for field in cls.FIELDS if field[0] not in cls._plain)
        cls._has_arrays = any(isinstance(leaf.kind, Array) for leaf in leaves)
        cls._fields = operator.attrgetter(*(leaf.path for leaf in leaves))

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
        fields = self.__dict__
        fields.update(self._plain)
        fields.update(values)
        for name, kind in self._structs:
            if name not in values:
                fields[name] = kind()
        if len(fields) > len(self.FIELDS):
            known = [name for name, _ in self.FIELDS]
            unknown = ", ".join(name for name in values if name not in known)
            raise TypeError(f"{self.C_NAME} has no field {unknown}; it has {', '.join(known)}")

    def _values(self) -> Tuple[Any, ...]:
        """Scalars and arrays in the order of the leaves."""
        values = type(self)._fields(self)
        return values if len(self.leaves) > 1 else (values,)

    @classmethod
    def _from_values(cls: Type[S], values: Iterator[Any]) -> S:
        made = cls.__new__(cls)
        for name, kind in cls.FIELDS:
            is_leaf = isinstance(kind, (Scalar, Array))
            setattr(made, name, next(values) if is_leaf else kind._from_values(values))
        return made

    def pack(self) -> bytes:
        """The bytes of the struct; arrays that are too short are filled up with zeros."""
        return self._pack(self._values())

    def pack_si(self) -> bytes:
        """The same as to_raw().pack()."""
        return self._pack(self._counts())

    @classmethod
    def pack_values(cls, *values: int) -> bytes:
        """The bytes of raw values in the order of the leaves, an array's one by one; no struct is made first."""
        try:
            return cls._struct.pack(*values)
        except struct.error as error:
            raise ValueError(f"{cls.C_NAME}: {error}") from None

    def _pack(self, values: Iterable[Any]) -> bytes:
        if not self._has_arrays:
            return self.pack_values(*values)
        flat = []  # type: List[int]
        for leaf, value in zip(self.leaves, values):
            if not isinstance(leaf.kind, Array):
                flat.append(value)
                continue
            missing = leaf.kind.length - len(value)
            if missing < 0:
                raise ValueError(f"{leaf.path}: {len(value)} values, at most {leaf.kind.length}")
            flat.extend(value)
            flat.extend((0,) * missing)
        return self.pack_values(*flat)

    @classmethod
    def unpack(cls: Type[S], data: bytes) -> S:
        """The struct that these bytes are; ValueError when there are too few or too many."""
        if len(data) != cls.size:
            raise ValueError(f"{cls.C_NAME}: {len(data)} bytes, expected {cls.size}")
        flat = cls._struct.unpack(data)
        values, at = [], 0  # type: List[Any], int
        for leaf in cls.leaves:
            if isinstance(leaf.kind, Array):
                values.append(flat[at : at + leaf.kind.length])
                at += leaf.kind.length
            else:
                values.append(flat[at])
                at += 1
        return cls._from_values(iter(values))

    def to_si(self: S) -> S:
        """The same with physical values in the units of the table of scales; NO_VALUE becomes NaN."""
        values = []  # type: List[Any]
        for leaf, value in zip(self.leaves, self._values()):
            per_unit = leaf.scale.counts_per_unit
            if per_unit is None:
                values.append(value)
            elif isinstance(leaf.kind, Array):
                values.append(tuple(raw / per_unit for raw in value))
            else:
                values.append(math.nan if value == NO_VALUE else value / per_unit)
        return self._from_values(iter(values))

    def to_raw(self: S) -> S:
        """The same with integers for the wire, from physical values: rounded, saturated, NaN as NO_VALUE."""
        return self._from_values(self._counts())

    def _counts(self) -> Iterator[Any]:
        """Values for the wire from physical ones."""
        for leaf, value in zip(self.leaves, self._values()):
            per_unit = leaf.scale.counts_per_unit or 1
            if isinstance(leaf.kind, Array):
                yield scaled(value, per_unit)
            else:
                yield _to_count(value, per_unit, leaf.limits)

    def as_dict(self) -> Dict[str, Any]:
        """Dotted path -> value."""
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


def scaled(values: Sequence[float], per_unit: int) -> Tuple[int, ...]:
    """Physical values as int32 counts: rounded, saturated, NaN as NO_VALUE."""
    return tuple(_to_count(value, per_unit, INT32.limits) for value in values)
