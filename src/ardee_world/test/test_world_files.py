# SPDX-License-Identifier: MIT
"""Tests that worlds, launch files, rviz configuration and the environment hook are whole."""

import os
import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
import yaml

WORLDS = {
    "farm.world": ["heightmap_ground", "small-corn-stalk-plot"],
    "custom.world": ["heightmap_ground", "small-corn-stalk-plot"],
    "flat_farm.world": ["ground_plane", "flat-corn-stalk-plot"],
    "empty.world": ["sun", "ground_plane"],
    "corn.world": ["heightmap_tractor", "corn-field"],
    "early_corn.world": ["heightmap_tractor", "early-corn-field"],
    "mid_corn.world": ["heightmap_tractor", "mid-corn-field"],
    "weeds.world": ["heightmap_tractor", "weeds-field"],
    "gaps.world": ["heightmap_tractor", "gaps-field"],
    "low_sun.world": ["heightmap_tractor", "early-corn-field"],
    "overcast.world": ["heightmap_tractor", "early-corn-field"],
    "mesh_corn.world": ["mesh_ground", "mesh-corn-plot"],
    "sorghum.world": ["heightmap_ground", "sorghum-field"],
    "tobacco.world": ["heightmap_tobacco", "tobacco-field"],
    "scenario_1_artificial.world": ["heightmap_flat", "scenario-1-artificial-plot"],
    "scenario_2_corn.world": ["heightmap_ground", "scenario-2-corn-plot"],
    "scenario_3_sorghum.world": ["heightmap_ground", "scenario-3-sorghum-plot"],
    "long_corn.world": ["heightmap_rough", "long-corn-field"],
    "long_corn_gaps.world": ["heightmap_rough", "long-corn-gaps-field"],
    "curved_corn.world": ["heightmap_rough", "curved-corn-field"],
    "energy_farm.world": ["heightmap_rough", "energy-farm-field"],
    "energy_farm_sorghum.world": ["heightmap_rough", "energy-farm-sorghum-field"],
}


@pytest.mark.parametrize("name", WORLDS)
def test_worlds_include_what_the_build_makes(package, name):
    root = ElementTree.parse(package / "worlds" / name).getroot()
    uris = [include.findtext("uri") for include in root.findall("world/include")]
    assert root.get("version") == "1.5" and uris == [f"model://{model}" for model in WORLDS[name]]


def test_every_world_is_tested(package):
    assert sorted(path.name for path in (package / "worlds").glob("*.world")) == sorted(WORLDS)


@pytest.mark.parametrize("name", [name for name in WORLDS if name != "empty.world"])
def test_every_field_world_says_where_a_robot_starts(package, name):
    start = yaml.safe_load((package / "worlds" / name.replace(".world", ".start.yaml")).read_text())
    assert sorted(start) == ["x_m", "y_m", "yaw_rad", "z_m"] and abs(start["z_m"] - 0.175) < 0.15


@pytest.mark.parametrize("name", [name for name in WORLDS if name != "empty.world"])
def test_a_world_includes_its_field_where_it_was_planned_and_starts_a_robot_before_it(
    package, name
):
    plan = yaml.safe_load((package / "fields" / f"{WORLDS[name][1]}.yaml").read_text())
    x, y, turn = plan.get("world_pose", (0.0, 0.0, -1.57))
    include = ElementTree.parse(package / "worlds" / name).getroot().findall("world/include")[1]
    pose = [float(number) for number in include.findtext("pose").split()]
    assert pose == pytest.approx([x, y, 0.0, 0.0, 0.0, turn], abs=1e-6)
    start = yaml.safe_load((package / "worlds" / name.replace(".world", ".start.yaml")).read_text())
    assert (start["x_m"], start["y_m"]) == pytest.approx((x, y))
    # rows run along the field's -y
    along_rows = turn - np.pi / 2 - start["yaw_rad"]
    assert abs(np.sin(along_rows / 2.0)) < 2e-3 and np.cos(along_rows) > 0.0


@pytest.mark.parametrize("name", WORLDS)
def test_what_a_world_includes_has_a_plan_or_is_a_model(package, name):
    here = {p.stem for folder in ("fields", "terrains") for p in (package / folder).glob("*.yaml")}
    elsewhere = {"heightmap_ground", "heightmap_flat", "ground_plane", "sun"}
    assert set(WORLDS[name]) <= here | elsewhere


