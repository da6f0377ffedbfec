# SPDX-License-Identifier: MIT
"""A run in a page of the browser while it is done again."""
import sys
from typing import Any

import ardee_sim

from ardee_campaigns.robot import NAME
from ardee_common.errors import GeneratorError


class Page:
    """Shows a run: paused at its start, then in real time, and paused at its end. For `with`."""

    def __init__(self, port: int) -> None:
        try:
            from ardee_sim.view import Viewer
        except ImportError as error:
            raise GeneratorError(f"--view: {error}") from None
        self._make, self._port = Viewer, port
        self._viewer: Any = None

    def __call__(self, sim: ardee_sim.Simulation, is_over: bool) -> None:
        """Shows the present; returns when the next step is due."""
        is_first = self._viewer is None
        if is_first:
            self._open(sim)
        if is_first or is_over:
            self._viewer.wanted.is_paused = True
        self._viewer.update()

    def _open(self, sim: ardee_sim.Simulation) -> None:
        try:
            self._viewer = self._make(sim, robot=NAME, drive=False, port=self._port)
        except ardee_sim.ArdeeError as error:  # which is no failure of the run
            print(f"run_campaign: --view: {error}", file=sys.stderr)
            sys.exit(2)
        print(
            f"{self._viewer.url} (paused at the start and at the end; Ctrl-C ends it)", flush=True
        )

    def __enter__(self) -> "Page":
        return self

    def __exit__(self, *_: object) -> None:
        if self._viewer:
            self._viewer.close()
