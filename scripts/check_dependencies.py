# SPDX-License-Identifier: MIT
"""Prints imports that the package.xml of their package does not declare: check_dependencies.py FILE...

Files in no package need nothing. Run-time code needs <depend> or <exec_depend>; tests may have <test_depend> too.
"""
import ast
import pathlib
import sys
import xml.etree.ElementTree as ElementTree
from typing import Iterator, List, Optional, Set, Tuple

# The rosdep key, or the package of ours, of each module that has not its name.
KEYS = {
    "ardee_sim": "ardee_sim_py",
    "cv2": "python3-opencv",
    "mpl_toolkits": "python3-matplotlib",
    "PIL": "python3-pil",
}
_APT = "collada dask distributed ephem matplotlib numpy pyproj pytest rasterio rospkg scipy tqdm websockets yaml"
_PIP = "gymnasium pyarrow pycocotools viser"
KEYS.update({name: f"python3-{name}" for name in _APT.split()})
KEYS.update({name: f"python3-{name}-pip" for name in _PIP.split()})
# What no package needs: an example that imports one says how to install it.
OF_THE_USER = {"stable_baselines3", "torch"}


def modules(file: pathlib.Path) -> Iterator[Tuple[int, str]]:
    """Returns line and first part of the name of every module that a file imports."""
    for node in ast.walk(ast.parse(file.read_bytes())):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, each.name.split(".")[0]) for each in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module and not node.level:
            yield node.lineno, node.module.split(".")[0]


def package_of(file: pathlib.Path) -> Optional[pathlib.Path]:
    """Returns the folder of the package that a file belongs to, or None."""
    return next((folder for folder in file.parents if (folder / "package.xml").is_file()), None)


def declared(package: pathlib.Path, tags: List[str]) -> Set[str]:
    """Returns the package's own name and all that its package.xml names in elements with one of the tags."""
    root = ElementTree.parse(package / "package.xml").getroot()
    return {(element.text or "").strip() for tag in ["name", *tags] for element in root.iter(tag)}


def undeclared(file: pathlib.Path, ours: Set[str]) -> Iterator[str]:
    """Returns a message for each import of a file that nothing declares; `ours` are modules of no package."""
    package = package_of(file)
    if not package or file == package / "setup.py":  # which is catkin's
        return
    is_test = "test" in file.relative_to(package).parts
    tags = ["depend", "exec_depend"] + ["test_depend"] * is_test
    known = declared(package, tags) | ours | OF_THE_USER | set(sys.stdlib_module_names)
    for line, module in modules(file):
        key = KEYS.get(module, module)
        if not {key, module} & known:
            yield (
                f"{file}:{line}: {module} is not declared: "
                f"add <{tags[-1]}>{key}</{tags[-1]}> to {package / 'package.xml'}"
            )


def main() -> int:
    """Prints the imports; returns 1 if there is any."""
    files = [pathlib.Path(name) for name in sys.argv[1:]]
    # Programs and tests find these beside themselves or through sys.path.
    ours = {file.stem for file in files if not (file.parent / "__init__.py").exists()}
    ours -= {package.name for package in map(package_of, files) if package}
    found = [message for file in files for message in undeclared(file, ours)]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
