# SPDX-License-Identifier: MIT
"""The viewer: a page in the browser that shows a simulation, and drives it."""

import contextlib
import io
import logging
import math
import socket
import time
import warnings
from types import TracebackType
from typing import TYPE_CHECKING, Any, Dict, Optional, Tuple, Type

import numpy as np
from ardee_sim.errors import ArdeeError
from ardee_sim.simulation import Entity, Simulation, Twist
from ardee_sim.view.panel import NO_CAMERA, Panel, Wanted
from ardee_sim.view.readings import CloudView, PictureView, link_of, topics_of
from ardee_sim.view.rows import row_lines
from ardee_sim.view.scene import SceneView, node, remove
from ardee_sim.view.server import start_server

if TYPE_CHECKING:
    from ardee_sim.envs import Episode

PERIOD_S = 0.04  # of simulated time between two updates, in run()
_WAIT_S = 0.02  # between two looks into the inbox while paused
_EYE_M = (-1.3, 0.0, 0.6)  # of the first view, in the robot's axes


def _require_free(host: str, port: int) -> None:
    """Raises ArdeeError if the page cannot be served there."""
    try:
        if not 0 <= port <= 65535:  # getaddrinfo() takes some others for small ones
            raise OverflowError("port must be 0-65535")
        kind = socket.getaddrinfo(host, port, type=socket.SOCK_STREAM)[0]
        with socket.socket(kind[0], socket.SOCK_STREAM) as trial:
            trial.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
            trial.bind(kind[4])
    except (OSError, OverflowError) as error:
        raise ArdeeError(
            f"found {host}:{port}: {error}; expected an address of this machine and a free port"
        ) from None


