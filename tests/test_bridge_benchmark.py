# SPDX-License-Identifier: MIT
"""Runs the bridge's benchmark, briefly, on messages of its own and on a simulated robot: every figure is there."""
import benchmark_bridge
import pytest
from bench.capture import Capture

SMALL = {"imu", "gps", "lidar", "battery", "encoder", "bare forwarder"}
FRAMES = {"point_cloud", "jpeg image", "raw image"}
# Streams of a kind, and their rate [Hz].
PLANNED = {
    "imu": (1, 100),
    "gps": (1, 20),
    "lidar": (1, 40),
    "battery": (1, 100),
    "encoder": (4, 100),
    "jpeg image": (3, 30),
    "raw image": (1, 10),
    "point_cloud": (1, 10),
}


@pytest.fixture(scope="module")
def is_captured() -> bool:
    """Returns whether packets can be captured here, by which a simulated robot's messages are timed."""
    try:
        Capture("/anyone").close()
    except OSError:
        return False
    return True


def test_everything_is_measured(is_captured: bool) -> None:
    found = benchmark_bridge.measure(1.0, 1.0, 1, print)
    kinds = {"": SMALL, "beside cameras, ": SMALL | FRAMES}
    kinds["beside raw images, "] = kinds["beside cameras, "] - {"jpeg image"}
    if is_captured:
        kinds["simulated, "] = kinds["beside cameras, "]
    rows = {f"{run}{name} message to datagram" for run, names in kinds.items() for name in names}
    assert set(found) == rows | {"datagram to cmd_vel"}
    for name, figures in found.items():
        # a message through a socket takes microseconds, and the whole measurement less than minutes
        assert 0.005 < figures["p50_ms"] <= figures["p99_ms"] <= figures["max_ms"] < 240e3, name
    for kind, (streams, rate_hz) in PLANNED.items():
        sent = found[f"beside cameras, {kind} message to datagram"]["sent"]
        # of each stream, the last message may be due after the end
        assert streams * (rate_hz - 3) <= sent <= streams * (rate_hz + 1), kind
