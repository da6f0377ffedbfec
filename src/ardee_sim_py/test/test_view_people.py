# SPDX-License-Identifier: MIT
"""Tests what people and programs may do to the viewer, without a browser."""
import pathlib
import socket
from typing import Any, Dict, Iterator, Optional

import ardee_sim
import numpy as np
import pytest
import viser
from ardee_sim.envs import Episode
from ardee_sim.view import Viewer, viewer
from ardee_sim.view.glb import write_glb
from ardee_sim.view.panel import NO_CAMERA
from ardee_sim.view.server import is_own_page
from ardee_sim.view.shapes import Piece
from PIL import Image
from test_view import WORLD
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect

SCAN, PICTURE = "/ardee/hokuyo", "/ardee/camera/front/image_raw"


@pytest.fixture
def yard(terrasentia: str) -> Iterator[ardee_sim.Simulation]:
    """Yields a TerraSentia on a plane."""
    with ardee_sim.Simulation(ardee_sim.World.from_string(WORLD), seed=1) as made:
        made.spawn("robot", terrasentia, xyz_m=(0, 0, 0.175))
        yield made


@pytest.fixture
def shown(yard: ardee_sim.Simulation) -> Iterator[Viewer]:
    """Yields a viewer of the yard, as fast as it can."""
    with Viewer(yard, port=0, limits=(1.0, 2.0)) as made:
        made.wanted.pace = float("inf")
        yield made


def is_answered(port: str, page: Optional[str], host: str) -> bool:
    """Returns whether a page's websocket is answered."""
    address = f"ws://{host}:{port}"
    protocols: Any = [f"viser-v{viser.__version__}"]
    origin: Any = page
    try:
        with connect(address, origin=origin, subprotocols=protocols) as socket:
            return bool(socket.recv(timeout=10))
    except InvalidStatus as error:
        assert error.response.status_code == 403
        return False


def test_pages_of_other_sites_are_not_answered(shown: Viewer) -> None:
    port = shown.url.rpartition(":")[2]
    for page, expected in (
        (None, True),
        (shown.url, True),
        ("http://evil.example", False),
        ("null", False),
        (f"http://127.0.0.1:{int(port) + 1}", False),
        (f"http://evil.example:{port}", False),
    ):
        assert is_answered(port, page, "127.0.0.1") == expected, page
    # a foreign name that was made to point here
    assert not is_own_page(["http://evil.example:80"], ["evil.example:80"], "127.0.0.1")
    for name in ("localhost", f"{socket.gethostname().lower()}.local"):
        assert is_own_page([f"http://{name}:9000"], [f"{name}:9000"], "127.0.0.1")


