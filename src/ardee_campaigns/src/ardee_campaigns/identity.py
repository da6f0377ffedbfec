# SPDX-License-Identifier: MIT
"""Hashes of what a run is made of beside its campaign's file: the simulator as it is built, files and models."""
import functools
import hashlib
from importlib.util import find_spec
from pathlib import Path
from typing import Dict, Iterable, List
from xml.etree import ElementTree

from ardee_sim.packages import find_package

from ardee_campaigns.program import python_files
from ardee_models import lookup
from ardee_world import trial

_CORE = "ardee_sim._core"  # the extension module


def engine_version() -> str:
    """Returns the version of the simulator."""
    package = ElementTree.parse(find_package("ardee_world") / "package.xml")
    return package.findtext("version", "")


@functools.lru_cache(maxsize=None)
def engine_digest() -> str:
    """Returns a hash of the simulator: its version, its extension module, Python files of plants and fields."""
    core = find_spec(_CORE)
    files = [Path(core.origin)] if core and core.origin else []
    for module in (trial, lookup):
        files += python_files(Path(module.__file__))
    return Digests().of(files) + engine_version()


class Digests:
    """Hashes of files and folders, each of which is read once."""

    def __init__(self) -> None:
        self._known: Dict[Path, bytes] = {}

    def of(self, paths: Iterable[Path]) -> str:
        """Returns the hash of the names and contents of files, and of all files in folders."""
        return hashlib.sha256(b"".join(map(self._of, paths))).hexdigest()

    def _of(self, path: Path) -> bytes:
        if path not in self._known:
            files: List[Path] = sorted(path.rglob("*")) if path.is_dir() else [path]
            made = hashlib.sha256()
            for file in files:
                if file.is_file():
                    name = str(file.relative_to(path.parent)).encode()
                    made.update(hashlib.sha256(name).digest())
                    made.update(hashlib.sha256(file.read_bytes()).digest())
            self._known[path] = made.digest()
        return self._known[path]
