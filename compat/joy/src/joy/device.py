# SPDX-License-Identifier: MIT
"""A Linux joystick: the bytes of /dev/input/jsN (linux/joystick.h) and the state they add up to."""
import os
import select
import struct
from dataclasses import dataclass, field
from typing import Iterator, List, Optional

EVENT = struct.Struct("=IhBB")  # struct js_event: time (ms), value, type, number
BUTTON, AXIS, INIT = 0x01, 0x02, 0x80
FULL_DEFLECTION = 32767
READ_BYTES = 64 * EVENT.size


class DeviceGone(Exception):
    """Error of a joystick that was unplugged or cannot be read any more."""


@dataclass(frozen=True)
class Event:
    """One js_event."""

    value: int
    kind: int  # BUTTON or AXIS
    number: int
    initial: bool  # tells the state at opening, not a movement


def decode(data: bytes) -> Iterator[Event]:
    """The events in whole records; kinds that the kernel does not have today are left out."""
    for _, value, kind, number in EVENT.iter_unpack(data):
        if kind & ~INIT in (BUTTON, AXIS):
            yield Event(value, kind & ~INIT, number, bool(kind & INIT))


def axis_value(raw: int, deadzone: float) -> float:
    """Deflection from -1 to 1, left and forward positive, of the kernel's -32767 to 32767, right and back positive."""
    dead = deadzone * FULL_DEFLECTION
    beyond = max(0.0, abs(raw) - dead) / (FULL_DEFLECTION - dead)
    return min(beyond, 1.0) * (-1.0 if raw > 0 else 1.0) if beyond > 0.0 else 0.0


@dataclass
class JoyState:
    """Axes and buttons as events have told them so far."""

    deadzone: float
    sticky: bool = False  # a button keeps its state until it is pressed again
    initial_axes: bool = False  # deflections at opening count, else axes begin at 0
    axes: List[float] = field(default_factory=list)
    buttons: List[int] = field(default_factory=list)

    def apply(self, event: Event) -> None:
        """Applies an event; the lists grow to the numbers that occur."""
        values = self.buttons if event.kind == BUTTON else self.axes
        values.extend([0] * (event.number + 1 - len(values)))
        if event.kind == AXIS:
            counts = self.initial_axes or not event.initial
            values[event.number] = axis_value(event.value, self.deadzone) if counts else 0.0
        elif not self.sticky:
            values[event.number] = int(event.value != 0)
        elif event.value and not event.initial:
            values[event.number] = 1 - values[event.number]

    def release(self) -> None:
        """Releases all buttons and axes, as if no hand were on the joystick."""
        self.axes = [0.0] * len(self.axes)
        self.buttons = [0] * len(self.buttons)


class Device:
    """An open joystick."""

    def __init__(self, path: str):
        """Open the device; OSError where there is none."""
        self._path = path
        self.has_told = False  # any event
        self._rest = b""  # an event that has arrived in part, as pipes may deliver it
        self._file: Optional[int] = os.open(path, os.O_RDONLY | os.O_NONBLOCK)

    def read(self, timeout_s: float) -> List[Event]:
        """The events that arrive, none after the time-out; DeviceGone when the joystick is not there any more."""
        try:
            if not select.select([self._file], [], [], timeout_s)[0]:
                self._check_path()
                return []
            data = os.read(self._file, READ_BYTES)
        except BlockingIOError:
            return []
        except OSError as error:
            raise DeviceGone(error.strerror) from None
        if not data:
            raise DeviceGone("end of file")
        data = self._rest + data
        whole = len(data) - len(data) % EVENT.size
        self._rest = data[whole:]
        self.has_told = self.has_told or whole > 0
        return list(decode(data[:whole]))

    def _check_path(self) -> None:
        """The name must still lead to the file that is open."""
        try:
            same = os.path.samestat(os.stat(self._path), os.fstat(self._file))
        except FileNotFoundError:
            raise DeviceGone("its file has disappeared") from None
        if not same:
            raise DeviceGone("its file has been replaced")

    def close(self) -> None:
        """Close the device; nothing happens the second time."""
        if self._file is not None:
            os.close(self._file)
            self._file = None
