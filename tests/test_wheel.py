# SPDX-License-Identifier: MIT
"""Tests the wheel as a user has it: an empty Debian with its Python, no ROS, no compiler, no checkout, not root."""
import os
import pathlib
import subprocess
from typing import Callable, Iterator

import pytest

ROOT = pathlib.Path(__file__).resolve().parents[1]
# What a process of pip has of its machine: indexes, certificates
PIP = {name: value for name, value in os.environ.items() if name.startswith("PIP_")}
NAMES = ("resolv.conf", "pip.conf", "xdg/pip", "ssl/certs/ca-certificates.crt")
SETTINGS = [pathlib.Path("/etc") / name for name in NAMES]
# A root of Debian of a user's own, in which the user's processes see nothing of this machine's
DEBOOTSTRAP = ["debootstrap", "--variant=minbase", "--include=python3-venv,ca-certificates"]
USER = "1000"
FIRST_SCAN = """
import hashlib, ardee_sim
world = ardee_sim.World.from_file("scenario_2_corn.world")
with ardee_sim.Simulation(world, seed=3) as sim:
    sim.spawn("robot", ardee_sim.robot("tsv1_default", command_timeout=0), xyz_m=(0, 0, 0.175))
    sim.demand("ardee/hokuyo")
    sim.step(400)
    print(hashlib.sha256(sim.latest("ardee/hokuyo").ranges_m.tobytes()).hexdigest())
"""
Shell = Callable[[str], str]


def checked(*words: object, **options: object) -> str:
    """Runs a command and returns its output; fails with that output if the command fails."""
    command = [str(word) for word in words]
    done = subprocess.run(
        command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **options
    )
    assert done.returncode == 0, f"{command}\n{done.stdout[-3000:]}"
    return done.stdout


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> pathlib.Path:
    """Returns the wheel, made of this checkout."""
    folder = tmp_path_factory.mktemp("wheel")
    checked(ROOT / "scripts" / "wheel", "--output", folder)
    (made,) = folder.glob("*.whl")
    return made


@pytest.fixture(scope="module")
def shell(wheel: pathlib.Path) -> Iterator[Shell]:
    """Returns a function that runs a line of bash in an empty Debian, as a user who has installed the wheel."""
    debian = ROOT / "build_wheel" / "debian"
    as_root = [] if os.geteuid() == 0 else ["sudo"]
    if not debian.exists():
        unfinished = debian.with_name("debian.part")
        checked(*as_root, "rm", "-rf", unfinished)
        checked(*as_root, *DEBOOTSTRAP, "bookworm", unfinished)
        checked(*as_root, "mv", unfinished, debian)
    for file in filter(pathlib.Path.exists, SETTINGS):
        place = debian / file.relative_to("/")
        checked(*as_root, "mkdir", "-p", place.parent)
        checked(*as_root, "cp", "-rLT", file, place)
    home = debian / "home" / "user"
    checked(*as_root, "rm", "-rf", home)
    checked(*as_root, "mkdir", "-p", home)
    checked(*as_root, "cp", wheel, home)
    checked(*as_root, "chown", "-R", f"{USER}:{USER}", home)
    names = {"HOME": "/home/user", "PATH": "/home/user/venv/bin:/usr/bin:/bin", "LANG": "C.UTF-8"}
    env = [f"{name}={value}" for name, value in {**PIP, **names}.items()]
    enter = ["chroot", f"--userspec={USER}:{USER}", debian, "env", "-i", *env, "bash", "-ec"]
    mounts = f'mount -t proc proc {debian}/proc && mount --rbind /dev {debian}/dev && exec "$@"'

    def run(line: str) -> str:
        apart = [*as_root, "unshare", "--mount", "bash", "-ec", mounts, "apart"]
        return checked(*apart, *enter, f"cd; {line}", timeout=300)

    run("python3 -m venv venv")
    run(f"pip install -q '{wheel.name}[campaign,data,gym,view]'")
    yield run
    checked(*as_root, "rm", "-rf", home)


def test_nothing_but_python_is_there(shell: Shell) -> None:
    assert shell("! which gcc cc roscore catkin_make").strip() == ""
    assert shell("ls /opt").strip() == ""
    assert shell("id -u").strip() == USER


def test_the_first_drive_runs(shell: Shell) -> None:
    said = shell("python3 -m ardee_sim.examples.first_drive")
    assert "beams met something" in said


def test_readings_are_those_of_the_workspace(shell: Shell, tmp_path: pathlib.Path) -> None:
    script = tmp_path / "scan.py"
    script.write_text(FIRST_SCAN)
    here = checked("/usr/bin/python3", script).splitlines()[-1]
    there = shell(f"python3 - <<'EOF'\n{FIRST_SCAN}\nEOF").splitlines()[-1]
    assert there == here


def test_an_environment_runs(shell: Shell) -> None:
    program = """import gymnasium, ardee_sim.envs
env = gymnasium.make("ardee/RowFollow-v0", scenario="corn", robot="tsv1_default")
scan, info = env.reset(seed=1)
print(env.step(env.action_space.sample())[0].shape)
"""
    assert "(1081,)" in shell(f"python3 - <<'EOF'\n{program}\nEOF")


def test_the_viewer_serves_its_page(shell: Shell) -> None:
    program = """import urllib.request, ardee_sim
from ardee_sim.view import view
with ardee_sim.Simulation(ardee_sim.World.from_file("corn.world")) as sim, view(sim, port=0) as viewer:
    print(urllib.request.urlopen(viewer.url).read().decode()[-200:])
"""
    assert "</html>" in shell(f"python3 - <<'EOF'\n{program}\nEOF")


def test_a_field_is_made(shell: Shell) -> None:
    shell(
        "mkdir -p fields; python3 -m ardee_world.cli generate_crop --species corn --stage V6 --name my_corn"
        " --output fields"
    )
    said = shell(
        "python3 -m ardee_world.cli generate_field --models my_corn corn_variant_8 --model-path fields"
        " --rows-per-plot 2 --row-length-m 3 --seed 1 --name f --output fields; head -n 1 fields/f/truth.csv"
    )
    assert said.splitlines()[-1].startswith("id,plot,row,place")


def test_a_campaign_runs(shell: Shell) -> None:
    shell("python3 -m ardee_campaigns run_campaign small --csv --output small")
    said = shell("head -n 1 small/runs.csv; tail -n +2 small/runs.csv | wc -l")
    assert said.startswith('"run_id"') and said.split()[-1] == "12"


def test_a_data_set_is_made(shell: Shell) -> None:
    shell(
        "printf 'fields: {corn: {fields: 2, frames: 1, options: {models: [corn_variant_1], row_length_m: 3}}}\\n"
        "cameras: {front: {width_px: 96, height_px: 72, horizontal_fov_deg: 70}}\\n' >recipe.yaml"
    )
    shell("python3 -m ardee_datasets generate_dataset recipe.yaml --output set --workers 2")
    assert shell("ls set/train/rgb | wc -l").strip() == "2"


def test_libraries_come_with_their_licences(shell: Shell) -> None:
    held = shell(
        "cd venv/lib/python3.11/site-packages; ls ardee.libs; ls ardee-*.dist-info/licenses"
    )
    for library in ("libembree3", "libode", "libtbb", "libassimp"):
        assert library in held
    for licence in ("LICENSE", "libembree3-3.txt", "libode8.txt", "libtbb12.txt"):
        assert licence in held
