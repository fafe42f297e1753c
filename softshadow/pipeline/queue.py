"""Draws that wait: a run of draws under one state is carried out at once, when someone looks at the buffers.

A thousand draws of twelve triangles cost a thousand times what Python needs for one; in a run, it is needed once. Draws
wait only if they cannot fail (`choose.begin_run`), so errors appear at the calls that make them.
"""

from __future__ import annotations

import numpy as np

from softshadow import pipeline
from softshadow.framebuffer import Storage
from softshadow.pipeline.choose import MOST_DRAWS, MOST_VERTICES, begin_run, plan_draw
from softshadow.pipeline.commands import Draw

try:
    from softshadow.pipeline.fast.batch.geometry import geometry_of
    from softshadow.pipeline.fast.batch.table import Run
except ModuleNotFoundError:  # the folder can be deleted: then no draw waits
    pass


class DrawQueue:
    """The draws of a context that are not carried out yet.

    Parameters
    ----------
    storage : Storage        what they will be drawn to
    """

    def __init__(self, storage: Storage) -> None:
        self._storage = storage
        self._run: Run | None = None
        self._draws: list[Draw] = []
        self._n_vertices = 0

    def add(self, command: Draw) -> bool:
        """Let a draw wait; return False if it must be carried out at once (all draws before it have been, then)."""
        n_vertices = len(command.vertices.position)
        run = self._run
        if run is None or self._n_vertices + n_vertices > MOST_VERTICES or not run.takes(command):
            self.carry_out()
            run = self._run = begin_run(command, self._storage)
            if run is None:
                return False
        self._draws.append(command)
        self._n_vertices += n_vertices
        if len(self._draws) == MOST_DRAWS:
            self.carry_out()
        return True

    def carry_out(self) -> None:
        """Carry out the draws that wait."""
        run, draws = self._run, self._draws
        if run is None:
            return
        self._run, self._draws, self._n_vertices = None, [], 0
        command, storage = run.command, self._storage
        target = storage.framebuffers[command.state.draw_framebuffer]
        with np.errstate(all="ignore"):  # as in pipeline.draw
            geometry = geometry_of(run, draws, target, storage)
            pipeline.draw_geometry(plan_draw(command, target, False), command, target, storage, geometry)
