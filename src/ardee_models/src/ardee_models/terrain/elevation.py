# SPDX-License-Identifier: MIT
"""Makes terrain of a digital elevation model: ESRI ASCII grid (.asc) or GeoTIFF, holes refused or filled."""

from dataclasses import dataclass
from pathlib import Path
from typing import Dict, Optional

import numpy as np
from PIL import Image
from scipy.interpolate import LinearNDInterpolator, NearestNDInterpolator
from scipy.ndimage import binary_dilation

from ardee_common.errors import GeneratorError
from ardee_models.terrain.grey_image import MAX_SIDE_PX, open_image
from ardee_models.terrain.height_map import Terrain
from ardee_models.terrain.image import Say, fitting_samples, level_at_origin, resample

_LARGEST_M = 9000.0  # ground beyond this height or depth points to a mistaken unit or NODATA value
_HEADER = ("ncols", "nrows", "cellsize")
_PIXEL_SCALE, _NODATA, _GEO_KEYS = 33550, 42113, 34735  # GeoTIFF 1.1, tags; GDAL's NODATA tag
_MODEL_TYPE_KEY, _GEOGRAPHIC = 1024, 2
_METRES_A_DEGREE = 111_320.0  # degree of latitude, or of longitude at the equator


@dataclass(frozen=True)
class Elevation:
    """Heights [m] of cell centres, row 0 in the north, NaN where there is none; and the distances of centres."""

    heights_m: np.ndarray
    cell_x_m: float
    cell_y_m: float


def _read_asc_header(lines: list, path: Path) -> Dict[str, float]:
    header: Dict[str, float] = {}
    for number, line in enumerate(lines[:6], 1):
        words = line.split()
        if not words or not words[0][0].isalpha():
            break
        try:
            key, value = words
            header[key.lower()] = float(value)
        except ValueError as error:
            raise GeneratorError(
                f"{path}:{number}: found {line.strip()!r}, expected a key and a number"
            ) from error
    missing = [key for key in _HEADER if key not in header]
    if missing:
        raise GeneratorError(
            f"{path}: found no {missing[0]!r} in the header, expected an ESRI ASCII grid"
        )
    return header


def read_asc(path: Path) -> Elevation:
    """Reads an ESRI ASCII grid."""
    try:
        lines = path.read_text(encoding="ascii").splitlines()
    except OSError as error:
        raise GeneratorError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise GeneratorError(f"{path}: cannot be read as text: {error}") from error
    header = _read_asc_header(lines, path)
    columns, rows, cell = int(header["ncols"]), int(header["nrows"]), header["cellsize"]
    if not (2 <= columns <= MAX_SIDE_PX and 2 <= rows <= MAX_SIDE_PX and 0.0 < cell < 1e5):
        raise GeneratorError(
            f"{path}: found {columns} x {rows} cells of {cell}, expected 2 to {MAX_SIDE_PX} a side"
        )
    body = lines[len(header) :]
    if len(body) < rows:
        raise GeneratorError(f"{path}: found {len(body)} rows, expected {rows}")
    heights = np.empty((rows, columns))
    for row in range(rows):
        try:
            values = np.array(body[row].split(), dtype=float)
        except ValueError:
            values = np.empty(0)
        if len(values) != columns:
            raise GeneratorError(
                f"{path}:{len(header) + row + 1}: expected {columns} numbers, found {body[row][:60]!r}"
            )
        heights[row] = values
    heights[heights == header.get("nodata_value", -9999.0)] = np.nan
    return Elevation(heights, cell, cell)


def _is_geographic(keys: tuple) -> bool:
    entries = [keys[i : i + 4] for i in range(4, len(keys) - 3, 4)]
    return any(key == _MODEL_TYPE_KEY and value == _GEOGRAPHIC for key, _, _, value in entries)


def _geotiff(image: Image.Image, path: Path) -> Elevation:
    tags = getattr(image, "tag_v2", None)
    if tags is None or _PIXEL_SCALE not in tags:
        raise GeneratorError(
            f"{path}: found no pixel scale (tag {_PIXEL_SCALE}), expected a GeoTIFF"
        )
    if len(image.getbands()) != 1 or max(image.size) > MAX_SIDE_PX or min(image.size) < 2:
        raise GeneratorError(
            f"{path}: found {image.width} x {image.height} pixels of {len(image.getbands())} bands, expected one band"
        )
    heights = np.array(image).astype(float)
    try:
        nodata = float(str(tags.get(_NODATA, "nan")).strip("\0 "))
        scale = [float(v) for v in tags[_PIXEL_SCALE][:2]]
    except (ValueError, TypeError) as error:
        raise GeneratorError(
            f"{path}: found a NODATA value or pixel scale that is not a number"
        ) from error
    heights[heights == nodata] = np.nan
    if _is_geographic(tuple(tags.get(_GEO_KEYS, ()))):
        tie = tags.get(33922, (0, 0, 0, 0, 0, 0))
        latitude = np.radians(float(tie[4]) - 0.5 * scale[1] * image.height)
        scale = [scale[0] * _METRES_A_DEGREE * float(np.cos(latitude)), scale[1] * _METRES_A_DEGREE]
    return Elevation(heights, scale[0], scale[1])


def read_geotiff(path: Path) -> Elevation:
    """Reads a GeoTIFF of one band; degrees become metres at the middle latitude."""
    with open_image(path, "GeoTIFF") as image:
        return _geotiff(image, path)


def fill_holes(heights_m: np.ndarray) -> np.ndarray:
    """Fills holes linearly from their rims, and at the edge of the model by the nearest height."""
    holes = np.isnan(heights_m)
    if not holes.any():
        return heights_m
    rim = binary_dilation(holes, np.ones((3, 3))) & ~holes
    known, wanted = np.argwhere(rim), np.argwhere(holes)
    filled = heights_m.copy()
    values = np.full(len(wanted), np.nan)
    if len(known) >= 4 and np.ptp(known, axis=0).min() > 0:
        values = LinearNDInterpolator(known, heights_m[rim])(wanted)
    left = np.isnan(values)
    if left.any():
        values[left] = NearestNDInterpolator(known, heights_m[rim])(wanted[left])
    filled[holes] = values
    return filled


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
    row = np.clip(0.5 * (rows - 1) + at / elevation.cell_y_m, 0, rows - 1)
    column = np.clip(0.5 * (columns - 1) + at / elevation.cell_x_m, 0, columns - 1)
    r, c = np.minimum(row.astype(int), rows - 2), np.minimum(column.astype(int), columns - 2)
    fr, fc = (row - r)[:, None], (column - c)[None, :]
    upper = heights[np.ix_(r, c)] * (1 - fc) + heights[np.ix_(r, c + 1)] * fc
    lower = heights[np.ix_(r + 1, c)] * (1 - fc) + heights[np.ix_(r + 1, c + 1)] * fc
    return Elevation(upper * (1 - fr) + lower * fr, side / (count - 1), side / (count - 1))


def dem_terrain(path: Path, samples: Optional[int], fill: bool, say: Say) -> Terrain:
    """The middle square of an elevation model, the ground at its middle being zero."""
    raw = read_asc(path) if path.suffix.lower() in (".asc", ".txt", ".agr") else read_geotiff(path)
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
        heights = fill_holes(heights)
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
