# SPDX-License-Identifier: MIT
"""Runs scripts/benchmark on the smallest field: every figure is there but the bridge's. Their values are not tested."""
import json
import math
import pathlib
import subprocess
from typing import Dict

import benchmark_bridge
import benchmark_field
import benchmark_python
import benchmark_run
import benchmark_table

SCRIPTS = pathlib.Path(__file__).resolve().parents[1] / "scripts"


def run(*arguments: str) -> subprocess.CompletedProcess:
    """Runs the benchmark, in the workspace that the tests run in."""
    command = ["/usr/bin/python3", str(SCRIPTS / "benchmark_run.py"), *arguments]
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)


def test_every_figure_is_measured(tmp_path: pathlib.Path) -> None:
    path = tmp_path / "figures.json"
    kinds = ",".join(
        kind for kind in benchmark_run.KINDS if kind != "bridge"
    )  # test_bridge_benchmark has it
    brief = ("--only", kinds, "--brief", "--repeat", "1", "--window-s", "0.5")
    done = run("--plants", "200", *brief, "--json", str(path))
    assert done.returncode == 0, done.stderr
    figures = json.loads(path.read_text())["plants"]["200"]
    for row in benchmark_table.ROWS:
        value = benchmark_table.value_at(figures, row.path)
        assert value is not None and math.isfinite(value) and value > 0.0, row.text
        assert row.text in done.stdout
    # The robot drove, and its scans arrived.
    assert 0.3 < figures["node"]["speed_m_s"] < 0.6
    assert 35.0 < figures["node"]["scans_per_simulated_s"] < 45.0
    # Rays of engine and Embree have equal hits.
    assert figures["lidar"]["flat_agreement"] > 0.99
    assert figures["engine"]["placements"] == 201
    python = json.loads(path.read_text())["python"]
    assert set(python) == set(benchmark_python.ROWS)
    assert all(value > 0.0 for name, value in python.items() if name != "overhead_percent")
    assert all(text in done.stdout for text, *_ in benchmark_python.ROWS.values())


def test_bad_arguments_are_named() -> None:
    done = run("--only", "start,nonsense")
    assert done.returncode == 2
    assert "found 'nonsense', expected some of start,physics,lidar,camera,rtf" in done.stderr


def test_fields_are_whole_and_about_square() -> None:
    for plants in (200, 2_000, 20_000, 100_000, 200_000):
        rows = benchmark_field.rows_of(plants)
        assert plants % rows == 0 and rows % 2 == 0
        length_m = plants / rows * benchmark_field.STALK_SPACING_M
        assert 0.3 < rows * benchmark_field.ROW_SPACING_M / length_m < 3.0


def test_medians_and_missed_budgets() -> None:
    repetitions = [{"node": {"start_s": value}} for value in (0.5, 3.5, 3.2)]
    figures = benchmark_table.medians(repetitions)
    assert figures == {"node": {"start_s": 3.2}}
    start = benchmark_table.ROWS[0]
    assert start.cell(200, figures, figures) == "3.20 (<= 1.00) !"
    assert start.cell(20_001, figures, figures) == "3.20 (<= 10.00)  "
    assert start.cell(200_001, figures, figures) == "3.20  "
    assert start.cell(200, {}, {}) == "-"


def test_a_figure_of_python_that_misses_its_budget_is_marked() -> None:
    slow, quick, late = benchmark_python.lines(
        {"steps_per_s": 399.0, "camera_steps_per_s": 30.0, "reset_ms": 20.1}
    )
    assert slow.endswith("399 (>= 400) !") and quick.endswith("30 (>= 30)")
    assert late.endswith("20.1 (<= 20.0) !")


def spread_of(p99_ms: float, lost: int = 0) -> Dict[str, float]:
    """Returns the spread of a bridge's row of one run."""
    return dict(p50_ms=0.5, p99_ms=p99_ms, max_ms=p99_ms + 0.5, sent=100, lost=lost)


def test_the_floor_has_no_budget() -> None:
    late = benchmark_bridge.medians([{"": spread_of(7.5)}])[""]
    names = ("imu message to datagram", "simulated, bare forwarder message to datagram")
    imu, floor = benchmark_bridge.lines({name: late for name in names})
    assert "99th percentile 7.50 ms (<= 5.00), most" in imu and imu.endswith("lost !")
    assert "99th percentile 7.50 ms, most" in floor and floor.endswith("0 of 100 lost")


def test_images_and_clouds_have_a_budget_of_their_own() -> None:
    late = benchmark_bridge.medians([{"": spread_of(19.0)}, {"": spread_of(19.0)}])[""]
    names = ("beside cameras, raw image message to datagram", "point_cloud message to datagram")
    for line in benchmark_bridge.lines({name: late for name in names}):
        assert "(<= 20.00)" in line and line.endswith(" lost")


def test_a_bridge_row_without_messages_is_missed() -> None:
    nothing = {"imu": benchmark_bridge.NOTHING}
    early, late = {"imu": spread_of(0.8)}, {"imu": spread_of(0.9)}
    for runs in ([nothing], [late, nothing, early], [nothing, late], [late, {}, early]):
        found = benchmark_bridge.medians(runs)
        tails = [found["imu"]["p99_ms"], *found["imu"]["p99_range_ms"], found["imu"]["max_ms"]]
        assert all(map(math.isnan, tails))
        (imu,) = benchmark_bridge.lines(found)
        assert imu.endswith(" lost !")


def test_repeated_bridge_rows_are_medians_over_all_losses() -> None:
    runs = [spread_of(0.9), spread_of(4.0, lost=1), spread_of(1.1)]
    found = benchmark_bridge.medians([{"imu": run} for run in runs])
    assert found["imu"] == dict(
        p50_ms=0.5, p99_ms=1.1, p99_range_ms=[0.9, 4.0], max_ms=4.5, sent=300, lost=1
    )
    (line,) = benchmark_bridge.lines(found)
    assert "99th percentile 1.10 of 0.90 to 4.00 ms (<= 5.00), most 4.50 ms" in line
    assert line.endswith("1 of 300 lost !")
