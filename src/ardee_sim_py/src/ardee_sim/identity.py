# SPDX-License-Identifier: MIT
"""Hash of the simulator as it is built, which is part of what runs and data sets are known by."""
import functools
from importlib.util import find_spec
from pathlib import Path
from xml.etree import ElementTree

from ardee_sim.packages import find_package

from ardee_common.digests import Digests, python_files
from ardee_models import lookup
from ardee_world import trial

_CORE = "ardee_sim._core"  # the extension module


def engine_version() -> str:
    """Returns the version of the simulator."""
    package = ElementTree.parse(find_package("ardee_world") / "package.xml")
    return package.findtext("version", "")


@functools.lru_cache(maxsize=None)
def engine_digest() -> str:
    """Returns a hash of the simulator: its version, its extension module, Python files of plants and fields."""
    core = find_spec(_CORE)
    files = [Path(core.origin)] if core and core.origin else []
    for module in (trial, lookup):
        files += python_files(Path(module.__file__))
    return Digests().of(files) + engine_version()
