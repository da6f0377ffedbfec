# SPDX-License-Identifier: MIT
"""Drives a run in lockstep: a scan, the row follower's answer and command, the physics steps between scans."""
import time
from typing import TYPE_CHECKING, Callable, Union

from ardee_navigation.evaluation.record import Record
from ardee_navigation.evaluation.scan import Scan
from ardee_navigation.evaluation.simulation import Simulation, SimulationError
from ardee_navigation.evaluation.trial import Judge, Seen
from ardee_navigation.lbirnt import Output, Parameters, RowFollower
from ardee_world.trial import Trial

if TYPE_CHECKING:  # over ROS it is the same, and a run without ROS does not import it
    from ardee_navigation.evaluation.ros_simulation import RosSimulation

STEP_S = 0.005  # step of the worlds
STEPS_A_SCAN = 5  # 25 ms: the UST-10LX's 40 Hz
SETTLE_STEPS = 200  # 1 s: the robot comes to rest on its springs
AnySimulation = Union[Simulation, "RosSimulation"]


def _settle(simulation: AnySimulation) -> None:
    """Lets the robot come to rest; discards the scans of that time."""
    simulation.command(0.0, 0.0)
    end_s = simulation.step(SETTLE_STEPS)
    before_s = now_s = simulation.scan().time_s
    while now_s < end_s - (STEPS_A_SCAN - 0.5) * STEP_S:
        before_s, now_s = now_s, simulation.scan().time_s
    if abs(now_s - before_s - STEPS_A_SCAN * STEP_S) > 1e-6:
        raise SimulationError(
            f"found scans {now_s - before_s:.6f} s apart, expected {STEPS_A_SCAN} steps of {STEP_S} s"
        )


def _seen(output: Output) -> Seen:
    lane = output.lane
    return Seen(lane.left.distance_m, -lane.right.distance_m, output.valid, output.state.value)


def drive(
    simulation: AnySimulation,
    trial: Trial,
    parameters: Parameters,
    judge: Judge,
    progress: Callable[[float], None],
    watch: Callable[[Scan, Output], None] = lambda scan, output: None,
) -> Record:
    """Drives one run; the robot stands at its start. `progress` gets the distance along the lane [m].

    `watch` gets each scan and its answer, after the judge.
    """
    began = time.monotonic()
    follower = RowFollower(parameters)
    _settle(simulation)
    while not judge.record.end:
        simulation.step(STEPS_A_SCAN)
        scan = simulation.scan()
        output = follower.update(scan.ranges_m, scan.angle_min_rad, scan.increment_rad, scan.time_s)
        command = (output.speed_m_s, output.turn_rad_s)
        pose = simulation.command(*command)
        back = judge.look(scan.time_s, pose, command, _seen(output))
        judge.keep_scan(scan)
        progress(judge.record.samples[-1].along_m)
        watch(scan, output)
        if back is not None:
            simulation.set_pose(back, trial.height_m(back))
            follower.reset()
            _settle(simulation)
    return judge.finish(time.monotonic() - began)
