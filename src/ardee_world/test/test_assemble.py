# SPDX-License-Identifier: MIT
"""Tests a field and a terrain put together into a world."""

import json
import re
import shutil
import subprocess
import xml.etree.ElementTree as ElementTree

import numpy as np
import pytest
import yaml

from ardee_common.errors import GeneratorError
from ardee_models.lookup import terrain_model
from ardee_models.terrain.ground import LevelGround
from ardee_world import assemble_world
from ardee_world.field_layout import to_world
from ardee_world.moving import seat_plots
from ardee_world.urdf_file import EMPTY, SEPARATOR

BASE = ("--models", "corn_a", "corn_b", "--name", "field", "--world-pose", "0", "0", "0")


@pytest.fixture()
def put_together(models, generate_field, tmp_path, monkeypatch, run_main):
    """Runs the command in a folder with a field, an empty field and a geofence; returns code and standard error."""
    assert generate_field(*BASE, "--output", tmp_path / "models")[0] == 0
    (tmp_path / "share" / "pkg").mkdir(parents=True)
    (tmp_path / "share" / "pkg" / "empty.urdf.xacro").write_text(EMPTY)
    (tmp_path / "share" / "pkg" / "my.geofence").write_text("<robot/>\n")
    monkeypatch.chdir(tmp_path)

    def call(
        field="models/field/field.urdf.xacro",
        terrain="pkg/ground",
        geofence="pkg/my.geofence",
        *more,
    ):
        folders = ("--output", "out", "--search", "share")
        return run_main(assemble_world.main, field, terrain, geofence, *folders, *more)

    return call


def test_the_world_includes_the_terrain_at_its_origin_and_the_field_where_its_own_pose_says(
    put_together, tmp_path
):
    assert put_together() == (0, "")
    world = ElementTree.parse(tmp_path / "out/worlds/custom.world").getroot().find("world")
    includes = [(i.findtext("uri"), i.findtext("pose")) for i in world.findall("include")]
    assert includes == [
        ("model://custom_heightmap", "0 0 0 0 0 0"),
        ("model://custom_field", None),
    ]
    assert world.findtext("physics/max_step_size") == "0.005"
    for name in (
        "custom_field/model.config",
        "custom_field/plots.xacro",
        "custom_heightmap/model.sdf",
    ):
        assert (tmp_path / "out/models" / name).is_file()
    assert (
        tmp_path / "out/ardee_geofence/custom_gps_behavior.geofence"
    ).read_text() == "<robot/>\n"


def test_a_terrain_of_no_model_path_is_found_by_its_copy(put_together, tmp_path, models):
    shutil.copytree(models / "ground", tmp_path / "elsewhere" / "ground")
    assert put_together(terrain="elsewhere/ground") == (0, "")
    copy = tmp_path / "out/models/custom_heightmap"
    sdf = ElementTree.parse(copy / "model.sdf").getroot()
    images = {uri.text for uri in sdf.findall(".//heightmap/uri")}
    assert images and all(i.startswith("file://custom_heightmap/") for i in images)
    assert all((copy.parent / image[len("file://") :]).is_file() for image in images)


def test_plants_of_a_generated_field_stand_on_the_terrain(put_together, tmp_path, models):
    assert put_together()[0] == 0
    poses = (
        ElementTree.parse(tmp_path / "out/models/custom_field/model.sdf")
        .getroot()
        .findall(".//include/pose")
    )
    values = np.array([[float(v) for v in pose.text.split()] for pose in poses])
    ground = terrain_model("ground", [models]).height_at(values[:, 0], values[:, 1])
    np.testing.assert_allclose(values[:, 2], ground, atol=5.1e-5)
    assert np.ptp(ground) > 0.03
    before = (
        ElementTree.parse(tmp_path / "models/field/model.sdf").getroot().findall(".//include/pose")
    )
    planned = np.array([[float(v) for v in pose.text.split()] for pose in before])
    np.testing.assert_array_equal(np.delete(values, 2, axis=1), np.delete(planned, 2, axis=1))


