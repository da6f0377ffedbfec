# SPDX-License-Identifier: MIT
"""A campaign that takes seconds: a field of some plants, controllers that behave or misbehave."""
import os
import subprocess
import sys
from pathlib import Path
from typing import Any, Dict, List

import yaml

HERE = Path(__file__).resolve().parent
RECIPE = {
    "models": ["corn_variant_7"],
    "rows_per_plot": 2,
    "row_length_m": 1.0,
    "stalk_spacing_m": 0.2,
}
CAMPAIGN: Dict[str, Any] = {
    "name": "small",
    "seed": 3,
    "replicates": 2,
    "workers": 1,
    "limit_sim_s": 1.5,
    "worlds": {"tiny": "tiny.yaml"},
    "controllers": {
        "straight": {"factory": "ardee_campaigns.examples.constant:make"},
        "turning": {
            "factory": "ardee_campaigns.examples.constant:make",
            "params": {"turn_rad_s": 0.2},
        },
    },
    "measures": ["distance_m", "lateral_rms_m", "collisions"],
}


def write(folder: Path, **changes: Any) -> Path:
    """Writes campaign and recipe into a folder; returns the campaign's path. A change to None removes a key."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "tiny.yaml").write_text(yaml.safe_dump(RECIPE))
    content = {key: value for key, value in {**CAMPAIGN, **changes}.items() if value is not None}
    file = folder / "campaign.yaml"
    file.write_text(yaml.safe_dump(content, sort_keys=False))
    return file


def command(*arguments: Any) -> List[str]:
    """Returns the command run_campaign with arguments."""
    return [sys.executable, "-m", "ardee_campaigns", "run_campaign", *map(str, arguments)]


def environment() -> Dict[str, str]:
    """Returns an environment in which this folder's controllers can be imported, without ROS."""
    env = {key: value for key, value in os.environ.items() if not key.startswith("ROS_MASTER")}
    env["PYTHONPATH"] = f"{HERE}:{env.get('PYTHONPATH', '')}"
    return env


def run(*arguments: Any, code: int = 0) -> "subprocess.CompletedProcess[str]":
    """Runs the command and checks its exit code."""
    done = subprocess.run(
        command(*arguments), env=environment(), capture_output=True, text=True, timeout=120
    )
    assert done.returncode == code, done.stdout + done.stderr
    return done
