# SPDX-License-Identifier: MIT
"""Makes terrain of a digital elevation model: ESRI ASCII grid (.asc) or GeoTIFF, holes refused or filled."""

import logging
import re
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Optional, Tuple

import numpy as np
import pyproj
import rasterio
from rasterio.errors import NotGeoreferencedWarning, RasterioError
from rasterio.fill import fillnodata
from scipy.ndimage import map_coordinates

from ardee_common.errors import GeneratorError
from ardee_models.terrain.grey_image import MAX_SIDE_PX
from ardee_models.terrain.height_map import Terrain
from ardee_models.terrain.image import Say, fitting_samples, level_at_origin, resample

_LARGEST_M = 9000.0  # ground beyond this height or depth points to a mistaken unit or NODATA value
_LARGEST_DEGREES = (
    0.5  # of a model in degrees: cells of a larger one differ by more than 1 % in width
)
_LARGEST_STRETCH = 0.01  # of a projection's lengths that is not corrected; UTM has 0.0004
_NUMBER = re.compile(r"[-+]?(nan|(\d+\.?\d*|\.\d+)(e[-+]?\d+)?)", re.IGNORECASE)
_WHOLE = re.compile(r"\d{1,9}")
_US_FOOT_M = 1200.0 / 3937.0
# length of a unit of heights [m], by GDAL's names of units and those of the command
UNITS_M = {"m": 1.0, "ft": 0.3048, "us-ft": _US_FOOT_M}
_NAMES = {
    **UNITS_M,
    **dict.fromkeys(("metre", "meter", "metres", "meters"), 1.0),
    **dict.fromkeys(("foot", "feet", "international foot"), 0.3048),
    **dict.fromkeys(("us survey foot", "us survey feet", "ussft", "foot_us"), _US_FOOT_M),
}
logging.getLogger("rasterio").addHandler(logging.NullHandler())  # its errors are raised, too


@dataclass(frozen=True)
class Elevation:
    """Heights [m] of cell centres, row 0 in the north, NaN where there is none; and the distances of centres."""

    heights_m: np.ndarray
    cell_x_m: float
    cell_y_m: float


def _check_words(path: Path) -> None:
    """Raises GeneratorError for a word of an ESRI ASCII grid that is no number, or for a wrong count of values.

    GDAL reads such a word as 0, and takes missing values for 0 too.
    """
    try:
        lines = path.read_text(encoding="ascii").splitlines()
    except (OSError, UnicodeDecodeError) as error:
        raise GeneratorError(f"{path}: cannot be read as text: {error}") from error
    sizes, values = {}, 0
    for number, line in enumerate(lines, 1):
        words, expected = line.split(), _NUMBER
        key = words[0].lower() if words and number <= 7 else ""
        if key[:1].isalpha() and key != "nan":  # a key of the header
            words = words[1:] or [""]
            if key in ("ncols", "nrows"):
                sizes[key], expected = words[0], _WHOLE
        else:
            values += len(words)
        if not all(map(expected.fullmatch, words)):
            raise GeneratorError(f"{path}:{number}: found {line.strip()[:60]!r}, expected numbers")
    columns, rows = (int(sizes.get(key, 0)) for key in ("ncols", "nrows"))
    if columns and rows and values != columns * rows:
        raise GeneratorError(
            f"{path}: found {values} values, expected {columns} x {rows} = {columns * rows}"
        )


def _ground_cells_m(data: rasterio.DatasetReader, path: Path, say: Say) -> Tuple[float, float]:
    """Distances of cell centres in metres, by the file's coordinate reference system."""
    cell_x, cell_y = data.res
    if data.crs is None:
        say(f"{path}: has no coordinate reference system, so its cells are taken for metres")
        return cell_x, cell_y
    is_geographic = data.crs.is_geographic
    if is_geographic and max(data.width * cell_x, data.height * cell_y) > _LARGEST_DEGREES:
        raise GeneratorError(
            f"{path}: found {data.width * cell_x:g} x {data.height * cell_y:g} degrees, expected at most"
            f" {_LARGEST_DEGREES:g}, or a projected coordinate reference system"
        )
    reference = pyproj.CRS.from_user_input(data.crs)
    unit_m = 1.0 if is_geographic else data.crs.linear_units_factor[1]
    if reference.geodetic_crs is None:  # of a building site, say
        return cell_x * unit_m, cell_y * unit_m
    x, y = data.xy(0.5 * (data.height - 1), 0.5 * (data.width - 1))
    degrees = pyproj.Transformer.from_crs(reference, reference.geodetic_crs, always_xy=True)
    west_south = degrees.transform([x - 0.5 * cell_x, x], [y, y - 0.5 * cell_y])
    east_north = degrees.transform([x + 0.5 * cell_x, x], [y, y + 0.5 * cell_y])
    x_m, y_m = reference.get_geod().inv(*west_south, *east_north)[2]
    if is_geographic:
        say(f"{path}: is in degrees; its cells are {x_m:.6g} x {y_m:.6g} m at its middle")
        return x_m, y_m
    scale = x_m / (cell_x * unit_m)
    if abs(scale - 1.0) <= _LARGEST_STRETCH:
        return cell_x * unit_m, cell_y * unit_m
    say(
        f"{path}: its coordinates are stretched; its cells are {x_m:.6g} x {y_m:.6g} m at its middle,"
        f" {scale:.4g} times what they say"
    )
    return x_m, y_m


