# SPDX-License-Identifier: MIT
"""Controls of the page. What its people do waits in an inbox until the thread that steps takes it."""

import math
import queue
from dataclasses import dataclass
from typing import Any, Dict, List, Optional, Tuple

import numpy as np
from ardee_sim.view.scene import remove

UNLIMITED = "unlimited"
SPEEDS = ("0.1", "0.25", "0.5", "1", "2", "5", "10", UNLIMITED)
NO_CAMERA = "none"
_STEP_M_S, _STEP_RAD_S = 0.1, 0.2  # of a key
_KEYS = """I and K change the speed, J and L the turn rate, space stops; P pauses, N makes one step.
Stop gives the drive back to the program. The mouse, W, A, S, D and the arrows move the eye."""


@dataclass
class Wanted:
    """Wishes of the page's people."""

    is_paused: bool = False
    steps: int = 0  # that a paused simulation is to make
    pace: float = 1.0  # simulated seconds a second; inf: as fast as it can
    follow: bool = True
    rows: bool = True
    speed_m_s: float = 0.0
    turn_rad_s: float = 0.0
    is_driven: bool = False  # by people, who have not stopped since
    is_stopping: bool = False  # people stopped: one command of zero is due, then they drive no more
    clouds: Tuple[str, ...] = ()
    camera: str = NO_CAMERA


class Panel:
    """The controls, for one robot.

    topics : of ardee_sim.view.readings.topics_of()
    limits : greatest speed [m/s] and turn rate [rad/s]
    """

    def __init__(
        self,
        server: Any,
        wanted: Wanted,
        topics: Dict[str, List[str]],
        limits: Tuple[float, float],
    ) -> None:
        self.wanted, self._limits = wanted, limits
        self._cameras = (NO_CAMERA, *topics["pictures"])
        if wanted.camera not in self._cameras:  # of another simulation or robot
            wanted.camera = NO_CAMERA
        self._inbox: "queue.SimpleQueue[Tuple[str, Any]]" = queue.SimpleQueue()
        self._gui = gui = server.gui
        self._parts: List[Any] = []
        self._status = gui.add_markdown("")
        self._pause = self._input(gui.add_checkbox("pause", wanted.is_paused), "is_paused")
        step = gui.add_button("step")
        step.on_click(lambda _: self._inbox.put(("step", None)))
        pace = UNLIMITED if wanted.pace == float("inf") else f"{wanted.pace:g}"
        # a program may have set another pace
        self._paces = SPEEDS if pace in SPEEDS else (pace, *SPEEDS)
        self._input(gui.add_dropdown("times real time", self._paces, initial_value=pace), "pace")
        self._input(gui.add_checkbox("follow the robot", wanted.follow), "follow")
        self._input(gui.add_checkbox("rows", wanted.rows), "rows")
        self._parts += [self._status, step]
        for topic in topics["clouds"]:
            self._input(gui.add_checkbox(topic, topic in wanted.clouds), topic)
        self._image: Optional[Any] = None
        self._drives: List[Any] = []
        if topics["pictures"]:
            camera = gui.add_dropdown("camera", self._cameras, initial_value=wanted.camera)
            self._input(camera, "camera")
        if topics["drives"]:
            self._add_drive()

    def _input(self, handle: Any, name: str) -> Any:
        """Sends what somebody changes to the inbox; changes by this program have no client."""

        def changed(event: Any) -> None:
            if event.client is not None:
                self._inbox.put((name, event.target.value))

        handle.on_update(changed)
        self._parts.append(handle)
        return handle

    def _key(self, label: str, key: str, name: str) -> None:
        command = self._gui.add_command(label, hotkey=key)
        command.on_trigger(lambda _: self._inbox.put((name, None)))
        self._parts.append(command)

    def _add_drive(self) -> None:
        gui, wanted = self._gui, self.wanted
        (v, w), (dv, dw) = self._limits, (_STEP_M_S, _STEP_RAD_S)
        speed = gui.add_slider("speed [m/s]", -v, v, dv, wanted.speed_m_s)
        turn = gui.add_slider("turn [rad/s]", -w, w, dw, wanted.turn_rad_s)
        self._drives = [self._input(speed, "speed_m_s"), self._input(turn, "turn_rad_s")]
        stop = gui.add_button("stop")
        stop.on_click(lambda _: self._inbox.put(("stop", None)))
        self._parts += [stop, gui.add_markdown(_KEYS)]
        for label, key, name in (
            ("Faster", "I", "faster"),
            ("Slower", "K", "slower"),
            ("Turn left", "J", "left"),
            ("Turn right", "L", "right"),
            ("Stop", "space", "stop"),
            ("Pause", "P", "pause"),
            ("Step", "N", "step"),
        ):
            self._key(label, key, name)

    def take(self) -> None:
        """Brings `wanted` up to date with the inbox."""
        while True:
            try:
                self._apply(*self._inbox.get_nowait())
            except queue.Empty:
                return

    def _is_valid(self, name: str, value: Any) -> bool:
        """Returns whether the page can have sent this; other clients send what they like."""
        if name == "pace":
            return value in self._paces
        if name == "camera":
            return value in self._cameras
        if name in ("speed_m_s", "turn_rad_s"):
            return type(value) in (int, float) and math.isfinite(value)
        return value is None or isinstance(value, bool)

    def _apply(self, name: str, value: Any) -> None:
        wanted = self.wanted
        if not self._is_valid(name, value):
            return
        if name == "step":
            wanted.steps += 1
        elif name == "pause":
            wanted.is_paused = not wanted.is_paused
        elif name == "pace":
            wanted.pace = float("inf") if value == UNLIMITED else float(value)
        elif name in ("is_paused", "follow", "rows", "camera"):
            setattr(wanted, name, value)
        elif name.startswith("/"):
            others = tuple(topic for topic in wanted.clouds if topic != name)
            wanted.clouds = (*others, name) if value else others
        else:
            self._drive(name, value)

    def _drive(self, name: str, value: Any) -> None:
        wanted, (v, w) = self.wanted, self._limits
        wanted.is_driven, wanted.is_stopping = name != "stop", name == "stop"
        if name == "speed_m_s":
            wanted.speed_m_s = float(np.clip(value, -v, v))
        elif name == "turn_rad_s":
            wanted.turn_rad_s = float(np.clip(value, -w, w))
        elif name == "stop":
            wanted.speed_m_s = wanted.turn_rad_s = 0.0
        else:
            dv, dw = {
                "faster": (_STEP_M_S, 0.0),
                "slower": (-_STEP_M_S, 0.0),
                "left": (0.0, _STEP_RAD_S),
                "right": (0.0, -_STEP_RAD_S),
            }[name]
            wanted.speed_m_s = float(np.clip(round(wanted.speed_m_s + dv, 6), -v, v))
            wanted.turn_rad_s = float(np.clip(round(wanted.turn_rad_s + dw, 6), -w, w))

    def draw(self, status: str) -> None:
        """Shows what is wanted, which keys change too, and a line about the present."""
        self._status.content = status
        self._pause.value = self.wanted.is_paused
        if self._drives:
            self._drives[0].value = self.wanted.speed_m_s
            self._drives[1].value = self.wanted.turn_rad_s

    def show_picture(self, pixels: np.ndarray) -> None:
        """Shows a camera's picture below the controls."""
        if self._image is None:
            self._image = self._gui.add_image(pixels, format="jpeg")
            self._parts.append(self._image)
        else:
            self._image.image = pixels

    def close(self) -> None:
        """Takes the controls away."""
        for part in self._parts:
            remove(part)
