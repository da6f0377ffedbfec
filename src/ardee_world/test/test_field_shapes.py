# SPDX-License-Identifier: MIT
"""Tests row shapes, headlands and directions against geometry in closed form."""

import numpy as np
import pytest

from ardee_common.errors import GeneratorError
from ardee_world.expression import parse_expression
from ardee_world.field_config import FieldConfig, Plots, RowShape
from ardee_world.field_layout import generate
from ardee_world.plots import plan_centres

PLOTS = Plots(row_length_m=10.0)


def _spacing(plan):
    same = (np.diff(plan.row) == 0) & (np.diff(plan.plot) == 0)
    return np.linalg.norm(np.diff(plan.centres_m, axis=0), axis=1)[same]


def test_no_noise_means_exact_positions(pool):
    config = FieldConfig(noise_covariance_m2=(0.0, 0.0, 0.0), emergence_min=1, emergence_max=1)
    layout = generate(config, pool, 9)
    x = np.repeat([-1.143, -0.381, 0.381, 1.143], 50)
    y = np.tile(-1.0 - 0.166 * np.arange(50), 4)
    np.testing.assert_allclose(layout.position_m[:, 0], x, rtol=0, atol=1e-12)
    np.testing.assert_allclose(layout.position_m[:, 1], y, rtol=0, atol=1e-12)


@pytest.mark.parametrize("angle", [0.0, 180.0, 37.0])
def test_direction_turns_the_whole_plan(angle):
    usual, turned = plan_centres(PLOTS), plan_centres(PLOTS, RowShape(row_direction_deg=angle))
    c, s = np.cos(np.radians(angle + 90.0)), np.sin(np.radians(angle + 90.0))
    expected = usual.centres_m @ np.array([[c, s], [-s, c]])
    np.testing.assert_allclose(turned.centres_m, expected, atol=1e-12)
    heading = [np.cos(np.radians(angle)), np.sin(np.radians(angle))]
    np.testing.assert_allclose(turned.along, np.tile(heading, (len(expected), 1)), atol=1e-12)


@pytest.mark.parametrize("radius", [20.0, -20.0])
def test_curved_rows_are_concentric_and_evenly_planted(radius):
    plan = plan_centres(PLOTS, RowShape(row_shape="curved", curve_radius_m=radius))
    # Rows start along -y; a left turn's centre lies to the left, which is +x.
    distance = np.linalg.norm(plan.centres_m - [radius, 0.0], axis=1)
    for row, x in enumerate((-1.143, -0.381, 0.381, 1.143)):
        np.testing.assert_allclose(distance[plan.row == row], abs(radius - x), atol=1e-4)
    # The spacing is that of chords of arcs of 0.166 m.
    np.testing.assert_allclose(_spacing(plan), 0.166, atol=1e-4)
    counts = np.bincount(plan.row)
    assert (np.diff(counts) * radius < 0).all()  # outer rows hold more


def test_sine_and_expression_agree():
    sine = RowShape(row_shape="sine", sine_amplitude_m=0.2, sine_wavelength_m=8.0)
    same = RowShape(row_shape="expression", row_expression="0.2 * sin(2*pi*x/8)")
    a, b = plan_centres(PLOTS, sine), plan_centres(PLOTS, same)
    np.testing.assert_allclose(a.centres_m, b.centres_m, atol=1e-9)
    middle = a.centres_m[a.row == 2] - a.along[a.row == 2][:, ::-1] * [-0.381, 0.381]
    np.testing.assert_allclose(middle[:, 0], 0.2 * np.sin(-2 * np.pi * middle[:, 1] / 8), atol=2e-3)
    np.testing.assert_allclose(_spacing(a), 0.166, atol=1e-3)


def test_rows_part_around_an_island_and_lanes_stay_open():
    shape = RowShape(island_radius_m=1.0, island_distance_m=6.0)
    plan = plan_centres(Plots(rows_per_plot=8, row_length_m=12.0), shape)
    assert np.linalg.norm(plan.centres_m - [0.0, -6.0], axis=1).min() >= 1.0
    lines = [row.line_m for row in plan.rows]
    at_island = [np.interp(6.0, -line[:, 1], line[:, 0]) for line in lines]
    between = np.diff(at_island)
    assert between.max() > 2.0 and np.sort(between)[0] > 0.75 * 0.762
    np.testing.assert_allclose(
        [line[0, 0] for line in lines], -2.667 + 0.762 * np.arange(8), atol=0.02
    )


