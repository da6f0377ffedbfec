# SPDX-License-Identifier: MIT
"""The page of keys of YAML files, made from the dataclasses that read them."""
import dataclasses
import inspect
import re
import typing
from typing import Any, Iterator, Tuple

from markdown_text import code, table

from ardee_bridge.nodes import settings
from ardee_campaigns import campaign_file
from ardee_common.options import kind_of, range_text, unit_of
from ardee_datasets import camera, light
from ardee_datasets import recipe as dataset
from ardee_datasets import robots
from ardee_models.plant.species import SpeciesFile
from ardee_models.terrain.recipe import Recipe
from ardee_navigation.evaluation.scenario_files import Scenario
from ardee_navigation.lbirnt import Parameters
from ardee_navigation.vision import VisionParameters
from ardee_world.request import groups
from ardee_world.start import Start

# Title, what the keys are of, and the dataclass that reads them.
FILES = (
    ("Start of a robot", "`<field>.start.yaml` and `<world>.start.yaml`", Start),
    ("Terrain", "a recipe of `rosrun ardee_models generate_terrain RECIPE.yaml`", Recipe),
    ("Species", "`config/species/*.yaml` of ardee_models, with the numbers' sources", SpeciesFile),
    ("Row follower", "`parameters:=FILE` and `--parameters FILE`", Parameters),
    ("Row follower by camera", "`params` of a campaign's controller", VisionParameters),
    ("Scenario", "an entry of `config/scenarios.yaml` of ardee_world", Scenario),
    ("Campaign", "a file of `rosrun ardee_campaigns run_campaign`", campaign_file.CampaignKeys),
    ("A world of a campaign", "an entry of `worlds`", campaign_file.WorldKeys),
    ("A robot of a campaign", "an entry of `robots`", campaign_file.RobotKeys),
    ("A controller of a campaign", "an entry of `controllers`", campaign_file.ControllerKeys),
    ("A factor of a campaign", "an entry of `factors`", campaign_file.FactorKeys),
    ("Data set", "a recipe of `rosrun ardee_datasets generate_dataset`", dataset.Recipe),
    ("Fields of a data set", "an entry of `fields`", dataset.FieldKeys),
    ("A camera of a data set", "an entry of `cameras`", camera.CameraKeys),
    ("A robot of a data set", "an entry of `robots`", robots.RobotKeys),
    ("A lidar of a data set", "an entry of `lidars`", dataset.LidarKeys),
    ("Light of a data set", "its entry `light`", light.LightKeys),
    ("Sensor server", "`config/sensor_server.yaml` of ardee_bridge", settings.ServerSettings),
    ("A GPS of the sensor server", "an entry of `sources`", settings.GpsSource),
    ("A camera of the sensor server", "an entry of `sources`", settings.ImageSource),
    ("A cloud of the sensor server", "an entry of `sources`", settings.CloudSource),
    ("Controls client", "`config/controls_client.yaml` of ardee_bridge", settings.ControlSettings),
)
HEAD = ("key", "meaning", "values", "default")
PLAIN = {
    str: "text",
    float: "number",
    int: "whole number",
    bool: "true or false",
    dict: "mapping",
    Any: "any",
}
RATES = (("_m_s", "m/s"), ("_rad_s", "rad/s"), ("_hz", "1/s"), ("_s", "s"), ("_bytes", "bytes"))
WITHOUT_END = 1e15  # a limit above it is none
INTRODUCTION = """# Keys of YAML files

An unknown key or a value out of its limits is refused with file and line. `a.b` is the key `b` of the mapping `a`,
`a[].b` that of each entry of the list `a`. A key without a default has to be given, or is off.

## Field

A file of `rosrun ardee_world generate_field FIELD.yaml`.

"""


def comment_of(cls: type, name: str) -> str:
    """Returns the comment behind a field in the source of the class, or of a base that has the field."""
    source = "".join(inspect.getsource(each) for each in cls.__mro__ if each is not object)
    found = re.search(rf"^    {name}:.*?#\s*(.*)$", source, re.MULTILINE)
    return found[1] if found else ""


def kind_text(kind: Any) -> str:
    """Returns the name of a field's type."""
    if typing.get_origin(kind) is tuple:
        items = typing.get_args(kind)
        count = "" if items[-1] is Ellipsis else f"{len(items)} "
        return f"list of {count}{kind_text(items[0])}s"
    return PLAIN.get(kind, getattr(kind, "__name__", str(kind)))


def values_text(field: dataclasses.Field, kind: Any) -> str:
    """Returns what values a key may have, with their unit."""
    if field.metadata.get("choices"):
        return ", ".join(field.metadata["choices"])
    unit = unit_of(field.name) or next((u for end, u in RATES if field.name.endswith(end)), "")
    limits = field.metadata.get("limits")
    if not limits:
        return field.metadata.get("expected") or f"{kind_text(kind)} {unit}".strip()
    low, high = limits
    end = high if high < WITHOUT_END else float("inf")
    return f"{kind_text(kind)}, {range_text((low, end), unit)}"


def rows_of(cls: type, prefix: str = "") -> Iterator[Tuple[str, str, str, str]]:
    """Rows of a table of keys; keys of nested groups have a prefix."""
    for field in dataclasses.fields(cls):
        kind = kind_of(cls, field)
        is_mapping = dataclasses.is_dataclass(kind)
        nested = kind if is_mapping else field.metadata.get("group")
        if inspect.isclass(nested):
            yield from rows_of(nested, f"{prefix}{field.name}{'.' if is_mapping else '[].'}")
            continue
        is_given = field.default not in (dataclasses.MISSING, None, (), "")
        default = code(str(field.default).strip("()")) if is_given else ""
        meaning = field.metadata.get("text") or comment_of(cls, field.name)
        yield code(prefix + field.name), meaning, values_text(field, kind), default


def page() -> str:
    """Returns the page."""
    fields = [row for cls in groups().values() for row in rows_of(cls)]
    shown = {row[0]: row for row in fields if "." not in row[0]}
    parts = [INTRODUCTION, table(HEAD, shown.values())]
    for title, what, cls in FILES:
        about = f"Keys of {what}. {inspect.getdoc(cls)}"
        parts.append(f"\n## {title}\n\n{about}\n\n{table(HEAD, rows_of(cls))}")
    return "".join(parts)
