# SPDX-License-Identifier: MIT
"""The configuration of a field: the arguments of the thesis's field generator (Figure 4.4) and more, checked."""

import math
from dataclasses import dataclass, fields, is_dataclass
from typing import Optional, Tuple

import numpy as np

from ardee_common.errors import GeneratorError
from ardee_common.options import check, option

MAX_PLANTS = 5_000_000
FAR_M = 1e5
_LENGTH = (0.0, FAR_M)
_PROBABILITY = (0.0, 1.0)
_COUNT = (1, 100_000)


@dataclass(frozen=True)
class Plots:
    """The plan of a field. Rows run along the row direction; plots are counted along x (across) and y (along)."""

    rows_per_plot: int = option(4, "rows per plot", _COUNT)
    plots_x: int = option(1, "number of plots side by side", _COUNT)
    plots_y: int = option(1, "number of plots one behind the other", _COUNT)
    row_length_m: float = option(8.134, "length of rows (50 plants)", _LENGTH)
    # 30 inches, usual for corn
    row_spacing_m: float = option(0.762, "distance between rows", (0.01, FAR_M))
    # 32,000 plants an acre in 30 inch rows (OSU's optimum)
    stalk_spacing_m: float = option(0.166, "distance between stalks in a row", (0.01, FAR_M))
    plot_spacing_x_m: float = option(
        1.524, "distance between the outer rows of plots side by side", _LENGTH
    )
    plot_spacing_y_m: float = option(
        1.5, "distance between the ends of plots one behind the other", _LENGTH
    )
    headland_m: float = option(1.0, "distance from the field's origin to the first stalks", _LENGTH)

    def stalks_per_row(self) -> int:
        """Number of stalks in a row: the first at its start, the last at or before its end."""
        return int(math.floor(self.row_length_m / self.stalk_spacing_m + 1e-6)) + 1

    def planned_count(self) -> int:
        """Stalks planned in the whole field, if its rows are straight."""
        return self.rows_per_plot * self.plots_x * self.plots_y * self.stalks_per_row()

    def length_m(self) -> float:
        """Distance from the field's origin to the end of the last plot, along the rows."""
        between = (self.plots_y - 1) * self.plot_spacing_y_m
        return self.headland_m + self.plots_y * self.row_length_m + between


@dataclass(frozen=True)
class RowShape:
    """The line that rows follow, their direction, and rows across the ends of the field."""

    row_shape: str = option(
        "straight",
        "line that the rows follow",
        choices=("straight", "curved", "sine", "expression"),
    )
    row_direction_deg: float = option(
        -90.0, "direction in which rows run, from the field's x axis", (-360.0, 360.0)
    )
    curve_radius_m: float = option(
        50.0, "radius of curved rows, positive to the left", (-FAR_M, FAR_M)
    )
    sine_amplitude_m: float = option(0.3, "amplitude of sine rows", _LENGTH)
    sine_wavelength_m: float = option(10.0, "wavelength of sine rows", (0.1, FAR_M))
    row_expression: Optional[str] = option(
        None, "y(x) [m] of rows of shape expression: x along, y to the left; e.g. '0.2*sin(x/2)'"
    )
    island_radius_m: float = option(
        0.0, "radius of a round spot that the rows bend around, 0 for none", _LENGTH
    )
    island_distance_m: float = option(
        5.0, "distance of the spot from the field's origin, along the rows", _LENGTH
    )
    island_offset_m: float = option(
        0.0, "offset of the spot to the left of the middle lane", (-FAR_M, FAR_M)
    )
    cross_rows: int = option(0, "number of rows across each headland", (0, 1000))
    cross_rows_at: str = option(
        "both", "headlands that have cross rows", choices=("both", "start", "end")
    )
    cross_row_clearance_m: float = option(
        3.0, "distance from the rows' ends to the first cross row", _LENGTH
    )


@dataclass(frozen=True)
class Stand:
    """Gaps and doubles in the rows, plants of different size, and plants that lean."""

    gaps: int = option(0, "number of gaps in the rows of the field", (0, MAX_PLANTS))
    gap_length_m: float = option(1.0, "length of each gap, in whole plants", (0.01, FAR_M))
    doubles: float = option(0.0, "probability that two plants stand at a place", _PROBABILITY)
    double_spacing_m: float = option(
        0.03, "distance between the plants of a double, along the row", (0.0, 10.0)
    )
    size_cv: float = option(
        0.0, "coefficient of variation of the plants' size about their model's", (0.0, 0.3)
    )
    late_emergence: float = option(
        0.0, "probability that a plant emerged late and stays small", _PROBABILITY
    )
    late_size: float = option(
        0.6, "least size of a late plant over its model's; the largest is 1", (0.1, 1.0)
    )
    lodging: float = option(0.0, "probability that a plant leans", _PROBABILITY)
    lodging_angle_min_deg: float = option(20.0, "least tilt from the vertical", (0.0, 85.0))
    lodging_angle_max_deg: float = option(70.0, "largest tilt from the vertical", (0.0, 85.0))
    lodging_direction_deg: Optional[float] = option(
        None,
        "direction in which plants lean, from the field's x axis; random if not given",
        (-360.0, 360.0),
    )
    lodging_direction_sd_deg: float = option(
        15.0, "standard deviation of the direction in which plants lean", (0.0, 180.0)
    )


