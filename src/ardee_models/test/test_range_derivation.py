# SPDX-License-Identifier: MIT
"""Tests that the derived bounds of config/ranges.yaml follow from their arithmetic, independently of the models."""

import inspect
import math
import re

import pytest
import range_derivation as derive
from range_derivation import CORN, SORGHUM, Trait, between

from ardee_models.report.ranges import load_ranges

_CALL = re.compile(r"(\w+)\(([^)]*)\)")
_GRASSES = {"CORN": CORN, "SORGHUM": SORGHUM}


def _rows():
    for species, metrics in load_ranges()[0].items():
        for metric, rows in metrics.items():
            for row in rows:
                yield pytest.param(metric, row, id=f"{species}-{metric}-{row.stages[0]}")


def _call(name, text, metric):
    words = [word.strip() for word in text.split(",") if word.strip()]
    if words and words[0] in _GRASSES:
        bounds = getattr(derive, name)(_GRASSES[words[0]], *map(int, words[1:]))
    elif len(words) >= 3:
        bounds = getattr(derive, name)(Trait(*map(float, words[:3])), *map(float, words[3:]))
    else:
        bounds = getattr(derive, name)(*([between(*map(float, words))] if words else []))
    return bounds[int(metric == "leaf_width_max_m")] if name == "tobacco_blade" else bounds


def _calls(row):
    return [c for c in _CALL.findall(row.how) if inspect.isfunction(getattr(derive, c[0], None))]


@pytest.mark.parametrize("metric, row", [p for p in _rows() if _calls(p.values[1])])
def test_bounds_are_what_the_named_function_gives(metric, row):
    bounds = [_call(*call, metric) for call in _calls(row)]
    elsewhere = row.how.partition(";")[2]  # names of the bounds that another argument sets
    for side, bound in (("low", bounds[0][0]), ("high", bounds[-1][1])):
        if not re.search(rf"\b{side}\b", elsewhere):
            assert getattr(row, {"low": "min", "high": "max"}[side]) == float(f"{bound:.2g}")
    assert row.min < bounds[-1][1] and row.max > bounds[0][0]


def test_what_is_derived_names_its_function_but_leaf_numbers_and_a_few_in_words():
    rows = [p.values for p in _rows()]
    assert all(row.mark == "derived" for _, row in rows if _calls(row))
    in_words = [(m, r.stages[0]) for m, r in rows if r.mark == "derived" and not _calls(r)]
    heights = {("height_m", s) for s in ("6", "L9", "knee_high", "grand_growth", "button")}
    others = {("stalk_diameter_m", "6"), ("leaf_area_m2", "6"), ("leaf_area_index", "ripening")}
    assert {r for r in in_words if r[0] != "leaf_number"} == heights | others


@pytest.mark.parametrize("metric, row", _rows())
def test_ranges_can_fail(metric, row):
    """Expects that no range allows everything: the widest, of stages that span leaves, spans a factor of 12."""
    assert row.max <= 12 * row.min or metric == "tiller_count"


def test_the_middle_agrees_with_figures_that_the_formulas_do_not_use():
    """Compares with known leaf area indices and leaf sizes: about 0.5 at V6, 2-3 at V10-12, 0.8-1 m by 9-11 cm."""
    middle = {n: math.sqrt(math.prod(derive.leaf_area_index(CORN, n))) for n in (6, 10, 12)}
    assert 0.35 < middle[6] < 0.7 and 1.8 < middle[10] < middle[12] < 3
    low, high = derive.longest_blade(CORN)
    assert low < 0.8 < high and math.isclose(math.sqrt(low * high), 0.8, rel_tol=0.1)
    low, high = derive.widest_blade(CORN)
    assert low < 0.09 < high


def test_spread_of_a_product_is_the_quadrature_of_its_factors():
    low, high = derive.spread(lambda a, b: a * b, a=between(0.5, 2.0), b=between(1.0, 9.0))
    factor = math.exp(math.hypot(math.log(2), math.log(3)))
    assert math.isclose(low, 3 / factor) and math.isclose(high, 3 * factor)


def test_relative_areas_are_one_at_the_largest_leaf_and_the_skew_below_the_first():
    areas = derive.relative_areas(20, 0.5, 0.01)
    assert max(areas) == areas[9] == 1.0
    assert math.isclose(areas[0], 0.01 ** (2 * 0.45**2 - 0.45**3), rel_tol=1e-9)
