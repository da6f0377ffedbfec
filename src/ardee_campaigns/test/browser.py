# SPDX-License-Identifier: MIT
"""Looks at a page in Chromium, without a display and without a network."""
import re
import shutil
import subprocess
from pathlib import Path
from typing import List, NamedTuple

import numpy as np
import pytest
from matplotlib import image

BROWSER = shutil.which("chromium") or shutil.which("google-chrome")
NEEDS = pytest.mark.skipif(not BROWSER, reason="found no chromium, which shows pages")


class Seen(NamedTuple):
    """A page as a browser shows it."""

    pixels: np.ndarray  # uint8[h, w, 3]
    complaints: List[str]  # of its console

    def has(self, color: str, within: int = 12) -> int:
        """Returns how many pixels have a color `#rrggbb`, nearly."""
        wanted = [int(color[place : place + 2], 16) for place in (1, 3, 5)]
        return int((np.abs(self.pixels.astype(int) - wanted) <= within).all(axis=2).sum())


def look_at(page: Path, height_px: int = 6000) -> Seen:
    """Loads a page and takes a picture of its upper part."""
    shot = page.with_suffix(".shot.png")
    settings = ["--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"]
    network = ["--host-resolver-rules=MAP * ~NOTFOUND", "--disable-background-networking"]
    output = [f"--screenshot={shot}", f"--window-size=1200,{height_px}", "--enable-logging=stderr"]
    profile = f"--user-data-dir={page.with_suffix('.profile')}"
    words = [str(BROWSER), *settings, *network, *output, profile, f"file://{page}"]
    done = subprocess.run(words, capture_output=True, text=True, timeout=120)
    assert shot.is_file(), done.stderr
    pixels = (image.imread(str(shot))[:, :, :3] * 255).astype(np.uint8)
    return Seen(pixels, re.findall(r".*CONSOLE.*|.*Failed to load.*", done.stderr))
