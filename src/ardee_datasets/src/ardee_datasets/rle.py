# SPDX-License-Identifier: MIT
"""COCO's compressed run-length encoding of masks."""

import numpy as np


def encode(mask: np.ndarray) -> str:
    """Returns the counts of a mask [h, w] as pycocotools does: runs in column order, the first of zeros."""
    flat = np.asarray(mask, dtype=bool).ravel(order="F")
    edges = np.flatnonzero(np.diff(flat)) + 1
    ends = np.concatenate((edges, [flat.size]))
    runs = np.diff(ends, prepend=0).tolist()
    if flat.size and flat[0]:
        runs.insert(0, 0)
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
