# SPDX-License-Identifier: MIT
"""Hashes of files and folders, which tell whether inputs have changed."""
import contextlib
import hashlib
from modulefinder import ModuleFinder
from pathlib import Path
from typing import Dict, Iterable, List


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


def python_files(file: Path) -> List[Path]:
    """Returns the Python files of a file's package, or itself and what it imports from its folder."""
    folder = file.parent
    if not (folder / "__init__.py").is_file():
        finder = ModuleFinder([str(folder)])  # which reads files and runs none
        with contextlib.suppress(SyntaxError, ValueError):  # of a file that Python cannot read
            finder.run_script(str(file))
        imported = [Path(each.__file__) for each in finder.modules.values() if each.__file__]
        return shown(folder, [file, *imported])
    while (folder.parent / "__init__.py").is_file():
        folder = folder.parent
    return shown(folder, folder.glob("**/*.py"))


def shown(folder: Path, files: Iterable[Path]) -> List[Path]:
    """Returns the files, each once and in order, without those that are hidden or lead nowhere."""
    return sorted(
        file
        for file in set(files)
        if file.is_file() and not any(part[0] == "." for part in file.relative_to(folder).parts)
    )
