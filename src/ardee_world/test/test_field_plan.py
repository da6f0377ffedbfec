# SPDX-License-Identifier: MIT
"""Tests the planting plan: counts and coordinates known in closed form."""

import numpy as np
import pytest

from ardee_world.field_config import Plots
from ardee_world.field_layout import to_world
from ardee_world.plots import plan_centres, row_positions, row_starts


def test_default_plot_has_four_rows_of_fifty_round_a_lane_on_x_0():
    plots = Plots()
    plan = plan_centres(plots)
    assert len(plan.centres_m) == plots.planned_count() == 200
    np.testing.assert_allclose(row_positions(plots), [[-1.143, -0.381, 0.381, 1.143]])
    for row in range(4):
        y = plan.centres_m[plan.row == row, 1]
        assert y[0] == -1.0 and y[-1] == pytest.approx(-1.0 - plots.row_length_m)
        np.testing.assert_allclose(np.diff(y), -0.166)


def test_farm_worlds_rows_run_along_minus_x_of_the_world():
    # R(-90 deg) (px, py) = (py, -px): the lane px = 0 lies on the world's y = 0
    np.testing.assert_allclose(
        to_world(np.array([[0.381, -1.0]]), (0, 0, -np.pi / 2)), [[-1.0, -0.381]]
    )
    np.testing.assert_allclose(to_world(np.array([[1.0, 0.0]]), (2, 3, np.pi / 2)), [[2.0, 4.0]])


@pytest.mark.parametrize("rows", [1, 2, 3, 4, 7])
@pytest.mark.parametrize("plots_x", [1, 2, 3])
def test_a_lane_always_lies_on_x_0(rows, plots_x):
    x = row_positions(Plots(rows_per_plot=rows, plots_x=plots_x)).ravel()
    assert np.abs(x).min() == pytest.approx(0.381)
    assert (np.diff(x) > 0).all()


def test_plots_are_spaced_as_asked():
    plots = Plots(
        plots_x=2, plots_y=3, plot_spacing_x_m=2.0, plot_spacing_y_m=5.0, row_length_m=3.32
    )
    x, y = row_positions(plots), row_starts(plots)
    assert x[1, 0] - x[0, -1] == pytest.approx(2.0)
    np.testing.assert_allclose(np.diff(y), 3.32 + 5.0)
    plan = plan_centres(plots)
    assert sorted(set(plan.plot)) == list(range(6))
    assert (
        len({tuple(c) for c in np.round(plan.centres_m, 6)}) == plots.planned_count() == 6 * 4 * 21
    )


def test_row_shorter_than_a_spacing_holds_one_stalk():
    assert Plots(row_length_m=0.1).stalks_per_row() == 1
    assert Plots(row_length_m=0.332).stalks_per_row() == 3
