# SPDX-License-Identifier: MIT
"""The file of a campaign: its keys, read with their lines; an unknown key or a value without meaning is refused."""
import dataclasses
import math
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, Optional, Tuple

from ardee_campaigns import tables
from ardee_common.config import Mapping, build, build_group, read_yaml_lines
from ardee_common.errors import GeneratorError
from ardee_common.options import bounded, converted, option

LARGEST_SEED = 2**31 - 1  # of a field
_LARGEST = 2**63 - 1  # whole number
_NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
Value = Any  # of a factor: a number, a text or a truth value


def _scalars(value: Any) -> Tuple[Value, ...]:
    """Returns the values of a list of numbers, texts or truth values that differ in the tables, too."""
    if not isinstance(value, list) or not value:
        raise ValueError(value)
    if not all(isinstance(v, (str, int, float)) and _is_bounded(v) for v in value):
        raise ValueError(value)
    if len(set(tables.stored(value))) != len(value):
        raise ValueError(value)
    return tuple(value)


def _is_bounded(value: Value) -> bool:
    if isinstance(value, int):
        return -_LARGEST <= value <= _LARGEST
    return isinstance(value, str) or math.isfinite(value)


@dataclass(frozen=True)
class WorldKeys:
    """Give one of the keys `scenario` and `field`, or `world` with or without `field`."""

    scenario: Optional[str] = option(None, "name in `config/scenarios.yaml` of ardee_world")
    world: Optional[str] = option(
        None, "world file with its `.start.yaml` beside it, or the name of a shipped one"
    )
    field: Optional[str] = option(
        None, "field recipe, sown anew for each replicate; alone it stands on its `terrain`"
    )
    options: Optional[dict] = option(
        None, "keys of the field recipe that are replaced; paths are relative to this file"
    )
    params: Optional[dict] = option(
        None, "controller to parameters that this world needs, over its own"
    )

    def __post_init__(self) -> None:
        given = [key for key in ("scenario", "world", "field") if getattr(self, key)]
        if given not in (["scenario"], ["world"], ["field"], ["world", "field"]):
            found = " and ".join(given) or "none of the keys scenario, world, field"
            raise GeneratorError(
                f"found {found}, expected scenario, world, field, or world + field"
            )
        if self.options and given == ["world"]:
            raise GeneratorError("options: found some for a world without field, expected a recipe")


@dataclass(frozen=True)
class RobotKeys:
    """A robot is a model and what its topics are used for."""

    model: str = option("tsv1_default", "shipped robot, or a `.urdf` or `.xacro` file")
    xacro: Optional[dict] = option(None, "arguments of the `.xacro` file")
    topics: Optional[dict] = option(
        None,
        "use to topic; `command` gets the commands, `battery` its state of charge, each other one is a key of the"
        " controller's observation (default: command: cmd_vel, scan: ardee/hokuyo, battery: ardee/battery_state)",
    )
    parameters: Optional[dict] = option(
        None, "of its ros_control controllers, and joints' gains; a text is a `.yaml` file of them"
    )
    controllers: Tuple[str, ...] = option(
        (), "of ros_control, started in this order; they have topics"
    )
    pace: str = option("scan", "use whose readings the controller answers, one step each")
    period_s: Optional[float] = option(
        None, "control period instead of the pace of a sensor", (1e-4, 10.0)
    )
    stand_m: float = option(0.175, "height of its origin above the ground", (0.0, 10.0))
    length_m: Optional[float] = option(
        None, "of its outline, instead of the collision bodies'", (0.01, 20.0)
    )
    width_m: Optional[float] = option(None, "of its outline, likewise", (0.01, 20.0))

    def __post_init__(self) -> None:
        if (self.length_m is None) != (self.width_m is None):
            raise GeneratorError("found one of length_m and width_m, expected both or none")
        for use, topic in (self.topics or {}).items():
            if not isinstance(topic, str) or not topic.strip("/"):
                raise GeneratorError(f"topics: {use}: found {topic!r}, expected a topic")


