# SPDX-License-Identifier: MIT
"""Prints how many tests of a JUnit file passed and how many failed, as two numbers; skipped tests are neither."""
import sys
import xml.etree.ElementTree as tree
from typing import Tuple


def count(path: str) -> Tuple[int, int]:
    """Returns the numbers of passed and failed test cases in the JUnit file at `path`."""
    passed = failed = 0
    for case in tree.parse(path).getroot().iter("testcase"):
        if case.find("failure") is not None or case.find("error") is not None:
            failed += 1
        elif case.find("skipped") is None and case.get("status") not in ("notrun", "disabled"):
            passed += 1
    return passed, failed


if __name__ == "__main__":
    print(*count(sys.argv[1]))
