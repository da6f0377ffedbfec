# SPDX-License-Identifier: MIT
"""Tests that worlds, models and launch files of the thesis's Listings A.14 to A.24 work as they are printed."""
import pathlib
import shutil
from typing import Tuple

import numpy as np
import probes
import pytest
from gazebo_calls import call, pose, simulate, spawn, state
from PIL import Image

from ardee_common.ros_graph import RosGraph, wait_until

LISTINGS = pathlib.Path(__file__).resolve().parent / "data/listings"
PLANT = "corn_variant_1"
LEAVES = "Corn/LeavesBase", "AG20lef3.tif"  # material and texture of Listing A.14


def model_folder(graph: RosGraph, name: str, listing: str) -> pathlib.Path:
    """Makes a folder of a model of this listing, found before those that ship; returns it."""
    folder = graph.folder / "models" / name
    folder.mkdir(parents=True)
    shutil.copy(LISTINGS / listing, folder / "model.sdf")
    for name in ("GAZEBO_MODEL_PATH", "GAZEBO_RESOURCE_PATH"):
        graph.env[name] = f"{folder.parent}:{graph.env[name]}"
    return folder


def box(height_m: float) -> str:
    """Returns a model of a box of this size."""
    return (
        '<sdf version="1.6"><model name="m"><link name="l"><collision name="c"><geometry><box>'
        f"<size>1 1 {height_m}</size></box></geometry></collision></link></model></sdf>"
    )


def test_the_ground_of_listing_a_23_is_as_high_as_its_image_is_bright(graph: RosGraph) -> None:
    """An image of 8 bits, in the west black, in the east a fifth of its brightest: 0 and 2 of the listing's 10 m."""
    images = model_folder(graph, "heightmap_ground", "a_23.sdf") / "meshes/heightmaps"
    images.mkdir(parents=True)
    grey = np.zeros((129, 129), np.uint8)
    grey[:, 65:], grey[0, 0] = 51, 255
    Image.fromarray(grey).save(images / "corn_rows.png")
    include = "<include><uri>model://heightmap_ground</uri></include>"
    simulator = simulate(graph, f'<sdf version="1.5"><world name="w">{include}</world></sdf>')
    places = {"west": (-7.0, 0.0), "east": (7.0, 2.0)}
    boxes = [spawn(name, box(0.4), pose(x=x, z=z + 0.3)) for name, (x, z) in places.items()]
    assert [answer.success for answer in call(graph, *boxes)] == [True, True]
    graph.call(probes.clock_at_least, graph.call(probes.clock_at_least, 0.1) + 0.5)
    heights = [answer.pose.position.z for answer in call(graph, *map(state, places))]
    assert heights == pytest.approx([0.2, 2.2], abs=0.01)
    assert "ERROR" not in simulator.output() and "WARN" not in simulator.output()


def test_the_plant_of_listing_a_24_is_drawn_in_the_material_of_a_14(graph: RosGraph) -> None:
    """Its leaves have the colour of the TIFF file where that is opaque, and from either side."""
    shipped = next(
        folder / PLANT
        for folder in map(pathlib.Path, graph.env["GAZEBO_MODEL_PATH"].split(":"))
        if (folder / PLANT).is_dir()
    )
    plant = model_folder(graph, PLANT, "a_24.sdf")
    shutil.copytree(shipped / "meshes", plant / "meshes")
    text = (LISTINGS / "a_14.material").read_text()
    colours = {"LeavesBase": (250, 0, 0), "Stem": (0, 250, 0), "LeavesMid": (0, 0, 250)}
    for folder in ("scripts", "textures"):
        (plant / "materials" / folder).mkdir(parents=True)
    for part, colour in colours.items():
        texture = LEAVES[1] if part == "LeavesBase" else f"{part}.tif"
        material = text.replace(LEAVES[0], f"Corn/{part}").replace(LEAVES[1], texture)
        (plant / f"materials/scripts/{part}.material").write_text(material)
        Image.new("RGBA", (8, 8), (*colour, 255)).save(plant / "materials/textures" / texture)
    world = graph.folder / "plant.world"
    include = f"<include><uri>model://{PLANT}</uri></include>"
    world.write_text(f'<sdf version="1.5"><world name="w">{include}</world></sdf>')
    for side in ("1", "-1"):
        output = str(graph.folder / f"plant{side}.png")
        look = ["--look-from", side, "0", "0.3", "--look-at", "0", "0", "0.15"]
        told = graph.run(
            "rosrun", "ardee_sim_cpp", "render_world", str(world), "--output", output, *look
        )
        assert "WARN" not in told
        picture = np.asarray(Image.open(output).convert("RGB")).astype(int)
        assert [pixels(picture, colour) > 100 for colour in colours.values()] == [True] * 3


def pixels(picture: np.ndarray, colour: Tuple[int, int, int]) -> int:
    """Number of pixels of one hue among red, green and blue, however bright."""
    lit = np.argmax(colour)
    others = [channel for channel in range(3) if channel != lit]
    return int(
        np.count_nonzero((picture[..., lit] > 40) & (picture[..., others].max(axis=-1) < 20))
    )


def test_the_robot_of_listing_a_21_drives_in_the_world_of_a_15(graph: RosGraph) -> None:
    """As printed, but for robot_state_publisher's old node `state_publisher`, which Debian's package has not."""
    world = graph.spawn("rosrun", "ardee_sim_cpp", "simulator", str(LISTINGS / "a_15.world"))
    wait_until(lambda: "2 models" in world.output(), "the world")
    graph.run("rosparam", "set", "/sim_sensor_node/port", "0")  # other tests may use the usual one
    launched = graph.spawn("roslaunch", str(LISTINGS / "a_21.launch"), "use_rviz:=false")
    wait_until(lambda: "Successfully spawned" in launched.output(), "the robot", 60.0)
    first, last = graph.call(probes.drive, "/cmd_vel", "/odom", 0.5, 0.0, 2.0)
    assert last.pose.pose.position.x - first.pose.pose.position.x == pytest.approx(-1.0, abs=0.2)
    told = [line for line in launched.output().splitlines() if "ERROR" in line]
    assert len(told) == 1 and "robot_state_publisher/state_publisher" in told[0]
    names = set(graph.run("rosnode", "list").split())
    assert names >= {
        "/joint_state_publisher",
        "/joy_node",
        "/joy_controller_node",
        "/sim_sensor_node",
    }
