# SPDX-License-Identifier: MIT
"""Sends the sensors of a robot to target computers over UDP, and drives it by their commands."""
from ardee_bridge.wire import chunks, codec, pairing  # noqa: F401
