# SPDX-License-Identifier: MIT
"""Processes for images whose end comes at a bad time."""
import subprocess
import sys
from pathlib import Path

import yaml

from ardee_bridge.counters import Counters
from ardee_bridge.frames import FrameProcess, FrameProcesses, Job, Shared
from ardee_bridge.sensor_server import SensorServer, Target
from ardee_bridge.settings import read_server
from ardee_bridge.udp import PairLock, open_socket

SOURCE = {"name": "depth", "kind": "image", "topic": "/depth", "component_id": 6, "format": "raw"}
SHIPPED = Path(__file__).parents[1] / "config" / "sensor_server.yaml"
EVERYTHING = 0xFFFFFFFF


class _EndsAtOnce(subprocess.Popen):
    def __init__(self, *arguments, **options):
        super().__init__(*arguments, **options)
        self.wait()


def test_one_that_ends_before_it_has_its_job_is_started_again(monkeypatch):
    monkeypatch.setattr(sys, "executable", "/bin/false")
    monkeypatch.setattr(subprocess, "Popen", _EndsAtOnce)
    settings = read_server({**yaml.safe_load(SHIPPED.read_text()), "sources": [SOURCE]})
    said = []
    with open_socket("127.0.0.1", 0) as opened:
        shared = Shared(opened, PairLock.make(), said.append)
        process = FrameProcess(Job("frames", settings, False), shared)
        wanted = (Target(("127.0.0.1", 9), EVERYTHING, 6, None),)
        for _ in range(2):
            process.serve(wanted, frozenset({"depth"}))
        assert said == ["frames has ended: exit code 1"]
        process.stop()
        assert said == ["frames has ended: exit code 1"] * 2


def test_none_is_started_once_they_have_ended(monkeypatch):
    values = yaml.safe_load(SHIPPED.read_text())
    peer = {"address": "127.0.0.1", "port": 9, "data_types": ["image"]}
    settings = read_server({**values, "sources": [SOURCE], "peers": [peer]})
    started = []
    monkeypatch.setattr(FrameProcess, "serve", lambda self, *_: started.append(self.name))
    with open_socket("127.0.0.1", 0) as opened:
        lock = PairLock.make()
        server = SensorServer(settings, opened, Counters(print), lambda: None, lock=lock)
        frames = FrameProcesses("server", settings, None, Shared(opened, lock, print))
        frames.serve(server)
        assert started == ["server_frames"]
        frames.stop()
        frames.serve(server)
        frames.follow(server)
        assert started == ["server_frames"]
