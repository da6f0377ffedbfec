# SPDX-License-Identifier: MIT
"""A request to the field generator: a field's options and where its models are, from arguments and a YAML file."""

import dataclasses
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Dict, List, Optional, Tuple

from ardee_common.config import Mapping, read_yaml_lines, unknown_key, value_of
from ardee_common.errors import GeneratorError
from ardee_common.options import kind_of, option, scalar_fields, spoken
from ardee_models.lookup import DEFAULT_OUTPUT
from ardee_world.field_config import GROUPS, FieldConfig, RowShape

# number of plants and clutter items above which a field is by default written as a stream
LARGEST_SDF = 20_000
_WHOLE = (0, 2**63)
Values = Dict[str, Any]
# options that centres replace; spacings and direction of rows remain, for plots.xacro and the start pose
_OF_A_PLAN = (
    "rows_per_plot",
    "plots_y",
    "row_length_m",
    "stalks_per_row",
    "plot_spacing_x_m",
    "plot_spacing_y_m",
    "headland_m",
    *(f.name for f in scalar_fields(RowShape) if f.name != "row_direction_deg"),
)
# option that does nothing unless another one is given, to that one
_PARTNERS = {
    "curve_radius_m": "row_shape",
    "sine_amplitude_m": "row_shape",
    "sine_wavelength_m": "row_shape",
    "island_distance_m": "island_radius_m",
    "island_offset_m": "island_radius_m",
    "cross_rows_at": "cross_rows",
    "cross_row_clearance_m": "cross_rows",
    "gap_length_m": "gaps",
    "double_spacing_m": "doubles",
    "late_size": "late_emergence",
    "lodging_angle_min_deg": "lodging",
    "lodging_angle_max_deg": "lodging",
    "lodging_direction_deg": "lodging",
    "lodging_direction_sd_deg": "lodging",
    "weed_image": "weed_density_per_m2",
    "stone_image": "stone_density_per_m2",
    "litter_image": "litter_density_per_m2",
}


@dataclass(frozen=True)
class Sources:
    """Names and folders; in a YAML file paths are relative to the file."""

    models: Tuple[str, ...] = option((), "pool of crop models to draw from")
    name: Optional[str] = option(None, "name of the field's model")
    output: Optional[str] = option(
        None, f"folder of models to write it in (default: {DEFAULT_OUTPUT})"
    )
    model_path: Tuple[str, ...] = option((), "folders of models, searched before GAZEBO_MODEL_PATH")
    terrain: Optional[str] = option(
        None, "terrain model at the world's origin that the field stands on (default: level ground)"
    )
    centers: Any = option(None, "CSV file of your own stalk centres x_m,y_m, instead of a plan")
    format: str = option(
        "auto",
        "model.sdf with an include a plant, or a table plants.csv that only this simulator reads, as a stream;"
        f" auto: stream above {LARGEST_SDF} plants",
        choices=("auto", "sdf", "stream"),
    )
    seed: int = option(0, "root of all random numbers", _WHOLE)


_PATHS = ("output", "centers", "weed_image", "stone_image", "litter_image")


@dataclass(frozen=True)
class _Aliases:
    """Options whose form in the request differs from their form in the configuration."""

    noise_covariance_m2: Tuple[float, ...] = ()
    stalks_per_row: Optional[int] = option(
        None, "number of stalks in a row, instead of the row length", (1, 1_000_000)
    )
    gps_origin_deg: Optional[Tuple[float, float]] = option(
        None, "latitude and longitude of the world's origin", (-180.0, 180.0)
    )


def groups() -> Dict[str, type]:
    """Name to class of the groups of options, the field's own last."""
    named = {name: type(getattr(FieldConfig(), name)) for name in GROUPS}
    return {"sources": Sources, **named, "field": FieldConfig, "aliases": _Aliases}


def all_fields() -> Dict[str, Tuple[type, dataclasses.Field]]:
    """Key to the class and field that an option fills."""
    return {f.name: (cls, f) for cls in groups().values() for f in scalar_fields(cls)}


def _relative(value: str, folder: Path) -> str:
    return str(folder / Path(value).expanduser())


