# SPDX-License-Identifier: MIT
"""COCO's compressed run-length encoding of masks."""

from typing import Optional

import numpy as np


def encode(mask: np.ndarray, left: int = 0, width: Optional[int] = None) -> str:
    """Returns the counts of a mask as pycocotools does: runs in column order, the first of zeros.

    `mask` [h, w] holds the columns from `left` on of a picture so wide; all others are empty.
    """
    height, columns = mask.shape
    flat = np.pad(np.asarray(mask, dtype=bool).ravel(order="F"), 1)
    changes = np.flatnonzero(flat[1:] != flat[:-1]) + left * height
    size = height * (columns if width is None else width)
    runs = np.diff(changes, prepend=0, append=size).tolist()
    if len(runs) > 1 and not runs[-1]:
        runs.pop()
    text = []
    for i, run in enumerate(runs):
        # each run from the fourth on is given by its difference to the one of its own value before
        value = run - runs[i - 2] if i > 2 else run
        while True:
            five_bits, value = value & 0x1F, value >> 5
            is_last = value == (-1 if five_bits & 0x10 else 0)
            text.append(chr(48 + (five_bits if is_last else five_bits | 0x20)))
            if is_last:
                break
    return "".join(text)
