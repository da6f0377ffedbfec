#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
import signal
import sys

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C during the imports ends the program silently

from axis_camera.node import main  # noqa: E402

if __name__ == "__main__":
    sys.exit(main())
