# SPDX-License-Identifier: MIT
"""Tests report and compare on tables with effects of known size, and on a small campaign that was run."""
import re
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path
from typing import Dict, List

import numpy as np
import pytest
import synthetic_campaign
from browser import NEEDS, look_at
from scipy import stats
from small_campaign import run, write

from ardee_campaigns import tables
from ardee_campaigns.__main__ import main
from ardee_campaigns.campaign_file import read_campaign
from ardee_campaigns.plan import about, cells
from ardee_campaigns.plots import pyplot
from ardee_campaigns.report import comparison, drives, figures, statistics
from ardee_campaigns.report.runs import Runs, chosen, read
from ardee_common.errors import GeneratorError

COUNT = 400


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Tables of synthetic runs, and their report."""
    made = synthetic_campaign.write(tmp_path_factory.mktemp("synthetic"), COUNT)
    assert main(["report", str(made)]) == 0
    return made


@pytest.fixture(scope="module")
def runs(folder: Path) -> Runs:
    """The runs that did not fail."""
    return read(folder).ok()


@pytest.mark.slow
def test_a_paired_difference_is_found_to_its_size(runs: Runs) -> None:
    found = {one.measure: one for one in statistics.differences(runs, "controller", "one")}
    lateral = found["lateral_rms_m"]
    assert lateral.level == "other" and lateral.pairs > 150
    assert lateral.found.low < synthetic_campaign.SHIFT_M < lateral.found.high
    # The fields differ by more than 5 mm; within a pair that falls out, and 1 mm of noise is left.
    assert lateral.found.high - lateral.found.low < 6e-4
    assert found["collisions"].found.low < 0.0 < found["collisions"].found.high
    assert found["way_m"].found == (0.0, 0.0, 0.0)


def by_seed(runs: Runs) -> Dict[int, np.ndarray]:
    return {seed: runs["lateral_rms_m"][runs["seed"] == seed] for seed in set(runs["seed"])}


def test_worlds_are_compared_without_pairs(runs: Runs) -> None:
    found = {one.measure: one for one in statistics.differences(runs, "world", "corn")}
    one, other = (
        np.array([parts[seed].mean() for seed in sorted(parts)])
        for parts in (by_seed(runs.where(runs["world"] == name)) for name in ("corn", "sorghum"))
    )
    assert found["lateral_rms_m"].pairs is None
    for bound_m in found["lateral_rms_m"].found[1:]:
        shifted = stats.ttest_ind(other - bound_m, one, equal_var=False)
        assert shifted.pvalue == pytest.approx(0.05)


def test_runs_in_one_field_count_once_in_a_mean(runs: Runs) -> None:
    corn = runs.where(runs["world"] == "corn")
    means = [part[np.isfinite(part)].mean() for part in by_seed(corn).values()]
    assert len(means) < len(corn) / 2
    found = statistics.field_mean(corn, "lateral_rms_m")
    assert found == pytest.approx(statistics.mean_interval(means))


def crossed(rng: np.random.Generator) -> Runs:
    """Returns runs of 5 fields, 6 values of x and 2 controllers; both have other effects y and z in each field."""
    field, x, other = (part.ravel() for part in np.indices((5, 6, 2)))
    own, effect = rng.normal(size=(2, 5))
    noise = 0.5 * rng.normal(size=(2, 60))
    columns = {
        "run_id": np.arange(60).astype(str),
        "world": np.full(60, "w", dtype=object),
        "controller": np.array(["a", "b"], dtype=object)[other],
        "factor_x": x.astype(float),
        "replicate": field,
        "seed": field,
        "y": own[field] + effect[field] * other + noise[0],
        "z": own[field] + effect[field] * x + noise[1],
    }
    return Runs("", columns, ["world", "controller", "factor_x"], ["y", "z"])


def test_intervals_over_fields_cover_as_they_say() -> None:
    """In 400 experiments of 5 fields, 95 % are covered, within 3.9 standard errors (99.99 %)."""
    rng, shares = np.random.default_rng(1), np.zeros(2)
    for _ in range(400):
        runs = crossed(rng)
        difference = statistics.differences(runs, "controller", "a")[0]
        assert (difference.pairs, difference.fields) == (30, 5)
        both = (difference.found, statistics.slope(runs, "factor_x", "z"))
        shares += [found.low <= 0.0 <= found.high for found in both]
    assert (np.abs(shares / 400 - 0.95) < 3.9 * np.sqrt(0.95 * 0.05 / 400)).all()


def test_runs_in_one_field_count_once() -> None:
    """Differences of 1 and 3 in the first field and of 6 in the second are 2 and 6: mean 4, standard error 2."""
    columns = {
        "run_id": np.arange(6).astype(str),
        "world": np.full(6, "w", dtype=object),
        "controller": np.array(list("ababab"), dtype=object),
        "factor_x": np.array([1.0, 1.0, 2.0, 2.0, 1.0, 1.0]),
        "replicate": np.array([0, 0, 0, 0, 1, 1]),
        "seed": np.array([7, 7, 7, 7, 8, 8]),
        "y": np.array([0.0, 1.0, 0.0, 3.0, 0.0, 6.0]),
    }
    runs = Runs("", columns, ["controller", "factor_x"], ["y"])
    (found,) = statistics.differences(runs, "controller", "a")
    reach = 2.0 * np.tan(0.475 * np.pi)  # Student's of one degree of freedom
    assert found[2:6] == (3, 2, 0.0, 4.0)
    assert found.found == pytest.approx((4.0, 4.0 - reach, 4.0 + reach))
    (alone,) = statistics.differences(runs.where(runs["seed"] == 7), "controller", "a")
    assert alone.fields == 1 and alone.found.estimate == 2.0 and np.isnan(alone.found.low)


def test_shares_of_variance_and_slopes() -> None:
    rng = np.random.default_rng(0)
    x = rng.random(200)
    columns = {
        "run_id": np.arange(200).astype(str),
        "factor_x": x,
        "controller": np.array(["a", "b"] * 100, dtype=object),
        "world": np.full(200, "w", dtype=object),
        "seed": np.repeat(np.arange(10), 20),
        "y": 2.0 * x + 0.01 * rng.normal(size=200),
        "z": np.array([0.0, 1.0] * 100),
    }
    runs = Runs("", columns, ["controller", "factor_x"], ["y", "z"])
    slope = statistics.slope(runs, "factor_x", "y")
    assert slope.low < 2.0 < slope.high and slope.high - slope.low < 0.02
    assert statistics.share_of_variance(runs, "factor_x", "y") > 0.99
    assert statistics.share_of_variance(runs, "controller", "z") == pytest.approx(1.0)
    assert statistics.share_of_variance(runs, "controller", "y") < 0.05


def test_points_of_a_latin_hypercube_are_a_scale_however_few() -> None:
    x = np.repeat(np.arange(6) / 7.0, 4)
    columns = {
        "run_id": np.arange(24).astype(str),
        "controller": np.array(["a", "b"] * 12, dtype=object),
        "world": np.full(24, "w", dtype=object),
        "factor_x": x,
        "factor_w": np.repeat(np.array([3.0, 1.0, 2.0, 6.0, 5.0, 4.0]), 4),
        "replicate": np.tile([0, 0, 1, 1], 6),
        "seed": np.tile([7, 7, 8, 8], 6),
        "y": 2.0 * x + 0.01 * np.random.default_rng(0).normal(size=24),
    }
    runs = Runs("", columns, ["controller", "factor_x", "factor_w"], ["y"])
    assert statistics.is_scale(runs, "factor_x") and not statistics.is_scale(runs, "controller")
    slope = statistics.slope(runs, "factor_x", "y")
    assert slope.low < 2.0 < slope.high and slope.high - slope.low < 0.3
    crossed = Runs(
        "", {**columns, "factor_w": 0.0 * x}, ["controller", "factor_x", "factor_w"], ["y"]
    )
    assert not statistics.is_scale(crossed, "factor_x")


def test_a_factor_of_low_and_high_is_a_scale_however_few_its_points(tmp_path: Path) -> None:
    factors = {"speed_m_s": {"low": 0.2, "high": 0.5}, "turn_rad_s": [0.0, 0.1, 0.2]}
    file = write(tmp_path, factors=factors, plan={"kind": "latin_hypercube", "points": 6})
    campaign = read_campaign(file)
    kinds = {name: tables.pa.float64() for name in factors}
    schema = tables.runs_schema(kinds, ["y"], about(campaign))
    rows = [
        tables.RunRow(f"{n}", "tiny", "tsv1", cell.controller, dict(cell.factors), 0, 7, tables.OK)
        for n, cell in enumerate(cells(campaign)[:6])
    ]
    tables.write_runs(tmp_path, [replace(row, measures={"y": 0.0}) for row in rows], schema)
    runs = read(tmp_path).ok()
    assert len(runs) == 6 and statistics.is_scale(runs, "factor_speed_m_s")
    pair = runs.where(runs["factor_speed_m_s"] < sorted(runs["factor_speed_m_s"])[3])
    alone = replace(pair, factors=["factor_speed_m_s"])  # with nothing else that varies
    assert statistics.is_scale(alone, "factor_speed_m_s")


def test_an_interquartile_mean_leaves_out_the_ends() -> None:
    values = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 1000.0])
    found = statistics.iqm(values, ["w"] * 8)
    assert found.estimate == 4.5 and found.low < 4.5 < found.high
    assert statistics.iqm(values, ["w"] * 8) == found  # seeded
    # Each world keeps its runs: where all runs of a world are alike, nothing varies.
    assert statistics.iqm(np.array([1.0, 1.0, 3.0, 3.0]), list("aabb"))[1:] == (2.0, 2.0)
    assert np.isnan(statistics.iqm(np.array([1.0, np.nan]), list("ab")).estimate)


def test_a_rate_has_the_interval_of_poisson(runs: Runs) -> None:
    part = runs.where(np.arange(10))
    part.columns["collisions"][:] = [1.0] + [0.0] * 9
    count, way_m, rate = statistics.rate_per_100_m(part, "collisions")
    assert (count, way_m) == (1, 100.0)
    assert rate == pytest.approx((1.0, 0.0253, 5.572), abs=1e-3)  # Garwood's for a count of 1


def test_the_worst_runs_come_first(runs: Runs) -> None:
    order = statistics.order_by(runs, None)
    steps = runs["interventions"][order]
    assert (np.diff(steps) <= 0).all() and steps[0] > 0
    alike = order[steps == steps[0]]
    assert (np.diff(runs["collisions"][alike]) <= 0).all()
    by_way = statistics.order_by(runs, "way_m")
    assert len(set(by_way.tolist())) == len(runs)


def test_runs_are_chosen_by_conditions(folder: Path) -> None:
    part = chosen(read(folder), ["world=corn", "speed_m_s=0.3"])
    assert set(part["world"]) == {"corn"} and set(part["factor_speed_m_s"]) == {0.3}
    for text, message in (("corn", "NAME=VALUE"), ("x=1", "known"), ("world=x", "corn")):
        with pytest.raises(GeneratorError, match=f"--where: .*{message}"):
            chosen(read(folder), [text])


def test_levels_are_told_apart_by_all_their_digits() -> None:
    levels = [0.1234567, 0.1234568, 6.0]
    columns = {
        "run_id": np.array(list("abc")),
        "factor_x": np.array(levels),
        "factor_kind": np.array(["1", "x", "x"], dtype=object),
    }
    runs = Runs("", columns, ["factor_x", "factor_kind"], [])
    for text, run_id in (("x=0.1234567", "a"), ("x=0.1234568", "b"), ("x=6", "c"), ("kind=1", "a")):
        assert chosen(runs, [text])["run_id"].tolist() == [run_id]
    assert comparison.base_level(runs, "factor_x", "0.1234568") == levels[1]
    with pytest.raises(GeneratorError, match="'0.123457'.* 0.1234567, 0.1234568, 6"):
        chosen(runs, ["x=0.123457"])


class Parts(HTMLParser):
    """Parts of a page."""

    def __init__(self, page: Path) -> None:
        super().__init__()
        self.tags: Dict[str, List[dict]] = {}
        self.feed(page.read_text())

    def handle_starttag(self, tag: str, attrs: list) -> None:
        self.tags.setdefault(tag, []).append(dict(attrs))


def test_the_page_has_all_sections_and_needs_nothing_else(folder: Path) -> None:
    text, parts = (folder / "report.html").read_text(), Parts(folder / "report.html")
    for heading in ("Failed runs", "Means", "Interquartile means", "Distributions", "Effects"):
        assert f"<h2>{heading}</h2>" in text
    assert "wheel 49 &lt;came&gt; off" in text and "came" not in parts.tags
    assert text.count("&lt;came&gt;") == COUNT // synthetic_campaign.FAILED_EVERY
    # distributions, offsets, effects; two factors; a usual run and three worst ones, two figures each
    assert len(parts.tags["img"]) == 3 + 2 + 4 * 2
    assert all(one["src"].startswith("data:image/png;base64,") for one in parts.tags["img"])
    assert not re.search(r"(src|href)=\"(?!data:)", text) and "script" not in parts.tags
    assert "Without pictures:" in text and "--replay" in text


def test_the_markdown_has_the_same_tables_and_pictures_beside_it(folder: Path) -> None:
    text = (folder / "report.md").read_text()
    pictures = re.findall(r"!\[.*\]\((.*)\)", text)
    assert len(pictures) == len(Parts(folder / "report.html").tags["img"])
    assert all((folder / name).is_file() for name in pictures)
    assert "wheel 49 \\<came> off" in text
    assert re.search(r"\| lateral_rms_m \| \d+ \| 100 \| 0.0395 \| 0.0595 \| \+0.02 \|", text)


@pytest.mark.slow
@NEEDS
def test_a_browser_shows_the_report(folder: Path) -> None:
    seen = look_at(folder / "report.html")
    assert not seen.complaints
    for color in (*figures.COLORS[:2], drives.RAW, drives.SEEN):
        assert seen.has(color) > 100, color
    assert seen.has("#1c2733") > 1000  # text


@pytest.mark.slow
def test_the_same_tables_give_the_same_page(folder: Path, tmp_path: Path) -> None:
    page = (folder / "report.html").read_bytes()
    assert main(["report", str(folder), "--output", str(tmp_path)]) == 0
    assert (tmp_path / "report.html").read_bytes() == page


def test_a_base_of_a_scale_is_refused(tmp_path: Path, capsys: pytest.CaptureFixture) -> None:
    speeds = [0.1 * number for number in range(9)]
    rows = [
        replace(row, factors={"speed_m_s": speeds[number % 9]})
        for number, row in enumerate(synthetic_campaign.rows(27))
    ]
    schema = tables.runs_schema({"speed_m_s": tables.pa.float64()}, synthetic_campaign.MEASURES, {})
    tables.write_runs(tmp_path, rows, schema)
    with pytest.raises(SystemExit) as ended:
        main(["compare", str(tmp_path), "--by", "speed_m_s", "--base", "0.1"])
    assert ended.value.code == 2 and "--base: found '0.1' for speed_m_s" in capsys.readouterr().err


def test_compare_prints_and_writes(folder: Path, capsys: pytest.CaptureFixture) -> None:
    words = ["compare", str(folder), "--by", "speed_m_s", "--base", "0.6", "--where", "world=corn"]
    assert main(words) == 0
    printed = capsys.readouterr().out
    assert "speed_m_s 0.6 (the first) and 0.3 (the other):" in printed
    assert printed.endswith(f"\n{folder}/compare_speed_m_s.md\n")
    written = (folder / "compare_speed_m_s.md").read_text()
    assert written in printed and (folder / "compare_speed_m_s.png").is_file()


@pytest.mark.parametrize(
    "words, message",
    [
        (["report", "/nowhere"], "/nowhere/runs.parquet: found no such file"),
        (["report", "FOLDER", "--worst-by", "lateral"], "did you mean 'lateral_rms_m'?"),
        (["compare", "FOLDER", "--by", "speed"], "did you mean 'speed_m_s'?"),
        (["compare", "FOLDER", "--by", "robot"], "found 1 values in the 392 runs"),
        (["compare", "FOLDER", "--base", "mine"], "--base: found 'mine', known: one, other"),
        (["compare", "FOLDER", "--where", "world=x"], "--where: world: found 'x'"),
    ],
)
def test_bad_input_is_named_in_a_line(
    folder: Path, words: List[str], message: str, capsys: pytest.CaptureFixture
) -> None:
    with pytest.raises(SystemExit) as ended:
        main([word.replace("FOLDER", str(folder)) for word in words])
    printed = capsys.readouterr().err
    assert ended.value.code == 2 and message in printed and printed.count("\n") == 1


def test_a_campaign_of_failures_alone_is_reported(tmp_path: Path) -> None:
    rows = [row for row in synthetic_campaign.rows(100) if row.status == tables.FAILED]
    schema = tables.runs_schema({"speed_m_s": tables.pa.float64()}, synthetic_campaign.MEASURES, {})
    tables.write_runs(tmp_path, rows, schema)
    assert main(["report", str(tmp_path)]) == 0
    assert "2 runs, 2 of them failed" in (tmp_path / "report.md").read_text()


@pytest.mark.slow
def test_a_run_campaign_is_reported_with_pictures(tmp_path: Path) -> None:
    file = write(tmp_path, replicates=1)
    run(file, "--output", tmp_path / "out")
    assert main(["report", str(tmp_path / "out"), "--worst", "1", "--worst-by", "distance_m"]) == 0
    text = (tmp_path / "out" / "report.md").read_text()
    row = min(tables.read_runs(tmp_path / "out").to_pylist(), key=lambda row: row["distance_m"])
    assert f"1. {row['run_id']}" in text and f"--replay {row['run_id']}" in text
    picture = pyplot.imread(str(tmp_path / "out" / "report_pictures" / "worst_1_pictures.png"))
    assert picture.shape[0] == 240 and picture.shape[1] > 3 * 320
    parts = [picture[:, place : place + 320, :3] for place in range(0, 3 * 324, 324)]
    assert all(part.std() > 0.05 for part in parts)  # something is seen
    assert np.abs(parts[0] - parts[2]).mean() > 0.01  # of different places
