# SPDX-License-Identifier: MIT
"""Conversion of a joystick's axes and buttons to linear (m/s) and angular (rad/s) velocities."""
import math
from dataclasses import dataclass
from typing import Any, Callable, Dict, Optional, Sequence

LINEAR, ANGULAR = ("x", "y", "z"), ("roll", "pitch", "yaw")
DEFAULTS = {
    # part: the direction that plain numbers are for, its axis, its scale, its turbo scale (None: as without turbo)
    "linear": ("x", 1, 0.5, 1.0),
    "angular": ("yaw", 0, 0.5, None),
}
Get = Callable[[str, Any], Any]  # a parameter by its name, or the default


@dataclass(frozen=True)
class Mapping:
    """Which axes drive, how fast, and while which button is held. Absent: -1."""

    enable_button: int
    enable_turbo_button: int
    axes: Dict[str, int]  # by direction: x y z roll pitch yaw
    scale: Dict[str, float]
    scale_turbo: Dict[str, float]

    def velocity(self, axes: Sequence[float], buttons: Sequence[int]) -> Optional[Dict[str, float]]:
        """Velocity by direction while a button is held, None while none is."""
        if _held(buttons, self.enable_turbo_button):
            scale = self.scale_turbo
        elif _held(buttons, self.enable_button):
            scale = self.scale
        else:
            return None
        return {
            name: scale.get(name, 0.0) * _deflection(axes, axis) for name, axis in self.axes.items()
        }


def _deflection(axes: Sequence[float], number: int) -> float:
    """Returns the deflection of an axis; 0 if the axis is missing or its value is not finite."""
    is_there = 0 <= number < len(axes) and math.isfinite(axes[number])
    return axes[number] if is_there else 0.0


def _held(buttons: Sequence[int], number: int) -> bool:
    return 0 <= number < len(buttons) and bool(buttons[number])


def read_mapping(get: Get) -> Mapping:
    """The mapping by parameters; ValueError for one that makes no sense."""
    axes, scale, scale_turbo = (
        {},
        {},
        {},
    )  # type: Dict[str, int], Dict[str, float], Dict[str, float]
    for part, names in (("linear", LINEAR), ("angular", ANGULAR)):
        only, axis, normal, turbo = DEFAULTS[part]
        axes_of = get(f"axis_{part}", axis)
        if isinstance(axes_of, dict):
            normal_of = get(f"scale_{part}", {})
            turbo_of = get(f"scale_{part}_turbo", normal_of)
        else:
            axes_of = {only: axes_of}
            normal_of = {only: get(f"scale_{part}", normal)}
            turbo_of = {
                only: get(f"scale_{part}_turbo", normal_of[only] if turbo is None else turbo)
            }
        axes.update(_checked(f"axis_{part}", axes_of, names, int))
        scale.update(_checked(f"scale_{part}", normal_of, names, float))
        scale_turbo.update(_checked(f"scale_{part}_turbo", turbo_of, names, float))
    buttons = {
        name: _number(name, get(name, default), int)
        for name, default in (("enable_button", 0), ("enable_turbo_button", -1))
    }
    return Mapping(axes=axes, scale=scale, scale_turbo=scale_turbo, **buttons)


def _number(name: str, value: Any, kind: type) -> Any:
    """The value as int or float."""
    whole = isinstance(value, int) and not isinstance(value, bool)
    if not (whole or (kind is float and isinstance(value, float) and math.isfinite(value))):
        expected = "a whole number" if kind is int else "a number"
        raise ValueError(f"~{name}: {value!r}; expected {expected}")
    return kind(value)


def _checked(name: str, values: Any, names: Sequence[str], kind: type) -> Dict[str, Any]:
    """A map from some of the names to numbers."""
    if not isinstance(values, dict):
        raise ValueError(f"~{name}: {values!r}; expected a map like that of the axes")
    unknown = sorted(set(values) - set(names))
    if unknown:
        raise ValueError(f"~{name}: unknown {unknown[0]!r}; expected some of {', '.join(names)}")
    return {key: _number(f"{name}/{key}", value, kind) for key, value in values.items()}
