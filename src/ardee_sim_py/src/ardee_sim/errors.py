# SPDX-License-Identifier: MIT
"""Exceptions of the simulator."""

import re
from typing import Optional

_PLACE = re.compile(r"^(?P<file>[^\n:]+):(?P<line>\d+): (?:<(?P<element>[^>\n]*)>: )?")


class ArdeeError(ValueError):
    """An invalid input; the message says its place, what was found and what was expected.

    Attributes
    ----------
    file : path of the file, or None where the message names none
    line : line in the file, or None
    element : name of the XML element, or None
    """

    def __init__(self, message: object) -> None:
        message = str(message)  # gymnasium makes the error of a worker anew from the error
        super().__init__(message)
        place = _PLACE.match(message)
        self.file: Optional[str] = place["file"] if place else None
        self.line: Optional[int] = int(place["line"]) if place else None
        self.element: Optional[str] = place["element"] if place else None


class PhysicsError(ArdeeError):
    """A model's state that became invalid in a step; the model is back where it was spawned."""
