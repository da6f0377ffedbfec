# SPDX-License-Identifier: MIT
"""Tests the viewer, with its page in headless Chromium."""
import pathlib
import re
import socket
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from typing import Iterator, List

import ardee_sim
import browser_page
import gymnasium
import numpy as np
import pytest
from ardee_sim.envs import Episode, RecordEpisode
from ardee_sim.view import Viewer, play, view

WORLD = """<sdf version="1.6"><world name="yard">
  <physics type="ode"><max_step_size>0.005</max_step_size></physics>
  <include><uri>model://sun</uri></include>
  <model name="ground"><static>true</static><link name="link">
    <collision name="c"><geometry><plane><normal>0 0 1</normal></plane></geometry></collision>
    <visual name="v"><geometry><plane><normal>0 0 1</normal><size>20 20</size></plane></geometry>
      <material><diffuse>0.5 0.5 0.5 1</diffuse></material></visual>
  </link></model>
  <include><uri>model://corn_variant_8</uri><pose>2 0.6 0 0 0 0</pose></include>
</world></sdf>"""


@pytest.fixture
def yard(terrasentia: str) -> Iterator[ardee_sim.Simulation]:
    """Yields a TerraSentia and a plant on a plane."""
    with ardee_sim.Simulation(ardee_sim.World.from_string(WORLD), seed=1) as made:
        made.spawn("robot", terrasentia, xyz_m=(0, 0, 0.175))
        yield made


def orange(pixels: np.ndarray) -> int:
    """Returns the number of pixels of the robot's legs, the only ones of their colour."""
    r, g, b = (pixels[:, :, k].astype(int) for k in range(3))
    return int(((r > 120) & (r > g + 40) & (g > b + 20)).sum())


def number(page: browser_page.Page, pattern: str) -> float:
    """Returns a number that the page says, 0 if it does not."""
    found = re.search(pattern, page.text())
    return float(found[1]) if found else 0.0


@pytest.mark.slow
@browser_page.NEEDS
def test_the_page_shows_the_robot_and_keys_drive_it(
    yard: ardee_sim.Simulation, tmp_path: pathlib.Path
) -> None:
    times_s: List[float] = []

    def look_and_drive(page: browser_page.Page) -> None:
        browser_page.wait_for(lambda: orange(page.pixels()[:, :400]) > 100)
        # a page that is still loading does not hear keys
        browser_page.wait_for(lambda: page.press("i") or viewer.wanted.speed_m_s > 0, 1.0)
        browser_page.wait_for(lambda: number(page, r"x ([\d.]+) m") > 0.1)
        page.press("p")
        browser_page.wait_for(lambda: viewer.wanted.is_paused)
        count = len(times_s)
        said_s = r"([\d.]+) s, robot"
        browser_page.wait_for(lambda: number(page, said_s) == pytest.approx(times_s[-1]))
        page.press("n")
        after_s = times_s[count - 1] + 0.1
        browser_page.wait_for(lambda: number(page, said_s) == pytest.approx(after_s))
        assert len(times_s) == count + 1
        assert page.complaints == []

    def people() -> None:
        try:
            with browser_page.open_page(viewer.url, tmp_path / "profile") as page:
                look_and_drive(page)
        finally:
            viewer.wanted.is_paused = False

    with view(yard, port=0, radius_m=5) as viewer, ThreadPoolExecutor() as pool:
        done = pool.submit(people)
        while not done.done():
            yard.step(20)
            times_s.append(yard.time_ns * 1e-9)
            viewer.update()
        done.result()
    assert yard.state("robot").xyz_m[0] > 0.1


@pytest.mark.slow
def test_readings_are_the_same_bytes_with_a_viewer(corn: ardee_sim.World, terrasentia: str) -> None:
    topics = (
        "ardee/hokuyo",
        "ardee/imu/custom",
        "odom",
        "ardee/gps",
        "ardee/camera/front/image_raw",
    )

    def drive(with_viewer: bool) -> List[bytes]:
        readings: List[bytes] = []
        with ardee_sim.Simulation(corn, seed=3) as sim:
            sim.spawn("robot", terrasentia, **corn.start)
            sim.demand(*topics, keep=100)
            viewer = Viewer(sim, port=0) if with_viewer else None
            if viewer:
                viewer.wanted.pace = float("inf")
                viewer.wanted.camera = "/ardee/camera/front/image_raw"
            sim.command("cmd_vel", ardee_sim.Twist(linear_x_m_s=0.5))
            for _ in range(6):
                sim.step(10)
                if viewer:
                    viewer.update()
            for topic in topics:
                for reading in sim.drain(topic):
                    fields = vars(reading).values()
                    readings += [getattr(f, "tobytes", repr(f).encode)() for f in fields]
            if viewer:
                viewer.close()
                assert all(sim.demands(topic) for topic in topics)
        return readings

    assert drive(True) == drive(False)


