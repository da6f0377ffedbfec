# SPDX-License-Identifier: MIT
"""Tests an install space as a user has it: nothing else sourced, and the checkout hidden below an empty folder."""
import os
import pathlib
import re
import subprocess
from typing import Callable, Iterator, List

import pytest
from PIL import Image

ROOT = pathlib.Path(__file__).resolve().parents[1]
SRC = ROOT / "src"
OWN = sorted(path.parent.name for path in SRC.glob("*/package.xml") if not path.parent.is_symlink())
# What builds a package's own files, and is of no use without the checkout
FOR_BUILDING = {"generate_wire_files"}
# An unprivileged user mounts in a user namespace of its own, if the kernel allows one.
NAMESPACE = ["unshare", "--mount"] + ["--map-root-user"] * (os.geteuid() != 0)
Shell = Callable[..., str]


def checked(command: List[object], **options: object) -> str:
    """Runs a command and returns its output; fails with that output if the command fails."""
    words = [str(word) for word in command]
    done = subprocess.run(
        words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options
    )
    assert done.returncode == 0, f"{words}\n{done.stdout}"
    return done.stdout


@pytest.fixture(scope="module")
def prefix(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """Returns a folder into which all packages are installed."""
    folder = tmp_path_factory.mktemp("install") / "prefix"
    env = {name: os.environ[name] for name in ("HOME", "PATH")}
    checked([ROOT / "scripts" / "build", "-j1", "--install", folder], env=env)
    return folder


@pytest.fixture(scope="module")
def shell(prefix: pathlib.Path) -> Iterator[Shell]:
    """Returns a function that runs a line of bash in a folder of its own, with the install space sourced."""
    home, empty = prefix.with_name("home"), prefix.with_name("empty")
    home.mkdir()
    empty.mkdir()
    may_hide = subprocess.run([*NAMESPACE, "true"], stderr=subprocess.DEVNULL).returncode == 0
    hide = [*NAMESPACE, "bash", "-ec", f'mount --bind {empty} {ROOT}; exec "$@"', "hidden"]
    env = {"HOME": str(home), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8", "ROS_IP": "127.0.0.1"}
    env["ROS_MASTER_URI"] = "http://127.0.0.1:1"  # no master: what needs one starts its own

    def run(line: str) -> str:
        script = f"source {prefix}/setup.bash; set -euo pipefail; {line}"
        command = [*(hide if may_hide else []), "bash", "-c", script]
        return checked(command, env=env, cwd=home, timeout=300)

    run.home = home
    yield run


def installed(file: pathlib.Path, prefix: pathlib.Path) -> pathlib.Path:
    """Returns where a file of a package is to be found in the install space."""
    package, kind, *rest = file.relative_to(SRC).parts
    if kind == "src":
        return prefix.joinpath("lib/python3/dist-packages", *rest)
    if kind == "scripts":
        return prefix.joinpath("lib", package, *rest)
    return prefix.joinpath("share", package, kind, *rest)


def test_what_the_packages_hold_is_installed(prefix: pathlib.Path) -> None:
    kinds = "config examples fields launch media meshes models rviz robots terrains urdf worlds"
    patterns = [f"{kind}/**/*" for kind in kinds.split()] + ["src/**/*.py"]
    files = {f for name in OWN for kind in patterns for f in (SRC / name).glob(kind) if f.is_file()}
    scripts = {f for name in OWN for f in (SRC / name / "scripts").glob("*") if "." not in f.name}
    scripts = {f for f in scripts if f.is_file() and f.name not in FOR_BUILDING}
    files = {f for f in files if "__pycache__" not in f.parts}
    missing = [str(f) for f in sorted(files | scripts) if not installed(f, prefix).is_file()]
    assert len(files) > 300 and len(scripts) > 20 and missing == []


def test_no_installed_file_names_the_checkout(prefix: pathlib.Path) -> None:
    done = subprocess.run(["grep", "-rIlF", f"{ROOT}/", prefix], capture_output=True, text=True)
    assert done.stdout == ""


def test_the_demo_drives_and_tells(shell: Shell) -> None:
    text = shell("DISPLAY= rosrun ardee_bringup demo")

    def told(what: str) -> float:
        return float(re.search(rf"{what} +([\d.]+)", text).group(1))

    assert 7.0 < told("distance driven") < 11.0, text  # 50 plants in a row, and the way to it
    assert told("scans published") > 200 and told("plants in the field") > 150, text
    output = shell.home / "demo_output"
    assert Image.open(output / "rviz.png").size == (1280, 960)
    assert (output / "drive.bag").stat().st_size > 100_000


def test_launch_files_find_their_nodes_and_robots(shell: Shell, prefix: pathlib.Path) -> None:
    (shell.home / "load.py").write_text(
        "import sys, roslaunch.config, roslib.packages as packages\n"
        "for file in sys.argv[1:]:\n"
        "    config = roslaunch.config.load_config_default([file], None, verbose=False)\n"
        "    assert config.nodes and not config.config_errors, file\n"
        "    for node in config.nodes:\n"
        "        assert packages.find_node(node.package, node.type), (file, node.type)\n"
        "    print(file, len(config.nodes))\n"
    )
    text = shell(f"/usr/bin/python3 load.py {prefix}/share/*/launch/*.launch")
    for name in ("custom_world", "farm_and_robot", "launch_default_tsv1", "show_sensor", "bridge"):
        assert f"/{name}.launch " in text


def test_all_modules_are_imported(shell: Shell) -> None:
    (shell.home / "import_all.py").write_text(
        "import importlib, pkgutil, sys\n"
        "of_torch = (  # whose user installs it\n"
        "    'ardee_navigation.training.network', 'ardee_sim.examples.train_row_follower'\n"
        ")\n"
        "for name in sys.argv[1:]:\n"
        "    package = importlib.import_module(name)\n"
        "    for module in pkgutil.walk_packages(package.__path__, name + '.'):\n"
        "        if module.name not in of_torch:\n"
        "            importlib.import_module(module.name)\n"
        "print(len(sys.modules))\n"
    )
    modules = [p.parent.name for name in OWN for p in (SRC / name / "src").glob("*/__init__.py")]
    assert len(modules) > 5
    shell(f"/usr/bin/python3 import_all.py {' '.join(modules)}")


def test_commands_that_are_no_modules_tell_their_help(shell: Shell, prefix: pathlib.Path) -> None:
    names = [f"ardee_bringup {p.name}" for p in (prefix / "lib" / "ardee_bringup").glob("[!m]*")]
    for package in ("ardee_sensors", "ardee_sim_cpp", "terrasentia_description"):
        programs = (prefix / "lib" / package).glob("*")
        names += [f"{package} {p.name}" for p in programs if "." not in p.name and p.is_file()]
    assert len(names) > 10
    (shell.home / "names").write_text("\n".join(names))
    told = 'rosrun "$@" -h >/dev/null || { echo "$@"; false; }'
    shell(f"xargs -P2 -L1 bash -c '{told}' x <names")


def test_crops_terrains_fields_and_pictures(shell: Shell, prefix: pathlib.Path) -> None:
    mesh = prefix / "share/ardee_models/models/corn_variant_8/meshes/corn_variant_8.dae"
    shell("rosrun ardee_models generate_crop --stage V3 --name seedling --output models")
    shell(f"rosrun ardee_models prepare_crop {mesh} --name prepared --output models")  # trimesh
    shell("python3 -m ardee_world.cli generate_terrain --samples 33 --name ground --output models")
    field = "--models seedling --model-path models --rows-per-plot 2 --stalks-per-row 5"
    shell(f"rosrun ardee_world generate_field {field} --name patch --output models")
    world = shell(
        "python3 -m ardee_world.assemble_world models/patch models/ground"
        " ardee_geofence/default_gps_behavior.geofence --output w"
        f" --search {prefix}/share --model-path models | tail -n 1"
    ).strip()
    robot = "$(rospack find terrasentia_description)/robots/tsv1_default.urdf.xacro"
    shell(f"xacro {robot} >robot.urdf")
    options = (
        "--robot robot.urdf --size 64x48 --samples 1 --model-path w/models --model-path models"
    )
    shell(f"rosrun ardee_sim_cpp render_world {world} {options} --output picture.png")
    assert Image.open(shell.home / "picture.png").getextrema() != ((255, 255),) * 3


def test_sensor_macros_expand(shell: Shell, prefix: pathlib.Path) -> None:
    text = shell(f"xacro {prefix}/share/ardee_sensors/robots/show_sensor.urdf.xacro sensor:=vlp16")
    assert "package://ardee_sensors/meshes" in text


def test_an_experiment_and_a_drive_in_python(shell: Shell) -> None:
    shell("rosrun ardee_navigation run_experiment --scenario artificial --runs 1 --output runs")
    assert "end of the row" in (shell.home / "runs" / "report.md").read_text()
    assert "beams met something" in shell("python3 -m ardee_sim.examples.first_drive")


def test_programs_of_a_user_are_built_over_it(shell: Shell, prefix: pathlib.Path) -> None:
    (shell.home / "CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.10)\nproject(target C)\n"
        "find_package(ardee_bridge REQUIRED)\ninclude_directories(${ardee_bridge_INCLUDE_DIRS})\n"
        f"add_executable(client {prefix}/share/ardee_bridge/examples/ardee_client.c)\n"
        "target_link_libraries(client m)\n"
    )
    shell("cmake -S . -B client && cmake --build client && test -x client/client")
