# SPDX-License-Identifier: MIT
"""Tests static models, and the environment hook."""

import subprocess
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import pytest

HOOK = "env-hooks/20.ardee_models.sh"


@pytest.mark.parametrize("name", ["ground_plane", "sun"])
def test_static_models_are_whole(share, name):
    config = ElementTree.parse(share / "models" / name / "model.config").getroot()
    sdf = ElementTree.parse(share / "models" / name / config.findtext("sdf")).getroot()
    assert config.findtext("name") == name == sdf[0].get("name")


def test_static_models_are_found_by_what_the_package_exports(package):
    """Worlds include them even if a user's GAZEBO_MODEL_PATH replaces the hook's."""
    manifest = ElementTree.parse(package / "package.xml").getroot()
    exported = manifest.find("export/gazebo_ros").get("gazebo_model_path")
    folder = exported.replace("${prefix}", str(package))
    assert {"ground_plane", "sun"} <= {path.name for path in Path(folder).iterdir()}


def test_ground_plane_grips_as_gazebos_does(share):
    root = ElementTree.parse(share / "models/ground_plane/model.sdf").getroot()
    assert root.findtext(".//mu") == "100" and root.findtext(".//mu2") == "50"
    assert [e.text for e in root.iter("size")] == ["100 100", "100 100"]


@pytest.mark.parametrize("user", ["", "/home/me/models"])
def test_hook_appends_once_and_keeps_the_users_paths(package, user):
    script = f'set -u; . "{package / HOOK}"; . "{package / HOOK}"; echo "$GAZEBO_MODEL_PATH $GAZEBO_RESOURCE_PATH"'
    environment = {"CATKIN_ENV_HOOK_WORKSPACE": "/ws", "PATH": "/usr/bin:/bin"}
    if user:
        environment.update(GAZEBO_MODEL_PATH=user, GAZEBO_RESOURCE_PATH=user)
    result = subprocess.run(
        ["sh", "-c", script], env=environment, capture_output=True, text=True, check=True
    )
    models, resources = result.stdout.split()
    prefix = f"{user}:" if user else ""
    assert models == f"{prefix}/ws/share/ardee_models/models"
    assert resources == f"{prefix}/ws/share/ardee_models:/ws/share/ardee_models/models"
