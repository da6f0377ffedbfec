# SPDX-License-Identifier: MIT
"""Fit of all crop rows of a picture that a camera of unknown place took from above: parallel curves on level ground.

The index of picture row v is correlated with exp(-2 pi i u / period(v)), where the period grows evenly from the
horizon down. Rows of that period turn the phase of the results along the picture by their direction and bend alone, so
that these are found by adding the results up, turned back. Horizon and spacing are tried one after the other. At last
the rows are moved by the phase that is left around each picture row, for curves that no bend describes.
"""
from dataclasses import dataclass
from typing import Iterator, Tuple

import numpy as np

_SHRINKAGE = np.linspace(0.1, 0.8, 8)  # of the period, from the picture's bottom to its top
_PERIODS = np.geomspace(0.12, 0.6, 14)  # at the bottom, of the picture's width
_BENDS = np.arange(-1.5, 1.51, 0.25)  # at the top [rows]
_HEADING_STEP = 0.1  # at the top [rows]
_LEAST_PERIOD_PX = 4.0
_REFINEMENTS = 4  # halvings of the steps of shrinkage and period
_AROUND = 0.07  # standard deviation of the picture rows whose phases are averaged, of the height


@dataclass(frozen=True)
class FieldRows:
    """Crop rows of a picture: row m passes picture row v at u = width / 2 + offset_px[v] + m period_px[v]."""

    offset_px: np.ndarray
    period_px: np.ndarray


class Wave:
    """The picture rows' correlation with rows of one horizon and spacing."""

    def __init__(self, width_px: int, height_px: int, shrinkage: float, period: float) -> None:
        below = (np.arange(height_px) + 0.5) / height_px
        self.period_px = period * width_px * (shrinkage + (1.0 - shrinkage) * below)
        self.distance = self.period_px.min() / self.period_px  # along the ground, 1 at the top
        u_px = np.arange(width_px) + 0.5 - width_px / 2.0
        wave = np.exp(-2j * np.pi * u_px / self.period_px[:, None])
        wave -= wave.mean(axis=1, keepdims=True)
        wave /= np.linalg.norm(wave, axis=1, keepdims=True)
        self._wave = (wave * (self.period_px >= _LEAST_PERIOD_PX)[:, None]).astype(np.complex64)
        reach = width_px / self.period_px.min()
        headings = np.arange(-reach, reach + _HEADING_STEP, _HEADING_STEP)
        self._headings, self._turns = headings, self._turned(headings, self.distance)
        self._curls = self._turned(_BENDS, self.distance**2)

    @staticmethod
    def _turned(rows: np.ndarray, along: np.ndarray) -> np.ndarray:
        return np.exp(2j * np.pi * np.outer(rows, along)).astype(np.complex64)

    def phases(self, unit: np.ndarray) -> np.ndarray:
        """Returns amplitude and phase in each picture row, complex[v]; `unit` has rows of mean 0 and norm 1."""
        return np.einsum("vu,vu->v", self._wave, unit)

    def best(self, unit: np.ndarray) -> Tuple[float, FieldRows]:
        """Returns how well the best rows fit, 0 to 1, and these."""
        phases = self.phases(unit)
        sums = (self._curls * phases) @ self._turns.T
        bend, heading = np.unravel_index(np.argmax(np.abs(sums)), sums.shape)
        along = self._headings[heading] * self.distance + _BENDS[bend] * self.distance**2
        offset = along - np.angle(sums[bend, heading]) / (2.0 * np.pi)
        rows = FieldRows(offset * self.period_px, self.period_px)
        return float(np.abs(sums[bend, heading])) / len(phases), rows

    def moved(self, rows: FieldRows, unit: np.ndarray) -> FieldRows:
        """Returns the rows, moved by the phase that is left around each picture row."""
        left = self.phases(unit) * np.exp(2j * np.pi * rows.offset_px / rows.period_px)
        apart = np.subtract.outer(np.arange(len(left)), np.arange(len(left)))
        smooth = np.exp(-0.5 * (apart / (_AROUND * len(left))) ** 2) @ left
        move = -np.angle(smooth) / (2.0 * np.pi)
        return FieldRows(rows.offset_px + move * rows.period_px, rows.period_px)


class FieldFitter:
    """Finds the crop rows in indices of one size."""

    def __init__(self, width_px: int, height_px: int) -> None:
        self._size_px = width_px, height_px
        self._tried = [
            (Wave(*self._size_px, shrinkage, period), shrinkage, period)
            for shrinkage in _SHRINKAGE
            for period in _PERIODS
        ]

    def fit(self, index: np.ndarray) -> FieldRows:
        """Returns the rows of an index float32[h, w]."""
        unit = index - index.mean(axis=1, keepdims=True)
        unit = unit / (np.linalg.norm(unit, axis=1, keepdims=True) + 1e-6)
        best = max(((*each[0].best(unit), *each) for each in self._tried), key=lambda one: one[0])
        for level in range(1, _REFINEMENTS + 1):
            near = [
                (Wave(*self._size_px, shrinkage, period), shrinkage, period)
                for shrinkage, period in self._around(best[3], best[4], 0.5**level)
            ]
            found = [(*each[0].best(unit), *each) for each in near]
            best = max((best, *found), key=lambda one: one[0])
        return best[2].moved(best[1], unit)

    @staticmethod
    def _around(shrinkage: float, period: float, share: float) -> Iterator[Tuple[float, float]]:
        """Yields neighbours at a share of the steps between those tried."""
        step, factor = share * (_SHRINKAGE[1] - _SHRINKAGE[0]), (_PERIODS[1] / _PERIODS[0]) ** share
        for other in (shrinkage - step, shrinkage, shrinkage + step):
            for longer in (1.0 / factor, 1.0, factor):
                if (other, longer) != (shrinkage, 1.0):
                    yield other, period * longer
