# SPDX-License-Identifier: MIT
"""Tests controllers that are programs of their own, over UDP in real time."""
import sys
from pathlib import Path
from typing import Any

import pytest
import small_campaign
from small_campaign import run, write

from ardee_bridge.wire import codec
from ardee_campaigns import tables, udp
from ardee_campaigns.campaign_file import read_campaign
from ardee_campaigns.plan import Planner
from ardee_common.errors import GeneratorError

LIMITS = codec.MAX_SPEED_M_S, codec.MAX_YAW_RATE_RAD_S
PROGRAM = [sys.executable, str(small_campaign.HERE / "udp_program.py"), "{bind}", "{controls}"]


def controller(*words: str, **params: Any) -> dict:
    return {"kind": "udp", "command": [*PROGRAM, *words], "params": params}


@pytest.mark.slow
def test_a_program_drives_and_one_that_ends_fails_its_run(tmp_path: Path) -> None:
    controllers = {
        "lasts": controller("{speed_m_s}", "1000", speed_m_s=0.5),
        "ends": controller("0.5", "10"),
        "same": small_campaign.CAMPAIGN["controllers"]["straight"],
    }
    file = write(tmp_path, controllers=controllers, replicates=1)
    run(file, "--output", tmp_path / "out")
    found = {row["controller"]: row for row in tables.read_runs(tmp_path / "out").to_pylist()}
    assert found["lasts"]["status"] == tables.OK
    kept = tables.read_run(tmp_path / "out", found["lasts"]["run_id"])
    assert set(kept.samples["left_seen_m"].to_pylist()) == {0.4}  # as the program prints
    count = len(kept.about["latency_ms"]) + kept.about["unanswered"] + 1  # and the first scan
    assert count == len(kept.samples) and min(kept.about["latency_ms"]) > 0.0
    assert found["lasts"]["distance_m"] == pytest.approx(found["same"]["distance_m"], abs=0.05)
    assert found["ends"]["status"] == tables.FAILED
    assert found["ends"]["error"].endswith("has ended with exit code 0")
    timings = {row["run_id"]: row for row in tables.read_timings(tmp_path / "out").to_pylist()}
    assert timings[found["lasts"]["run_id"]]["wall_s"] > found["lasts"]["sim_s"]


@pytest.mark.parametrize(
    "keys, said",
    [
        ({"kind": "udp"}, "found no command"),
        ({"kind": "udp", "command": ["no_such_program"]}, "found no program 'no_such_program'"),
        ({"kind": "udp", "command": ["true", "{port}"]}, "expected {bind}, {sensors}, {controls}"),
        (controller(speed_m_s=1), "params: found 'speed_m_s'"),
        (controller(bind="here:1"), "params: found 'bind', expected another name"),
        ({"kind": "udp", "command": ["true"], "factory": "a:b"}, "found factory and kind udp"),
        ({"kind": "tcp"}, "expected one of python, udp, ros"),
    ],
)
def test_a_program_that_cannot_be_meant_is_refused(tmp_path: Path, keys: dict, said: str) -> None:
    file = write(tmp_path, controllers={"a": keys})
    with pytest.raises(GeneratorError) as caught:
        Planner(read_campaign(file))
    assert said in str(caught.value) and str(caught.value).startswith(f"{file}:")


def test_a_command_beyond_the_limits_is_the_limit() -> None:
    motion = codec.MotionCommands(
        normalized_speed=2_000_000, normalized_yaw_rate=-5_000_000, multiplier=1_000_000
    )
    assert udp._motion(motion) == (LIMITS[0], -LIMITS[1])
