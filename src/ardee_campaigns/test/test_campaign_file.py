# SPDX-License-Identifier: MIT
"""Tests the campaign's file, the plan that it gives, and what is refused before the first run."""
import itertools
import math
from datetime import date
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Dict

import numpy as np
import pytest
import small_campaign
from PIL import Image

from ardee_campaigns import controllers
from ardee_campaigns.campaign_file import CampaignKeys, ControllerKeys, read_campaign
from ardee_campaigns.controllers import source_digest
from ardee_campaigns.plan import Planner, cells, seed_of
from ardee_campaigns.program import files_of
from ardee_campaigns.run import sow
from ardee_campaigns.run_campaign import half_width
from ardee_common.errors import GeneratorError


def test_short_forms_stand_for_long_ones(tmp_path: Path) -> None:
    worlds = {"a": "corn", "b": "my.world", "c": "tiny.yaml"}
    file = small_campaign.write(tmp_path, worlds=worlds, factors={"speed_m_s": [0.2, 1]})
    campaign = read_campaign(file)
    assert campaign.worlds["a"].scenario == "corn"
    assert campaign.worlds["b"].world == "my.world"
    assert campaign.worlds["c"].field == "tiny.yaml"
    assert campaign.factors["speed_m_s"].values == (0.2, 1)
    assert campaign.robots["tsv1"].model == "tsv1_default"


def test_a_factorial_plan_has_all_combinations(tmp_path: Path) -> None:
    factors = {"speed_m_s": [0.2, 0.4], "turn_rad_s": {"values": [0, 1, 2]}}
    found = cells(read_campaign(small_campaign.write(tmp_path, factors=factors)))
    assert len(found) == len(set(found)) == 2 * 2 * 3
    wanted = set(itertools.product([0.2, 0.4], [0, 1, 2]))
    assert {tuple(value for _, value in cell.factors) for cell in found} == wanted


def test_a_latin_hypercube_has_one_point_in_each_part_of_each_range(tmp_path: Path) -> None:
    factors = {"speed_m_s": {"low": 0.2, "high": 1.0}, "turn_rad_s": [0, 1]}
    plan = {"kind": "latin_hypercube", "points": 8}
    file = small_campaign.write(tmp_path, factors=factors, plan=plan)
    points = [dict(cell.factors) for cell in cells(read_campaign(file))][:8]
    speeds = sorted(point["speed_m_s"] for point in points)
    assert [math.floor((speed - 0.2) / 0.1) for speed in speeds] == list(range(8))
    assert sorted(point["turn_rad_s"] for point in points) == [0] * 4 + [1] * 4
    assert points == [dict(cell.factors) for cell in cells(read_campaign(file))][:8]


def test_points_of_listed_values_that_are_equal_are_one(tmp_path: Path) -> None:
    factors, plan = {"gain": [1, 2]}, {"kind": "latin_hypercube", "points": 4}
    file = small_campaign.write(tmp_path, factors=factors, plan=plan)
    assert len({cell.factors for cell in cells(read_campaign(file))}) == 2
    found = cells(read_campaign(file))
    assert len(found) == len(set(found))


def test_what_a_controller_tells_is_checked() -> None:
    assert controllers.about(SimpleNamespace(about={"scans": 3}), {"width_m"}) == {"scans": 3}
    for told, said in (({"scans": np.int64(3)}, "int64"), ({"width_m": 5.0}, "width_m")):
        with pytest.raises(GeneratorError, match=f"controller's about: .*{said}"):
            controllers.about(SimpleNamespace(about=told), {"width_m"})
    assert controllers.seen(SimpleNamespace(seen=np.array([0.3, 0.4]))) == (0.3, 0.4)
    assert all(map(math.isnan, controllers.seen(SimpleNamespace(seen=None))))
    with pytest.raises(GeneratorError, match="is_finished: found a method"):
        controllers.is_finished(SimpleNamespace(is_finished=lambda: False))


