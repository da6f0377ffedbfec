# SPDX-License-Identifier: MIT
"""The joystick's reader on real files: pipes and a pty that carry the kernel's js_event bytes."""
import os
import pathlib
import random
import struct
import tty

import pytest

from joy.device import (
    AXIS,
    BUTTON,
    INIT,
    READ_BYTES,
    Device,
    DeviceGone,
    Event,
    JoyState,
    axis_value,
)


def js_event(kind: int, number: int, value: int) -> bytes:
    """A record as the kernel writes it (linux/joystick.h)."""
    return struct.pack("=IhBB", 12345, value, kind, number)


class Pipe:
    """A named pipe with its writing end open."""

    def __init__(self, path: pathlib.Path):
        self.path = path
        os.mkfifo(path)
        self.device = Device(str(path))
        self.writer = os.open(path, os.O_WRONLY)

    def write(self, data: bytes) -> None:
        os.write(self.writer, data)


@pytest.fixture
def pipe(tmp_path: pathlib.Path):
    made = Pipe(tmp_path / "js0")
    yield made
    made.device.close()
    if made.writer is not None:
        os.close(made.writer)


def test_a_record_has_the_kernels_eight_bytes():
    assert len(js_event(AXIS, 0, 0)) == 8


def test_events_arrive_in_order(pipe: Pipe):
    pipe.write(js_event(BUTTON | INIT, 3, 0) + js_event(AXIS, 1, -32767) + js_event(BUTTON, 3, 1))
    assert pipe.device.read(1.0) == [
        Event(0, BUTTON, 3, True),
        Event(-32767, AXIS, 1, False),
        Event(1, BUTTON, 3, False),
    ]
    assert pipe.device.read(0.0) == []


def test_a_record_in_two_parts_is_one_event(pipe: Pipe):
    record = js_event(AXIS, 2, 100)
    pipe.write(record[:3])
    assert pipe.device.read(1.0) == []
    pipe.write(record[3:] + record[:7])
    assert pipe.device.read(1.0) == [Event(100, AXIS, 2, False)]
    pipe.write(record[7:])
    assert pipe.device.read(1.0) == [Event(100, AXIS, 2, False)]


def test_unknown_kinds_are_left_out(pipe: Pipe):
    pipe.write(js_event(0x04, 0, 1) + js_event(BUTTON | AXIS, 0, 1) + js_event(BUTTON, 0, 1))
    assert pipe.device.read(1.0) == [Event(1, BUTTON, 0, False)]


def test_any_bytes_are_survived(pipe: Pipe):
    noise = random.Random(7).randbytes(32768)
    pipe.write(noise)
    state, records = JoyState(deadzone=0.05), 0
    for _ in range(len(noise) // READ_BYTES):
        for event in pipe.device.read(1.0):
            state.apply(event)
            records += 1
    assert 0 < records < len(noise) // 8
    assert len(state.axes) <= 256 and len(state.buttons) <= 256
    assert all(-1 <= axis <= 1 for axis in state.axes) and set(state.buttons) <= {0, 1}


def test_a_closed_pipe_is_a_joystick_gone(pipe: Pipe):
    os.close(pipe.writer)
    pipe.writer = None
    with pytest.raises(DeviceGone, match="end of file"):
        pipe.device.read(1.0)


def test_a_file_that_disappears_is_a_joystick_gone(pipe: Pipe):
    assert pipe.device.read(0.0) == []
    pipe.path.unlink()
    with pytest.raises(DeviceGone, match="disappeared"):
        pipe.device.read(0.0)


def test_a_file_that_is_replaced_is_a_joystick_gone(pipe: Pipe):
    pipe.path.rename(pipe.path.with_name("other"))
    os.mkfifo(pipe.path)
    with pytest.raises(DeviceGone, match="replaced"):
        pipe.device.read(0.0)


def test_a_read_error_is_a_joystick_gone():
    """A pty whose master hangs up answers EIO, as an unplugged joystick answers ENODEV."""
    master, slave = os.openpty()
    tty.setraw(slave)
    device = Device(os.ttyname(slave))
    os.write(master, js_event(BUTTON, 0, 1))
    assert device.read(1.0) == [Event(1, BUTTON, 0, False)]
    os.close(slave)
    os.close(master)
    with pytest.raises(DeviceGone):
        device.read(1.0)
    device.close()


def test_no_device_is_an_os_error(tmp_path: pathlib.Path):
    with pytest.raises(FileNotFoundError):
        Device(str(tmp_path / "js9"))


@pytest.mark.parametrize("deadzone", [0.0, 0.05, 0.3])
def test_axes_end_at_one_and_have_a_dead_zone(deadzone: float):
    assert axis_value(-32767, deadzone) == 1.0  # left, forward
    assert axis_value(32767, deadzone) == -1.0
    assert axis_value(-32768, deadzone) == 1.0
    edge = int(deadzone * 32767)
    assert axis_value(edge, deadzone) == 0.0 and axis_value(-edge, deadzone) == 0.0
    middle = (deadzone + 1) / 2 * 32767  # half-way between the edge of the zone and the end
    assert axis_value(-round(middle), deadzone) == pytest.approx(0.5, abs=5e-5)


def test_axes_begin_at_0_unless_their_deflection_at_opening_counts():
    """A trigger rests at one end; `default_trig_val` of joy_node."""
    for counts, expected in ((False, 0.0), (True, 1.0)):
        state = JoyState(deadzone=0.05, initial_axes=counts)
        state.apply(Event(-32767, AXIS, 0, True))
        assert state.axes == [expected]
        state.apply(Event(32767, AXIS, 0, False))
        assert state.axes == [-1.0]


def test_sticky_buttons_change_when_they_are_pressed():
    state, told = JoyState(deadzone=0.0, sticky=True), []
    for value, initial in ((1, True), (0, False), (1, False), (0, False), (1, False), (0, False)):
        state.apply(Event(value, BUTTON, 0, initial))
        told.append(state.buttons[0])
    assert told == [0, 0, 1, 1, 0, 0]


def test_a_device_that_never_tells_anything(tmp_path: pathlib.Path):
    device = Device(os.devnull)
    with pytest.raises(DeviceGone, match="end of file"):
        device.read(1.0)
    assert not device.has_told
    device.close()


def test_letting_go_keeps_the_numbers_of_axes_and_buttons():
    state = JoyState(deadzone=0.0)
    state.apply(Event(-32767, AXIS, 2, False))
    state.apply(Event(1, BUTTON, 1, False))
    assert (state.axes, state.buttons) == ([0, 0, 1.0], [0, 1])
    state.release()
    assert (state.axes, state.buttons) == ([0.0] * 3, [0, 0])
