"""The place in the line stipple from draw to draw.

A strip whose first line is clipped goes on in the pattern where the draw before it ended (glLineStipple). To find that
place takes the geometry of that draw, and hardly any draw asks for it. So it is found only then.
"""

from __future__ import annotations

import numpy as np

from softshadow.framebuffer import Storage
from softshadow.matrices import multiply
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.stipple_places import begins_stipple_anew, draws_stippled_lines, stipple_place_after

NO_MATRIX = np.empty((0, 0))


class LinePattern:
    """Where the draws of a context have left the line stipple.

    Parameters
    ----------
    storage : Storage        what they draw to
    """

    def __init__(self, storage: Storage) -> None:
        self._storage = storage
        self._place = 0  # before the last draw of stippled lines
        self._last: Draw | None = None  # that draw; None where the place after it has been found
        self._product = NO_MATRIX, NO_MATRIX, NO_MATRIX  # projection and modelview of a draw, and their product

    def continued(self, command: Draw) -> Draw:
        """Return a draw with the place at which it goes on, if it does, and remember it."""
        if draws_stippled_lines(command):
            if not begins_stipple_anew(command, self._model_view_projection(command)):
                self.find_place()
                command = command._replace(stipple_place=self._place)
            self._last = command
        return command

    def _model_view_projection(self, command: Draw) -> np.ndarray:
        """Return the product of the matrices of a draw; many draws have the same ones."""
        projection, modelview, product = self._product
        if projection is not command.projection or modelview is not command.modelview:
            product = multiply(command.projection, command.modelview)
            self._product = command.projection, command.modelview, product
        return product

    def find_place(self) -> None:
        """Find the place after the last draw, before what it depends on changes."""
        if self._last is not None:
            self._place, self._last = stipple_place_after(self._last, self._storage), None