@dataclass(frozen=True)
class TaskKeys:
    """Rules of a run: when a person steps in, and when it is over."""

    kind: str = option(
        "row",
        "row: down the lane before the start, a person steps in; free: until the limit or the controller's end",
        choices=("row", "free"),
    )
    largest_offset_m: float = bounded(0.01, 100.0, 0.38)  # beside the centre line: off the lane
    stuck_after_s: float = bounded(0.1, 1000.0, 2.0)  # without moving
    stuck_within_m: float = bounded(0.001, 10.0, 0.05)  # counts as not moving
    row_end_m: float = bounded(0.0, 100.0, 0.5)  # a stop nearer to the row's end is its end
    set_ahead_m: float = bounded(0.0, 100.0, 0.5)  # where a robot that stood is set down again
    overrun_m: float = bounded(0.0, 1000.0, 5.0)  # behind the row's end: the run is over
    most_interventions: int = bounded(1, 100_000, 100)  # then the run is given up
    slowest_m_s: float = bounded(
        0.0, 100.0, 0.0
    )  # mean speed down the lane; a slower run is over; 0: limit_sim_s alone
    damage_penalty_m: float = bounded(0.0, 1000.0, 1.0)  # a touched plant, in fre_score_m; assumed


@dataclass(frozen=True)
class ControllerKeys:
    """In Python `make(params, robot, seed)` returns an object with `reset()` and `step()`."""

    kind: str = option(
        "python",
        "python: a factory; udp: a program that speaks the bridge's wire format, in real time; ros: a node or launch"
        " file beside the node `simulator`",
        choices=("python", "udp", "ros"),
    )
    factory: str = option("", "module:function that makes it, of kind python")
    command: Tuple[str, ...] = option(
        (),
        "words of the program's command, of kind udp and ros: `{NAME}` is a parameter; of udp, `{bind}` is where it"
        " listens for scans, `{sensors}` whence they come, `{controls}` whither it sends commands",
    )
    realtime: bool = option(
        False,
        "of kind ros: simulated time goes as the wall's; else it waits for a command after each reading of the robot's"
        " `pace`",
    )
    params: Optional[dict] = option(None, "its parameters")

    def __post_init__(self) -> None:
        if self.realtime and self.kind != "ros":
            raise GeneratorError(f"realtime: found true for kind {self.kind}, expected kind ros")
        if self.kind != "python":
            if self.factory or not self.command:
                found = f"factory and kind {self.kind}" if self.factory else "no command"
                raise GeneratorError(f"found {found}, expected the command of a program")
            return
        if self.command:
            raise GeneratorError("command: found some for kind python, expected a factory")
        if ":" not in self.factory:
            raise GeneratorError(f"factory: found {self.factory!r}, expected module:function")


@dataclass(frozen=True)
class FactorKeys:
    """A factor, which is varied. A list is short for `values` of a controller's parameter."""

    of: str = option(
        "controller",
        "what has a parameter, field option or xacro argument of this name",
        choices=("controller", "field", "robot"),
    )
    values: Optional[tuple] = converted(
        _scalars,
        "a list of different numbers of at most 64 bit, texts or truth values that is not empty; a table has a list of"
        " mixed ones as texts",
        None,
    )
    low: Optional[float] = option(None, "least value, in a Latin hypercube")
    high: Optional[float] = option(None, "greatest value, in a Latin hypercube")

    def __post_init__(self) -> None:
        is_range = self.low is not None and self.high is not None
        if (self.values is None) != is_range or (self.low is None) != (self.high is None):
            raise GeneratorError("expected either values, or low and high")
        if is_range and not self.low < self.high:
            raise GeneratorError(f"found low {self.low} and high {self.high}, expected low < high")


@dataclass(frozen=True)
class PlanKeys:
    """The plan chooses combinations; worlds, robots and controllers are always combined with each other."""

    kind: str = option(
        "factorial",
        "factorial: all values of the factors; latin_hypercube: `points` spread over them; until: all values, with more"
        " replicates until the 95 % interval of `measure` is narrow",
        choices=("factorial", "latin_hypercube", "until"),
    )
    points: Optional[int] = option(None, "of the Latin hypercube", (1, 1_000_000))
    measure: str = option("", "measure whose mean is wanted")
    half_width: Optional[float] = option(None, "of its 95 % interval, at most", (0.0, 1e300))
    most_replicates: int = option(100, "even if the interval is still wider", (2, 1_000_000))

    def __post_init__(self) -> None:
        if (self.kind == "latin_hypercube") != (self.points is not None):
            raise GeneratorError("points: expected for kind latin_hypercube, and for it alone")
        is_until = self.kind == "until"
        if is_until != bool(self.measure) or is_until != (self.half_width is not None):
            raise GeneratorError("expected measure and half_width for kind until, and for it alone")