class Viewer:
    """Shows a simulation in a page, http://127.0.0.1:8080 if not told otherwise.

    Everything happens in update(), in the thread that steps: what people do in the page waits for it. Readings are the
    same bytes with a viewer and without one, unless somebody drives.

    sim : to be shown; attach() shows another one
    robot : name of the model that is followed and driven, even if spawned anew; by default the first that can be driven
    host, port : of the page; port 0: any free one
    radius_m : fields and grounds are shown up to here around the robot
    limits : greatest speed [m/s] and turn rate [rad/s] that the page commands
    drive : whether people may drive
    """

    def __init__(
        self,
        sim: Simulation,
        *,
        robot: Optional[str] = None,
        host: str = "127.0.0.1",
        port: int = 8080,
        radius_m: float = 12.0,
        limits: Tuple[float, float] = (2.0, 2.0),
        drive: bool = True,
    ) -> None:
        if not 0 < radius_m < math.inf:
            raise ArdeeError(f"radius_m: found {radius_m}, expected a positive number")
        if not all(0 < limit < math.inf for limit in limits):
            raise ArdeeError(f"limits: found {limits}, expected two positive numbers")
        _require_free(host, port)
        self._sim, self._robot_name, self._radius_m, self._limits = sim, robot, radius_m, limits
        self._drives, self._is_closed = drive, False
        self._followed = self._find_robot(sim)
        # browsers open connections that they do not use, each of which would be a traceback
        logging.getLogger("websockets.server").setLevel(logging.CRITICAL)
        self._server = start_server(host, port)
        try:
            self._server.scene.configure_default_lights(cast_shadow=False)
            place = f"[{host}]" if ":" in host else host  # IPv6
            self.url = f"http://{place}:{self._server.get_port()}"
            self._world = self._server.scene.add_frame(node(), show_axes=False)
            self.wanted = Wanted()
            self._is_first = True
            self._show(sim)
        except BaseException:
            self._stop_server()
            raise

    def _find_robot(self, sim: Simulation) -> Optional[str]:
        names = [entity.name for entity in sim.entities() if not entity.is_static]
        if self._robot_name is not None:
            if self._robot_name not in names:
                raise ArdeeError(f"found no robot '{self._robot_name}', expected one of: {names}")
            return self._robot_name
        driven = [name for name in names if topics_of(sim, name)["drives"]]
        return next(iter(driven + names), None)

    def attach(self, sim: Simulation) -> None:
        """Shows another simulation from now on, with the same controls."""
        self._followed = self._find_robot(sim)
        self._hide()
        self._show(sim)

    def _present(self, sim: Simulation) -> Optional[Tuple[Entity, Any]]:
        """Returns the followed robot and its description, which tell it from another one of its name; None if gone."""
        for entity in sim.entities():
            if entity.name == self._followed:
                return entity, sim.description(entity.name)
        return None

    def _follow(self) -> None:
        """Shows the robot anew if it was removed, came back, or is another one now."""
        if self._followed is None:
            self._followed = self._find_robot(self._sim)
        if self._present(self._sim) == self._shown:
            return
        self._hide()
        self._show(self._sim)
        if not self._robot:
            warnings.warn(
                f"'{self._followed}' was removed; the page shows the rest until it is back",
                stacklevel=3,
            )

    def _show(self, sim: Simulation) -> None:
        self._sim = sim
        self._shown = self._present(sim)
        self._robot = self._followed if self._shown else None
        nothing: Dict[str, Any] = {"clouds": [], "pictures": [], "drives": []}
        self._topics = topics_of(sim, self._robot) if self._robot else nothing
        self._topics["clouds"] = [
            topic for topic in self._topics["clouds"] if link_of(sim, self._robot or "", topic)
        ]
        if not self._drives:
            self._topics["drives"] = []
        if self._is_first:
            kinds = sim.topics()
            lidars = [t for t in self._topics["clouds"] if kinds[t].kind == "LidarReading"]
            self.wanted.clouds = tuple(lidars)
        self._panel = Panel(self._server, self.wanted, self._topics, self._limits)
        self._scene = SceneView(self._server, sim, self._radius_m)
        self._clouds: Dict[str, CloudView] = {}
        self._camera: Optional[Tuple[str, PictureView]] = None
        self._rows: Optional[Any] = None
        plants = sim.world.plants()
        self._rest_m = np.mean([p.xyz_m for p in plants], axis=0) if plants else np.zeros(3)
        self._place_m = self._place()
        self._world.position = -self._place_m
        if self._is_first:
            self._look_at_robot()
            self._is_first = False
        self._start_clock()
        self._draw()

    def _hide(self) -> None:
        for cloud in self._clouds.values():
            cloud.close()
        if self._camera:
            self._camera[1].close()
        if self._rows is not None:
            remove(self._rows)
        self._panel.close()
        self._scene.close()

    def _place(self) -> np.ndarray:
        """Returns where the robot is, or the middle of the world's plants."""
        return self._sim.state(self._robot).xyz_m if self._robot else self._rest_m

    def _look_at_robot(self) -> None:
        yaw = self._sim.state(self._robot).yaw_rad if self._robot else 0.0
        c, s = math.cos(yaw), math.sin(yaw)
        x, y, z = _EYE_M
        camera = self._server.initial_camera
        camera.position = (c * x - s * y, s * x + c * y, z)
        camera.look_at = (0.5 * c, 0.5 * s, 0.0)
        camera.near = 0.05

    def update(self) -> None:
        """Shows the present, and does what people want; returns when the next step is due.

        It waits while the page has paused the simulation, or if simulated time is ahead of the page's pace.
        """
        self._follow()
        self._panel.take()
        self._draw()
        wanted = self.wanted
        while wanted.is_paused and not wanted.steps:
            time.sleep(_WAIT_S)
            self._panel.take()
            self._draw()
            self._start_clock()
        if wanted.steps:
            wanted.steps -= 1
        self._keep_pace()
        if (wanted.is_driven or wanted.is_stopping) and self._topics["drives"]:
            twist = Twist(linear_x_m_s=wanted.speed_m_s, angular_z_rad_s=wanted.turn_rad_s)
            self._sim.command(self._topics["drives"][0], twist)
            wanted.is_stopping = False

    def _start_clock(self) -> None:
        if not self.wanted.pace > 0:
            raise ArdeeError(f"wanted.pace: found {self.wanted.pace}, expected a positive number")
        self._clock = time.monotonic(), self._sim.time_ns, self.wanted.pace

    def _ahead_s(self) -> float:
        """Returns how long to wait for simulated time to be due; negative if it is late."""
        start_s, start_ns, pace = self._clock
        return start_s + (self._sim.time_ns - start_ns) * 1e-9 / pace - time.monotonic()

    def _keep_pace(self) -> None:
        # a simulation that is late, or was reset, does not hurry afterwards
        if self._clock[2] != self.wanted.pace or self._ahead_s() < 0:
            self._start_clock()
        while (ahead_s := self._ahead_s()) > 0 and self._clock[2] == self.wanted.pace:
            time.sleep(min(ahead_s, _WAIT_S))
            self._panel.take()

    def _draw(self) -> None:
        """Shows the present. What fails as remove() says is shown the next time."""
        try:
            with self._server.atomic():
                place_m = self._place()
                self._scene.update(place_m)
                self._draw_sensors()
                self._panel.draw(self._status())
                if self.wanted.follow:
                    # the world moves, and the eye stays: the page's people move that themselves
                    self._world.position = self._world.position - (place_m - self._place_m)
                self._place_m = place_m
        except RuntimeError as error:
            if "mutated during iteration" not in str(error):
                raise

    def _draw_sensors(self) -> None:
        wanted = self.wanted
        for number, topic in enumerate(self._topics["clouds"]):
            if topic in wanted.clouds and topic not in self._clouds:
                self._clouds[topic] = CloudView(
                    self._server, self._sim, str(self._robot), topic, number
                )
            elif topic not in wanted.clouds and topic in self._clouds:
                self._clouds.pop(topic).close()
        for cloud in self._clouds.values():
            cloud.update()
        shown = self._camera[0] if self._camera else NO_CAMERA
        if wanted.camera != shown:
            if self._camera:
                self._camera[1].close()
            is_there = wanted.camera in self._topics["pictures"]
            view = (
                PictureView(self._sim, wanted.camera, self._panel.show_picture)
                if is_there
                else None
            )
            self._camera = (wanted.camera, view) if view else None
        if self._camera:
            self._camera[1].update()
        if wanted.rows and self._rows is None:
            segments, colors = row_lines(self._sim.world)
            self._rows = self._server.scene.add_line_segments(node("rows"), segments, colors)
        if self._rows is not None:
            self._rows.visible = wanted.rows

    def _status(self) -> str:
        now = f"{self._sim.time_ns * 1e-9:.2f} s"
        if not self._robot:
            return now
        state = self._sim.state(self._robot)
        x, y, _ = state.xyz_m
        return (
            f"{now}, {self._robot}: x {x:.2f} m, y {y:.2f} m, {np.hypot(*state.v_m_s[:2]):.2f} m/s"
        )

    def run(self) -> None:
        """Steps and shows until Ctrl-C."""
        steps = max(1, round(PERIOD_S * 1e9 / self._sim.step_ns))
        try:
            while True:
                self._sim.step(steps)
                self.update()
        except KeyboardInterrupt:
            return

    def close(self) -> None:
        """Ends the page. The simulation lives on."""
        if self._is_closed:
            return
        self._is_closed = True
        try:
            self._hide()
        finally:
            self._stop_server()

    def _stop_server(self) -> None:
        with contextlib.redirect_stdout(io.StringIO()):
            self._server.stop()

    def __enter__(self) -> "Viewer":
        return self

    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        error: Optional[BaseException],
        traceback: Optional[TracebackType],
    ) -> None:
        self.close()


def view(sim: Simulation, **options: Any) -> Viewer:
    """Shows a simulation of yours, and returns the Viewer, whose update() is called after each of your steps.

    options : those of Viewer
    Raises ArdeeError if the port is taken.
    """
    return Viewer(sim, **options)


def play(episode: "Episode", *, turns: float = math.inf, **options: Any) -> None:
    """Shows a recorded episode again and again, paused at its end, until Ctrl-C or so many turns.

    options : those of Viewer
    """
    env = episode.make()
    viewer = None
    try:
        while turns > 0:
            for _ in episode.play(env):
                own: Any = env.unwrapped  # a FieldEnv
                sim = own.simulation
                if viewer is None:
                    viewer = Viewer(sim, robot="robot", drive=False, **options)
                    print(f"{viewer.url} (Ctrl-C ends it)", flush=True)
                viewer.update()
            turns -= 1
            if turns > 0 and viewer:
                viewer.wanted.is_paused = True
                viewer.update()
    except KeyboardInterrupt:
        return
    finally:
        if viewer:
            viewer.close()
        env.close()
