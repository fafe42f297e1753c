"""Draws that wait: a run of draws under one state is carried out at once, when someone looks at the buffers.

A thousand draws of twelve triangles cost a thousand times what Python needs for one; in a run, it is needed once. Draws
wait only if they cannot fail (`choose.begin_run`), so errors appear at the calls that make them.
"""

from __future__ import annotations

import numpy as np

from softshadow import pipeline
from softshadow.framebuffer import Storage
from softshadow.pipeline.choose import MOST_DRAWS, MOST_VERTICES, SHORT_CUTS_EXIST, Plan, begin_run, may_wait, plan_draw
from softshadow.pipeline.commands import Draw

try:
    from softshadow.pipeline.fast.any_state import FILL_KERNELS
    from softshadow.pipeline.fast.batch.geometry import Setting, geometry_of, setting_of
    from softshadow.pipeline.fast.batch.table import BATCH_KERNELS, Run, key_of
    from softshadow.pipeline.fast.map_visibility_kernel import VISIBILITY_KERNEL
except ModuleNotFoundError:  # the folder can be deleted: then no draw waits
    pass


KNOWN_KINDS = 64


class DrawQueue:
    """The draws of a context that are not carried out yet.

    Parameters
    ----------
    storage : Storage        what they will be drawn to
    compiles : bool          whether to compile kernels at the first use: for one picture some of them do not pay
    """

    def __init__(self, storage: Storage, compiles: bool = True) -> None:
        self._storage, self._compiles = storage, compiles
        if compiles and SHORT_CUTS_EXIST:
            FILL_KERNELS.want()
            VISIBILITY_KERNEL.want()
        self._run: Run | None = None
        self._draws: list[Draw] = []
        self._n_vertices = 0
        # kinds of runs by the identity of what they depend on, each with that of their geometry and their fragments
        self._known: dict[tuple[int, ...], list[tuple[Run, Setting, Plan]]] = {}
        self._setting: Setting | None = None
        self._plan: Plan | None = None

    def add(self, command: Draw) -> bool:
        """Let a draw wait; return False if it must be carried out at once (all draws before it have been, then)."""
        n_vertices = len(command.vertices.position)
        run = self._run
        if run is None or self._n_vertices + n_vertices > MOST_VERTICES or not run.takes(command):
            self.carry_out()
            if not self._begin_run(command):
                return False
        self._draws.append(command)
        self._n_vertices += n_vertices
        if len(self._draws) == MOST_DRAWS:
            self.carry_out()
        return True

    def _begin_run(self, command: Draw) -> bool:
        if not may_wait(command, self._storage) or not (self._compiles or BATCH_KERNELS.are_compiled()):
            return False
        key = key_of(command.state)
        for kind in self._known.get(key, ()):
            if kind[0].takes(command):
                self._run, self._setting, self._plan = kind
                return True
        target = self._storage.framebuffers[command.state.draw_framebuffer]
        run = begin_run(command, target, self._storage)
        if run is None:
            return False
        kind = run, setting_of(run, target, self._storage), plan_draw(command, target, False)
        if len(self._known) >= KNOWN_KINDS:
            self._known.clear()
        self._known.setdefault(key, []).append(kind)
        self._run, self._setting, self._plan = kind
        return True

    def forget(self) -> None:
        """Forget the kinds of runs, when a texture or a framebuffer object changes."""
        self._known.clear()

    def carry_out(self) -> None:
        """Carry out the draws that wait."""
        run, setting, plan, draws = self._run, self._setting, self._plan, self._draws
        if run is None or setting is None or plan is None:
            return
        self._run, self._draws, self._n_vertices = None, [], 0
        storage = self._storage
        target = storage.framebuffers[run.state.draw_framebuffer]
        with np.errstate(all="ignore"):  # as in pipeline.draw
            geometry, fragments = geometry_of(run, setting, draws, target, storage)
            BATCH_KERNELS.note_compiled()
            pipeline.draw_geometry(plan, run.command, target, storage, geometry, fragments=fragments)
