# SPDX-License-Identifier: MIT
"""Shows the models of a simulation: scenery near a place, and everything that moves."""

import contextlib
from typing import Any, Dict, List, Tuple

import numpy as np
from ardee_sim.simulation import Simulation
from ardee_sim.view.glb import write_glb
from ardee_sim.view.shapes import ground_pieces, moved, pieces_of, rotation

_Links = List[Tuple[str, np.ndarray, np.ndarray, List[Dict[str, Any]]]]


def wxyz(quat_xyzw: np.ndarray) -> np.ndarray:
    """Returns a quaternion, or an array of them, in the order of the page."""
    return np.roll(quat_xyzw, 1, axis=-1)


def node(*names: str) -> str:
    """Returns the name of a node in the page's tree, in the simulated world."""
    return "/world" + "".join("/" + name.replace("/", "_") for name in names)


def remove(handle: Any) -> None:
    """Takes a node or a control of the page away.

    viser wakes its own thread in a way that fails with RuntimeError if that thread goes to sleep at this moment; the
    message is in its queue by then.
    """
    with contextlib.suppress(RuntimeError):
        handle.remove()


_SAME = 1e-5  # difference of poses that nobody sees


class SceneView:
    """The models of a simulation in the tree of the page: /world/scenery/N and /world/models/MODEL/LINK.

    radius_m : fields and grounds are shown up to here from the place of the last update()
    """

    def __init__(self, server: Any, sim: Simulation, radius_m: float) -> None:
        self._server, self._sim, self._radius_m = server, sim, radius_m
        self._scenery: List[Any] = []
        self._models_glb: Dict[Any, Tuple[bytes, _Links]] = {}  # of a description: file, grounds
        self._center = np.full(2, np.inf)
        self._models: Dict[
            str, Tuple[Any, Dict[str, Any]]
        ] = {}  # description, node of each link, of "" the model's
        self._statics: List[Tuple[str, bytes]] = []

    def update(self, place_m: np.ndarray) -> None:
        """Shows the present state; `place_m` is where scenery has to be seen."""
        entities = self._sim.entities()
        statics = [
            (entity.name, self._sim.state(entity.name).xyz_m.tobytes())
            for entity in entities
            if entity.is_static
        ]
        far = np.hypot(*(place_m[:2] - self._center)) > self._radius_m / 3
        if far or statics != self._statics:
            self._show_scenery(place_m[:2])
            self._statics, self._center = statics, place_m[:2].copy()
        moving = {entity.name for entity in entities if not entity.is_static}
        for name in moving | set(self._models):
            self._show_model(name, name in moving)

    def close(self) -> None:
        """Takes everything away."""
        for handle in self._scenery:
            remove(handle)
        for name in list(self._models):
            self._show_model(name, False)

    def _show_scenery(self, center_m: np.ndarray) -> None:
        old, self._scenery = self._scenery, []
        for handle in old:
            remove(handle)
        found = self._sim.scenery(center_m[0], center_m[1], self._radius_m)
        for number, (description, places) in enumerate(found):
            name = node("scenery", f"{number}_{description.name}")
            if description not in self._models_glb:
                links = description.links()
                grounds = [link for link in links if any(map(_is_ground, link[3]))]
                self._models_glb[description] = write_glb(_at_rest(links)), grounds
            glb, grounds = self._models_glb[description]
            if glb:
                handle = self._server.scene.add_batched_glb(
                    name, glb, wxyz(places[:, 3:7]), places[:, :3], batched_scales=places[:, 7]
                )
                self._scenery.append(handle)
            if grounds:
                for k, place in enumerate(places):
                    self._show_grounds(f"{name}_ground_{k}", grounds, place, center_m)

    def _show_grounds(
        self, name: str, links: _Links, place: np.ndarray, center_m: np.ndarray
    ) -> None:
        """Shows the heightmaps of a placed model."""
        pieces = []
        for _, link_xyz_m, link_quat, shapes in links:
            for shape in shapes:
                if not _is_ground(shape):
                    continue
                near = _inverse_place(place, link_xyz_m, link_quat, center_m)
                radius_m = self._radius_m / place[7]
                for piece in ground_pieces(shape, near[0], near[1], radius_m):
                    pieces.append(moved(piece, link_xyz_m, link_quat))
        if pieces:
            handle = self._server.scene.add_glb(
                name,
                write_glb(pieces),
                scale=float(place[7]),
                wxyz=wxyz(place[3:7]),
                position=place[:3],
            )
            self._scenery.append(handle)

    def _show_model(self, name: str, is_there: bool) -> None:
        description = self._sim.description(name) if is_there else None
        if name in self._models and self._models[name][0] is not description:
            remove(self._models.pop(name)[1][""])  # and all below it
        if description is None:
            return
        if name not in self._models:
            self._models[name] = description, self._add_links(name, description.links())
        # links that stay where they are in the model need no message to the page
        for link, handle in self._models[name][1].items():
            state = (
                self._sim.state(f"{name}::{link}", relative_to=name)
                if link
                else self._sim.state(name)
            )
            if np.abs(handle.position - state.xyz_m).max() > _SAME:
                handle.position = state.xyz_m
            if np.abs(handle.wxyz - wxyz(state.quat_xyzw)).max() > _SAME:
                handle.wxyz = wxyz(state.quat_xyzw)

    def _add_links(self, name: str, links: _Links) -> Dict[str, Any]:
        handles = {"": self._server.scene.add_frame(node("models", name), show_axes=False)}
        for link, _, _, shapes in links:
            frame = self._server.scene.add_frame(node("models", name, link), show_axes=False)
            glb = write_glb(pieces_of(shapes))
            if glb:
                self._server.scene.add_glb(node("models", name, link, "look"), glb)
            handles[link] = frame
        return handles


def _is_ground(shape: Dict[str, Any]) -> bool:
    return shape["kind"] == "heightmap"


def _at_rest(links: _Links) -> List[Any]:
    return [
        moved(piece, xyz_m, quat_xyzw)
        for _, xyz_m, quat_xyzw, shapes in links
        for piece in pieces_of(shapes)
    ]


def _inverse_place(
    place: np.ndarray, link_xyz_m: np.ndarray, link_quat: np.ndarray, center_m: np.ndarray
) -> np.ndarray:
    """Returns a place on the ground plan of the world in the frame of a placed model's link."""
    in_world = np.append(center_m, place[2])
    in_model = rotation(place[3:7]).T @ (in_world - place[:3]) / place[7]
    return rotation(link_quat).T @ (in_model - link_xyz_m)