def test_seeds_are_paired_and_runs_are_known_by_their_inputs(tmp_path: Path) -> None:
    planner = Planner(read_campaign(small_campaign.write(tmp_path)))
    jobs = [planner.job(cell, number, tmp_path) for cell in planner.cells for number in range(2)]
    assert len({job.run_id for job in jobs}) == 4
    assert [job.seed for job in jobs[:2]] == [job.seed for job in jobs[2:]]
    assert len({job.seed for job in jobs}) == 2
    changed = Planner(read_campaign(small_campaign.write(tmp_path, limit_sim_s=2)))
    assert changed.job(changed.cells[0], 0, tmp_path).run_id != jobs[0].run_id
    (tmp_path / "tiny.yaml").write_text((tmp_path / "tiny.yaml").read_text() + "seed: 4\n")
    sown = Planner(read_campaign(tmp_path / "campaign.yaml"))
    assert (
        sown.job(sown.cells[0], 0, tmp_path).run_id
        != changed.job(changed.cells[0], 0, tmp_path).run_id
    )
    one, other = CampaignKeys(seed=1), CampaignKeys(seed=2)
    assert seed_of(one, "a", 0) != seed_of(one, "b", 0) != seed_of(other, "b", 0)


def test_a_first_seed_is_that_of_field_and_noise(tmp_path: Path) -> None:
    planner = Planner(read_campaign(small_campaign.write(tmp_path, first_seed=7)))
    jobs = [planner.job(cell, number, tmp_path) for cell in planner.cells for number in range(2)]
    assert [(job.seed, job.field_seed) for job in jobs] == [(7, 7), (8, 8)] * 2


