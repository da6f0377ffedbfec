# SPDX-License-Identifier: MIT
"""Tests that every kind of reading of the shipped sensors arrives as its class, whole and read-only."""
import dataclasses

import ardee_sim
import numpy as np
import pytest


@pytest.mark.slow
def test_every_topic_of_the_robot_gives_its_class_at_its_rate_in_its_frame(
    sim: ardee_sim.Simulation,
) -> None:
    topics = {name: info for name, info in sim.topics().items() if info.role == "reading"}
    sim.demand(*topics, keep=1000)
    sim.step(400)
    for name, info in topics.items():
        readings = sim.drain(name)
        reading = readings[-1]
        assert type(reading) is getattr(ardee_sim, info.kind), name
        assert 0 < reading.stamp_ns <= sim.time_ns, name
        frames = {each.frame_id for each in readings}
        assert info.frame_id == (frames.pop() if len(frames) == 1 else ""), name
        if info.rate_hz is None:
            assert len(readings) == 1, name
        else:
            assert len(readings) == pytest.approx(info.rate_hz * sim.time_ns * 1e-9, abs=1), name
        for field in dataclasses.fields(reading):
            value = getattr(reading, field.name)
            if isinstance(value, np.ndarray):
                assert not value.flags.writeable, (name, field.name)
    assert len({info.kind for info in topics.values()}) >= 12


def test_the_imu_feels_gravity(sim: ardee_sim.Simulation) -> None:
    sim.demand("ardee/imu/custom", keep=200)
    sim.step(400)
    felt = np.mean([reading.a_m_s2[2] for reading in sim.drain("ardee/imu/custom")[-50:]])
    assert abs(felt - 9.8) < 0.3