def test_what_nobody_else_demands_is_measured_while_it_is_shown(yard: ardee_sim.Simulation) -> None:
    with view(yard, port=0):
        assert yard.demands("ardee/hokuyo")
    assert not yard.demands("ardee/hokuyo")


def test_the_page_is_for_this_computer_alone(yard: ardee_sim.Simulation) -> None:
    with view(yard, port=0) as viewer:
        assert viewer.url.startswith("http://127.0.0.1:")
        port = int(viewer.url.rpartition(":")[2])
        with socket.create_connection(("127.0.0.1", port), timeout=5):
            pass
        with pytest.raises(OSError):  # 127.0.0.2 is this computer too, by another address
            socket.create_connection(("127.0.0.2", port), timeout=5)


def test_bad_options_are_refused(yard: ardee_sim.Simulation) -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        with pytest.raises(ardee_sim.ArdeeError, match=f"127.0.0.1:{port}.*in use.*free port"):
            view(yard, port=port)
    with pytest.raises(ardee_sim.ArdeeError, match="127.0.0.1:65536: port must be 0-65535"):
        view(yard, port=65536)
    with pytest.raises(ardee_sim.ArdeeError, match=r"no robot 'robbot'.*\['robot'\]"):
        view(yard, port=0, robot="robbot")
    with pytest.raises(ardee_sim.ArdeeError, match="radius_m: found -1"):
        view(yard, port=0, radius_m=-1)


@pytest.mark.parametrize(
    "words, expected",
    [
        (["lost.world"], "lost.world"),
        (["corn.world", "--robot", "lost"], "found no robot 'lost', expected a file or one of: "),
        (["empty.world", "--parameters", "lost.yaml"], "lost.yaml"),
        (["empty.world", "--controllers", "base"], "without a controller manager"),
    ],
)
def test_the_command_refuses_bad_input_in_one_line(words: List[str], expected: str) -> None:
    command = [sys.executable, "-m", "ardee_sim.view", "--port", "0", *words]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.returncode == 2 and expected in done.stderr and done.stderr.count("\n") == 1


def test_a_missing_viser_is_said() -> None:
    program = "import sys; sys.modules['viser'] = None; import ardee_sim.view"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert "expected: pip install viser, or the wheel with its extra [view]" in done.stderr


def test_a_recorded_episode_is_shown_again(
    tmp_path: pathlib.Path, capsys: pytest.CaptureFixture
) -> None:
    env = RecordEpisode(gymnasium.make("ardee/RowFollow-v0", seed_field=False))
    env.reset(seed=5)
    for _ in range(3):
        observation = env.step(np.array([0.7, 0.1], np.float32))[0]
    env.episode.save(tmp_path / "episode.json")
    env.close()
    episode = Episode.load(tmp_path / "episode.json")
    again = episode.make()
    results = list(episode.play(again))
    assert len(results) == 4 and np.array_equal(results[-1][0], observation)
    with Viewer(again.unwrapped.simulation, port=0, drive=False) as viewer:
        viewer.wanted.pace = float("inf")
        for result in episode.play(again):
            viewer.update()
    assert np.array_equal(result[0], observation)
    again.close()
    play(episode, turns=1, port=0)
    assert capsys.readouterr().out.startswith("http://127.0.0.1:")


def test_what_is_no_episode_is_refused(tmp_path: pathlib.Path) -> None:
    file = tmp_path / "episode.json"
    for text, expected in (
        ("{", "expected JSON"),
        ("[]", "expected the keys environment, arguments, replay, actions"),
    ):
        file.write_text(text)
        with pytest.raises(ardee_sim.ArdeeError, match=f"episode.json: .*{expected}"):
            Episode.load(file)
    with pytest.raises(ardee_sim.ArdeeError, match="ardee/RowFolow-v0"):
        Episode("ardee/RowFolow-v0", {}, {}, []).make()
