# SPDX-License-Identifier: MIT
"""Dust and drops against closed forms."""

import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_datasets.lens import Lens, LensKeys, Spot

GREY = np.full((60, 80, 3), 100, dtype=np.uint8)


def test_dust_takes_light_and_scatters_some() -> None:
    """A spot of opacity 0.5 leaves 50 of 100 in its middle, adds 0.5 x 0.3 of the mean, and fades towards its edge."""
    made = Lens((Spot("dust", 40.0, 30.0, 20.0, 0.5),)).applied(GREY)
    assert (made[28:32, 38:42] == 65).all()
    column = made[30, 40:52, 0].astype(int)
    assert (np.diff(column) >= 0).all() and 65 < column[7] < 100
    away = np.hypot(*(np.mgrid[0.5:60, 0.5:80] - np.array([30, 40])[:, None, None])) > 10
    assert (made[away] == 100).all() and (made[~away] <= 100).all()


def test_a_drop_shows_the_picture_upside_down() -> None:
    picture = GREY.copy()
    picture[:30], picture[:, :40, 2] = 200, 0
    made = Lens((Spot("drop", 60.0, 20.0, 16.0, 1.0),)).applied(picture)
    assert (made[15:18, 58:62, 0] < 130).all() and (made[22:25, 58:62, 0] > 170).all()
    assert (made[18:22, 55:57, 2] > 90).all() and (made[18:22, 63:65, 2] < 60).all()
    assert np.array_equal(made[:, :50], picture[:, :50])


def test_a_lens_is_drawn_within_its_ranges_and_the_same_for_a_seed() -> None:
    keys = LensKeys(dust=(5, 9), dust_diameter=(0.1, 0.2), dust_opacity=(0.2, 0.3), drops=(2, 2))
    lens = keys.draw(np.random.default_rng(4), (80, 60))
    assert lens == keys.draw(np.random.default_rng(4), (80, 60))
    dust = [spot for spot in lens.spots if spot.kind == "dust"]
    assert 5 <= len(dust) <= 9 and len(lens.spots) == len(dust) + 2
    assert all(8 <= spot.diameter_px <= 16 and 0.2 <= spot.opacity <= 0.3 for spot in dust)
    assert all(0 <= spot.u_px <= 80 and 0 <= spot.v_px <= 60 for spot in lens.spots)
    assert Lens().applied(GREY) is GREY
    with pytest.raises(GeneratorError, match=r"drops: found \[3, 2\], expected \[least, most\]"):
        LensKeys(drops=(3, 2))
