# SPDX-License-Identifier: MIT
"""Runs the demo in a sourced workspace or install space: field, world, robot, drive, summary."""
import argparse
import os
import pathlib
import shutil
import sys
import tempfile
import time
from typing import Any, Callable, List, Optional

import rospkg

from ardee_bringup import field, report
from ardee_common.cli import Parser, number_in, seed_number
from ardee_common.process import end_by_signals, end_if_told, ignore_end_signals
from ardee_common.ros_graph import Process, RosGraph, wait_until

RVIZ_CONFIG = "config/rviz/waypoint_follower_paths.rviz"
SCAN = "/ardee/hokuyo"
RECORDED = ["/clock", "/tf", "/tf_static", "/odom", "/joint_states", "/cmd_vel", SCAN]
SETTLE_S = 2.0  # simulated time in which the robot comes to rest on its springs


def say(text: str) -> None:
    """Prints one line of progress."""
    print(f"   {text}", flush=True)


class Demo:
    """One run of the demo: its processes, and its waits for conditions."""

    def __init__(self, options: argparse.Namespace, work: pathlib.Path) -> None:
        self.options, self.work = options, work
        self.graph = RosGraph(work)
        self.graph.env["GAZEBO_MODEL_PATH"] = os.pathsep.join(
            [str(work / "models"), os.environ.get("GAZEBO_MODEL_PATH", "")]
        )
        self.needed = []  # type: List[Process]

    def wait(self, condition: Callable[[], Any], what: str, timeout_s: float = 60.0) -> Any:
        """Returns the first true value of the condition; raises an error if a process that it needs ends before."""

        def checked() -> Any:
            end_if_told()
            for process in self.needed:
                if process.exit_code() is not None:
                    raise RuntimeError(f"{' '.join(process.command[:3])} has ended")
            return condition()

        return wait_until(checked, what, timeout_s)

    def start_world(self) -> None:
        """Starts the first launch file."""
        import rospy

        command = ["roslaunch", "ardee_world", "custom_world.launch", "world:=farm.world"]
        say(" ".join(command))
        self.needed.append(self.graph.spawn(*command, f"seed:={self.options.seed}"))
        self.wait(lambda: rospy.get_param("/use_sim_time", False), "the launch file's parameters")
        rospy.init_node("demo", anonymous=True, disable_signals=True)
        self.wait(lambda: rospy.get_time() > 0, "/clock")

    def start_robot(self, start: field.Start) -> None:
        """Starts the second launch file, with rviz if there is a display."""
        import rospy

        command = ["roslaunch", "terrasentia_description", "launch_default_tsv1.launch"]
        say(" ".join(command) + f" x:={start.x_m:.2f} y:={round(start.y_m, 2) + 0.0:.2f} ...")
        pose = {"x": start.x_m, "y": start.y_m, "z": start.z_m, "yaw": start.yaw_rad}
        arguments = [f"{name}:={value:.4f}" for name, value in pose.items()]
        display = os.environ.get("DISPLAY", "")
        env = {"DISPLAY": display} if display else {}
        self.needed.append(
            self.graph.spawn(*command, *arguments, f"use_rviz:={bool(display)}".lower(), **env)
        )
        self.wait(
            lambda: {"/odom", SCAN} <= {name for name, _ in rospy.get_published_topics()},
            "the robot's topics",
        )
        settled = rospy.get_time() + SETTLE_S
        self.wait(lambda: rospy.get_time() > settled, "the robot at rest")

    def record(self) -> Process:
        """Starts rosbag on the topics of a drive."""
        import rosnode

        bag = self.graph.spawn("rosbag", "record", "-O", str(self.work / "drive.bag"), *RECORDED)
        self.needed.append(bag)
        self.wait(lambda: any("record" in name for name in rosnode.get_node_names()), "rosbag")
        return bag

    def drive(self, distance_m: float) -> float:
        """Drives down the row, recorded, with a picture on the way; returns the real-time factor."""
        import rospy

        bag = self.record()

        wall_s, sim_s = time.monotonic(), rospy.get_time()
        driver = self.graph.spawn(
            "rosrun",
            "ardee_bringup",
            "drive_row",
            f"--speed-m-s={self.options.speed_m_s}",
            f"--distance-m={distance_m}",
        )
        photographer = None  # type: Optional[Process]
        shown = 0
        limit_s = 60.0 + 20.0 * distance_m / self.options.speed_m_s
        while driver.exit_code() is None:
            time.sleep(0.1)
            self.wait(lambda: True, "")
            if time.monotonic() - wall_s > limit_s:
                raise RuntimeError(f"the drive has not ended in {limit_s:.0f} s")
            lines = driver.output().splitlines()
            for line in lines[shown:]:
                say(f"  {line}")
            shown = len(lines)
            if shown and photographer is None:
                photographer = self.take_picture()
        factor = (rospy.get_time() - sim_s) / (time.monotonic() - wall_s)
        self.needed.remove(bag)
        bag.stop()
        # rosbag may end before its recorder has renamed the file.
        self.wait((self.work / "drive.bag").exists, "the bag")
        if driver.exit_code() != 0 or photographer is None:
            raise RuntimeError("the driver did not drive")
        if photographer.wait(90.0) != 0:
            raise RuntimeError("no picture")
        return factor

    def take_picture(self) -> Process:
        """Takes a picture of rviz with the robot launch file's configuration."""
        say("rviz draws a picture, off-screen")
        if not os.environ.get("DISPLAY"):  # else the launch file has it
            self.graph.spawn("rosrun", "terrasentia_description", "camera_preview")
        view = os.path.join(rospkg.RosPack().get_path("terrasentia_description"), RVIZ_CONFIG)
        command = ["rosrun", "ardee_bringup", "rviz_picture", view]
        return self.graph.spawn(*command, "--output", str(self.work / "rviz.png"))

    def run(self) -> None:
        """Runs all stages in order."""
        heading("field")
        truth = field.generate(self.graph, self.work / "models", self.options.seed, say)
        heading("world and robot")
        os.environ.update(self.graph.env)
        self.start_world()
        start = field.start_of_a_row(truth)
        self.start_robot(start)
        if not os.environ.get("DISPLAY"):
            say("no display: rviz draws off-screen only, into the picture below")
        heading("drive")
        factor = self.drive(start.distance_m)
        drive = report.read_drive(self.work / "drive.bag", SCAN)
        output = self.options.output
        output.mkdir(parents=True, exist_ok=True)
        for name in ("drive.bag", "rviz.png"):
            shutil.move(str(self.work / name), str(output / name))
        heading("summary")
        print(report.summary(drive, factor, truth, output), flush=True)


