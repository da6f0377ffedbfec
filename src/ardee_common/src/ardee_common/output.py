# SPDX-License-Identifier: MIT
"""Writes output completely or not at all: written to a temporary place, then renamed."""

import contextlib
import errno
import fcntl
import os
import re
import shutil
import socket
import tempfile
import time
from pathlib import Path
from typing import Iterator

from ardee_common.errors import GeneratorError

FULL = (errno.ENOSPC, errno.EDQUOT)  # error numbers of a full disk
_STALE_S = 60.0  # a file is written in less; nothing that is older is left half written but by a killed program
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.-]*")


@contextlib.contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Keeps other programs that lock a folder out of it; the lock ends with the block, or with the process."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            found = f"found {str(folder)!r}, in which another program is at work"
            raise GeneratorError(f"--output: {found}, expected its end") from None
        yield
    finally:
        os.close(handle)


def check_name(name: str) -> str:
    """A model name that is safe as a folder and in XML."""
    if not _NAME.fullmatch(name):
        raise GeneratorError(
            f"name {name!r}: expected letters, digits, '_', '-', '.', the first a letter or digit"
        )
    return name


def _swap(temporary: Path, target: Path) -> None:
    """Puts `temporary` in the place of `target`; if that fails, `target` is as it was."""
    if not target.exists():
        os.rename(temporary, target)
        return
    retired = Path(tempfile.mkdtemp(prefix=f".{target.name}.old-", dir=target.parent))
    os.rename(target, retired / target.name)
    try:
        os.rename(temporary, target)
    except BaseException:  # Ctrl-C too
        if not target.exists():
            os.rename(retired / target.name, target)
        raise
    finally:
        shutil.rmtree(retired)


@contextlib.contextmanager
def model_directory(parent: Path, name: str) -> Iterator[Path]:
    """A temporary folder that becomes parent/name when the block ends well; otherwise nothing changes."""
    target = parent / check_name(name)
    if target.exists() and not (target / "model.config").is_file():
        raise GeneratorError(
            f"{target}: exists and is not a model directory (no model.config); not overwritten"
        )
    try:
        parent.mkdir(parents=True, exist_ok=True)
        temporary = Path(tempfile.mkdtemp(prefix=f".{name}.new-", dir=parent))
    except OSError as error:
        raise GeneratorError(f"{parent}: cannot be written: {error.strerror}") from error
    try:
        temporary.chmod(0o755)
        yield temporary
        _swap(temporary, target)
    except OSError as error:
        raise GeneratorError(f"{target}: cannot be written: {error.strerror}") from error
    finally:
        shutil.rmtree(temporary, ignore_errors=True)


@contextlib.contextmanager
def output_folder(folder: Path) -> Iterator[Path]:
    """Makes a folder to write in; one that is still empty when the block ends badly is removed."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError as error:
        raise GeneratorError(
            f"found --output {folder} ({error.strerror}), expected a folder that can be written"
        ) from None
    try:
        yield folder
    except BaseException:  # Ctrl-C too
        with contextlib.suppress(OSError):
            folder.rmdir()  # refused where something is in it
        raise


def check_file(path: Path) -> None:
    """Raises GeneratorError if no file can be written at a path; before long work, whose result is for it."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.is_dir():
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR))
        tempfile.TemporaryFile(dir=path.parent).close()
    except OSError as error:
        raise GeneratorError(f"{path}: cannot be written: {error.strerror}") from None


def write_file(path: Path, data: bytes) -> None:
    """Replaces one file in one step, while other processes, on other machines too, may do the same."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f".{path.name}.{socket.gethostname()}.{os.getpid()}.new")
    try:
        temporary.write_bytes(data)
        os.replace(temporary, path)
    finally:
        temporary.unlink(missing_ok=True)


def remove_stale(folder: Path) -> None:
    """Removes files of write_file that killed programs left in a folder which this one has locked."""
    for path in folder.glob(".*.new"):
        if _is_stale(path):
            path.unlink(missing_ok=True)


@contextlib.contextmanager
def scratch_folder(prefix: str) -> Iterator[Path]:
    """Makes a folder for temporary files; those of this prefix that killed programs left are removed."""
    for path in Path(tempfile.gettempdir()).glob(f"{prefix}*"):
        # One that is in use is locked, one of somebody else cannot be opened.
        with contextlib.suppress(GeneratorError, OSError):
            if _is_stale(path):
                with locked(path):
                    shutil.rmtree(path, ignore_errors=True)
    with tempfile.TemporaryDirectory(prefix=prefix) as name:
        with locked(Path(name)):
            yield Path(name)


def _is_stale(path: Path) -> bool:
    with contextlib.suppress(FileNotFoundError):
        return time.time() - path.stat().st_mtime > _STALE_S
    return False