@dataclass(frozen=True)
class Clutter:
    """Weeds, stones and litter of the field. An image multiplies the density: by 0 where black, by 1 where white."""

    weed_density_per_m2: float = option(0.0, "density of weeds", (0.0, 10_000.0))
    weed_models: Tuple[str, ...] = option(
        ("weed_rosette", "weed_broadleaf", "weed_grass"), "pool of weed models"
    )
    weed_image: Optional[str] = option(None, "grey image over the field's bounds: density of weeds")
    edge_weed_density_per_m2: float = option(
        0.0, "density of further weeds in the margin beside the outer rows", (0.0, 10_000.0)
    )
    stone_density_per_m2: float = option(0.0, "density of stones", (0.0, 10_000.0))
    stone_models: Tuple[str, ...] = option(
        ("stone_round", "stone_flat", "stone_sharp"), "pool of stone models"
    )
    stone_image: Optional[str] = option(None, "grey image: density of stones")
    litter_density_per_m2: float = option(
        0.0, "density of litter: dead leaves and stalks", (0.0, 10_000.0)
    )
    litter_models: Tuple[str, ...] = option(
        ("litter_leaf", "litter_stalk"), "pool of litter models"
    )
    litter_image: Optional[str] = option(None, "grey image: density of litter")
    clutter_margin_m: float = option(
        0.5, "width of the margin of weeds, stones and litter beyond the outer plants", _LENGTH
    )


@dataclass(frozen=True)
class FieldConfig:
    """A field: plan, randomness, position. Covariance is (xx, xy, yy) in m^2, x across the rows."""

    plots: Plots = Plots()
    shape: RowShape = RowShape()
    stand: Stand = Stand()
    clutter: Clutter = Clutter()
    # Along the row: half the variance of spacing, whose best achievable SD is 5 cm (Nielsen, Purdue); across: estimate.
    noise_covariance_m2: Tuple[float, float, float] = option(
        (0.015**2, 0.0, 0.05**2 / 2), "placement noise: XX YY, or XX XY YY; x across the rows"
    )
    # 90-95 % is an average stand (Hermans)
    emergence_min: float = option(0.90, "lowest probability that a plant emerges", _PROBABILITY)
    emergence_max: float = option(0.98, "highest probability that a plant emerges", _PROBABILITY)
    stalk_height_min_m: Optional[float] = option(
        None, "lowest plant height; the models' own if not given", (0.01, 20.0)
    )
    stalk_height_max_m: Optional[float] = option(
        None, "highest plant height; the models' own if not given", (0.01, 20.0)
    )
    origin_latitude_deg: Optional[float] = option(None, "", (-89.9, 89.9))
    origin_longitude_deg: Optional[float] = option(None, "", (-180.0, 180.0))
    # x m, y m, yaw rad
    world_pose: Tuple[float, float, float] = option(
        (0.0, 0.0, -1.57), "pose of the field in the world, X Y YAW [m m rad]", (-FAR_M, FAR_M)
    )

    def covariance(self) -> np.ndarray:
        """Placement noise as a 2x2 matrix."""
        xx, xy, yy = self.noise_covariance_m2
        return np.array([[xx, xy], [xy, yy]])

    def validate(self) -> None:
        """Raises GeneratorError for the first value out of range."""
        for group in GROUPS:
            check(getattr(self, group))
        check(self)
        for good, what, found, expected in _joint_checks(self):
            if not good:
                raise GeneratorError(f"{what}: found {found}, expected {expected}")


GROUPS = tuple(f.name for f in fields(FieldConfig) if is_dataclass(f.default))


def _ordered(low: Optional[float], high: Optional[float], what: str, unit: str) -> tuple:
    good = low is None or high is None or low <= high
    return good, what, f"minimum {low} above maximum {high}{unit}", "minimum <= maximum"


def _shape_checks(shape: RowShape) -> list:
    given = shape.row_expression is not None
    return [
        (
            shape.row_shape != "curved" or shape.curve_radius_m != 0.0,
            "curve radius",
            shape.curve_radius_m,
            "a number other than zero",
        ),
        (
            given == (shape.row_shape == "expression"),
            "row expression",
            repr(shape.row_expression),
            f"{'one' if shape.row_shape == 'expression' else 'none'} for row shape {shape.row_shape}",
        ),
    ]


def _joint_checks(config: FieldConfig) -> list:
    xx, xy, yy = config.noise_covariance_m2
    none_at_all = (xx, xy, yy) == (0.0, 0.0, 0.0)
    definite = xx > 0 and yy > 0 and xx * yy * (1 - 1e-9) > xy * xy
    short, tall = config.stalk_height_min_m, config.stalk_height_max_m
    latitude, longitude = config.origin_latitude_deg, config.origin_longitude_deg
    stand, count = config.stand, config.plots.planned_count()
    return [
        (count <= MAX_PLANTS, "planned plants", count, f"at most {MAX_PLANTS}"),
        *_shape_checks(config.shape),
        (
            definite or none_at_all,
            "noise covariance",
            f"[[{xx}, {xy}], [{xy}, {yy}]]",
            "a positive definite matrix in m^2, or all zeros for no noise",
        ),
        _ordered(config.emergence_min, config.emergence_max, "emergence", ""),
        (
            (short is None) == (tall is None),
            "stalk height",
            f"{short} to {tall}",
            "both a minimum and a maximum, or neither",
        ),
        _ordered(short, tall, "stalk height", " m"),
        _ordered(stand.lodging_angle_min_deg, stand.lodging_angle_max_deg, "lodging angle", " deg"),
        (
            (latitude is None) == (longitude is None),
            "GPS origin",
            f"{latitude}, {longitude}",
            "both or neither",
        ),
    ]
