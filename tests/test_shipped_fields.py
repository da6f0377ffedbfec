# SPDX-License-Identifier: MIT
"""In each shipped field plants, plots, truth and start pose agree, where it was planned to stand and anywhere else."""
import json
import pathlib
import xml.etree.ElementTree as ElementTree
from typing import Dict, Tuple

import numpy as np
import pytest
import yaml

from ardee_world.assemble_world import assemble, make_parser

SHARE = pathlib.Path(__file__).resolve().parents[1] / "devel" / "share"
FIELDS = sorted(p.stem[: -len(".urdf")] for p in SHARE.glob("ardee_world/urdf/*.urdf.xacro"))
PLANS = SHARE.parents[1] / "src" / "ardee_world" / "fields"
ELSEWHERE = (-7.0, 12.0, 2.2)
PLACING_M = 0.5  # how far noise and doubles put a plant from its place: 3 cm along a row, 5 sd of 5 cm, curves


def turned(xy: np.ndarray, yaw: float) -> np.ndarray:
    """Points turned about the origin."""
    c, s = np.cos(yaw), np.sin(yaw)
    return xy @ np.array([[c, s], [-s, c]])


def plants_of(folder: pathlib.Path) -> Tuple[np.ndarray, Tuple[float, float, float]]:
    """Places of the plants in the world by the field's model, and the field's pose."""
    model = ElementTree.parse(folder / "model.sdf").getroot().find("model")
    x, y, _, _, _, yaw = (float(number) for number in model.findtext("pose").split())
    poses = {i.findtext("name"): i.findtext("pose").split() for i in model.findall("include")}
    places = [pose[:2] for name, pose in poses.items() if name.startswith("plant_")]
    return turned(np.array(places, dtype=float), yaw) + [x, y], (x, y, yaw)


def is_in(plot: ElementTree.Element, xy: np.ndarray) -> np.ndarray:
    """Tells which points lie in a plot, or next to it."""
    of = {child.tag: float(child.text) for child in plot}  # type: Dict[str, float]
    along, beside = turned(xy - [of["x"], of["y"]], -of["rotation"]).T
    half_m = of["row_length"] / 2 + PLACING_M, of["row_count"] * of["row_width"] / 2
    return (abs(along) <= half_m[0]) & (abs(beside) <= half_m[1])


def test_the_fields_are_those_of_the_plans() -> None:
    assert FIELDS and set(FIELDS) - {"empty"} == {plan.stem for plan in PLANS.glob("*.yaml")}


@pytest.mark.parametrize("pose", [None, ELSEWHERE])
@pytest.mark.parametrize("name", [name for name in FIELDS if name != "empty"])
def test_plants_plots_truth_and_start_agree(
    name: str, pose: Tuple[float, float, float], tmp_path: pathlib.Path
) -> None:
    words = [str(SHARE / f"ardee_world/urdf/{name}.urdf.xacro"), "ardee_models/heightmap_flat"]
    words += ["ardee_geofence/default_gps_behavior.geofence", "--output", str(tmp_path)]
    words += ["--search", str(SHARE), str(SHARE.parents[1] / "src")]
    words += ["--world-pose", *map(str, pose)] if pose else []
    assemble(make_parser().parse_args(words))
    folder = tmp_path / "models" / "custom_field"
    plants, stands = plants_of(folder)
    plan = yaml.safe_load((PLANS / f"{name}.yaml").read_text())
    assert stands == pytest.approx(pose or plan.get("world_pose", (0.0, 0.0, -1.57)))
    truth = json.loads((folder / "truth.json").read_text())
    told = np.column_stack((truth["plants"]["world_x_m"], truth["plants"]["world_y_m"]))
    np.testing.assert_allclose(plants, told, atol=2e-4)
    plots = ElementTree.parse(folder / "plots.xacro").getroot().findall("plot")
    assert np.all(np.any([is_in(plot, plants) for plot in plots], axis=0))
    start = yaml.safe_load((tmp_path / "worlds" / "custom.start.yaml").read_text())
    from_start = turned(plants - [start["x_m"], start["y_m"]], -start["yaw_rad"])
    in_front = from_start[abs(from_start[:, 1]) < 1.2]
    near = in_front[in_front[:, 0] < in_front[:, 0].min() + 1.5]
    assert 0.5 < near[:, 0].min() < 1.5  # the headland of 1 m
    assert np.any(near[:, 1] > 0.0) and np.any(near[:, 1] < 0.0)  # in a lane
    assert np.abs(near[:, 1]).min() > 0.2


@pytest.mark.parametrize(
    "name, species, rows, stalks, off",
    [
        ("scenario-1-artificial-plot", "corn", 2, 23, 0),
        ("scenario-2-corn-plot", "corn", 4, 50, 2),
        ("scenario-3-sorghum-plot", "sorghum", 4, 50, 2),
    ],
)
def test_the_scenarios_of_the_thesis_have_its_rows(
    name: str, species: str, rows: int, stalks: int, off: int
) -> None:
    """Sections 5.2.2 to 5.2.4: rows 30 in apart; 23 stalks 6 in apart without noise, or on the average 50 on 5 m."""
    truth = json.loads((SHARE / f"ardee_world/models/{name}/truth.json").read_text())
    plants = truth["plants"]
    assert set(plants["species"]) == {species}
    counts = np.bincount(plants["row"])
    assert len(counts) == rows and np.abs(counts - stalks).max() <= off
    across = [
        np.mean(np.array(plants["x_m"])[np.array(plants["row"]) == row]) for row in range(rows)
    ]
    np.testing.assert_allclose(np.diff(across), 0.762, atol=0.02)
    along = np.sort(np.array(plants["y_m"])[np.array(plants["row"]) == 0])
    if off == 0:
        np.testing.assert_allclose(np.diff(along), 0.1524, atol=2e-4)
        assert np.ptp(np.abs(plants["x_m"])) == 0.0
    else:
        assert np.ptp(along) == pytest.approx(5.0, abs=0.15)


def test_sorghum_of_the_thesis_is_sown_with_more_noise_than_its_corn() -> None:
    corn, sorghum = (
        json.loads((SHARE / f"ardee_world/models/{name}/truth.json").read_text())["plants"]
        for name in ("scenario-2-corn-plot", "scenario-3-sorghum-plot")
    )
    spreads = [
        np.mean([np.std(np.array(field["x_m"])[np.array(field["row"]) == row]) for row in range(4)])
        for field in (corn, sorghum)
    ]
    assert 0.0 < spreads[0] < spreads[1]
