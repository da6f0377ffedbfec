# SPDX-License-Identifier: MIT
"""Tests the light that is drawn for fields."""

import pathlib

import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_datasets.light import LightKeys
from ardee_datasets.plan import scenes
from ardee_datasets.recipe import read_recipe

DAY = ("2026-06-21T00:00-05:00", "2026-06-22T00:00-05:00")
NIGHT = ("2026-06-21T00:00-05:00", "2026-06-21T03:00-05:00")
URBANA_DEG = (40.06, -88.20)


def test_numbers_are_drawn_within_their_ranges() -> None:
    keys = LightKeys(elevation_deg=(5, 10), azimuth_deg=(90, 100), cloud=(0.5, 0.6))
    for seed in range(20):
        light = keys.draw(np.random.default_rng(seed))
        assert 5 <= light.elevation_deg <= 10 and 90 <= light.azimuth_deg <= 100
        assert light.turbidity == 3 and 0.5 <= light.cloud <= 0.6


def test_moments_are_those_of_the_day() -> None:
    """The sun of midsummer rises north of east, and culminates at 90 - 40.06 + 23.44 deg in the south."""
    keys = LightKeys(place_deg=URBANA_DEG, times=DAY)
    drawn = [keys.draw(np.random.default_rng(seed)) for seed in range(300)]
    elevations = np.array([light.elevation_deg for light in drawn])
    assert elevations.min() > 0 and elevations.max() == pytest.approx(73.38, abs=0.3)
    assert drawn[int(elevations.argmax())].azimuth_deg == pytest.approx(180, abs=10)
    assert min(light.azimuth_deg for light in drawn) == pytest.approx(58, abs=3)


@pytest.mark.parametrize(
    "keys, said",
    [
        (dict(cloud=(0.5, 0.1)), r"cloud: found \[0.5, 0.1\], expected \[least, most\]"),
        (dict(place_deg=(-91.0, 0.0), times=DAY), "found a latitude of -91.0, expected -90 to 90"),
        (dict(times=DAY), "found one of place_deg and times"),
        (dict(place_deg=URBANA_DEG, times=("2026-06-21", DAY[1])), "times: found '2026-06-21'"),
        (dict(place_deg=URBANA_DEG, times=DAY[::-1]), r"expected \[first, last\]"),
        (dict(place_deg=URBANA_DEG, times=NIGHT), "times: found night alone at .*40.06, -88.2"),
    ],
)
def test_wrong_keys_are_refused(keys: dict, said: str) -> None:
    with pytest.raises(GeneratorError, match=said):
        LightKeys(**keys)


def test_a_little_day_is_always_found() -> None:
    """The night of three days ends with the first minutes after a sunrise at 5:24."""
    times = ("2026-06-21T00:00-05:00", "2026-06-21T05:26-05:00")
    keys = LightKeys(place_deg=URBANA_DEG, times=times)
    for seed in range(3):
        assert 0.0 <= keys.draw(np.random.default_rng(seed)).elevation_deg < 1.0


RECIPE = (
    "fields: {corn: {fields: 3, options: {models: [corn_variant_1]}}}\n"
    "cameras: {front: {width_px: 64, height_px: 48, horizontal_fov_deg: 70}}\n"
)


@pytest.mark.parametrize(
    "light, said",
    [
        ("elevation_deg: 30", r"elevation_deg: found 30, expected \[least, most\]"),
        ("times: [2026-06-21T08:00:00-05:00, 2026-06-22]", "times: found 2026-06-21T08.*in quotes"),
        ("times: noon", "times: found 'noon', expected first and last moment, in quotes"),
        (f"elevation_deg: [1, 2], times: {list(DAY)}", "elevation_deg: found it with times"),
        (f"place_deg: {list(URBANA_DEG)}, times: {list(NIGHT)}", "times: found night alone"),
        (
            f"place_deg: {list(URBANA_DEG)}, times: ['0001-01-01T00:00+14:00', '0001-01-02T00:00+14:00']",
            "times: found 0001-01-01 .*expected years 2 to 9998",
        ),
    ],
)
def test_a_wrong_light_of_a_recipe_is_refused(
    tmp_path: pathlib.Path, light: str, said: str
) -> None:
    file = tmp_path / "recipe.yaml"
    file.write_text(f"{RECIPE}light: {{{light}}}\n")
    with pytest.raises(GeneratorError, match=f"recipe.yaml:3: {said}"):
        read_recipe(file)


def test_each_field_of_a_recipe_has_its_light(tmp_path: pathlib.Path) -> None:
    text, file = RECIPE, tmp_path / "recipe.yaml"
    file.write_text(text)
    assert [scene.light() for scene in scenes(read_recipe(file))] == [None] * 3
    file.write_text(text + "light: {cloud: [0, 1]}\n")
    lights = [scene.light() for scene in scenes(read_recipe(file))]
    assert len({light.cloud for light in lights if light}) == 3
    file.write_text(text + "light: {}\n")
    drawn = [scene.light() for scene in scenes(read_recipe(file))]
    assert len({light.azimuth_deg for light in drawn if light}) == 3
    file.write_text(text + "light: {clouds: [0, 1]}\n")
    with pytest.raises(GeneratorError, match="recipe.yaml:3.*clouds.*cloud"):
        read_recipe(file)
