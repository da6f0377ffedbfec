# SPDX-License-Identifier: MIT
"""Hashes of files and folders, which tell whether inputs have changed."""
import hashlib
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
