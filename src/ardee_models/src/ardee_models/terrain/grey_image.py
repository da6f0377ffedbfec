# SPDX-License-Identifier: MIT
"""Reads grey images of any depth; other files are refused with a plain message."""

import contextlib
import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Iterator

import numpy as np
from PIL import Image

from ardee_common.errors import GeneratorError

MAX_SIDE_PX = 16384


@dataclass(frozen=True)
class GreyImage:
    """Pixels (rows, columns), row 0 on top; `white` is the largest value of the pixel type."""

    pixels: np.ndarray
    white: int


def _floats(shares: np.ndarray, path: Path) -> GreyImage:
    """Makes 16-bit pixels of floats from 0 to 1."""
    least, greatest = shares.min(), shares.max()
    if not (least >= 0.0 and greatest <= 1.0):  # true for NaN
        raise GeneratorError(
            f"{path}: found floats from {least:g} to {greatest:g}, expected 0 to 1"
            " (generate_terrain --dem takes heights in metres)"
        )
    return GreyImage(np.rint(shares * 65535.0).astype(np.int64), 65535)


def _grey(image: Image.Image, path: Path) -> GreyImage:
    if max(image.size) > MAX_SIDE_PX:
        raise GeneratorError(
            f"{path}: found {image.width} x {image.height} pixels, expected at most {MAX_SIDE_PX} a side"
        )
    if image.mode in ("I;16", "I;16B", "I;16L", "I"):
        return GreyImage(np.asarray(image).astype(np.int64), 65535)
    if image.mode == "1":
        return GreyImage(np.asarray(image).astype(np.int64), 1)
    if image.mode == "F":
        return _floats(np.asarray(image), path)
    return GreyImage(np.asarray(image.convert("L")).astype(np.int64), 255)


@contextlib.contextmanager
def open_image(path: Path, kind: str) -> Iterator[Image.Image]:
    """Opens an image; raises GeneratorError if it is missing, too large, or no readable file of this kind."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            warnings.simplefilter("error", Image.DecompressionBombWarning)
            with Image.open(path) as image:
                yield image
    except FileNotFoundError as error:
        raise GeneratorError(f"{path}: cannot be read: {error.strerror}") from error
    except (
        OSError,
        ValueError,
        SyntaxError,
        Image.DecompressionBombError,
        Image.DecompressionBombWarning,
    ) as error:
        raise GeneratorError(f"{path}: not a readable {kind}: {error}") from error


def read_grey(path: Path) -> GreyImage:
    """Reads a grey image; colours become their luminance."""
    with open_image(path, "image") as image:
        grey = _grey(image, path)
    if grey.pixels.min() < 0 or grey.pixels.max() > grey.white:
        raise GeneratorError(
            f"{path}: found values {grey.pixels.min()} to {grey.pixels.max()}, expected 0 to {grey.white}"
        )
    return grey