def test_cross_rows_lie_across_both_headlands():
    shape = RowShape(cross_rows=3, cross_row_clearance_m=2.0)
    plan = plan_centres(PLOTS, shape)
    start, end = plan.plot == 1, plan.plot == 2
    assert sorted(set(np.round(plan.centres_m[start, 1], 9))) == [1.0, 1.762, 2.524]
    np.testing.assert_allclose(
        sorted(set(np.round(plan.centres_m[end, 1], 9))), [-14.524, -13.762, -13.0]
    )
    assert np.ptp(plan.centres_m[end, 0]) == pytest.approx(14 * 0.166 - 0.166)
    assert [row.plot for row in plan.rows] == [0] * 4 + [1] * 3 + [2] * 3
    only = plan_centres(PLOTS, RowShape(cross_rows=3, cross_rows_at="end"))
    assert set(only.plot) == {0, 2}


@pytest.mark.parametrize(
    "shape, message",
    [
        (RowShape(row_shape="curved", curve_radius_m=1.0), "more than a circle"),
        (RowShape(row_shape="curved", curve_radius_m=0.0), "curve radius"),
        (RowShape(row_shape="spiral"), "row shape: found spiral, expected one of straight"),
        (RowShape(row_shape="expression"), "row expression: found None, expected one"),
        (RowShape(row_expression="x"), "expected none for row shape straight"),
        (RowShape(row_shape="sine", sine_amplitude_m=3.0, sine_wavelength_m=6.0), "of the line"),
        (RowShape(row_shape="expression", row_expression="1/(x-4)"), "slope|finite"),
    ],
)
def test_impossible_shapes_are_refused(pool, shape, message):
    with pytest.raises(GeneratorError, match=message):
        generate(FieldConfig(plots=PLOTS, shape=shape), pool, 1)


def test_a_row_too_short_to_have_a_direction_has_the_lines():
    plots = Plots(row_length_m=1e-13, headland_m=1000.0)
    plan = plan_centres(plots, RowShape(row_shape="curved", curve_radius_m=1000.0))
    # 1000 m along a circle of 1000 m: the line has turned by 1 rad from its first direction, -y
    assert plan.along == pytest.approx(np.tile([np.sin(1.0), -np.cos(1.0)], (len(plan.along), 1)))


def test_a_field_beyond_what_a_world_holds_is_refused(pool):
    plots = Plots(row_length_m=10.0, headland_m=1e5, stalk_spacing_m=5.0)
    for config in (FieldConfig(plots=plots), FieldConfig(noise_covariance_m2=(1e30, 0.0, 1e30))):
        with pytest.raises(GeneratorError, match="m from the field's origin, expected at most"):
            generate(config, pool, 0)


def test_a_circle_too_tight_for_its_rows_is_refused(pool):
    tight = RowShape(row_shape="curved", curve_radius_m=2.0)
    plots = Plots(rows_per_plot=12, row_length_m=2.0)
    with pytest.raises(GeneratorError, match="radius of curvature is 2.00 m"):
        generate(FieldConfig(plots=plots, shape=tight), pool, 1)


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os').system('true')",
        "x.__class__",
        "[x for x in (1,)]",
        "lambda: 1",
        "x if x else 1",
        "'a'",
        "True",
        "sin(x, x)",
        "eval(x)",
        "y",
        "x +",
        "",
        "(" * 300 + "x" + ")" * 300,
        "9**9**9**9**9",
        "1" * 400,
    ],
)
def test_an_expression_is_arithmetic_or_refused(text):
    with pytest.raises(GeneratorError, match="row expression"):
        parse_expression(text)(np.linspace(0.0, 1.0, 5))


def test_an_expression_is_what_it_says():
    x = np.linspace(0.0, 3.0, 7)
    y = parse_expression("-2**2 + abs(x - 1) * sqrt(x) % 2 + pi/exp(0)")(x)
    np.testing.assert_allclose(y, -4 + np.abs(x - 1) * np.sqrt(x) % 2 + np.pi)


def test_an_expression_s_line_begins_in_the_lane_of_the_start():
    lines = [
        plan_centres(Plots(), RowShape(row_shape="expression", row_expression=text)).centres_m
        for text in ("1.5 * cos(x / 3)", "1.5 * cos(x / 3) - 1.5")
    ]
    assert np.allclose(*lines)
