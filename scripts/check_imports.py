# SPDX-License-Identifier: MIT
"""Prints uses of private names (_name) of other packages in Python files: check_imports.py FILE..."""
import ast
import pathlib
import sys
from typing import Iterator, Set, Tuple

ROOT = pathlib.Path(__file__).resolve().parents[1]
PACKAGES = {init.parent.name for init in ROOT.glob("*/*/src/*/__init__.py")}


def is_private(name: str) -> bool:
    """Returns whether a name is private: true for _name, false for __name__ and a._b.c."""
    return any(part.startswith("_") and not part.endswith("__") for part in name.split("."))


def imports(tree: ast.AST) -> Iterator[Tuple[int, str, str]]:
    """Returns line, full name and local name of every import."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for each in node.names:
                yield node.lineno, each.name, each.asname or each.name
        elif isinstance(node, ast.ImportFrom) and not node.level:
            for each in node.names:
                yield node.lineno, f"{node.module}.{each.name}", each.asname or each.name


def foreign_private_names(file: pathlib.Path) -> Iterator[Tuple[int, str]]:
    """Returns line and name of each private name of another package that a file uses."""
    tree = ast.parse(file.read_bytes())
    own: Set[str] = PACKAGES & set(file.resolve().relative_to(ROOT).parts)
    known = {}
    for line, name, here in imports(tree):
        if name.split(".")[0] in PACKAGES - own:
            known[here] = name
            if is_private(name):
                yield line, name
    for node in ast.walk(tree):
        if isinstance(node, ast.Attribute) and is_private(node.attr):
            module = ast.unparse(node.value)
            if module in known:
                yield node.lineno, f"{known[module]}.{node.attr}"


def main() -> int:
    """Prints the uses; returns 1 if there is any."""
    found = [
        f"{name}:{line}: {private} is private to its package"
        for name in sys.argv[1:]
        for line, private in foreign_private_names(pathlib.Path(name))
    ]
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
