# SPDX-License-Identifier: MIT
"""Makes the packages importable from the source tree."""
import sys
from pathlib import Path

PACKAGE = Path(__file__).resolve().parents[1]
for name in ("ardee_bridge", "ardee_common", "ardee_models", "ardee_world", "ardee_navigation"):
    sys.path.insert(0, str(PACKAGE.parent / name / "src"))
