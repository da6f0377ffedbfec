# SPDX-License-Identifier: MIT
"""Light of sun and sky over the fields of a data set."""

from dataclasses import dataclass
from datetime import date, datetime
from typing import Any, Iterable, Optional, Tuple

import numpy as np
from ardee_sim import ArdeeError, Daylight

from ardee_common.errors import GeneratorError
from ardee_common.options import converted, option

_TRIES = 1000  # to find a moment of the day between two times
_EVENLY = np.linspace(0.0, 1.0, _TRIES)  # shares of the time between them
_MOMENT = "'2026-06-01T08:00-05:00'"


def _texts(given: Any) -> Optional[Tuple[str, str]]:
    if given is None:
        return None
    for value in given if isinstance(given, list) else ():
        if isinstance(value, date):  # so YAML reads a moment, or a date
            found = f"found {value.isoformat()} without quotes"
            raise GeneratorError(f"{found}, expected it in quotes, such as {_MOMENT}")
    if not isinstance(given, list) or [type(value) for value in given] != [str, str]:
        raise ValueError(given)
    return given[0], given[1]


@dataclass(frozen=True)
class LightKeys:
    """Light that is drawn for each field, whose x points east; ranges are [least, most].

    With `place_deg` and `times` the sun stands as it does there at a moment drawn from those, of the day alone; else
    as `azimuth_deg` and `elevation_deg` say.
    """

    elevation_deg: Tuple[float, float] = option(
        (20.0, 70.0), "of the sun above the horizon", (0.0, 90.0)
    )
    azimuth_deg: Tuple[float, float] = option(
        (0.0, 360.0), "of the sun, clockwise from north", (-360.0, 360.0)
    )
    turbidity: Tuple[float, float] = option(
        (3.0, 3.0), "of the air, 3 on a clear day and 6 on a hazy one", (2.0, 10.0)
    )
    cloud: Tuple[float, float] = option(
        (0.0, 0.0), "share of the sky that clouds cover", (0.0, 1.0)
    )
    place_deg: Optional[Tuple[float, float]] = option(
        None, "latitude, -90 to 90, and longitude, north and east", (-180.0, 180.0)
    )
    times: Optional[Tuple[str, str]] = converted(  # between which the moment is drawn
        _texts, f"first and last moment, in quotes, such as {_MOMENT}", None
    )

    def __post_init__(self) -> None:
        for key in ("elevation_deg", "azimuth_deg", "turbidity", "cloud"):
            low, high = getattr(self, key)
            if low > high:
                raise GeneratorError(f"{key}: found [{low}, {high}], expected [least, most]")
        if self.place_deg and abs(self.place_deg[0]) > 90.0:
            found = f"found a latitude of {self.place_deg[0]}"
            raise GeneratorError(f"place_deg: {found}, expected -90 to 90, before the longitude")
        if (self.place_deg is None) != (self.times is None):
            raise GeneratorError("found one of place_deg and times, expected both or neither")
        if self.times:
            first, last = self._moments()
            if not first <= last:
                raise GeneratorError(f"times: found {list(self.times)}, expected [first, last]")
            self._daylight(_EVENLY)

    def _moments(self) -> Tuple[datetime, datetime]:
        assert self.times
        moments = []
        for text in self.times:
            try:
                moment = datetime.fromisoformat(text)
            except ValueError:
                moment = datetime.min
            if moment.tzinfo is None:
                raise GeneratorError(
                    f"times: found {text!r}, expected date, time and zone such as {_MOMENT}"
                )
            moments.append(moment)
        return moments[0], moments[1]

    def _daylight(self, shares: Iterable[float], **air: float) -> Daylight:
        """Returns the light at the first share of the time between the moments that is of the day, not of the night."""
        assert self.place_deg
        first, last = self._moments()
        for share in shares:
            try:
                return Daylight.at(*self.place_deg, first + share * (last - first), **air)
            except ArdeeError:  # at night
                continue
            except OverflowError:  # in another zone it is before the year 1 or after 9999
                raise GeneratorError(f"times: found {first}, expected years 2 to 9998") from None
        raise GeneratorError(
            f"times: found night alone at {list(self.place_deg)}, expected some day"
        )

    def draw(self, rng: np.random.Generator) -> Daylight:
        """Returns the light of a field."""
        air = {
            "turbidity": float(rng.uniform(*self.turbidity)),
            "cloud": float(rng.uniform(*self.cloud)),
        }
        if self.place_deg is None:
            return Daylight(
                float(rng.uniform(*self.azimuth_deg)),
                float(rng.uniform(*self.elevation_deg)),
                **air,
            )
        return self._daylight((*rng.uniform(size=_TRIES), *_EVENLY), **air)
