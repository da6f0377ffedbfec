# SPDX-License-Identifier: MIT
"""A Gymnasium environment: a robot in a field, and a task."""

import math
from numbers import Real
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple

import gymnasium
import numpy as np
from ardee_sim import checks
from ardee_sim.envs.arguments import a_seed, mapping, names, refusals
from ardee_sim.envs.driven import ROBOT, DrivenRobot
from ardee_sim.envs.fields import FieldSource
from ardee_sim.envs.randomise import STAGE, Ranges, check_ranges
from ardee_sim.envs.task import Scene, Task
from ardee_sim.errors import ArdeeError
from ardee_sim.parameters import Parameters
from ardee_sim.simulation import Simulation
from ardee_sim.world import PathLike, World
from gymnasium import spaces

from ardee_common.errors import known_names
from ardee_world.row_truth import Field, Pose
from ardee_world.start import STAND_M

SETTLE_S = 0.5  # in which a robot comes to rest on its springs
REPEAT_S = 0.2  # after which a command is given again: TerraSentias stop after 0.5 s without one
Episode = Dict[str, Any]


class FieldEnv(gymnasium.Env):
    """A robot that is driven through a field by speed and turn rate; the task observes and rewards.

    task : of ardee_sim.envs, or one of yours
    scenario, world : name of a scenario; or path of a world, or name of a shipped one such as corn.world, instead
    robot : name of a shipped robot, or a file, as ardee_sim.robot() takes it
    xacro : values of the arguments of the robot's xacro file
    parameters, controllers : of ros_control, as Simulation.set_parameters() and start_controllers() take them
    command_topic : that obeys a Twist
    stand_m : height of the robot's origin above the ground below its wheels
    control_period_s : a whole number of the world's steps
    seed_field : sow a new field at each reset; else the field of `field_seed` stays
    randomise : ranges of numbers of a scene (ardee_sim.envs.randomise.SCENE) and, with seed_field, of a field's plan
    randomise["stage"] : leaves of the plants with a visible collar; of tobacco all visible ones
    v_max_m_s, w_max_rad_s : speed and turn rate of an action of 1
    render_mode : None or rgb_array
    """

    metadata: Dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 10}

    def __init__(
        self,
        task: Task,
        *,
        scenario: Optional[str] = None,
        world: Optional[PathLike] = None,
        robot: PathLike = "tsv1_default",
        xacro: Optional[Mapping[str, Any]] = None,
        parameters: Optional[Parameters] = None,
        controllers: Sequence[str] = (),
        command_topic: str = "cmd_vel",
        stand_m: float = STAND_M,
        control_period_s: float = 0.1,
        seed_field: bool = True,
        field_seed: int = 1,
        randomise: Optional[Ranges] = None,
        v_max_m_s: float = 0.8,
        w_max_rad_s: float = 1.0,
        render_mode: Optional[str] = None,
    ) -> None:
        if render_mode not in (None, *self.metadata["render_modes"]):
            raise ArdeeError(f"render_mode: found {render_mode!r}, expected None or rgb_array")
        given = dict(
            control_period_s=control_period_s, v_max_m_s=v_max_m_s, w_max_rad_s=w_max_rad_s
        )
        for name, value in given.items():
            if not (isinstance(value, Real) and 0 < value < math.inf):
                raise ArdeeError(f"{name}: found {value}, expected a positive number")
        self.render_mode = render_mode
        self.metadata = {**self.metadata, "render_fps": max(1, round(1 / control_period_s))}
        self._task, self._period_s = task, control_period_s
        self._limits = v_max_m_s, w_max_rad_s
        self._field_seed = a_seed(field_seed, "field_seed")
        with refusals():
            seed_field = checks.flag(seed_field, "seed_field")
        ranges = {} if randomise is None else randomise
        self._sim: Optional[Simulation] = None
        self._scene: Optional[Scene] = None
        self.action_space = spaces.Box(-1.0, 1.0, (2,), np.float32)
        self._source = FieldSource(scenario, world)
        self._sows = seed_field and self._source.is_sown
        try:
            check_ranges(ranges, self._sows)
            self._ranges = dict(ranges)
            self._source.check_plan(self._ranges)
            self._source.check_stages(self._ranges.get(STAGE, ()))
            self._robot = DrivenRobot(
                robot,
                xacro=xacro,
                parameters=parameters,
                controllers=controllers,
                command_topic=command_topic,
                stand_m=stand_m,
            )
            self._probe()
        except BaseException:
            self.close()
            raise

    def _probe(self) -> None:
        """Finds the steps of a period, the observations' space, and how long the slowest sensor takes for a reading."""
        numbers = {name: (low + high) / 2 for name, (low, high) in self._ranges.items()}
        self._sow(self._field_seed, numbers)
        assert self._sim is not None and self._sown is not None
        steps = self._period_s * 1e9 / self._sim.step_ns
        if steps < 1 or abs(steps - round(steps)) > 1e-6:
            raise ArdeeError(
                f"control_period_s: found {self._period_s}, expected a whole number of steps of "
                f"{self._sim.step_ns * 1e-9:g} s"
            )
        self._steps = round(steps)
        self._check_topics()
        scene = self._place(self._task.start(self._sown, np.random.default_rng(0)), 0)
        self._sim.demand(*self._task.topics, keep=1000)
        self._sim.step(math.ceil(1e9 / self._sim.step_ns))
        self._window = 1
        for topic in self._task.topics:
            stamps = [reading.stamp_ns for reading in self._sim.drain(topic)]
            gap_ns = float(max(np.diff(stamps))) if len(stamps) > 1 else self._period_s * 1e9
            self._window = max(self._window, math.ceil(gap_ns / self._sim.step_ns))
        self._demand_counts = {t: self._sim.demand_count(t) for t in self._task.topics}
        self._task.begin(scene)
        self.observation_space = self._task.space(scene)

    def _check_topics(self) -> None:
        topics = self.simulation.topics().items()
        known = [name.lstrip("/") for name, info in topics if info.role == "reading"]
        wanted = [topic.lstrip("/") for topic in names(self._task.topics, "topics")]
        for topic in wanted:
            if topic not in known:
                raise ArdeeError(f"topics: found '{topic}', {known_names(topic, known)}")
            if wanted.count(topic) > 1:
                raise ArdeeError(f"topics: found '{topic}' twice, expected it once")

    def _sow(self, seed: int, numbers: Mapping[str, float]) -> None:
        """Loads the field of a seed with drawn numbers, and spawns the robot in its origin; if refused, all stays."""
        sown = self._source.load(seed, numbers)
        plants = frozenset(plant.name for plant in sown.world.plants())
        sim = Simulation(sown.world)
        try:
            file = self._source.folder / "robot.urdf"
            self._robot.spawn(sim, file, numbers.get("noise_scale", 1.0))
            first = sim.snapshot()
        except BaseException:
            sim.close()
            raise
        if self._sim is not None:
            self._sim.close()
        self._sim, self._sown, self._plants, self._first = sim, sown, plants, first
        self._present = seed, dict(numbers)
        self._scene = None
        self._demand_counts = dict.fromkeys(self._task.topics, 0)

    def _place(self, pose: Pose, noise_seed: int) -> Scene:
        """Puts the robot, as it was spawned, to its start, with the noise of an episode."""
        sim = self.simulation
        sim.restore(self._first)
        half = pose.yaw_rad / 2
        xyz_m = (pose.x_m, pose.y_m, self._sown.trial.height_m(pose) + self._robot.rise_m)
        sim.set_state(ROBOT, xyz_m=xyz_m, quat_xyzw=(0.0, 0.0, math.sin(half), math.cos(half)))
        sim.set_noise_seed(noise_seed)
        return Scene(sim, ROBOT, self._sown, self._plants)

    @property
    def world(self) -> World:
        """The present world."""
        return self._sown.world

    @property
    def field(self) -> Field:
        """The truth of the present field: rows and stalks."""
        return self._sown.trial.field

    def pose(self) -> Pose:
        """Returns the robot's true pose on the ground plan, which its task may hide."""
        if self._scene is None:
            raise RuntimeError("found no episode, expected reset() first")
        return self._scene.pose()

    @property
    def simulation(self) -> Simulation:
        """The present simulation, in which ROBOT drives; a field that is sown anew has another one."""
        if self._sim is None:
            raise RuntimeError("found a closed environment, expected an open one")
        return self._sim

    def _draw(self, given: Mapping[str, Any]) -> Episode:
        """Draws an episode from np_random; `given` replaces parts of it."""
        known = ("field_seed", "numbers", "noise_seed", "start_seed")
        for name in mapping(given, "options"):
            if name not in known:
                raise ArdeeError(f"options: found '{name}', expected one of: {', '.join(known)}")
        seeds = [int(seed) for seed in self.np_random.integers(2**31, size=3)]
        numbers = {
            name: float(self.np_random.uniform(*self._ranges[name])) for name in self._ranges
        }
        drawn: Episode = dict(
            field_seed=seeds[0], numbers=numbers, noise_seed=seeds[1], start_seed=seeds[2]
        )
        if not self._sows:
            drawn["field_seed"] = self._field_seed
        episode = {**drawn, **given}
        with refusals():
            episode["numbers"] = numbers = checks.named_numbers(episode["numbers"], "numbers")
        fixed = {name: (number, number) for name, number in numbers.items()}
        check_ranges(fixed, self._source.is_sown, "numbers")
        seeds_of = ("field_seed", "noise_seed", "start_seed")
        return {**episode, **{name: a_seed(episode[name], name) for name in seeds_of}}

    def reset(
        self, *, seed: Optional[int] = None, options: Optional[Mapping[str, Any]] = None
    ) -> Tuple[Any, Dict[str, Any]]:
        """Begins an episode; `options` = info["replay"] of an earlier reset repeats that one."""
        super().reset(seed=seed)
        self.simulation  # raises if closed
        episode = self._draw({} if options is None else options)
        if self._present != (episode["field_seed"], episode["numbers"]):
            self._sow(episode["field_seed"], episode["numbers"])
        rng = np.random.default_rng(np.random.SeedSequence(episode["start_seed"]))
        scene = self._place(self._task.start(self._sown, rng), episode["noise_seed"])
        self._scene = scene
        settle = max(math.ceil(SETTLE_S / self._period_s) * self._steps, self._window)
        self._step_and_measure(scene, settle)
        scene.sim.touched()  # what it touched as it settled is not the driver's
        self._task.begin(scene)
        return self._task.observe(scene), {"replay": episode}

    def _step_and_measure(
        self, scene: Scene, steps: int, v_m_s: float = 0.0, w_rad_s: float = 0.0
    ) -> None:
        """Drives; sensors that are faster than a control period measure only at its end.

        Topics that somebody else has demanded since are left to them.
        """
        sim, last = scene.sim, min(self._window, steps)
        ours = [t for t in self._task.topics if sim.demand_count(t) == self._demand_counts[t]]
        sim.undemand(*ours)
        self._drive(sim, steps - last, v_m_s, w_rad_s)
        sim.demand(*ours)
        self._demand_counts.update({topic: sim.demand_count(topic) for topic in ours})
        self._drive(sim, last, v_m_s, w_rad_s)

    def _drive(self, sim: Simulation, steps: int, v_m_s: float, w_rad_s: float) -> None:
        """Steps under a command, again and again before the robot stops for want of one."""
        repeat = max(1, int(REPEAT_S * 1e9 / sim.step_ns))
        for begin in range(0, steps, repeat):
            self._robot.command(sim, v_m_s, w_rad_s)
            sim.step(min(repeat, steps - begin))

    def step(self, action: Any) -> Tuple[Any, float, bool, bool, Dict[str, Any]]:
        """Drives for a control period; info has the terms of the reward and, at the end, its reason."""
        scene = self._scene
        if scene is None:
            raise RuntimeError("found a step before reset(), expected reset() first")
        self.action = checks.vector(action, "action", 2)  # RecordEpisode takes it from here
        v_m_s, w_rad_s = np.clip(self.action, -1.0, 1.0) * self._limits
        self._step_and_measure(scene, self._steps, v_m_s, w_rad_s)
        terms = self._task.reward(scene)
        reason, terms["end"] = self._task.end(scene)
        info: Dict[str, Any] = {f"reward_{name}": value for name, value in terms.items()}
        info["end_reason"] = reason
        return self._task.observe(scene), float(sum(terms.values())), bool(reason), False, info

    def render(self) -> Optional[np.ndarray]:
        """Returns a picture, uint8[360, 480, 3], from behind and above the robot."""
        if self.render_mode is None or self._scene is None:
            return None
        pose = self._scene.pose()
        c, s = math.cos(pose.yaw_rad), math.sin(pose.yaw_rad)
        z_m = float(self._scene.state().xyz_m[2]) + 0.35
        eye = (pose.x_m - 0.9 * c, pose.y_m - 0.9 * s, z_m)
        pitch, half = 0.15, pose.yaw_rad / 2
        up: List[float] = [
            -math.sin(half) * math.sin(pitch / 2),
            math.cos(half) * math.sin(pitch / 2),
            math.sin(half) * math.cos(pitch / 2),
            math.cos(half) * math.cos(pitch / 2),
        ]
        return self._scene.sim.render(eye, up, width_px=480, height_px=360, near_m=0.3)

    def close(self) -> None:
        """Ends the simulation and deletes the field."""
        if self._sim is not None:
            self._sim.close()
        self._sim = self._scene = None
        self._source.close()
