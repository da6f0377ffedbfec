# SPDX-License-Identifier: MIT
"""Tests scripts/setup from a shell with other workspaces sourced: another checkout's, and a user's own."""
import os
import pathlib
import shutil
import subprocess

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[1]
STAND_INS = {path.name for path in (ROOT / "compat").iterdir()}

pytestmark = pytest.mark.skipif(
    not (ROOT / "src" / "xacro").is_symlink(), reason="this machine has an xacro of its own"
)


@pytest.fixture
def checkout(tmp_path: pathlib.Path) -> pathlib.Path:
    """Returns the part of a checkout that setting up needs, without access to PyPI."""
    folder = tmp_path / "checkout"
    for name in ("scripts", "compat"):
        shutil.copytree(ROOT / name, folder / name)
    (folder / "src").mkdir()
    for modules in ROOT.glob("pydeps*"):
        (folder / modules.name).symlink_to(modules)
    return folder


def run(script: str, **env: str) -> str:
    """Returns the output of a line of bash in an environment that has sourced only `env`."""
    bare = {name: os.environ[name] for name in ("HOME", "PATH")}
    command = ["/bin/bash", "-euc", script]
    return subprocess.check_output(command, env={**bare, **env}, text=True)


def test_a_users_own_package_counts_and_another_checkouts_stand_ins_do_not(
    checkout: pathlib.Path,
) -> None:
    own = checkout.parent / "own" / "src" / "xacro"
    own.mkdir(parents=True)
    (own / "package.xml").write_text("<package><name>xacro</name></package>")
    path = f"{own.parent}:{ROOT}/src:/usr/share"
    run(f"{checkout}/scripts/setup", ROS_PACKAGE_PATH=path)
    linked = {path.name for path in (checkout / "src").iterdir() if path.is_dir()}
    assert linked == STAND_INS - {"xacro"}


@pytest.mark.parametrize("name", ["CMAKE_PREFIX_PATH", "PYTHONPATH", "GAZEBO_MODEL_PATH"])
def test_another_checkout_and_an_install_space_do_not_lie_below_this_one(
    checkout: pathlib.Path, name: str
) -> None:
    (checkout / "src" / "ardee_sim_cpp").mkdir()
    installed = checkout.parent / "installed"
    (installed / "share" / "ardee_sim_cpp").mkdir(parents=True)
    kept = f"{checkout}/devel/lib:/opt/ros/noetic:/own/devel:/own/src/models"
    print_it = f"source {checkout}/scripts/common.bash; echo ${{{name}-unset}}"
    assert (
        run(print_it, **{name: f"{ROOT}/devel/lib:{kept}:{installed}/lib:{ROOT}/src/a/b"}).strip()
        == kept
    )
    assert run(print_it, **{name: f"{ROOT}/devel:{installed}"}).strip() == "unset"