def test_farm_world_is_that_of_the_thesis(package):
    """Ours is Listing A.15 but for its camera and two elements without effect, of which the simulator would warn."""
    listings = package.parents[1] / "tests/data/listings"
    printed = ElementTree.parse(listings / "a_15.world").getroot()
    light, sky = printed.find("world/light"), printed.find("world/scene/sky")
    light.remove(light.find("specular"))
    sky.remove(sky.find("clouds"))
    ours = ElementTree.parse(package / "worlds" / "farm.world").getroot()
    for root in (printed, ours):
        root.find("world").remove(root.find("world/gui"))
        for element in root.iter():
            element.text = " ".join((element.text or "").split())
            element.tail = None
    assert ElementTree.tostring(printed) == ElementTree.tostring(ours)


@pytest.mark.parametrize("name", ["custom_world.launch", "world_template.launch"])
def test_every_argument_has_a_doc(package, name):
    root = ElementTree.parse(package / "launch" / name).getroot()
    arguments = root.findall("arg")
    assert arguments and all(argument.get("doc") for argument in arguments)


def _parameters(package, *arguments, file=None):
    """Returns parameters that roslaunch would set, with the package found in the source tree."""
    environment = dict(os.environ, ROS_PACKAGE_PATH=str(package.parent), PATH="/usr/bin:/bin")
    command = [
        "roslaunch",
        "--dump-params",
        str(file or package / "launch" / "custom_world.launch"),
        *arguments,
    ]
    result = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    return yaml.safe_load(result.stdout)


def test_launch_sets_the_simulators_parameters(package):
    parameters = _parameters(package, "world:=farm.world", "seed:=5", "paused:=true")
    assert parameters["/gazebo/world"] == str(package / "worlds" / "farm.world")
    assert parameters["/gazebo/seed"] == 5 and parameters["/gazebo/paused"] is True
    assert parameters["/gazebo/real_time_factor"] < 0 and parameters["/use_sim_time"] is True
    assert parameters["/use_gui"] is False


def test_the_launch_file_of_listing_a_20_starts_a_paused_world(package):
    file = package.parents[1] / "tests/data/listings/a_20.launch"
    for arguments, world in (((), "custom.world"), (("world:=tobacco.world",), "tobacco.world")):
        parameters = _parameters(package, *arguments, file=file)
        assert parameters["/gazebo/world"] == str(package / "worlds" / world)
        assert parameters["/gazebo/paused"] is True and parameters["/use_gui"] is False


def test_launch_tells_the_simulator_what_scenery_to_show(package):
    parameters = _parameters(package, "scenery_radius_m:=2.5", "show_collisions:=true")
    assert parameters["/gazebo/scenery_radius"] == 2.5
    assert parameters["/gazebo/show_collisions"] is True


def test_launch_takes_an_absolute_path_and_a_factor(package):
    parameters = _parameters(package, "world:=/tmp/mine.world", "rtf:=0.5")
    assert (
        parameters["/gazebo/world"] == "/tmp/mine.world"
        and parameters["/gazebo/real_time_factor"] == 0.5
    )


@pytest.mark.parametrize(
    "arguments, display, more",
    [
        ((), ":0", []),
        (("gui:=true",), ":0", ["/world_rviz"]),
        (("gui:=true",), "", ["/world_no_window"]),
        (("gui:=true", "headless:=true"), ":0", []),
    ],
)
def test_rviz_opens_only_when_asked_and_possible(package, arguments, display, more):
    environment = dict(os.environ, ROS_PACKAGE_PATH=str(package.parent), PATH="/usr/bin:/bin")
    environment["DISPLAY"] = display
    command = ["roslaunch", "--nodes", str(package / "launch" / "custom_world.launch"), *arguments]
    result = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    assert result.stdout.split() == ["/gazebo"] + more


def test_rviz_configuration_shows_the_scenery_in_the_world(package):
    manager = yaml.safe_load((package / "rviz" / "world.rviz").read_text())["Visualization Manager"]
    assert manager["Global Options"]["Fixed Frame"] == "world"
    classes = {display["Class"]: display for display in manager["Displays"]}
    assert {"rviz/Grid", "rviz/TF"} <= classes.keys()
    assert classes["rviz/MarkerArray"]["Marker Topic"] == "/ardee/scenery"


def test_hook_appends_once_after_the_users_models(package):
    hook = package / "env-hooks" / "30.ardee_world.sh"
    script = f'set -u; . "{hook}"; . "{hook}"; echo "$GAZEBO_MODEL_PATH $GAZEBO_RESOURCE_PATH"'
    environment = {
        "CATKIN_ENV_HOOK_WORKSPACE": "/ws",
        "GAZEBO_MODEL_PATH": "/mine",
        "PATH": "/usr/bin:/bin",
    }
    result = subprocess.run(
        ["sh", "-c", script], env=environment, capture_output=True, text=True, check=True
    )
    assert (
        result.stdout.strip() == "/mine:/ws/share/ardee_world/models /ws/share/ardee_world/models"
    )