def world_places(folder):
    """Returns x, y, z [m] of the plants of an assembled world."""
    model = ElementTree.parse(folder / "models/custom_field/model.sdf").getroot().find("model")
    x, y, z, roll, pitch, yaw = map(float, model.findtext("pose").split())
    assert (z, roll, pitch) == (0.0, 0.0, 0.0)
    if model.find("{urn:ardee:sdf}instances") is not None:
        rows = np.genfromtxt(
            folder / "models/custom_field/plants.csv", delimiter=",", skip_header=1
        )
        places = rows[:, 2:5]
    else:
        poses = [pose.text.split() for pose in model.findall("include/pose")]
        places = np.array(poses, dtype=float)[:, :3]
    return np.column_stack((to_world(places[:, :2], (x, y, yaw)), places[:, 2]))


@pytest.mark.parametrize("form", ["sdf", "stream"])
@pytest.mark.parametrize(
    "pose, moved_to",
    [
        (None, None),
        ((3.0, -2.0, 0.7), None),
        ((0.0, 0.0, 0.0), None),
        (None, (1.5, 4.0, 2.5)),
        ((3.0, -2.0, 0.7), (-1.0, 0.5, -3.0)),
    ],
)
def test_plants_plots_truth_and_start_agree_wherever_a_field_was_planned_or_moved_to(
    put_together, generate_field, tmp_path, models, form, pose, moved_to
):
    words = ("--models", "corn_a", "--name", "turned", "--rows-per-plot", "2", "--format", form)
    words += ("--world-pose", *map(str, pose)) if pose else ()
    assert generate_field(*words, "--output", tmp_path / "models")[0] == 0
    more = ("ground", "pkg/my.geofence", "--world-pose", *map(str, moved_to)) if moved_to else ()
    pose = moved_to or pose
    assert put_together("models/turned/turned.urdf.xacro", *more) == (0, "")
    places = world_places(tmp_path / "out")
    truth_file = tmp_path / "out/models/custom_field/truth.csv"
    truth = np.genfromtxt(truth_file, delimiter=",", names=True)
    told = np.column_stack((truth["world_x_m"], truth["world_y_m"], truth["z_m"]))
    np.testing.assert_allclose(places, told, atol=2e-4)
    everything = json.loads(truth_file.with_suffix(".json").read_text())
    assert everything["plants"]["world_x_m"] == pytest.approx(truth["world_x_m"])
    assert everything["config"]["world_pose"] == list(pose or (0.0, 0.0, -1.57))
    rows = [np.array(row["world_line_m"]).mean(axis=0) for row in everything["rows"]]
    ground = terrain_model("ground", [models])
    np.testing.assert_allclose(
        places[:, 2], ground.height_at(places[:, 0], places[:, 1]), atol=1e-4
    )
    plot = (
        ElementTree.parse(tmp_path / "out/models/custom_field/plots.xacro").getroot().find("plot")
    )
    middle = [float(plot.findtext(axis)) for axis in "xy"]
    np.testing.assert_allclose(middle, places[:, :2].mean(axis=0), atol=0.4)
    np.testing.assert_allclose(middle, np.mean(rows, axis=0), atol=1e-3)
    start = yaml.safe_load((tmp_path / "out/worlds/custom.start.yaml").read_text())
    x, y, turn = pose or (0.0, 0.0, -1.57)
    assert (start["x_m"], start["y_m"]) == pytest.approx((x, y), abs=1e-4)
    along_rows = float(plot.findtext("rotation")) - start["yaw_rad"]
    assert abs(np.sin(along_rows / 2.0)) < 1e-4
    ahead = np.array([np.cos(start["yaw_rad"]), np.sin(start["yaw_rad"])])
    np.testing.assert_allclose(ahead, [np.sin(turn), -np.cos(turn)], atol=1e-6)
    from_start = (places[:, :2] - [x, y]) @ ahead
    assert 0.8 < from_start.min() < 1.2  # the headland
    assert abs(from_start.mean() - float(plot.findtext("row_length")) / 2 - 1.0) < 0.4
    assert start["z_m"] - 0.175 >= ground.height_at(np.array([x]), np.array([y]))[0] - 1e-4