CONSTANT = "ardee_campaigns.examples.constant:make"
UNTIL = {"kind": "until", "measure": "distance_m", "half_width": 1.0}
REFUSED: Dict[str, Any] = {
    "an unknown key": ({"replicate": 3}, "unknown key 'replicate'"),
    "a last seed that no field has": (
        {"first_seed": 2**31 - 2, "replicates": 3},
        "first_seed: found a last seed above 2147483647",
    ),
    "no controllers": ({"controllers": {}}, "controllers: found none"),
    "an empty factor": ({"factors": {"speed_m_s": []}}, "speed_m_s|values: found []"),
    "a value twice": ({"factors": {"speed_m_s": [1, 1.0]}}, "values: found [1, 1.0]"),
    "a number of more than 64 bit": (
        {"factors": {"speed_m_s": [1, 10**30]}},
        "values: found [1,",
    ),
    "a number that is no float": ({"factors": {"speed_m_s": [10**400]}}, "values: found [1000"),
    "a number and its text": ({"factors": {"speed_m_s": [1, "1"]}}, "values: found [1, '1']"),
    "two numbers of one float": (
        {"factors": {"speed_m_s": [2**53, 2**53 + 1]}},
        "values: found",
    ),
    "a range of no floats": (
        {"factors": {"speed_m_s": {"low": 0, "high": 10**400}}},
        "high: found 1000",
    ),
    "a range in a factorial": (
        {"factors": {"speed_m_s": {"low": 0.1, "high": 0.2}}},
        "which a Latin hypercube needs",
    ),
    "an unknown measure": ({"measures": ["distance"]}, "did you mean 'distance_m'"),
    "a measure that does not import": ({"measures": ["nowhere:slip"]}, "No module named 'nowhere'"),
    "a factory that does not import": (
        {"controllers": {"mine": "nowhere:make"}},
        "No module named 'nowhere'",
    ),
    "a factory that is not there": (
        {"controllers": {"mine": "ardee_campaigns.examples.constant:build"}},
        "has no attribute 'build'",
    ),
    "an unknown parameter": ({"factors": {"sped_m_s": [1]}}, "sped_m_s"),
    "an unknown scenario": ({"worlds": {"a": "korn"}}, "did you mean 'corn'"),
    "a world without file": ({"worlds": {"a": "no.world"}}, "found 'no.world', no such file"),
    "an unknown option of a recipe": (
        {"worlds": {"a": {"field": "tiny.yaml", "options": {"row_spacing": 1}}}},
        "did you mean 'row_spacing_m'",
    ),
    "an option's file that is not there": (
        {"worlds": {"a": {"field": "tiny.yaml", "options": {"weed_image": "no.png"}}}},
        "weed_image: found",
    ),
    "a factor's file that is not there": (
        {"factors": {"weed_image": {"of": "field", "values": ["tiny.yaml", "no.png"]}}},
        "/no.png', no such file",
    ),
    "a folder of models that is not there": (
        {"worlds": {"a": {"field": "tiny.yaml", "options": {"model_path": ["nowhere"]}}}},
        "/nowhere', no such file",
    ),
    "two worlds in one": (
        {"worlds": {"a": {"scenario": "corn", "field": "tiny.yaml"}}},
        "found scenario and field",
    ),
    "an unknown topic": (
        {"robots": {"a": {"topics": {"command": "cmd_vel", "scan": "ardee/hokuio"}}}},
        "did you mean 'ardee/hokuyo'",
    ),
    "an unknown pace": ({"robots": {"a": {"pace": "odometry"}}}, "pace: found 'odometry'"),
    "an unknown pace beside a period": (
        {"robots": {"a": {"pace": "odometry", "period_s": 0.025}}},
        "pace: found 'odometry'",
    ),
    "most_replicates of a factorial": ({"plan": {"most_replicates": 3}}, "most_replicates: found"),
    "an intervention in a free task": (
        {"task": {"kind": "free", "most_interventions": 3}},
        "most_interventions: found it in a task of kind free",
    ),
    "a period of no whole steps": (
        {"robots": {"a": {"period_s": 0.012}}},
        "found a control period of 0.012 s, expected whole steps of 0.005 s",
    ),
    "an unknown robot": ({"robots": {"a": "tsv9"}}, "found no robot 'tsv9'"),
    "a plan without measure": ({"plan": {"kind": "until"}}, "expected measure and half_width"),
    "a column for two measures": (
        {"measures": ["distance_m", "misbehaving:distance_m"]},
        "measures: found 'misbehaving:distance_m', whose column distance_m is there already",
    ),
    "a column that is no measure's": ({"measures": ["misbehaving:seed"]}, "whose column seed is"),
    "an option's text for a number": (
        {"worlds": {"a": {"field": "tiny.yaml", "options": {"row_length_m": "abc"}}}},
        "row_length_m: found 'abc', expected 0 to",
    ),
    "a factor beyond its option's limits": (
        {"factors": {"row_length_m": {"of": "field", "values": [1.0, -2.0]}}},
        "row_length_m: found -2.0, expected",
    ),
    "fractions of a row": (
        {
            "factors": {"rows_per_plot": {"of": "field", "low": 2, "high": 5}},
            "plan": {"kind": "latin_hypercube", "points": 3},
        },
        "expected a whole number",
    ),
    "an option of each run": (
        {"factors": {"seed": {"of": "field", "values": [1, 2]}}},
        "found 'seed', which each run has of its own",
    ),
    "a world that is nothing": ({"worlds": {"a": None}}, "a: found None, expected a mapping"),
    "parameters that are a number": (
        {"worlds": {"a": {"field": "tiny.yaml", "params": {"straight": 3}}}},
        "params: straight: found 3, expected a mapping",
    ),
    "a date": (
        {"controllers": {"mine": {"factory": CONSTANT, "params": {"x": date(2020, 1, 1)}}}},
        "found 2020-01-01 (date), expected numbers",
    ),
    "more replicates than at most": (
        {"plan": {**UNTIL, "most_replicates": 3}, "replicates": 4},
        "replicates: found 4, more than most_replicates 3",
    ),
    "a name that leaves the folder": ({"name": "../evil"}, "name: found '../evil'"),
    "a name with a blank": ({"controllers": {"a b": CONSTANT}}, "found the name 'a b'"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_before_the_first_run_is_refused(tmp_path: Path, case: str) -> None:
    changes, said = REFUSED[case]
    file = small_campaign.write(tmp_path, **changes)
    with pytest.raises(GeneratorError) as caught:
        Planner(read_campaign(file))
    message = str(caught.value)
    assert message.startswith(f"{file}:") and "\n" not in message
    assert message[len(f"{file}:")].isdigit() or "missing" in message
    assert any(part in message for part in said.split("|")), message


def test_files_of_options_lie_beside_the_campaigns_file(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    weeds = {"weed_density_per_m2": 20.0, "weed_image": "grey.png"}
    worlds = {"a": {"field": "tiny.yaml", "options": weeds}}
    factors = {"stone_image": {"of": "field", "values": ["grey.png"]}}
    campaign = read_campaign(small_campaign.write(tmp_path / "c", worlds=worlds, factors=factors))
    Image.new("L", (2, 2), 99).save(tmp_path / "c" / "grey.png")
    monkeypatch.chdir(tmp_path)
    planner = Planner(campaign)
    job = planner.job(planner.cells[0], 0, tmp_path)
    sow(job, tmp_path / "models")
    assert "weed_" in (tmp_path / "models" / "tiny" / "model.sdf").read_text()


def test_a_run_is_known_by_the_files_and_models_of_its_field(tmp_path: Path) -> None:
    model, image = tmp_path / "own" / "my_corn", tmp_path / "stones.png"
    (model / "meshes").mkdir(parents=True)
    options = {"model_path": ["own"], "models": ["my_corn"], "stone_image": "stones.png"}
    worlds = {"a": {"field": "tiny.yaml", "options": options}, "b": "tiny.yaml"}
    for file in (model / "model.config", model / "meshes" / "leaf.obj", image):
        file.touch()
    campaign, found = read_campaign(small_campaign.write(tmp_path, worlds=worlds)), []
    for changed in (None, model / "meshes" / "leaf.obj", image, None):
        if changed:
            changed.write_text("other")
        planner = Planner(campaign)
        found.append([planner.job(cell, 0, tmp_path).run_id for cell in planner.cells[::2]])
    assert len({own for own, _ in found}) == 3 and found[2] == found[3]
    assert len({other for _, other in found}) == 1


def test_the_half_width_of_an_interval_is_students() -> None:
    assert half_width([1.0, 2.0, 3.0]) == pytest.approx(4.302653 / math.sqrt(3.0), rel=1e-6)
    assert half_width([1.0]) == math.inf


def test_a_run_is_known_by_its_measures_and_its_start(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.syspath_prepend(tmp_path)
    worlds = {"a": {"world": "w.world", "field": "tiny.yaml"}}
    file = small_campaign.write(tmp_path, worlds=worlds, measures=["mine_of_test:one"])
    (tmp_path / "w.world").write_text("<sdf version='1.6'><world name='w'/></sdf>")
    made = []
    for start, measure in (("x_m: 0", "1"), ("x_m: 1", "1"), ("x_m: 1", "2")):
        (tmp_path / "w.start.yaml").write_text(start)
        (tmp_path / "mine_of_test.py").write_text(f"def one(run, truth): return {measure}")
        planner = Planner(read_campaign(file))
        made.append(planner.job(planner.cells[0], 0, tmp_path).run_id)
    assert len(set(made)) == 3


def test_a_controller_is_known_by_all_files_of_its_package_and_those_it_imports(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    package, other = tmp_path / "the_package", tmp_path / "other"
    files = [tmp_path / "lone.py", tmp_path / "helper.py", package / "deep/__init__.py"]
    files += [other / "deep/__init__.py"]
    for file in (*files, package / "__init__.py", package / "main.py", other / "__init__.py"):
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text("")
    (tmp_path / ".#lone.py").symlink_to("no_file")  # as Emacs makes of a file that is edited
    files[1].write_text("def f():\n    import other.deep")
    monkeypatch.syspath_prepend(tmp_path)
    found = []
    for changed in (None, *files):
        if changed:
            changed.write_text(f"import helper\n{changed.read_text()}\nx = 1")
        (tmp_path / "unrelated.py").write_text(f"x = '{changed}'")
        keys = [ControllerKeys(factory=f"{name}:make") for name in ("lone", "the_package.main")]
        keys.append(ControllerKeys(kind="udp", command=("python3", str(files[0]))))
        found.append([source_digest(one) for one in keys])
    for lone in [lone for lone, _, _ in found], [program for _, _, program in found]:
        assert len(set(lone)) == 4 and lone[2] == lone[3]
    packaged = [packaged for _, packaged, _ in found]
    assert len(set(packaged)) == 2 and packaged[2] != packaged[3]


def test_a_program_is_known_by_the_files_that_its_command_names_and_those_they_load(
    tmp_path: Path,
) -> None:
    script = tmp_path / "node.py"
    keys = ControllerKeys(kind="ros", command=("python3", str(script), "{speed}"))
    found = []
    for text in ("x = 1", "x = ", "x = 1"):
        script.write_text(text)
        found.append(source_digest(keys))
    assert found[0] == found[2] != found[1]
    script, *loaded = files_of(["rosrun", "ardee_navigation", "row_follower"])
    assert script.parts[-3:] == ("ardee_navigation", "scripts", "row_follower")
    assert {"row_following.launch", "row_follower_node.py"} <= {file.name for file in loaded}
    launch, *_ = files_of(["roslaunch", "--log", "gazebo_ros", "empty_world.launch", "a:=b"])
    assert launch.name == "empty_world.launch"
    assert files_of(["rosrun", "no_package", "node"]) == []