@dataclass(frozen=True)
class CampaignKeys:
    """Entries by name, limits, and what is varied and measured."""

    name: str = option("", "of the campaign")
    worlds: Optional[dict] = option(
        None, "name to a world; a text is short for its scenario, `.world` or recipe `.yaml`"
    )
    controllers: Optional[dict] = option(None, "name to a controller; a text is its factory")
    robots: Optional[dict] = option(
        None, "name to a robot; a text is its model (default: tsv1: tsv1_default)"
    )
    seed: int = option(0, "root of all random numbers", (0, 2**63))
    first_seed: Optional[int] = option(
        None,
        "seed of the first replicate, in place of one drawn from `seed`; each further replicate's is 1 more",
        (0, LARGEST_SEED),
    )
    replicates: int = option(1, "runs of each combination; each has a seed", (1, 1_000_000))
    workers: int = option(0, "processes; 0: one for each core", (0, 10_000))
    limit_sim_s: float = option(120.0, "simulated time after which a run ends", (0.01, 1e6))
    watchdog_wall_s: float = option(
        900.0, "time after which a worker is taken for stalled and ended", (0.1, 1e6)
    )
    memory_mb: int = option(4000, "that a run may take", (100, 10_000_000))
    task: TaskKeys = TaskKeys()
    factors: Optional[dict] = option(None, "name to what is varied")
    measures: Tuple[str, ...] = option((), "names, or module:function of your own")
    plan: PlanKeys = PlanKeys()


@dataclass(frozen=True)
class Campaign:
    """A campaign as its file says, with entries by name."""

    file: Path
    keys: CampaignKeys
    worlds: Dict[str, WorldKeys]
    robots: Dict[str, RobotKeys]
    controllers: Dict[str, ControllerKeys]
    factors: Dict[str, FactorKeys]


class _NotPlain(GeneratorError):
    """A value that no file of results could hold."""