@pytest.mark.parametrize("pose", [(), ("5", "2", "1.5707963267948966")])
def test_the_worlds_origin_is_the_one_that_the_field_was_planned_with(
    put_together, generate_field, tmp_path, pose
):
    words = ("--models", "corn_a", "--name", "placed", "--gps-origin-deg", "40.1", "-88.2")
    assert generate_field(*words, "--output", tmp_path / "models")[0] == 0
    more = ("ground", "pkg/my.geofence", "--world-pose", *pose) if pose else ()
    assert put_together("models/placed/placed.urdf.xacro", *more) == (0, "")
    world = ElementTree.parse(tmp_path / "out/worlds/custom.world").getroot().find("world")
    origin = world.find("spherical_coordinates")
    assert float(origin.findtext("latitude_deg")) == 40.1
    assert float(origin.findtext("longitude_deg")) == -88.2
    truth = np.genfromtxt(tmp_path / "out/models/custom_field/truth.csv", delimiter=",", names=True)
    # a degree at 40.1 degrees north: 111,132.95 - 559.85 cos(2 lat) + 1.175 cos(4 lat) m to the north,
    # 111,412.84 cos(lat) - 93.5 cos(3 lat) + 0.118 cos(5 lat) m to the east
    north_m, east_m = (truth["latitude_deg"] - 40.1) * 111_036.6, (
        truth["longitude_deg"] + 88.2
    ) * 85_269.5
    np.testing.assert_allclose(north_m, truth["world_y_m"], rtol=1e-5, atol=1e-3)
    np.testing.assert_allclose(east_m, truth["world_x_m"], rtol=1e-5, atol=1e-3)


def test_a_field_that_reaches_beyond_its_terrain_is_told(put_together, tmp_path, models):
    """Moved to x = -40 m, its start and all its plants lie beside the terrain."""
    half_m = terrain_model("ground", [models]).size_m / 2.0
    assert half_m < 40.0
    words = ("ground", "pkg/my.geofence", "--world-pose", "-40", "0", "0")
    code, error = put_together("models/field/field.urdf.xacro", *words)
    plants = json.loads((tmp_path / "out/models/custom_field/truth.json").read_text())["plants"]
    count = len(plants["world_x_m"])
    assert code == 0
    assert error == (
        f"assemble_world: found the robot's start at (-40, 0) and {count} of {count} plants beside"
        f" terrain ground (x -{half_m:g} to {half_m:g} m, y -{half_m:g} to {half_m:g} m)\n"
    )


def test_a_field_of_somebody_elses_is_not_moved(put_together, tmp_path):
    other = "<sdf><model name='m'><include><uri>x</uri><pose>1 2 3 0 0 0</pose></include></model></sdf>\n"
    (tmp_path / "other.urdf.xacro").write_text(f"{other}{SEPARATOR}\n<robot/>\n")
    words = ("ground", "pkg/my.geofence", "--world-pose", "1", "2", "3")
    code, error = put_together("other.urdf.xacro", *words)
    assert code == 2 and "not made by generate_field, so it cannot be moved" in error


@pytest.mark.parametrize("number", ["nan", "inf", "1e6", "north"])
def test_a_pose_that_no_world_holds_is_refused(put_together, number):
    words = ("ground", "pkg/my.geofence", "--world-pose", number, "0", "0")
    code, error = put_together("models/field/field.urdf.xacro", *words)
    assert code == 2 and "argument --world-pose: " in error and number in error


def test_a_field_that_says_no_start_gets_the_usual_one(put_together, tmp_path):
    assert put_together("pkg/empty.urdf.xacro", "ground")[0] == 0
    start = yaml.safe_load((tmp_path / "out/worlds/custom.start.yaml").read_text())
    assert (start["x_m"], start["y_m"], start["yaw_rad"]) == (0.0, 0.0, -3.14)


@pytest.mark.parametrize("pose", ["0 0 0 0.1 0 0", "nan 0 0 0 0 0"])
def test_a_field_that_was_tilted_by_hand_is_refused(put_together, tmp_path, pose):
    field = tmp_path / "models/field/field.urdf.xacro"
    field.write_text(field.read_text().replace("<pose>0.0 0.0 0 0 0 0.0", f"<pose>{pose}", 1))
    code, error = put_together()
    assert code == 2 and f"found <pose>{pose}</pose>, expected X Y 0 0 0 YAW" in error


