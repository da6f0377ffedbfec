# SPDX-License-Identifier: MIT
"""Light of sun and sky, by place and time."""

import math
from dataclasses import dataclass
from datetime import datetime, timezone

import ephem
from ardee_sim import checks
from ardee_sim.errors import ArdeeError


@dataclass(frozen=True)
class Daylight:
    """Place of the sun, and the air that its light comes through; x points east, y north.

    azimuth_deg : clockwise from north
    elevation_deg : above the horizon, 0 to 90
    turbidity : 2 (very clear) to 10; 3 a clear day, 6 a hazy one
    cloud : share of the sky that clouds cover, 0 to 1

    The model is that of Preetham, Shirley and Smits (SIGGRAPH 1999), clouds by Kasten and Czeplak (1980).
    """

    azimuth_deg: float
    elevation_deg: float
    turbidity: float = 3.0
    cloud: float = 0.0

    @classmethod
    def at(
        cls,
        latitude_deg: float,
        longitude_deg: float,
        time: datetime,
        *,
        turbidity: float = 3.0,
        cloud: float = 0.0,
    ) -> "Daylight":
        """Returns the light at a place (degrees north and east) and time; the sun stands where PyEphem says.

        Raises
        ------
        ArdeeError
            The sun is below the horizon, the time has no time zone, or there is no such place.
        """
        if not isinstance(time, datetime):
            raise TypeError(f"{checks.found(time, 'time')}, expected a datetime")
        if time.tzinfo is None:
            raise ArdeeError(f"found the time {time.isoformat()}, expected one with a time zone")
        checks.number(latitude_deg, "latitude_deg", -90, 90)
        checks.number(longitude_deg, "longitude_deg", -360, 360)
        place = ephem.Observer()
        place.lat, place.lon = math.radians(latitude_deg), math.radians(longitude_deg)
        place.date = ephem.Date(time.astimezone(timezone.utc).replace(tzinfo=None))
        sun = ephem.Sun(place)
        elevation_deg = math.degrees(sun.alt)
        if elevation_deg < 0:
            raise ArdeeError(
                f"the sun is {-elevation_deg:.1f} deg below the horizon at {time.isoformat()}, expected a time of day"
            )
        return cls(math.degrees(sun.az), elevation_deg, turbidity, cloud)
