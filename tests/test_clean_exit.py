# SPDX-License-Identifier: MIT
"""Tests that Ctrl-C ends everything that a launch file started."""
import pathlib
import signal

import probes

from ardee_common.ros_graph import RosGraph, wait_until

PLANE = str(pathlib.Path(__file__).parent / "data" / "plane.world")


def test_ctrl_c_on_the_launch_files_leaves_no_process(graph: RosGraph) -> None:
    world = graph.launch("ardee_world", "custom_world.launch", "world:=farm.world")
    graph.call(probes.clock_at_least, 0.2)
    robot = graph.launch("terrasentia_description", "launch_default_tsv1.launch", "use_rviz:=false")
    graph.call(probes.wait_for_topics, ["/odom"], [])
    assert len(graph.alive()) >= 4  # two roslaunches, the simulator, robot_state_publisher
    for process in (robot, world):
        process.interrupt()
        process.wait()
    assert "escalating" not in robot.output() + world.output()
    wait_until(lambda: not graph.alive(), f"all ended; left: {graph.alive()}", 10.0)


def test_ctrl_c_ends_the_simulator_at_once_and_with_exit_0(graph: RosGraph) -> None:
    executable = graph.run("catkin_find", "--first-only", "--libexec", "ardee_sim_cpp", "simulator")
    simulator = graph.spawn(executable.strip(), PLANE)
    graph.call(probes.clock_at_least, 0.1)
    simulator.interrupt()
    assert simulator.wait(10.0) == 0, simulator.output()


def test_ctrl_c_amid_the_imports_of_spawn_model_ends_it_without_a_word(
    graph: RosGraph, tmp_path: pathlib.Path
) -> None:
    """Repeats the case in which the simulator refuses its world at once, and the launch file ends with it."""
    (tmp_path / "rospy.py").write_text(
        "import os, signal, time\nos.kill(os.getpid(), signal.SIGINT)\ntime.sleep(60)\n"
    )
    script = graph.run("catkin_find", "--first-only", "--libexec", "ardee_sim_cpp", "spawn_model")
    path = f"{tmp_path}:{graph.env.get('PYTHONPATH', '')}"
    spawner = graph.spawn(script.strip(), "-urdf", "-stdin", "-model", "m", PYTHONPATH=path)
    assert (spawner.wait(20.0), spawner.output()) == (-signal.SIGINT, "")
