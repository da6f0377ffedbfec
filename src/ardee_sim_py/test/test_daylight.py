# SPDX-License-Identifier: MIT
"""Tests the sun's place, and what its light does to pictures."""

from datetime import datetime, timedelta, timezone

import ardee_sim
import numpy as np
import pytest

EYE_M = (0.6, 0.0, 0.8)
BACK = (0.0, 0.0, 1.0, 0.0)  # along the lane


def test_the_sun_stands_where_published_positions_say() -> None:
    """The example of Reda and Andreas, NREL/TP-560-34302, table A5.1: zenith 50.11162, azimuth 194.34024 deg."""
    mountain = timezone(timedelta(hours=-7))
    light = ardee_sim.Daylight.at(
        39.742476, -105.1786, datetime(2003, 10, 17, 12, 30, 30, tzinfo=mountain)
    )
    assert light.elevation_deg == pytest.approx(90.0 - 50.11162, abs=0.02)
    assert light.azimuth_deg == pytest.approx(194.34024, abs=0.02)


def test_the_sun_passes_over_the_equator_at_an_equinox() -> None:
    """On 2024-03-20 noon by the sun is 7.4 minutes after noon by the clock (equation of time)."""
    noon = datetime(2024, 3, 20, 12, 7, 24, tzinfo=timezone.utc)
    assert ardee_sim.Daylight.at(0.0, 0.0, noon).elevation_deg > 89.7


def test_night_a_time_without_zone_and_no_place_are_refused() -> None:
    with pytest.raises(ardee_sim.ArdeeError, match="deg below the horizon at 2026-01-01T00:00"):
        ardee_sim.Daylight.at(40.0, 0.0, datetime(2026, 1, 1, tzinfo=timezone.utc))
    with pytest.raises(ardee_sim.ArdeeError, match="expected one with a time zone"):
        ardee_sim.Daylight.at(40.0, 0.0, datetime(2026, 1, 1, 12))
    noon = datetime(2026, 6, 1, 12, tzinfo=timezone.utc)
    for latitude_deg, longitude_deg in ((95.0, 0.0), (40.0, -8800.0), (float("nan"), 0.0)):
        with pytest.raises(
            ardee_sim.ArdeeError, match="itude_deg: found .*, expected a finite number"
        ):
            ardee_sim.Daylight.at(latitude_deg, longitude_deg, noon)


def test_pictures_show_the_light_and_snapshots_hold_it(corn: ardee_sim.World) -> None:
    def picture(sim: ardee_sim.Simulation) -> np.ndarray:
        return sim.render(EYE_M, BACK, width_px=80, height_px=60)

    with ardee_sim.Simulation(corn, seed=1) as sim:
        own = picture(sim)
        before = sim.snapshot()
        sim.set_light(ardee_sim.Daylight(azimuth_deg=100, elevation_deg=40))
        clear = picture(sim)
        sim.reset()
        assert np.array_equal(picture(sim), clear)
        after = sim.snapshot()
        sim.set_light(ardee_sim.Daylight(azimuth_deg=100, elevation_deg=40, cloud=1.0))
        overcast = picture(sim)
        sim.restore(after)
        assert np.array_equal(picture(sim), clear)
        sim.restore(before)
        assert np.array_equal(picture(sim), own)
        is_sky = np.isinf(sim.depth_image(EYE_M, BACK, width_px=80, height_px=60))
    assert is_sky.sum() > 200
    assert np.ptp(overcast[is_sky].mean(axis=0)) < 2  # without a colour
    red, _, blue = clear[is_sky].mean(axis=0)
    assert blue > 1.1 * red


def test_light_out_of_range_is_refused(sim: ardee_sim.Simulation) -> None:
    with pytest.raises(ardee_sim.ArdeeError, match="found turbidity 1, expected 2 to 10"):
        sim.set_light(ardee_sim.Daylight(azimuth_deg=0, elevation_deg=45, turbidity=1))
