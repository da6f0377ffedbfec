# SPDX-License-Identifier: MIT
"""Options of a recipe's fields, checked before any field is sown."""

import dataclasses
import functools
from pathlib import Path
from typing import Any, Dict, Optional, Tuple

from ardee_sim import packages

from ardee_common.config import Mapping, unknown_key, value_of
from ardee_common.errors import GeneratorError
from ardee_common.options import kind_of
from ardee_datasets.categories import CATEGORIES, OWN_LABELS
from ardee_datasets.seeds import stream
from ardee_models.lookup import crop_model, find_model, search_path
from ardee_models.terrain.ground import ground_model, is_ground
from ardee_models.terrain.height_map import Ground
from ardee_world.clutter import KINDS
from ardee_world.curves import Line
from ardee_world.field_config import FieldConfig
from ardee_world.field_layout import check_plan
from ardee_world.plots import row_positions
from ardee_world.request import all_fields, configure

WIDEST_LANE_M = 2.5  # beyond that, two rows are neighbours across an alley of plots
FIELD = "field"  # name of the field's model in the simulation
TERRAIN = "heightmap_ground"  # unless the options name another
_OF_THE_RECIPE = ("name", "output", "seed", "format", "centers", "model_path", "world_pose")
IMAGES = tuple(f"{kind}_image" for kind in KINDS)  # paths relative to the recipe
POOLS = ("models", *(f"{kind}_models" for kind in KINDS))
Values = Dict[str, Any]
Ranges = Dict[str, Tuple[float, float]]


def checked_options(
    options: Optional[Mapping], ranges: Optional[Mapping], labels: Dict[str, int]
) -> Tuple[Values, Ranges]:
    """Returns the options of fields, each checked, and the ranges that others are drawn from.

    `labels` are those of models of the recipe's own, by name. Raises GeneratorError.
    """
    options, ranges = options or Mapping(""), ranges or Mapping("")
    fixed = {key: _checked(options, key, options[key]) for key in options}
    drawn = {key: _range(ranges, key) for key in ranges}
    for key in sorted(set(fixed) & set(drawn)):
        raise ranges.error(key, f"{key}: found it in options too, expected it once")
    if {"row_length_m", "stalks_per_row"} <= {*fixed, *drawn}:
        raise GeneratorError("options: found row_length_m and stalks_per_row, expected one of them")
    if "models" not in fixed:
        raise GeneratorError("options: found no models, expected names of crop models")
    _check_models(options, fixed, labels)
    return fixed, drawn


def _option(given: Mapping, key: str) -> Tuple[type, dataclasses.Field]:
    if key in _OF_THE_RECIPE:
        raise given.error(key, f"{key}: found it, expected none: a recipe sets it itself")
    known = {name: pair for name, pair in all_fields().items() if name not in _OF_THE_RECIPE}
    if key not in known:
        raise unknown_key(given, key, sorted(known))
    return known[key]


def _checked(given: Mapping, key: str, value: Any) -> Any:
    """Returns the value of an option, checked as generate_field checks it."""
    one = Mapping(given.place)
    one.line[key], one[key] = given.line[key], value
    checked = value_of(*_option(given, key), one, key)
    if key in IMAGES and checked is not None:
        return str(Path(given.place).resolve().parent / Path(checked).expanduser())
    return checked


def _range(given: Mapping, key: str) -> Tuple[float, float]:
    limits = given[key]
    if kind_of(*_option(given, key)) not in (int, float):
        raise given.error(key, f"{key}: found a range, expected an option that is a number")
    if not isinstance(limits, list) or len(limits) != 2 or None in limits:
        raise given.error(key, f"{key}: found {limits!r}, expected [least, most]")
    least, most = (_checked(given, key, value) for value in limits)
    if least > most:
        raise given.error(key, f"{key}: found {limits!r}, expected [least, most]")
    return least, most


def _check_models(given: Mapping, options: Values, labels: Dict[str, int]) -> None:
    """Raises GeneratorError for a model that is not there, of another kind, or with a label that has no name."""
    named = {*(category["id"] for category in CATEGORIES), *labels.values()}
    folders = search_path([Path(folder) for folder in packages.model_folders()])
    for key in (key for key in POOLS if key in options):
        if not options[key]:
            raise given.error(key, f"{key}: found none, expected names of models")
        for name in options[key]:
            try:
                label = crop_model(name, folders).label
            except GeneratorError as error:
                raise given.error(key, f"{key}: {error}") from None
            if label not in named:
                raise given.error(key, f"{key}: found {name} with label {label}, {_instead(label)}")
    terrain = options.get("terrain")
    if terrain is None:
        return
    try:
        found = is_ground(find_model(terrain, folders))
    except GeneratorError as error:
        raise given.error("terrain", f"terrain: {error}") from None
    if not found:
        expected = "expected a model with a heightmap, mesh or plane to collide with"
        raise given.error("terrain", f"terrain: found {terrain!r}, {expected}")


def _instead(label: int) -> str:
    """Returns in words what is expected instead of a label that has no name."""
    least, greatest = OWN_LABELS
    if least <= label <= greatest:
        return f"expected a name for it: labels: {{NAME: {label}}}"
    return f"expected one of {least} to {greatest} (prepare_crop --label), or one of ARDEE's"


def drawn_options(options: Values, ranges: Ranges, seed: int) -> Values:
    """Returns the options of a field: the fixed ones, and those drawn from ranges."""
    made = dict(options)
    for key, (low, high) in sorted(ranges.items()):
        rng = stream(seed, key)
        if isinstance(low, int) and isinstance(high, int):
            made[key] = int(rng.integers(low, high + 1))
        else:
            made[key] = round(float(rng.uniform(low, high)), 6)
    return made


@functools.lru_cache(maxsize=None)
def _ground(terrain: str) -> Ground:
    folders = search_path([Path(folder) for folder in packages.model_folders()])
    return ground_model(terrain, folders)


def check_field(values: Values, seed: int) -> None:
    """Raises GeneratorError for a field whose options do not fit together or its terrain, or that has no lane."""
    _, config = configure({**values, "name": FIELD})
    across = row_positions(config.plots)
    line = Line(config.shape, config.plots.length_m())
    line.check_offsets(float(across.min()), float(across.max()))
    _check_lanes(config)
    try:
        check_plan(config, seed, _ground(values.get("terrain") or TERRAIN))
    except GeneratorError as error:
        raise GeneratorError(f"options: {error}") from None


def _check_lanes(config: FieldConfig) -> None:
    plots, widths = config.plots, {}
    if plots.rows_per_plot > 1 or config.shape.cross_rows > 1:
        widths["row_spacing_m"] = plots.row_spacing_m
    if plots.plots_x > 1:
        widths["plot_spacing_x_m"] = plots.plot_spacing_x_m
    lane = f"a lane for cameras and robots between two rows less than {WIDEST_LANE_M} m apart"
    if not widths:
        raise GeneratorError(f"rows_per_plot: found {plots.rows_per_plot}, expected {lane}")
    if min(widths.values()) >= WIDEST_LANE_M:
        found = " and ".join(f"{key} {width}" for key, width in widths.items())
        raise GeneratorError(f"found {found}, expected {lane}")
    if plots.row_length_m == 0.0:
        raise GeneratorError("found rows of one plant, expected rows with a direction")
