# SPDX-License-Identifier: MIT
"""Tests the campaigns and controllers that ship, as far as that takes seconds."""
from pathlib import Path

import pytest
import yaml
from small_campaign import run

from ardee_campaigns import examples, tables
from ardee_campaigns.examples import scripted
from ardee_navigation.evaluation.scenarios import known_scenarios
from ardee_navigation.lbirnt import Parameters

FOLDER = Path(examples.__file__).parent


@pytest.mark.slow
@pytest.mark.parametrize("name, count", [("small", 12), ("season", 420), ("vision", 270)])
def test_a_shipped_campaign_is_listed_by_its_name(name: str, count: int) -> None:
    done = run(name, "--output", "/nowhere", "--list")
    assert f"{count} runs, {count} of them to do" in done.stderr
    assert len(done.stdout.splitlines()) == count + 1


def test_the_season_has_all_scenarios_that_a_lidar_tells_apart_with_their_parameters() -> None:
    season = yaml.safe_load((FOLDER / "season.yaml").read_text())
    scenarios = known_scenarios()
    for light in ("low_sun", "overcast"):
        scenarios.pop(light)
    assert set(season["worlds"]) == set(scenarios)
    for name, scenario in scenarios.items():
        world = season["worlds"][name]
        params = world["params"]["lidar"] if isinstance(world, dict) else {}
        assert Parameters(**params) == scenario.parameters


@pytest.mark.slow
def test_a_shortened_season_runs(tmp_path: Path) -> None:
    season = yaml.safe_load((FOLDER / "season.yaml").read_text())
    season.update(replicates=1, limit_sim_s=4, workers=2)
    (tmp_path / "short.yaml").write_text(yaml.safe_dump(season, sort_keys=False))
    run(tmp_path / "short.yaml", "--output", tmp_path / "out")
    rows = tables.read_runs(tmp_path / "out").to_pylist()
    assert {row["world"] for row in rows} == set(season["worlds"])
    for row in rows:
        assert (row["status"], row["end_reason"]) == (tables.OK, "out of time")
        assert 0.3 < row["way_m"] < 2.0 and row["interventions"] == 0
        assert abs(row["row_width_m"] - (1.0 if row["world"] == "tobacco" else 0.762)) < 0.15
        assert row["energy_j"] > 0


@pytest.mark.slow
def test_the_row_followers_by_camera_see_the_rows_of_young_corn(tmp_path: Path) -> None:
    vision = yaml.safe_load((FOLDER / "vision.yaml").read_text())
    early_corn = {"scenario": "early_corn", "options": {"row_length_m": 4.0}}
    vision["controllers"].pop("lidar")
    vision.update(worlds={"early_corn": early_corn}, replicates=1, limit_sim_s=5, workers=1)
    (tmp_path / "short.yaml").write_text(yaml.safe_dump(vision, sort_keys=False))
    run(tmp_path / "short.yaml", "--output", tmp_path / "out")
    rows = tables.read_runs(tmp_path / "out").to_pylist()
    assert {row["controller"] for row in rows} == {"learned", "classical"}
    for row in rows:
        assert (row["status"], row["end_reason"]) == (tables.OK, "out of time")
        assert row["way_m"] > 1.0 and row["interventions"] == 0
        assert row["lateral_rms_m"] < 0.05 and row["heading_rms_rad"] < 0.1


def test_a_script_is_played_and_then_finished() -> None:
    controller = scripted.make({"commands": [[1.0, 0.5, 0.0], [0.5, 0.0, 1.0]]}, None, 0)
    answers = [controller.step({}, 10.0 + at_s) for at_s in (0.0, 0.99, 1.0, 1.49)]
    assert answers == [(0.5, 0.0), (0.5, 0.0), (0.0, 1.0), (0.0, 1.0)]
    assert not controller.is_finished
    assert controller.step({}, 11.5) == (0.0, 0.0) and controller.is_finished
    controller.reset()
    assert controller.step({}, 20.0) == (0.5, 0.0) and not controller.is_finished
