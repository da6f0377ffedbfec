# SPDX-License-Identifier: MIT
"""The xacro stand-in: ROS 1's substitutions, where its module comes from, what it says when that is missing."""
import os
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

import pytest

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
HEAD = '<robot name="r" xmlns:xacro="http://ros.org/wiki/xacro">'


def run(script: pathlib.Path, *arguments: str, **environment: str) -> subprocess.CompletedProcess:
    """Run a script of the package."""
    variables = dict(os.environ, ROS_PACKAGE_PATH=str(PACKAGE), **environment)
    command = ["/usr/bin/python3", str(script), *arguments]
    return subprocess.run(command, env=variables, capture_output=True, text=True)


def write(folder: pathlib.Path, body: str) -> str:
    """Path of a xacro file with this body."""
    file = folder / "robot.xacro"
    file.write_text(f"{HEAD}{body}</robot>")
    return str(file)


@pytest.mark.parametrize("script", ["xacro", "xacro.py"])
def test_substitutions_are_those_of_roslaunch(tmp_path: pathlib.Path, script: str):
    body = (
        '<xacro:arg name="side" default="left"/>'
        '<link name="$(arg side)|$(find xacro)|$(env ARM)|$(optenv NO_ARM none)|$(eval 2*3)"/>'
    )
    done = run(PACKAGE / "scripts" / script, write(tmp_path, body), "side:=right", ARM="x86")
    assert done.returncode == 0, done.stderr
    assert f'name="right|{PACKAGE}|x86|none|6"' in done.stdout


def test_an_argument_without_a_value_keeps_its_default_as_in_ros_1(tmp_path: pathlib.Path):
    body = '<xacro:arg name="ns" default="a"/><link name="[$(arg ns)]"/>'
    done = run(PACKAGE / "scripts/xacro", write(tmp_path, body), "ns:=")
    assert 'name="[a]"' in done.stdout, done.stderr


@pytest.mark.parametrize(
    "body, message",
    [
        ('<link name="$(find no_such_package)"/>', "no_such_package"),
        ('<link name="$(arg missing)"/>', "missing"),
        ('<link name="${missing}"/>', "missing"),
        ("<xacro:no_such_macro/>", "no_such_macro"),
    ],
)
def test_what_is_unknown_is_an_error_with_its_name(tmp_path: pathlib.Path, body: str, message: str):
    done = run(PACKAGE / "scripts/xacro", write(tmp_path, body))
    assert done.returncode != 0 and message in done.stderr and not done.stdout


def test_dirname_and_calls_within_eval(tmp_path: pathlib.Path):
    (tmp_path / "below").mkdir()
    (tmp_path / "below/part.xacro").write_text(f'{HEAD}<link name="$(dirname)"/></robot>')
    body = (
        '<xacro:include filename="$(dirname)/below/part.xacro"/><xacro:arg name="n" default="3"/>'
        """<link name="$(dirname)|$(eval find('xacro') + '/a')|$(eval int(str(arg('n'))) + 1)"/>"""
    )
    done = run(PACKAGE / "scripts/xacro", write(tmp_path, body))
    assert f'name="{tmp_path}/below"' in done.stdout, done.stderr
    assert f'name="{tmp_path}|{PACKAGE}/a|4"' in done.stdout


OLD = """
<property name="w" value="0.3"/><property name="up"><origin xyz="0 0 1"/></property>
<include filename="{folder}/part.xacro"/><arg name="n" default="2"/>
<macro name="wheel" params="side x:=1 *place">
  <link name="${{side}}" x="${{x * w}}"><insert_block name="place"/></link>
</macro>
<wheel side="left"><origin xyz="1 0 0"/></wheel><wheel side="right" x="$(arg n)"><insert_block name="up"/></wheel>
<if value="${{w > 0.2}}"><link name="wide"/></if><unless value="1"><link name="never"/></unless>
<part q="5"/><call macro="part" q="6"/>"""


def test_tags_without_a_prefix_are_expanded_with_one_warning(tmp_path: pathlib.Path):
    part = '<macro name="part" params="q"><link name="part_${q}"/></macro>'
    (tmp_path / "part.xacro").write_text(f"<robot>{part}</robot>")
    done = run(PACKAGE / "scripts/xacro", "--inorder", write(tmp_path, OLD.format(folder=tmp_path)))
    root = ElementTree.fromstring(done.stdout)
    assert {element.tag for element in root} == {"link"}
    links = [(link.get("name"), link.get("x")) for link in root]
    expected = [("left", "0.3"), ("right", "0.6"), ("wide", None), ("part_5", None)]
    assert links == [*expected, ("part_6", None)]
    assert [origin.get("xyz") for origin in root.iter("origin")] == ["1 0 0", "0 0 1"]
    assert done.stderr.count("warning") == 1
    assert "robot.xacro: found <property>, expected <xacro:property>" in done.stderr


