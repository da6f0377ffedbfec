# SPDX-License-Identifier: MIT
"""Attempts at a run, in a small file that outlives the worker: how often it was begun, and how a worker was lost."""
import contextlib
import dataclasses
import os
import re
from pathlib import Path
from typing import IO, Iterator, List

from ardee_campaigns.tables import RunFile

_BEGIN = "begin"
_BEGIN_LINE = re.compile(rf"^{_BEGIN} \d+$", re.MULTILINE)  # a stack dump may hold the word
_TIMEOUT = "Timeout ("  # what faulthandler writes when it ends a process
STALLED, DIED = "stalled: took longer than watchdog_wall_s", "its worker ended"


class Attempts:
    """The attempts at a run."""

    def __init__(self, folder: Path, run_id: str) -> None:
        self._file = folder / "attempts" / f"{run_id}.txt"

    @contextlib.contextmanager
    def begin(self) -> Iterator[IO[str]]:
        """Notes the begin of an attempt; yields the file, for the last words of a process."""
        self._file.parent.mkdir(parents=True, exist_ok=True)
        with self._file.open("a") as file:
            print(_BEGIN, os.getpid(), file=file, flush=True)
            yield file

    def _texts(self) -> List[str]:
        if not self._file.is_file():
            return []
        return _BEGIN_LINE.split(self._file.read_text(errors="replace"))[1:]

    def lost(self) -> List[str]:
        """Returns how each attempt so far was lost."""
        return [STALLED if _TIMEOUT in text else DIED for text in self._texts()]

    def counted(self, run: RunFile, *, is_last_lost: bool = False) -> RunFile:
        """Returns the run with the number of attempts, and how those before the last were lost."""
        lost = self.lost() if is_last_lost else self.lost()[:-1]
        count = max(len(self._texts()), 1)
        timing = dataclasses.replace(run.timing, attempts=count, lost="\n".join(lost))
        return dataclasses.replace(run, timing=timing)

    def forget(self) -> None:
        """Removes the file."""
        self._file.unlink(missing_ok=True)