def yaml_values(path: Path) -> Values:
    """Reads the options of a YAML file, by key."""
    known, mapping = all_fields(), read_yaml_lines(path)
    values: Values = {}
    for key, raw in mapping.items():
        if key not in known:
            raise unknown_key(mapping, key, sorted(known))
        if key == "centers" and not isinstance(raw, str):
            values[key] = raw
        else:
            values[key] = _from_yaml(known, mapping, key)
    if "row_length_m" in values and "stalks_per_row" in values:
        raise mapping.error("stalks_per_row", "found row_length_m too, expected one of them")
    return placed_values(values, path.parent)


def placed_values(values: Values, folder: Path) -> Values:
    """Returns options whose relative paths lie in a folder."""
    made = dict(values)
    for key in _PATHS:
        if isinstance(made.get(key), str):
            made[key] = _relative(made[key], folder)
    if "model_path" in made:
        made["model_path"] = tuple(_relative(name, folder) for name in made["model_path"])
    return made


def read_paths(values: Values) -> List[Path]:
    """Returns the files and the folders of models that options name."""
    names = [values.get(key) for key in _PATHS if key != "output"]
    names += values.get("model_path", ())
    return [Path(name) for name in names if isinstance(name, str)]


def checked_values(options: Values) -> Values:
    """Returns options that stand in no file, each checked as one of a YAML file."""
    known, mapping = all_fields(), Mapping("")
    mapping.update(options)
    return {key: _from_yaml(known, mapping, key) for key in mapping}


def _from_yaml(known: dict, mapping: Mapping, key: str) -> Any:
    cls, field = known[key]
    if kind_of(cls, field) is Any:
        return mapping[key]
    return value_of(cls, field, mapping, key)


def _covariance(values: Tuple[float, ...]) -> Tuple[float, float, float]:
    if len(values) == 2:
        return float(values[0]), 0.0, float(values[1])
    if len(values) != 3:
        raise GeneratorError(
            f"noise covariance: found {len(values)} numbers, expected XX YY or XX XY YY"
        )
    return tuple(map(float, values))


def _resolve_aliases(values: Values) -> Values:
    made = dict(values)
    if "noise_covariance_m2" in made:
        made["noise_covariance_m2"] = _covariance(made["noise_covariance_m2"])
    stalks = made.pop("stalks_per_row", None)
    if stalks is not None:
        if stalks < 1:
            raise GeneratorError(
                f"stalks per row: found {stalks}, expected a whole number, at least 1"
            )
        plots = type(FieldConfig().plots)
        spacing = made.get("stalk_spacing_m", plots().stalk_spacing_m)
        made["row_length_m"] = round((stalks - 1) * spacing, 9)
    origin = made.pop("gps_origin_deg", None)
    if origin is not None:
        made["origin_latitude_deg"], made["origin_longitude_deg"] = origin
    return made


def check_partners(values: Values) -> None:
    """Raises GeneratorError for an option that does nothing without another one, which is not given."""
    for key, partner in _PARTNERS.items():
        if values.get(key) is not None and values.get(partner) is None:
            found = f"found {values[key]}, expected {spoken(partner)} too"
            raise GeneratorError(f"{spoken(key)}: {found}")


def _check_centers(values: Values) -> None:
    """Raises GeneratorError for an option of a plan beside centres, which replace the plan."""
    for key in _OF_A_PLAN:
        if values.get("centers") is not None and values.get(key) is not None:
            found = f"found {values[key]}, expected none with centers"
            raise GeneratorError(f"{spoken(key)}: {found}")


def with_changes(values: Values, changes: Values) -> Values:
    """Returns options with changes, which win: of a row's length, too, over a number of stalks."""
    made = {**values, **changes}
    if changes.get("row_length_m") is not None:
        made.pop("stalks_per_row", None)
    return made


def configure(values: Values) -> Tuple[Sources, FieldConfig]:
    """Checks options by key; returns the generator's inputs."""
    given, values = values, _resolve_aliases(values)
    made = {}
    for group, cls in groups().items():
        if group in ("field", "aliases"):
            continue
        names = {f.name for f in scalar_fields(cls)}
        made[group] = cls(**{k: v for k, v in values.items() if k in names})
    sources = made.pop("sources")
    own = {f.name for f in scalar_fields(FieldConfig)}
    config = FieldConfig(**made, **{k: v for k, v in values.items() if k in own})
    config.validate()
    _check_centers(given)
    if sources.output == "":
        raise GeneratorError("output: found '', expected the name of a folder")
    for key in ("name", "models"):
        if not getattr(sources, key):
            raise GeneratorError(
                f"{key}: found none, expected --{key} or the key {key} of a YAML file"
            )
    return sources, config
