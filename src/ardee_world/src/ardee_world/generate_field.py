# SPDX-License-Identifier: MIT
"""The command `generate_field`."""

import argparse
import dataclasses
import shlex
import typing
from pathlib import Path
from typing import Any, Dict, Optional, Sequence

from ardee_common.cli import Parser, add_seed, run, say
from ardee_common.errors import GeneratorError
from ardee_common.options import kind_of, plain_name, scalar_fields, unit_of
from ardee_models.lookup import crop_model, default_output, search_path
from ardee_models.terrain.ground import ground_model
from ardee_world.centres import listed_centres, read_centres
from ardee_world.clutter import KINDS, has_items
from ardee_world.field_config import FieldConfig
from ardee_world.field_layout import generate
from ardee_world.plots import Plan
from ardee_world.request import (
    Sources,
    Values,
    check_partners,
    configure,
    groups,
    with_changes,
    yaml_values,
)
from ardee_world.writers.field import write_field

_TITLES = {
    "sources": "models and files",
    "plots": "planting plan; rows run along -y of the field's frame unless turned",
    "shape": "row shape and headlands",
    "stand": "gaps, doubles and lodging",
    "clutter": "weeds, stones and litter",
    "field": "variation and position",
}
_SPECIAL = (
    "origin_latitude_deg",
    "origin_longitude_deg",
    "seed",
    "noise_covariance_m2",
    "world_pose",
)
_METAVARS = {int: "N", float: "X", str: "TEXT"}
_UNIT_METAVARS = {"m": "M", "m^2": "M2", "deg": "DEG", "1/m^2": "DENSITY"}


def _default_text(value: Any) -> str:
    if value is None or value == ():
        return ""
    if isinstance(value, tuple):
        value = " ".join(f"{v:g}" if isinstance(v, float) else str(v) for v in value)
    return f" (default {value:g})" if isinstance(value, float) else f" (default {value})"


def _flag(key: str) -> str:
    return "--" + key.replace("_", "-")


def _old_names() -> Dict[str, str]:
    """Names without units, and that of the thesis for the number of rows (Figure 4.4: n_rows)."""
    keys = {field.name for cls in groups().values() for field in scalar_fields(cls)}
    keys -= {"origin_latitude_deg", "origin_longitude_deg"}  # whose flag is --gps-origin-deg
    old = {_flag(plain_name(key)): _flag(key) for key in keys if plain_name(key) != key}
    return {**old, "--rows": "--rows-per-plot"}


def _add_option(group: Any, cls: type, field: dataclasses.Field) -> None:
    kind, unit, meta = kind_of(cls, field), unit_of(field.name), field.metadata
    arguments: Dict[str, Any] = {"dest": field.name, "default": argparse.SUPPRESS}
    if typing.get_origin(kind) is tuple:
        kind = typing.get_args(kind)[0]
        arguments["nargs"] = "+"
    if kind is typing.Any:
        kind = str
    arguments["type"] = kind
    if meta["choices"]:
        arguments["choices"] = meta["choices"]
    else:
        arguments["metavar"] = _UNIT_METAVARS.get(unit, _METAVARS[kind])
    unit_text = f" [{unit}]" if unit else ""
    arguments["help"] = meta["text"] + unit_text + _default_text(field.default).replace("%", "%%")
    if field.name == "model_path":
        arguments["action"] = "extend"
    group.add_argument(_flag(field.name), **arguments)


def _add_special(group: Any) -> None:
    usual, none = FieldConfig(), argparse.SUPPRESS
    group.add_argument(
        "--noise-covariance-m2",
        dest="noise_covariance_m2",
        type=float,
        nargs="+",
        default=none,
        metavar="M2",
        help="placement noise [m^2]: XX YY, or XX XY YY; x across the rows (default 0.000225 0 0.00125)",
    )
    group.add_argument(
        "--world-pose",
        type=float,
        nargs=3,
        default=none,
        metavar=("X", "Y", "YAW"),
        help=f"pose of the field in the world [m m rad] (default {' '.join(map(str, usual.world_pose))},"
        " as farm.world does)",
    )
    group.add_argument(
        "--gps-origin-deg",
        dest="gps_origin_deg",
        type=float,
        nargs=2,
        default=none,
        metavar=("LAT", "LON"),
        help="latitude and longitude of the world's origin [deg]",
    )
    add_seed(group).default = none