def plain(value: Any) -> Any:
    """Returns a file's value without the places of its mappings. Raises _NotPlain for one that JSON cannot hold."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, list):
        return [plain(item) for item in value]
    if (
        value is None
        or isinstance(value, (str, int, float, tuple))
        or dataclasses.is_dataclass(value)
    ):
        return value
    expected = "numbers, texts, truth values, and lists and mappings of them"
    raise _NotPlain(f"found {value} ({type(value).__name__}), expected {expected}")


def _world_text(text: str) -> str:
    kinds = {".world": "world", ".sdf": "world", ".yaml": "field"}
    return kinds.get(Path(text).suffix, "scenario")


def _entries(cls: type, mapping: Mapping, key: str, short: Any) -> Dict[str, Any]:
    """Returns the entries of a mapping of names; `short` names the key that an entry that is no mapping is for."""
    named = mapping[key]
    if not named:
        raise mapping.error(key, f"{key}: found none, expected at least one")
    made = {}
    for name, value in named.items():
        if not _NAME.fullmatch(name):
            expected = "letters, digits and _, the first a letter"
            raise named.error(name, f"{key}: found the name {name!r}, expected {expected}")
        kind, called = (list, "list") if key == "factors" else (str, "text")
        if not isinstance(value, (dict, kind)):
            found = f"{key}: {name}: found {value!r}"
            raise named.error(name, f"{found}, expected a mapping or a {called}")
        if not isinstance(value, dict):
            long = Mapping(named.place, named.line[name])
            long[short(value)] = value
            long.line[short(value)] = named.line[name]
            named[name] = long
        try:
            made[name] = _without_places(build_group(cls, named, name))
        except _NotPlain as error:
            raise named.error(name, f"{key}: {name}: {error}") from None
    return made


def _without_places(group: Any) -> Any:
    changed = {f.name: plain(getattr(group, f.name)) for f in dataclasses.fields(group)}
    return dataclasses.replace(group, **changed)


def read_campaign(file: Path) -> Campaign:
    """Reads a campaign's file. Raises GeneratorError with file and line."""
    mapping = read_yaml_lines(file)
    keys = build(CampaignKeys, mapping)
    for needed in ("name", "worlds", "controllers"):
        if not getattr(keys, needed):
            raise mapping.error(needed, f"{needed}: found none, expected some")
    if Path(keys.name).name != keys.name or keys.name == "..":
        raise mapping.error("name", f"name: found {keys.name!r}, expected the name of a folder")
    if not keys.measures:
        raise mapping.error("measures", "measures: found none, expected at least one")
    if "robots" not in mapping:
        mapping["robots"] = Mapping(file)
        mapping["robots"]["tsv1"] = Mapping(file)
    factors = _factors(mapping) if keys.factors is not None else {}
    is_hypercube = keys.plan.kind == "latin_hypercube"
    for name, factor in factors.items():
        if factor.values is None and not is_hypercube:
            found = "low and high, which a Latin hypercube needs"
            raise mapping["factors"].error(name, f"{name}: found {found}, expected values")
    if is_hypercube and not factors:
        raise mapping.error("plan", "plan: found a Latin hypercube without factors, expected some")
    if keys.plan.kind == "until" and keys.plan.measure not in keys.measures:
        known = ", ".join(keys.measures)
        raise mapping.error("plan", f"plan: measure {keys.plan.measure!r}, expected one of {known}")
    if keys.plan.kind == "until" and keys.replicates < 2:
        raise mapping.error("replicates", "replicates: found 1, expected 2 or more for plan until")
    if keys.plan.kind == "until" and keys.replicates > keys.plan.most_replicates:
        found = f"found {keys.replicates}, more than most_replicates"
        raise mapping.error("replicates", f"replicates: {found} {keys.plan.most_replicates}")
    most = keys.plan.most_replicates if keys.plan.kind == "until" else keys.replicates
    if keys.first_seed is not None and keys.first_seed + most - 1 > LARGEST_SEED:
        found = f"found a last seed above {LARGEST_SEED}, the largest"
        raise mapping.error("first_seed", f"first_seed: {found}")
    _refuse_unused(mapping, keys)
    worlds = _entries(WorldKeys, mapping, "worlds", _world_text)
    _read_parameters(mapping["robots"] or {}, file.parent)
    robots = _entries(RobotKeys, mapping, "robots", lambda value: "model")
    controllers = _entries(ControllerKeys, mapping, "controllers", lambda value: "factory")
    for name, world in worlds.items():
        for controller, params in (world.params or {}).items():
            if params is not None and not isinstance(params, dict):
                found = f"{name}: params: {controller}: found {params!r}"
                raise mapping["worlds"].error(name, f"{found}, expected a mapping of parameters")
            if controller not in controllers:
                known = ", ".join(controllers)
                found = f"{name}: params: found controller {controller!r}"
                raise mapping["worlds"].error(name, f"{found}, expected one of {known}")
    return Campaign(file.resolve(), keys, worlds, robots, controllers, factors)


def _refuse_unused(mapping: Mapping, keys: CampaignKeys) -> None:
    """Raises GeneratorError for a key that has no effect in the plan or task of its kind."""
    unused = {"plan": ["most_replicates"] if keys.plan.kind != "until" else [], "task": []}
    if keys.task.kind == "free":
        of_both = ("kind", "damage_penalty_m")
        unused["task"] = [f.name for f in dataclasses.fields(TaskKeys) if f.name not in of_both]
    for group, names in unused.items():
        for name in names:
            if name in mapping.get(group, {}):
                found = f"{name}: found it in a {group} of kind {getattr(keys, group).kind}"
                raise mapping[group].error(name, f"{found}, where it has no effect, expected none")


def _read_parameters(robots: Mapping, folder: Path) -> None:
    """Puts the content of a file of parameters in the place of its name: runs are those of that content."""
    for robot in robots.values():
        if isinstance(robot, dict) and isinstance(robot.get("parameters"), str):
            robot["parameters"] = read_yaml_lines(folder / Path(robot["parameters"]).expanduser())


def _factors(mapping: Mapping) -> Dict[str, FactorKeys]:
    return _entries(FactorKeys, mapping, "factors", lambda value: "values")