def heading(text: str) -> None:
    """Prints a heading."""
    print(f"\n== {text}", flush=True)


def options() -> argparse.Namespace:
    """Returns the parsed command line of the demo."""
    parser = Parser(
        description="Drives a robot down a row of corn; writes a picture and a bag of the drive."
    )
    parser.add_argument("--seed", type=seed_number, default=0, help="root of all random numbers")
    parser.add_argument("--speed-m-s", type=number_in(0.05, 2.0), default=0.6, help="speed [m/s]")
    parser.add_argument(
        "--output", type=pathlib.Path, default="demo_output", help="folder to write"
    )
    return parser.parse_args()


def main() -> int:
    """Runs the demo; returns its exit code."""
    found = options()
    end_by_signals()
    work = pathlib.Path(tempfile.mkdtemp(prefix="ardee_demo_"))
    demo = None  # type: Optional[Demo]
    try:
        demo = Demo(found, work)
        demo.run()
        return 0
    except (RuntimeError, TimeoutError, OSError) as error:
        print(f"demo: {error}", file=sys.stderr)
        if demo:
            print(demo.graph.logs(), file=sys.stderr)
        return 1
    finally:
        ignore_end_signals()
        if demo:
            demo.graph.close()
        shutil.rmtree(work, ignore_errors=True)
