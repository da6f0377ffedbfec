# SPDX-License-Identifier: MIT
"""Makes the package importable from the source tree; generates one set of models for all tests."""

import hashlib
import re
import sys
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(PACKAGE / "src"))
sys.path.insert(0, str(PACKAGE.parent / "ardee_common" / "src"))


def folder_hash(folder: Path) -> str:
    """Returns SHA-256 over names and bytes of all files below `folder`."""
    digest = hashlib.sha256()
    for path in sorted(p for p in folder.rglob("*") if p.is_file()):
        digest.update(str(path.relative_to(folder)).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


# The line that says what to do with what was written
NEXT = re.compile(r"^\w+: to (drive|plant) .*\n", re.MULTILINE)


@pytest.fixture(scope="session")
def hash_of():
    """Returns a function for the hash of a folder's content."""
    return folder_hash


@pytest.fixture()
def run_main(monkeypatch, capsys):
    """Returns a function that runs a command's main() on words; it returns exit code and standard error."""

    def run(main, *words):
        monkeypatch.setattr(sys, "argv", [main.__module__, *map(str, words)])
        try:
            code = main()
        except SystemExit as ended:
            code = ended.code
        return code, NEXT.sub("", capsys.readouterr().err)

    return run


@pytest.fixture(scope="session")
def package() -> Path:
    """Returns the source folder of ardee_models."""
    return PACKAGE


@pytest.fixture(scope="session")
def share(tmp_path_factory) -> Path:
    """Returns the folder of everything that the build generates: models/ and media/."""
    from ardee_models import build

    root = tmp_path_factory.mktemp("share")
    build.copy_static(PACKAGE / "models", root / "models")
    build.build_crops(root / "models")
    build.build_terrains(root / "models")
    build.build_media(root / "media")
    return root
