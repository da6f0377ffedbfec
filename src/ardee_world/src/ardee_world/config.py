# SPDX-License-Identifier: MIT
"""What a field shall be: the arguments of the thesis's field generator (Figure 4.4), checked."""

import math
from dataclasses import dataclass
from typing import Optional, Tuple

import numpy as np

from ardee_models.errors import GeneratorError

MAX_PLANTS = 5_000_000


@dataclass(frozen=True)
class Plots:
    """Where plants are planned. Rows run along y, plots are counted along x and y."""

    rows_per_plot: int = 4
    plots_x: int = 1
    plots_y: int = 1
    row_length_m: float = 8.134  # 50 plants
    row_spacing_m: float = 0.762  # 30 inches, usual for corn
    stalk_spacing_m: float = 0.166  # 32,000 plants an acre in 30 inch rows (OSU's optimum)
    plot_spacing_x_m: float = 1.524  # between the outer rows of neighbouring plots
    plot_spacing_y_m: float = 1.5
    headland_m: float = 1.0  # from the field's origin to the first plant

    def stalks_per_row(self) -> int:
        """First stalk at the start of the row, last at or before its end."""
        return int(math.floor(self.row_length_m / self.stalk_spacing_m + 1e-6)) + 1

    def planned_count(self) -> int:
        """Stalks planned in the whole field."""
        return self.rows_per_plot * self.plots_x * self.plots_y * self.stalks_per_row()


@dataclass(frozen=True)
class FieldConfig:
    """A field: plan, randomness, position. Covariance is (xx, xy, yy) in m^2, x across the rows."""

    plots: Plots = Plots()
    # Along the row: half the variance of spacing, whose best achievable SD is 5 cm (Nielsen, Purdue); across: estimate.
    noise_covariance_m2: Tuple[float, float, float] = (0.015**2, 0.0, 0.05**2 / 2)
    emergence_min: float = 0.90  # 90-95 % is an average stand (Hermans)
    emergence_max: float = 0.98
    stalk_height_min_m: Optional[float] = None  # none: the models' own heights
    stalk_height_max_m: Optional[float] = None
    origin_latitude_deg: Optional[float] = None
    origin_longitude_deg: Optional[float] = None
    world_pose: Tuple[float, float, float] = (
        0.0,
        0.0,
        -1.57,
    )  # x m, y m, yaw rad: where a world includes the field

    def covariance(self) -> np.ndarray:
        """Placement noise as a 2x2 matrix."""
        xx, xy, yy = self.noise_covariance_m2
        return np.array([[xx, xy], [xy, yy]])

    def validate(self) -> None:
        """Raise GeneratorError for the first value out of range."""
        for good, what, found, expected in [*_plot_checks(self.plots), *_field_checks(self)]:
            if not good:
                raise GeneratorError(f"{what}: found {found}, expected {expected}")


def _inside(low: float, value: float, high: float) -> bool:
    return math.isfinite(value) and low <= value <= high


def _plot_checks(plots: Plots) -> list:
    checks = []
    for name in ("rows_per_plot", "plots_x", "plots_y"):
        value = getattr(plots, name)
        checks.append(
            (_inside(1, value, 100_000), name.replace("_", " "), value, "a whole number from 1")
        )
    for name, low in (("row_length_m", 0.0), ("row_spacing_m", 0.01), ("stalk_spacing_m", 0.01)):
        value = getattr(plots, name)
        checks.append(
            (_inside(low, value, 1e5), name[:-2].replace("_", " "), value, f"{low:g} to 100000 m")
        )
    for name in ("plot_spacing_x_m", "plot_spacing_y_m", "headland_m"):
        value = getattr(plots, name)
        checks.append((_inside(0, value, 1e5), name[:-2].replace("_", " "), value, "0 to 100000 m"))
    if all(check[0] for check in checks):
        count = plots.planned_count()
        checks.append((count <= MAX_PLANTS, "planned plants", count, f"at most {MAX_PLANTS}"))
    return checks


def _field_checks(config: FieldConfig) -> list:
    xx, xy, yy = config.noise_covariance_m2
    finite = all(math.isfinite(v) for v in (xx, xy, yy))
    none_at_all = (xx, xy, yy) == (0.0, 0.0, 0.0)
    definite = finite and xx > 0 and yy > 0 and xx * yy > xy * xy
    low, high = config.emergence_min, config.emergence_max
    short, tall = config.stalk_height_min_m, config.stalk_height_max_m
    both = (short is None) == (tall is None)
    latitude, longitude = config.origin_latitude_deg, config.origin_longitude_deg
    return [
        (
            definite or none_at_all,
            "noise covariance",
            f"[[{xx}, {xy}], [{xy}, {yy}]]",
            "a positive definite matrix in m^2, or all zeros for no noise",
        ),
        (
            _inside(0, low, 1) and _inside(0, high, 1),
            "emergence",
            f"{low} to {high}",
            "probabilities from 0 to 1",
        ),
        (low <= high, "emergence", f"minimum {low} above maximum {high}", "minimum <= maximum"),
        (both, "stalk height", f"{short} to {tall}", "both a minimum and a maximum, or neither"),
        (
            not both or short is None or (0.01 <= short <= tall <= 20.0),
            "stalk height",
            f"{short} to {tall} m",
            "0.01 m <= minimum <= maximum <= 20 m",
        ),
        (
            (latitude is None) == (longitude is None),
            "GPS origin",
            f"{latitude}, {longitude}",
            "both or neither",
        ),
        (
            latitude is None or _inside(-89.9, latitude, 89.9),
            "latitude",
            latitude,
            "-89.9 to 89.9 degrees",
        ),
        (
            longitude is None or _inside(-180, longitude, 180),
            "longitude",
            longitude,
            "-180 to 180 degrees",
        ),
        (
            all(map(math.isfinite, config.world_pose)),
            "world pose",
            config.world_pose,
            "finite numbers",
        ),
    ]
