# SPDX-License-Identifier: MIT
"""Tests scripts/check_dependencies.py on a small package."""
import pathlib
import subprocess

PROGRAM = pathlib.Path(__file__).resolve().parents[1] / "scripts" / "check_dependencies.py"
FILES = {
    "src/mower/package.xml": "<package><name>mower</name>"
    "<exec_depend>rospy</exec_depend><test_depend>python3-yaml</test_depend></package>",
    "src/mower/setup.py": "from catkin_pkg.python_setup import generate_distutils_setup\n",
    "src/mower/src/mower/__init__.py": "",
    "src/mower/src/mower/node.py": "import os\nimport rospy\nfrom PIL import Image\nimport yaml\n",
    "src/mower/test/blades.py": "from mower import node\n",
    "src/mower/test/test_node.py": "import blades\nimport yaml\nimport tf2_ros\nfrom mower import node\n",
    "tools/plot.py": "import matplotlib\n",
}


def test_names_what_to_declare_and_where(tmp_path: pathlib.Path) -> None:
    for name, text in FILES.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(text)
    python = [name for name in FILES if name.endswith(".py")]
    command = ["/usr/bin/python3", PROGRAM, *python]
    result = subprocess.run(command, cwd=tmp_path, stdout=subprocess.PIPE, text=True)
    to = "to src/mower/package.xml"
    node, test = "src/mower/src/mower/node.py", "src/mower/test/test_node.py"
    assert result.stdout.splitlines() == [
        f"{node}:3: PIL is not declared: add <exec_depend>python3-pil</exec_depend> {to}",
        f"{node}:4: yaml is not declared: add <exec_depend>python3-yaml</exec_depend> {to}",
        f"{test}:3: tf2_ros is not declared: add <test_depend>tf2_ros</test_depend> {to}",
    ]
    assert result.returncode == 1
