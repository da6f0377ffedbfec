# SPDX-License-Identifier: MIT
"""matplotlib without a display, and the file of a figure."""
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
matplotlib.rcParams["text.parse_math"] = False  # a level's name may have dollars in it

from matplotlib import pyplot  # noqa: E402

__all__ = ["pyplot", "save"]


def save(figure: pyplot.Figure, path: Path) -> None:
    """Writes a figure without the software's version, so that the same content gives the same file."""
    figure.tight_layout()
    figure.savefig(path, dpi=110, metadata={"Software": None})
    pyplot.close(figure)
