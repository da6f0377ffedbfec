# SPDX-License-Identifier: MIT
"""While a camera's images change from one process to another, from raw ones to the camera's own, none is sent twice."""
import os
import struct
from typing import Any

_RECORD = struct.Struct("<qq")  # stamp of the image sent last [ns], and of which form it was


class Handover:
    """In a file that the processes share: which image each camera's latest was, in which form.

    Drivers that leave the stamp at 0 lose one image when the form changes.
    """

    def __init__(self, file: int) -> None:
        self._file = file

    def is_first(self, component_id: int, stamp: Any, is_compressed: bool) -> bool:
        """Was the image of this time not sent in the other form? To be asked, before each, under a lock on the file."""
        stamp_ns, at = stamp.secs * 10**9 + stamp.nsecs, component_id * _RECORD.size
        before = os.pread(self._file, _RECORD.size, at)
        os.pwrite(self._file, _RECORD.pack(stamp_ns, is_compressed), at)
        # what has not been written yet reads as zeros, or not at all
        return not any(before) or before != _RECORD.pack(stamp_ns, not is_compressed)
