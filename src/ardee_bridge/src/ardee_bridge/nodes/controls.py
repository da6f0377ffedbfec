# SPDX-License-Identifier: MIT
"""Obeys motion and control messages of its peers, and stops the robot when they cease; without rospy."""
import socket
import threading
import time
from collections import deque
from typing import Callable, Deque, Dict, NamedTuple, Optional

from ardee_bridge.nodes.counters import Counters
from ardee_bridge.nodes.requests import Requests
from ardee_bridge.nodes.settings import ControlSettings
from ardee_bridge.wire import codec
from ardee_bridge.wire.c_struct import NO_VALUE
from ardee_bridge.wire.pairing import Message
from ardee_bridge.wire.udp import Sender


class Motion(NamedTuple):
    """Velocity command of the robot: m/s, and rad/s counter-clockwise."""

    speed_m_s: float
    yaw_rate_rad_s: float


STANDSTILL = Motion(0.0, 0.0)
# Greatest number of commands that are passed on at once; of more, the newest.
MOST_AT_ONCE = 64


def to_motion(commands: codec.MotionCommands, settings: ControlSettings) -> Motion:
    """Applies Listing A.19's limits: normalized / multiplier of the greatest speed and yaw rate, clamped to -1...1."""
    shares = (commands.normalized_speed, commands.normalized_yaw_rate)
    speed, yaw_rate = (max(-1.0, min(1.0, share / commands.multiplier)) for share in shares)
    return Motion(speed * settings.max_speed_m_s, yaw_rate * settings.max_yaw_rate_rad_s)


def what_was_obeyed(done: Dict[str, int], before: Dict[str, int], latest: Motion) -> str:
    """Returns the new counts since `before` as a line for the terminal (thesis 4.6.1); empty for none."""
    fresh = {kind: count - before.get(kind, 0) for kind, count in sorted(done.items())}
    counts = ", ".join(f"{kind}: {count}" for kind, count in fresh.items() if count)
    if not counts:
        return ""
    return f"{counts}; last told {latest.speed_m_s:.3f} m/s, {latest.yaw_rate_rad_s:.3f} rad/s"


class ControlsClient:
    """Reads the socket; calls `move` with motions and `pause_simulation` with True or False."""

    def __init__(
        self,
        settings: ControlSettings,
        opened: socket.socket,
        counters: Counters,
        move: Callable[[Motion], None],
        pause_simulation: Callable[[bool], None],
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._settings, self._socket, self._counters = settings, opened, counters
        self._move, self._pause_simulation, self._clock = move, pause_simulation, clock
        self._requests = Requests(opened, settings.peers, counters, clock, "sender is no peer")
        # A client that was killed before may have left the robot driving, so the watchdog runs from the start.
        self._stop_at_s: Optional[float] = clock() + settings.watchdog_s
        self._is_stopped = False
        self._pending: "Deque[Motion]" = deque()
        self._told, self._has_ended, self._telling = STANDSTILL, False, threading.Lock()

    def receive(self, timeout_s: float) -> None:
        """Waits at most this long, obeys the messages that came, stops the robot when its commands have stopped."""
        if self._stop_at_s is not None:
            timeout_s = max(0.0, min(timeout_s, self._stop_at_s - self._clock()))
        for message, sender, at_s in self._requests.receive(timeout_s):
            self._take(message, sender, at_s)
        while self._pending:
            self._tell(self._pending.popleft())
        if self._stop_at_s is not None and self._clock() >= self._stop_at_s:
            self._stop_at_s = None
            self._counters.did("watchdog stops")
            self._tell(STANDSTILL)

    def stop(self) -> None:
        """Stops the robot for good if it has been told to move; another thread may still receive."""
        with self._telling:
            self._has_ended = True
            if self._told != STANDSTILL:
                self._move(STANDSTILL)

    def _tell(self, motion: Motion) -> None:
        with self._telling:
            if not self._has_ended:
                self._told = motion
                self._move(motion)

    def _take(self, message: Message, sender: Sender, at_s: float) -> None:
        if message.header.msg_type == codec.MessageType.DATA_RCCOMMANDS:
            self._obey_motion(message, at_s)
        elif message.header.msg_type == codec.MessageType.CONTROL:
            self._obey_control(message, sender)
        else:
            self._counters.drop("neither motion nor control", f"type {message.header.msg_type}")

    def _obey_motion(self, message: Message, at_s: float) -> None:
        commands = codec.MotionCommands.unpack(message.data)
        if commands.multiplier < 1:
            self._counters.drop("malformed motion command", f"multiplier {commands.multiplier}")
            return
        if NO_VALUE in (commands.normalized_speed, commands.normalized_yaw_rate):
            self._counters.drop("malformed motion command", "a speed or yaw rate without a value")
            return
        if self._is_stopped:
            self._counters.drop("motion command between STOP and START")
            return
        age_s = self._clock() - at_s
        if age_s >= self._settings.watchdog_s:
            self._counters.drop("motion commands read too late", f"{age_s:.1f} s after they came")
            return
        self._counters.did("motion commands obeyed")
        if len(self._pending) == MOST_AT_ONCE:
            self._pending.popleft()
            self._counters.drop("motion commands overtaken by newer ones")
        self._pending.append(to_motion(commands, self._settings))
        self._stop_at_s = at_s + self._settings.watchdog_s

    def _obey_control(self, message: Message, sender: Sender) -> None:
        try:
            code = codec.ControlCode(codec.Control.unpack(message.data).code)
        except ValueError as error:
            self._counters.drop("unknown control code", str(error))
            return
        if code == codec.ControlCode.STOP:
            self._is_stopped, self._stop_at_s = True, None
            self._pending = deque([STANDSTILL])
        elif code == codec.ControlCode.START:
            self._is_stopped = False
        if code != codec.ControlCode.STOP:
            self._pause_simulation(code == codec.ControlCode.PAUSE)
        self._counters.did(f"{code.name} obeyed")
        self._answer(message.header, sender)

    def _answer(self, request: codec.Header, sender: Sender) -> None:
        try:
            for datagram in codec.encode_ack(request):
                self._socket.sendto(datagram, socket.MSG_DONTWAIT, sender)
        except OSError as error:
            self._counters.drop("answers that could not be sent", str(error))