def test_heights_can_be_kept_and_those_of_others_always_are(put_together, tmp_path):
    made = tmp_path / "out/models/custom_field/model.sdf"
    assert (
        put_together(
            "models/field/field.urdf.xacro", "ground", "pkg/my.geofence", "--keep-heights"
        )[0]
        == 0
    )
    assert made.read_bytes() == (tmp_path / "models/field/model.sdf").read_bytes()
    other = "<sdf><model name='m'><include><uri>x</uri><pose>1 2 3 0 0 0</pose></include></model></sdf>\n"
    (tmp_path / "other.urdf.xacro").write_text(f"{other}{SEPARATOR}\n<robot/>\n")
    assert put_together("other.urdf.xacro")[0] == 0 and made.read_text() == other


def test_a_fields_and_a_terrains_name_will_do(put_together, tmp_path, monkeypatch, models):
    monkeypatch.setenv("GAZEBO_MODEL_PATH", f"{models}:{tmp_path / 'models'}")
    assert put_together("field", "ground") == (0, "")
    assert put_together("models/field/", "ground") == (0, "")
    assert put_together("pkg/empty.urdf.xacro", str(models / "ground")) == (0, "")


@pytest.mark.parametrize(
    "text, message",
    [
        ("<sdf/>\n<robot/>\n", f"found 0 lines {SEPARATOR}, expected one"),
        (f"<sdf/>\n{SEPARATOR}\n{SEPARATOR}\n<robot/>\n", f"found 2 lines {SEPARATOR}"),
        (
            f"<sdf>\n\n</sd>\n{SEPARATOR}\n<robot/>\n",
            "bad.urdf.xacro:3: not valid XML: mismatched tag",
        ),
        (f"<sdf/>\n{SEPARATOR}\n<robot>\n\n<plot>\n</robot>\n", "bad.urdf.xacro:6: not valid XML"),
        ("\x00", "found 0 lines"),
    ],
)
def test_bad_field_files_leave_the_earlier_world(put_together, tmp_path, text, message):
    assert put_together()[0] == 0
    before = {p: p.read_bytes() for p in (tmp_path / "out").rglob("*") if p.is_file()}
    (tmp_path / "bad.urdf.xacro").write_text(text)
    code, error = put_together("bad.urdf.xacro")
    assert code == 2 and message in error and error.count("\n") == 1
    assert before == {p: p.read_bytes() for p in (tmp_path / "out").rglob("*") if p.is_file()}


@pytest.mark.parametrize(
    "arguments, message",
    [
        (("no.urdf.xacro",), "field 'no.urdf.xacro': no such file"),
        (("pkg/empty.urdf.xacro", "moon"), "model 'moon': not found"),
        (("pkg/empty.urdf.xacro", "ground", "no.geofence"), "geofence 'no.geofence': no such file"),
    ],
)
def test_what_is_not_there_is_said(put_together, arguments, message):
    code, error = put_together(*arguments)
    assert code == 2 and message in error


@pytest.mark.parametrize("script", ["run_custom_world", "run_demo_world"])
def test_the_scripts_say_what_they_do(package, script):
    path = package.parents[1] / "scripts" / script
    result = subprocess.run([path, "-h"], capture_output=True, text=True, check=True)
    assert "FIELD" in result.stdout and "TERRAIN" in result.stdout and "-y" in result.stdout
    assert subprocess.run([path, "--no"], capture_output=True).returncode == 2


def test_plots_lie_on_the_terrain(put_together, tmp_path):
    """The GPS's regions have heights: those of the ground in their middle."""
    assert put_together() == (0, "")
    text = (tmp_path / "out/models/custom_field/plots.xacro").read_text()
    x, y, z = (float(re.search(rf"<{tag}>([^<]+)", text)[1]) for tag in "xyz")
    ground = terrain_model("custom_heightmap", [tmp_path / "out/models"])
    assert z == pytest.approx(float(ground.height_at(np.array([x]), np.array([y]))[0]), abs=1e-4)
    assert z != 0.0


@pytest.mark.parametrize("place", ["", "<x>here</x>"])
def test_a_plot_without_its_place_is_refused(place):
    text = f"<robot><plot>{place}<y>2.0</y><z>0.0</z></plot></robot>"
    with pytest.raises(GeneratorError, match="expected numbers x, y in each plot"):
        seat_plots(text, LevelGround())