def test_elements_that_only_have_the_name_of_a_tag_or_a_macro_are_kept(tmp_path: pathlib.Path):
    body = (
        '<xacro:macro name="camera" params="name parent"><sensor><camera name="${name}"><image/>'
        '</camera></sensor></xacro:macro><xacro:macro name="imu" params="rate"/>'
        '<xacro:camera name="c" parent="p"/><imu><rate>5</rate></imu><arg>1</arg><property/>'
        "<gazebo><include><uri>model://sun</uri></include></gazebo>"
    )
    done = run(PACKAGE / "scripts/xacro", write(tmp_path, body))
    root = ElementTree.fromstring(done.stdout)
    assert [element.tag for element in root] == ["sensor", "imu", "arg", "property", "gazebo"]
    assert root.find("sensor/camera").get("name") == "c" and root.find("gazebo/include/uri").text
    assert done.stderr == ""


def test_min_and_max_are_good_names_for_arguments(tmp_path: pathlib.Path):
    body = (
        '<xacro:macro name="m" params="min max"><link name="${min}..${max}"/></xacro:macro>'
        '<xacro:m min="1" max="2"/><link name="${max(3, 4)}"/>'
    )
    done = run(PACKAGE / "scripts/xacro", write(tmp_path, body))
    assert 'name="1..2"' in done.stdout and 'name="4"' in done.stdout
    assert done.stderr == ""


@pytest.mark.parametrize("script", ["xacro", "xacro.py"])
def test_a_wrapper_in_another_folder_as_catkin_makes_it(tmp_path: pathlib.Path, script: str):
    for name in ("xacro", "xacro.py"):
        path = PACKAGE / "scripts" / name
        text = "#!/usr/bin/python3\nscope = {'__file__': %r, '__name__': '__main__'}\n" % str(path)
        (tmp_path / name).write_text(text + "exec(open(scope['__file__']).read(), scope)\n")
    done = run(tmp_path / script, write(tmp_path, '<link name="${1 + 1}"/>'))
    assert 'name="2"' in done.stdout, done.stderr


@pytest.mark.parametrize(
    "script, module",
    [
        ("ws/compat/xacro/scripts/xacro", "ws/pydeps"),
        ("ws/install/lib/xacro/xacro", "ws/pydeps"),
        ("ws/install/bin/xacro", "ws/pydeps"),
    ],
)
def test_the_module_is_found_in_the_workspace(tmp_path: pathlib.Path, script: str, module: str):
    target, package = tmp_path / script, tmp_path / module / "xacro"
    target.parent.mkdir(parents=True)
    shutil.copy(PACKAGE / "scripts/xacro", target)
    package.mkdir(parents=True)
    (package / "__init__.py").write_text("def main():\n    print('found', __file__)\n")
    variables = dict(os.environ, PYTHONPATH="", ARDEE_PYDEPS="")
    command = [sys.executable, "-S", str(target)]
    done = subprocess.run(command, env=variables, capture_output=True, text=True)
    assert done.stdout == f"found {package}/__init__.py\n", done.stderr


def test_a_xacro_module_on_the_python_path_wins(tmp_path: pathlib.Path):
    (tmp_path / "xacro.py").write_text("def main():\n    print('the real one')\n")
    done = run(PACKAGE / "scripts/xacro", PYTHONPATH=str(tmp_path))
    assert done.stdout == "the real one\n", done.stderr


@pytest.mark.parametrize("through", ["environment", "place"])
def test_without_the_module_it_says_where_it_looked(tmp_path: pathlib.Path, through: str):
    script, nowhere = PACKAGE / "scripts/xacro", tmp_path / "nowhere"
    environment = {"ARDEE_PYDEPS": str(nowhere)}
    if through == "place":  # in an empty workspace
        target = tmp_path / "compat/xacro/scripts/xacro"
        target.parent.mkdir(parents=True)
        shutil.copy(script, target)
        script, nowhere, environment = target, tmp_path / "pydeps", {"ARDEE_PYDEPS": ""}
    # -S: no site packages, so that a xacro installed for the whole machine does not help
    variables = dict(os.environ, PYTHONPATH="", **environment)
    command = [sys.executable, "-S", str(script)]
    done = subprocess.run(command, env=variables, capture_output=True, text=True)
    assert done.returncode != 0
    assert f"looked in {nowhere}" in done.stderr and "xacro==2.1.1" in done.stderr
