#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
import sys

from axis_camera.node import main

if __name__ == "__main__":
    sys.exit(main())
