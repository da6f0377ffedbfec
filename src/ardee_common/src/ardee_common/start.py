# SPDX-License-Identifier: MIT
"""Starts the program of a module; imports nothing that takes long, so that Ctrl-C is heeded from the first moments."""
import importlib
import signal
import sys


def start(module: str, prog: str = "", **arguments: str) -> None:
    """Imports a module and exits with what its main returns.

    Ctrl-C during the import ends the program silently, and one whose `prog` is given in a line and with code 130.
    """
    if prog:
        from ardee_common.process import end_in_a_line

        end_in_a_line(prog)
    else:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(importlib.import_module(module).main(**arguments))
