# SPDX-License-Identifier: MIT
"""What keeps threads that send from waiting."""
import subprocess
import sys

# Pages that a second block of 8 MB takes from the system, after a first one was freed.
SECOND_BLOCK = """
import resource
import numpy
from ardee_bridge import priority

{first}
numpy.empty(8 << 20, "u1").fill(1)
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
numpy.empty(8 << 20, "u1").fill(2)
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


def _faults(first: str) -> int:
    program = SECOND_BLOCK.format(first=first)
    return int(subprocess.check_output([sys.executable, "-c", program], text=True))


def test_freed_memory_stays_with_the_process() -> None:
    assert _faults("priority.keep_memory()") <= 2
    assert _faults("") > 2  # of 4 kB, or of 2 MB where the system has such