def _height_unit_m(data: rasterio.DatasetReader, path: Path, given: Optional[str]) -> float:
    """Length of the unit of heights: as given, as the band says or the vertical reference, else metres."""
    if given is not None:
        return UNITS_M[given]
    name = (data.units[0] or "").strip()
    if name:
        if name.lower() not in _NAMES:
            raise GeneratorError(
                f"{path}: found heights in {name!r}, expected metres or feet; --dem-unit says their unit"
            )
        return _NAMES[name.lower()]
    axes = pyproj.CRS.from_user_input(data.crs).axis_info if data.crs else []
    if len(axes) == 3:
        return float(axes[2].unit_conversion_factor)
    if axes and data.crs.is_projected and data.crs.linear_units_factor[1] != 1.0:
        raise GeneratorError(
            f"{path}: found cells in {axes[0].unit_name} and heights without a unit,"
            f" expected --dem-unit {', '.join(UNITS_M)}"
        )
    return 1.0


def _read(data: rasterio.DatasetReader, path: Path, unit: Optional[str], say: Say) -> Elevation:
    if data.count != 1 or max(data.shape) > MAX_SIDE_PX or min(data.shape) < 2:
        raise GeneratorError(
            f"{path}: found {data.width} x {data.height} cells of {data.count} bands,"
            f" expected one band of 2 to {MAX_SIDE_PX} a side"
        )
    across = data.transform
    if across.is_identity or across.b or across.d or across.a <= 0.0:
        raise GeneratorError(
            f"{path}: found the transform {tuple(across)[:6]}, expected columns to the east and rows to"
            " the north or south"
        )
    cell_x_m, cell_y_m = _ground_cells_m(data, path, say)
    unit_m = _height_unit_m(data, path, unit)
    heights = data.read(1, masked=True).astype(float).filled(np.nan)
    heights = (heights * data.scales[0] + data.offsets[0]) * unit_m
    return Elevation(heights if across.e < 0.0 else heights[::-1], cell_x_m, cell_y_m)


def read_elevation(path: Path, unit: Optional[str], say: Say) -> Elevation:
    """Reads an ESRI ASCII grid or a GeoTIFF of one band; `unit` is that of heights, if the file is not to say it."""
    is_text = path.suffix.lower() in (".asc", ".txt", ".agr")
    if not path.is_file():
        raise GeneratorError(f"{path}: cannot be read: no such file")
    if is_text:
        _check_words(path)
    # The numbers of a grid without a point are floats too, as NaN is none of the integers
    kind = {"driver": "AAIGrid", "DATATYPE": "Float64"} if is_text else {"driver": "GTiff"}
    try:
        with rasterio.Env(), warnings.catch_warnings():
            warnings.simplefilter("ignore", NotGeoreferencedWarning)
            with rasterio.open(path.resolve(), **kind) as data:
                return _read(data, path, unit, say)
    except (RasterioError, OSError, pyproj.exceptions.CRSError, ValueError) as error:
        raise GeneratorError(f"{path}: not a readable elevation model: {error}") from error


def _middle_square(elevation: Elevation) -> Elevation:
    """The largest square (in metres) about the middle, on square cells."""
    heights, cell = elevation.heights_m, min(elevation.cell_x_m, elevation.cell_y_m)
    rows, columns = heights.shape
    side = min((columns - 1) * elevation.cell_x_m, (rows - 1) * elevation.cell_y_m)
    count = int(round(side / cell)) + 1
    if count < 2:
        raise GeneratorError(
            f"elevation model: found {columns} x {rows} cells, expected at least 2 x 2"
        )
    if elevation.cell_x_m == elevation.cell_y_m:
        top, left = (rows - count) // 2, (columns - count) // 2
        return Elevation(heights[top : top + count, left : left + count], cell, cell)
    at = np.linspace(-0.5, 0.5, count) * side
    place = np.meshgrid(
        0.5 * (rows - 1) + at / elevation.cell_y_m,
        0.5 * (columns - 1) + at / elevation.cell_x_m,
        indexing="ij",
    )
    step = side / (count - 1)
    return Elevation(map_coordinates(heights, place, order=1, mode="nearest"), step, step)


def dem_terrain(
    path: Path, samples: Optional[int], fill: bool, unit: Optional[str], say: Say
) -> Terrain:
    """The middle square of an elevation model, the ground at its middle being zero."""
    raw = read_elevation(path, unit, say)
    heights = np.where(np.isfinite(raw.heights_m), raw.heights_m, np.nan)
    holes = np.isnan(heights)
    if holes.all():
        raise GeneratorError(f"{path}: found no height at all")
    if holes.any():
        row, column = (int(v) for v in np.argwhere(holes)[0])
        text = f"{holes.sum()} holes of {holes.size} cells, the first in row {row + 1}, column {column + 1}"
        if not fill:
            raise GeneratorError(f"{path}: found {text}, expected none; --fill-holes fills them")
        say(f"{path}: filled {text}")
        heights = fillnodata(np.where(holes, 0.0, heights), ~holes, float(max(holes.shape)))
    if np.abs(heights).max() > _LARGEST_M:
        worst = heights.ravel()[np.abs(heights).argmax()]
        raise GeneratorError(
            f"{path}: found a height of {worst:g} m, expected at most {_LARGEST_M:g} m"
        )
    if not (0.0 < raw.cell_x_m < 1e5 and 0.0 < raw.cell_y_m < 1e5):
        raise GeneratorError(f"{path}: found cells of {raw.cell_x_m} x {raw.cell_y_m} m")
    square = _middle_square(Elevation(heights, raw.cell_x_m, raw.cell_y_m))
    side = len(square.heights_m)
    resampled = resample(square.heights_m, fitting_samples(side, samples))
    return level_at_origin(resampled, (side - 1) * square.cell_x_m)