def make_parser() -> argparse.ArgumentParser:
    """Makes the parser of the arguments of thesis Figure 4.4, and of more."""
    parser = Parser(
        prog="generate_field",
        description="Write a random crop field as a Gazebo model directory with its ground truth.",
        epilog="A YAML file has the same names with underscores as keys: row_spacing_m, emergence_min, ...; "
        "arguments override it.",
        old_names=_old_names(),
    )
    parser.add_argument(
        "yaml", nargs="?", type=Path, metavar="FIELD.yaml", help="YAML file of options"
    )
    for name, cls in groups().items():
        if name == "aliases":
            continue
        group = parser.add_argument_group(_TITLES[name])
        for field in scalar_fields(cls):
            if field.name not in _SPECIAL:
                _add_option(group, cls, field)
        if name == "plots":
            group.add_argument(
                "--stalks-per-row",
                type=int,
                default=argparse.SUPPRESS,
                metavar="N",
                help="number of stalks in a row, instead of --row-length-m",
            )
        if name == "field":
            _add_special(group)
    return parser


def _plan(sources: Sources) -> Optional[Plan]:
    if sources.centers is None:
        return None
    if isinstance(sources.centers, str):
        return read_centres(Path(sources.centers))
    return listed_centres(sources.centers, sources.name)


def make_field(args: argparse.Namespace) -> Path:
    """Writes the field that the arguments describe; returns its path."""
    given: Values = vars(args)
    file = given.pop("yaml", None)
    if "row_length_m" in given and "stalks_per_row" in given:
        raise GeneratorError("found --row-length-m and --stalks-per-row, expected one of them")
    values = yaml_values(file) if file else {}
    values = with_changes(values, given)
    check_partners(values)
    path = make_configured(values)
    folders = [str(Path(folder).resolve()) for folder in configure(values)[0].model_path]
    listed = shlex.quote(":".join(folders))
    where = f"GAZEBO_MODEL_PATH={listed}:$GAZEBO_MODEL_PATH " if folders else ""
    field = shlex.quote(f"{path}/{path.name}.urdf.xacro")
    say(
        "generate_field",
        f"to drive in it: {where}rosrun ardee_bringup run_custom_world {field} [TERRAIN]",
    )
    return path


def make_configured(values: Values, *, has_map: bool = True) -> Path:
    """Writes the field of options by key; returns its path. The map takes longer than all the rest."""
    sources, config = configure(values)
    folders = search_path([Path(folder) for folder in sources.model_path])
    pool = tuple(crop_model(name, folders) for name in sources.models)
    pools = {
        kind: tuple(crop_model(n, folders) for n in getattr(config.clutter, f"{kind}_models"))
        for kind in KINDS
        if has_items(kind, config.clutter)
    }
    for kind in (kind for kind, found in pools.items() if not found):
        raise GeneratorError(f"{kind}_models: found none, expected names of models")
    terrain = ground_model(sources.terrain, folders) if sources.terrain else None
    layout = generate(config, pool, sources.seed, terrain, _plan(sources), pools)
    if layout.count() == 0:
        raise GeneratorError(
            f"emergence: found no plant that emerged of {len(layout.planned.centres_m)} planned, expected some"
        )
    parent = Path(sources.output or default_output())
    return write_field(layout, sources.name, parent, sources.format, terrain, has_map=has_map)


def main(arguments: Optional[Sequence[str]] = None) -> int:
    """Runs `generate_field --models corn_variant_1 ... --name my_field --output DIR`."""
    return run(make_parser(), make_field, arguments)
