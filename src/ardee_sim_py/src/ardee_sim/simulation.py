# SPDX-License-Identifier: MIT
"""A simulation: a world with robots, stepped by its owner."""

import zlib
from collections import Counter
from pathlib import Path
from types import TracebackType
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Type, Union

import numpy as np
from ardee_sim import _core, checks
from ardee_sim.checks import Vector
from ardee_sim.daylight import Daylight
from ardee_sim.errors import ArdeeError
from ardee_sim.parameters import Parameters, below
from ardee_sim.pictures import camera_of, take_picture
from ardee_sim.readings import make_reading
from ardee_sim.state import Contact, Entity, LogLine, Snapshot, State, TopicInfo, Twist
from ardee_sim.world import World, read_text

_MOST_THREADS = 1024
_MOST_LABEL = 2**16 - 1  # that a label picture holds
_CHECK_BYTES = 4  # of a snapshot, its last: CRC-32 of the others
Command = Union[Twist, float, bool, Sequence[float], Mapping[str, Any]]


class Simulation:
    """A world with robots. One thread at a time uses it; a second gets RuntimeError.

    The same world, seed, models, commands and steps give the same bytes, with any number of `ray_threads`, and beside
    any number of other simulations of the world.

    Simulations of one World share what rays meet and does not change, as long as one of them is open: beside the first
    in the shipped corn, each further one takes a ninth of the time to the first scan, and of the memory of a picture.

    An argument of a wrong type raises TypeError, one of a wrong value, or no vector of numbers, ArdeeError; the
    simulation stays as it was.

    seed : of all noise
    ray_threads : that measure together, 0: as many as the computer has cores
    """

    def __init__(self, world: World, *, seed: int = 0, ray_threads: int = 1) -> None:
        if not isinstance(world, World):
            raise TypeError(
                f"{checks.found(world, 'world')}, expected a World, as World.from_file() returns"
            )
        ray_threads = checks.whole(ray_threads, "ray_threads", 0, _MOST_THREADS)
        self.world = world
        self.seed = checks.whole(seed, "seed")
        self._core = _core.Simulation(world._core, self.seed, ray_threads)
        self._demand_counts: Counter = Counter()

    def __enter__(self) -> "Simulation":
        return self

    def __exit__(
        self,
        kind: Optional[Type[BaseException]],
        error: Optional[BaseException],
        traceback: Optional[TracebackType],
    ) -> None:
        self.close()

    def close(self) -> None:
        """Ends the simulation; its readings live on. Every later call raises RuntimeError."""
        self._core.close()

    def spawn(
        self,
        name: str,
        model: Union[str, Path],
        *,
        xyz_m: Vector = (0, 0, 0),
        rpy_rad: Vector = (0, 0, 0),
        namespace: str = "",
        joint_positions: Optional[Mapping[str, float]] = None,
        is_static: bool = False,
        scale: float = 1.0,
        label: int = 0,
    ) -> Entity:
        """Adds a model and returns it.

        model : URDF or SDF text, as robot() returns it, or the pathlib.Path of such a file
        xyz_m, rpy_rad : pose in the world; roll, pitch, yaw about the fixed axes
        namespace : of the robot's topics, if its URDF names none; of shipped robots: robot("tsv1_default", ns="robot2")
        joint_positions : initial ones, rad or m, by the joint's name; others as described
        scale : of a static model
        label : class in label pictures

        Raises ArdeeError, and then nothing is left behind.
        """
        checks.text(name, "name")
        loaded = self._loaded(name, model)
        places = (
            {}
            if joint_positions is None
            else checks.named_numbers(joint_positions, "joint_positions")
        )
        self._core.spawn(
            name,
            loaded,
            checks.vector(xyz_m, "xyz_m"),
            checks.vector(rpy_rad, "rpy_rad"),
            checks.text(namespace, "namespace"),
            places,
            checks.flag(is_static, "is_static"),
            checks.number(scale, "scale"),
            checks.whole(label, "label", 0, _MOST_LABEL),
        )
        return next(entity for entity in self.entities() if entity.name == name)

    def _loaded(self, name: str, model: Union[str, Path]) -> "_core.Model":
        if not isinstance(model, str):
            return self.world.load_model(read_text(checks.path(model, "model")), str(model))
        if not model.lstrip("\ufeff \t\r\n").startswith("<"):
            raise ArdeeError(
                f"found the model {model[:80]!r}, expected URDF or SDF text, as robot() returns it, or a pathlib.Path"
            )
        return self.world.load_model(checks.text(model, "model"), name)

    def remove(self, name: str) -> None:
        """Takes a model out of the world."""
        self._core.remove(checks.text(name, "name"))

    def set_parameters(self, parameters: Parameters, *, namespace: str = "") -> None:
        """Sets parameters, or those of a YAML file, as `rosparam load` does; joints' gains are read by spawn()."""
        self._core.set_parameters(below(namespace, parameters))

    def start_controllers(self, model: str, *names: str) -> None:
        """Loads and starts a model's ros_control controllers, which then have topics, as controller_spawner does."""
        self._core.start_controllers(
            checks.text(model, "model"), [checks.text(name, "name") for name in names]
        )

    def stop_controllers(self, model: str, *names: str) -> None:
        """Stops controllers; they stay loaded."""
        self._core.stop_controllers(
            checks.text(model, "model"), [checks.text(name, "name") for name in names]
        )

    def controllers(self, model: str) -> Dict[str, str]:
        """Returns the states of a model's loaded controllers: initialized, running or stopped."""
        return self._core.controllers(checks.text(model, "model"))

    def step(self, n: int = 1) -> None:
        """Advances the world by n steps of step_ns; other threads of Python run meanwhile, and Ctrl-C ends it.

        Raises PhysicsError if a model's state became invalid.
        """
        self._core.step(checks.whole(n, "n"))

    def reset(self) -> None:
        """Puts the clock to 0 and all models where they were spawned; what follows repeats the first run."""
        self._core.reset()

    def set_noise_seed(self, seed: int) -> None:
        """Draws the noise of all sensors from other random streams, and resets all devices; models stay in place.

        Under 0 the streams are those of the simulation's own seed. A reset keeps the noise seed; snapshots hold it.
        """
        self._core.set_noise_seed(checks.whole(seed, "seed"))

    def set_light(self, light: Daylight) -> None:
        """Sets the light of sun and sky for later pictures; resets keep it, snapshots hold it."""
        if not isinstance(light, Daylight):
            raise TypeError(f"{checks.found(light, 'light')}, expected a Daylight")
        names = ("azimuth_deg", "elevation_deg", "turbidity", "cloud")
        self._core.set_daylight(*(checks.number(getattr(light, name), name) for name in names))

    @property
    def time_ns(self) -> int:
        """Simulated time."""
        return self._core.time_ns()

    @property
    def step_count(self) -> int:
        """Number of steps since the start or the last reset."""
        return self._core.step_count()

    @property
    def step_ns(self) -> int:
        """Simulated time of a step."""
        return self._core.step_ns()

    @property
    def gravity_m_s2(self) -> np.ndarray:
        """Acceleration by gravity [3]."""
        return self._core.gravity_m_s2()

    def snapshot(self) -> Snapshot:
        """Returns the present moment."""
        data = self._core.snapshot()
        return Snapshot(data + zlib.crc32(data).to_bytes(_CHECK_BYTES, "little"))

    def restore(self, snapshot: Snapshot) -> None:
        """Goes on from a snapshot of a simulation of the same world and seed: what follows is equal, byte for byte.

        Models spawned since are gone, removed ones are back. Kept readings are forgotten.
        """
        if not isinstance(snapshot, Snapshot) or not isinstance(snapshot.data, bytes):
            raise TypeError(f"{checks.found(snapshot, 'snapshot')}, expected a Snapshot of bytes")
        data, check = snapshot.data[:-_CHECK_BYTES], snapshot.data[-_CHECK_BYTES:]
        if zlib.crc32(data).to_bytes(_CHECK_BYTES, "little") != check:
            raise ArdeeError(
                "found a snapshot that is damaged or of an older version, expected the bytes that snapshot() returned"
            )
        self._core.restore(data)

    def state(self, name: str, *, relative_to: str = "world") -> State:
        """Returns the state of "model" or "model::link", as seen from another such name, which may move, or the world.

        A model's state relative to itself is at rest; its velocity in its own axes is that of the world, turned.
        """
        checks.text(name, "name")
        return State(*self._core.state(name, checks.text(relative_to, "relative_to")))

    def set_state(
        self,
        name: str,
        *,
        xyz_m: Optional[Vector] = None,
        quat_xyzw: Optional[Vector] = None,
        v_m_s: Vector = (0, 0, 0),
        w_rad_s: Vector = (0, 0, 0),
        relative_to: str = "world",
    ) -> None:
        """Moves a model; a part of the pose that is not given stays.

        relative_to : in whose axes pose and velocity are; its own velocity is not added, as in Gazebo
        """
        present = self.state(name, relative_to=relative_to)
        xyz_m = present.xyz_m if xyz_m is None else xyz_m
        quat_xyzw = present.quat_xyzw if quat_xyzw is None else quat_xyzw
        self._core.set_state(
            name,
            checks.vector(xyz_m, "xyz_m"),
            checks.quaternion(quat_xyzw),
            checks.vector(v_m_s, "v_m_s"),
            checks.vector(w_rad_s, "w_rad_s"),
            relative_to,
        )

    def command(self, topic: str, value: Command) -> None:
        """Commands a device from the next step on, as a message on its topic does.

        A TerraSentia stops 0.5 s after its last command (xacro argument command_timeout, 0: never).
        Raises KeyError for an unknown topic, with the nearest ones; TypeError for a value of another kind;
        ArdeeError for a value that the device refuses.
        """
        if isinstance(value, Twist):
            value = (
                value.linear_x_m_s,
                value.linear_y_m_s,
                value.linear_z_m_s,
                value.angular_x_rad_s,
                value.angular_y_rad_s,
                value.angular_z_rad_s,
            )
        self._core.command(checks.text(topic, "topic"), value)

    def trigger(self, topic: str) -> None:
        """Sends a command without content."""
        self._core.command(checks.text(topic, "topic"), None)

    def call(self, service: str, *arguments: float) -> Optional[Dict[str, Any]]:
        """Calls a device's service, with no argument, a vector, or latitude, longitude [deg] and altitude [m]."""
        return self._core.call(checks.text(service, "service"), *arguments)

    def demand(self, *topics: str, keep: int = 1) -> None:
        """Lets devices measure for these topics from now on; `keep` readings of each wait for drain()."""
        checks.whole(keep, "keep", 1)
        for topic in topics:
            self.demands(topic)  # raises KeyError before any is demanded
        for topic in topics:
            self._core.demand(topic, keep)
            self._demand_counts[topic.strip("/")] += 1

    def undemand(self, *topics: str) -> None:
        """Lets devices measure for these topics no more; their last readings stay."""
        for topic in topics:
            self._core.undemand(checks.text(topic, "topic"))

    def demands(self, topic: str) -> bool:
        """Returns whether the topic is demanded."""
        return self._core.demands(checks.text(topic, "topic"))

    def demand_count(self, topic: str) -> int:
        """Returns how often demand() was called for the topic: who demanded it sees whether others did since."""
        return self._demand_counts[checks.text(topic, "topic").strip("/")]

    def latest(self, topic: str) -> Any:
        """Returns the last reading of a demanded topic, of the class that topics() names; None before the first."""
        made = self._core.latest(checks.text(topic, "topic"))
        return None if made is None else make_reading(made)

    def drain(self, topic: str) -> List[Any]:
        """Returns the readings since the last call, in the order of time, up to the `keep` of demand()."""
        return [make_reading(made) for made in self._core.drain(checks.text(topic, "topic"))]

    def dropped(self, topic: str) -> int:
        """Returns how many readings drain() came too late for; none with keep=1, where only the last counts."""
        return self._core.dropped(checks.text(topic, "topic"))

    def entities(self) -> List[Entity]:
        """Returns all models, in the order of the world's file, then of spawning."""
        return [Entity(*made) for made in self._core.entities()]

    def topics(self) -> Dict[str, TopicInfo]:
        """Returns the topics and services of all devices."""
        found: Dict[str, TopicInfo] = {}
        for name, kind, role, rate_hz, frame_id in self._core.topics():
            other = found.get(name)
            if other and other.role == role:  # several devices share it, as /tf
                rate_hz = rate_hz + other.rate_hz if rate_hz and other.rate_hz else None
                frame_id = frame_id if frame_id == other.frame_id else ""
            found[name] = TopicInfo(kind, role, rate_hz, frame_id)
        return found

    def description(self, name: str) -> Any:
        """Returns what a model was made of: its `name` and `links()`; another object if another model has its name."""
        return self._core.description(checks.text(name, "name"))

    def scenery(self, x_m: float, y_m: float, radius_m: float) -> List[Tuple[Any, np.ndarray]]:
        """Returns the static models near a place: each description, and its poses and scale, [n, 8]."""
        place = checks.number(x_m, "x_m"), checks.number(y_m, "y_m")
        return self._core.scenery(*place, checks.number(radius_m, "radius_m", 0.0))

    def contacts(self) -> List[Contact]:
        """Returns the contacts of the last step; the first call is empty and asks for them from the next step on."""
        self._core.want_contacts()
        return [Contact(**made) for made in self._core.contacts()]

    def touched(self) -> List[Tuple[str, str]]:
        """Returns the pairs of collisions that touched in any step since the last call, by name.

        The first call is empty and asks for them from the next step on. A reset or a restore forgets them.
        """
        self._core.want_contacts()
        return self._core.take_touches()

    def log(self) -> List[LogLine]:
        """Returns the engine's messages since the last call; at the first, also those of reading the world."""
        return [LogLine(*made) for made in self._core.take_log()]

    def render(self, xyz_m: Vector, quat_xyzw: Vector = (0, 0, 0, 1), **lens: Any) -> np.ndarray:
        """Returns a picture, uint8[h, w, 3], of a camera at this pose: x forward, y left, z up.

        lens : width_px=640, height_px=480, horizontal_fov_rad=1.2, near_m=0 (what is nearer is invisible);
            v_m_s=(0, 0, 0), w_rad_s=(0, 0, 0): motion of the camera in the world's axes, which is seen if
            exposure_time_s=0 (motion blur) or readout_time_s=0 (rolling shutter: row r of n begins r / n of it later)
            is more than 0; the pose is that at the first row's start;
            exposure=None: factor on the light, None chooses it by the picture;
            white_balance="off": or "auto" (grey world), the colour temperature of daylight in K, or gains (r, g, b)
        """
        return take_picture(self._core, xyz_m, quat_xyzw, ("rgb",), **lens)["rgb"]

    def depth_image(
        self, xyz_m: Vector, quat_xyzw: Vector = (0, 0, 0, 1), **lens: Any
    ) -> np.ndarray:
        """Returns depths along the camera's axis, float32[h, w] in m, +inf where nothing is met. As render()."""
        return take_picture(self._core, xyz_m, quat_xyzw, ("depth_m",), **lens)["depth_m"]

    def label_image(
        self, xyz_m: Vector, quat_xyzw: Vector = (0, 0, 0, 1), **lens: Any
    ) -> np.ndarray:
        """Returns classes, uint16[h, w]: 0 nothing, 1 corn, 2 sorghum, 3 tobacco, 10 weed, ... As render()."""
        return take_picture(self._core, xyz_m, quat_xyzw, ("labels",), **lens)["labels"]

    def instance_image(
        self, xyz_m: Vector, quat_xyzw: Vector = (0, 0, 0, 1), **lens: Any
    ) -> np.ndarray:
        """Returns numbers of models, int32[h, w]: 0 nothing, Plant.instance, ... As render()."""
        return take_picture(self._core, xyz_m, quat_xyzw, ("instances",), **lens)["instances"]

    def picture(
        self, xyz_m: Vector, quat_xyzw: Vector = (0, 0, 0, 1), **lens: Any
    ) -> Dict[str, np.ndarray]:
        """Returns the layers "rgb", "depth_m", "labels", "instances" and "visuals" of one picture. As render().

        visuals : uint32[h, w], numbers of a model's parts: 0 nothing, those of Placement.visuals
        """
        layers = ("rgb", "depth_m", "labels", "instances", "visuals")
        return take_picture(self._core, xyz_m, quat_xyzw, layers, **lens)

    def lone_pixels(
        self,
        instances: Sequence[int],
        xyz_m: Vector,
        quat_xyzw: Vector = (0, 0, 0, 1),
        **lens: Any,
    ) -> np.ndarray:
        """Returns how many pixels of a picture each plant or piece of scenery would cover if nothing hid it, int64[n].

        instances : numbers of instance_image(), of what stands still
        lens : as render(), without exposure and white_balance
        """
        camera = camera_of(xyz_m, quat_xyzw, **lens)
        numbers = [checks.whole(each, "instances", 1, 2**31 - 1) for each in instances]
        return np.array(self._core.lone_pixels(camera, numbers), dtype=np.int64)