def test_no_client_opens_a_tunnel(shown: Viewer, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("viser._viser.ViserTunnel", None)  # calling it would raise
    assert shown._server.request_share_url() is None


def is_served(url: str) -> bool:
    try:
        return is_answered(url.rpartition(":")[2], None, "127.0.0.1")
    except OSError:
        return False


def test_a_viewer_of_a_closed_simulation_shows_another_one_or_ends(
    yard: ardee_sim.Simulation, shown: Viewer
) -> None:
    with ardee_sim.Simulation(yard.world) as other:
        yard.close()
        shown.attach(other)
        shown.update()
    shown.close()
    assert not is_served(shown.url)


def test_a_simulation_without_the_chosen_camera_is_shown_without_one(
    yard: ardee_sim.Simulation, shown: Viewer
) -> None:
    shown.wanted.camera = "/ardee/camera/front/image_raw"
    shown.attach(yard)
    with ardee_sim.Simulation(yard.world) as other:
        other.spawn("robot", ardee_sim.robot("tsv1_default", ns="robot2"), xyz_m=(0, 0, 0.175))
        shown.attach(other)
        shown.update()
        assert shown.wanted.camera == NO_CAMERA
    shown.close()


def test_a_removed_robot_is_said_once(yard: ardee_sim.Simulation, shown: Viewer) -> None:
    yard.remove("robot")
    with pytest.warns(UserWarning, match="'robot' was removed") as said:
        shown.update()
        shown.update()
    assert len(said) == 1
    shown.close()
    assert not is_served(shown.url)


def test_a_robot_that_is_spawned_again_is_shown_and_driven(
    yard: ardee_sim.Simulation, shown: Viewer, terrasentia: str
) -> None:
    def scan_is_shown() -> bool:
        yard.step(round(0.1e9 / yard.step_ns))
        shown.update()
        return any(name.endswith("hokuyo") for name in shown._server.scene._handle_from_node_name)

    assert scan_is_shown()
    yard.remove("robot")
    with pytest.warns(UserWarning, match="'robot' was removed"):
        assert not scan_is_shown()
    yard.spawn("robot", terrasentia, xyz_m=(1, 0, 0.175))
    assert scan_is_shown() and "robot: x 1.00 m" in shown._panel._status.content
    yard.remove("robot")  # and at once another one has its name
    yard.spawn("robot", terrasentia.replace("cmd_vel", "drive"), xyz_m=(2, 0, 0.175))
    assert scan_is_shown() and "robot: x 2.00 m" in shown._panel._status.content
    shown._panel._inbox.put(("faster", None))
    shown.update()  # commands the topic that this robot has
    yard.step(40)
    assert yard.state("robot").v_m_s[0] > 0.02


def test_a_demand_made_since_stays(yard: ardee_sim.Simulation, shown: Viewer) -> None:
    yard.demand(SCAN.strip("/"), keep=5)
    shown.wanted.clouds, shown.wanted.camera = (), PICTURE
    shown.update()
    assert yard.demands(SCAN) and yard.demands(PICTURE)
    shown.wanted.camera = "none"
    shown.update()
    assert not yard.demands(PICTURE)


def test_a_viewer_that_fails_serves_nothing(
    yard: ardee_sim.Simulation, monkeypatch: pytest.MonkeyPatch
) -> None:
    with pytest.raises(ardee_sim.ArdeeError, match=r"limits: found \(-1, 2\)"):
        Viewer(yard, port=0, limits=(-1, 2))
    started = []
    start = viewer.start_server

    def recorded(*place: Any) -> Any:
        started.append(start(*place))
        return started[-1]

    monkeypatch.setattr(viewer, "start_server", recorded)
    monkeypatch.setattr(viewer, "SceneView", None)  # calling it raises TypeError
    with pytest.raises(TypeError):
        Viewer(yard, port=0)
    assert not is_served(f"http://127.0.0.1:{started[0].get_port()}")


@pytest.mark.parametrize(
    "name, sent, expected",
    [
        ("speed_m_s", 100.0, 1.0),
        ("turn_rad_s", -100, -2.0),
        ("speed_m_s", float("nan"), 0.0),
        ("speed_m_s", "fast", 0.0),
        ("pace", "0", float("inf")),
        ("pace", "2", 2.0),
        ("camera", "/lost", "none"),
        ("follow", "no", True),
        ("follow", False, False),
    ],
)
def test_what_clients_send_is_checked(shown: Viewer, name: str, sent: Any, expected: Any) -> None:
    shown._panel._inbox.put((name, sent))
    shown._panel.take()
    assert getattr(shown.wanted, name) == expected


def test_stop_gives_the_drive_back(
    yard: ardee_sim.Simulation, shown: Viewer, monkeypatch: pytest.MonkeyPatch
) -> None:
    sent = []
    monkeypatch.setattr(yard, "command", lambda topic, twist: sent.append(twist.linear_x_m_s))
    shown.update()
    for name in ("faster", "", "stop", ""):
        if name:
            shown._panel._inbox.put((name, None))
        shown.update()
    assert sent == [0.1, 0.1, 0.0]


def test_slow_paces_are_kept(
    yard: ardee_sim.Simulation, shown: Viewer, monkeypatch: pytest.MonkeyPatch
) -> None:
    now_s = [0.0]

    def sleep(wait_s: float) -> None:
        now_s[0] += wait_s

    monkeypatch.setattr(viewer.time, "monotonic", lambda: now_s[0])
    monkeypatch.setattr(viewer.time, "sleep", sleep)
    shown.wanted.pace = 0.1
    shown.update()
    for _ in range(3):
        yard.step(round(0.5e9 / yard.step_ns))
        shown.update()
    assert now_s[0] == pytest.approx(15.0, abs=0.1)


def test_a_program_sets_the_pace(yard: ardee_sim.Simulation, shown: Viewer) -> None:
    shown.wanted.pace = 300.0
    shown.attach(yard)
    shown.update()
    shown.wanted.pace = 0.0
    with pytest.raises(ardee_sim.ArdeeError, match="wanted.pace: found 0.0"):
        shown.update()


def test_a_texture_that_changed_is_read_again(tmp_path: pathlib.Path) -> None:
    material: Dict[str, Any] = {"rgba": np.ones(4), "emissive": np.zeros(3), "two_sided": False}
    material.update(texture=str(tmp_path / "leaf.png"), alpha_rejection=-1.0)
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    triangle = Piece(corners, np.array([[0, 1, 2]]), material, corners[:, :2], None)
    files = []
    for color in ("red", "green"):
        Image.new("RGB", (4, 4), color).save(material["texture"])
        files.append(write_glb([triangle]))
    assert files[0] != files[1]


def test_an_episode_keeps_its_arguments_or_is_refused(tmp_path: pathlib.Path) -> None:
    file = tmp_path / "episode.json"
    given = {"a": np.float32(0.5), "b": np.arange(2), "c": tmp_path, "d": np.bool_(True)}
    Episode("id", given, {}, [[0.0]]).save(file)
    assert Episode.load(file).arguments == {"a": 0.5, "b": [0, 1], "c": str(tmp_path), "d": True}
    with pytest.raises(ardee_sim.ArdeeError, match="found <object object.*expected numbers"):
        Episode("id", {"a": object()}, {}, []).save(file)
    assert Episode.load(file).environment == "id"  # the file of before


@pytest.mark.parametrize(
    "name, value, expected",
    [
        ("environment", "1", "environment: found 1, expected a str"),
        ("arguments", "[]", r"arguments: found \[\], expected a dict"),
        ("actions", "[[0.5], 2]", r"actions\[1\]: found 2, expected a list of numbers"),
    ],
)
def test_an_episode_of_wrong_types_is_refused(
    tmp_path: pathlib.Path, name: str, value: str, expected: str
) -> None:
    parts = {"environment": '"id"', "arguments": "{}", "replay": "{}", "actions": "[]"}
    parts[name] = value
    file = tmp_path / "episode.json"
    file.write_text("{" + ", ".join(f'"{key}": {part}' for key, part in parts.items()) + "}")
    with pytest.raises(ardee_sim.ArdeeError, match=expected):
        Episode.load(file)
