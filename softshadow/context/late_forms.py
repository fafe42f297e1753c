"""Late draws: those of glBegin ... glEnd pairs with the numbers of their vertices, those of lists and of small arrays.

What many of them have in common is found once: the form of pairs, and the draw that the others are like.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple

import numpy as np

from softshadow.context.primitive import Primitive
from softshadow.pipeline.alike_vertices import ConstantTexcoords
from softshadow.pipeline.commands import Draw, Vertices, moved_draws
from softshadow.pipeline.geometry.separate import separated

SINGLE = 64  # bytes of a matrix in single precision
NO_ROWS = np.empty((0, 4), np.float32)
NO_VERTICES = Vertices(NO_ROWS, NO_ROWS, NO_ROWS, ())


class LateForm(NamedTuple):
    """What draws of pairs have in common: all but the numbers of their vertices and their matrix.

    `like` is a draw that differs from them in its vertices and its modelview matrix only; it has neither debug groups
    nor an origin. Their vertices carry the attributes `columns`, among them texture coordinates of `units`; those of
    the others are `texcoords`, which were `current`. `follows`: materials follow their colours. `vertices_of` makes all
    arrays of a primitive.
    """

    like: Draw
    columns: tuple[str, ...]
    texcoords: ConstantTexcoords
    current: tuple[tuple[float, ...], ...]
    units: tuple[int, ...]
    follows: bool
    vertices_of: Callable[[Primitive], Vertices]


class LateDraw(NamedTuple):
    """A draw with the numbers of its vertices: those of `primitive`, from `start` to `end` among its positions.

    The columns of its form are among the changes of the primitive; the other attributes have the values `color` and
    `normal`. Where it is of several strips, fans, loops or polygons, `counts` are their numbers of vertices.
    """

    form: LateForm
    primitive: Primitive
    color: tuple[float, ...]
    normal: tuple[float, ...]
    modelview: bytes
    modelview_kind: int
    counts: tuple[int, ...] = ()
    start: int = 0
    end: int | None = None

    @property
    def n_numbers(self) -> int:
        """How many numbers the positions are."""
        return (len(self.primitive.positions) if self.end is None else self.end) - self.start

    @property
    def positions(self) -> list[float]:
        """x, y, z, w of each vertex."""
        positions = self.primitive.positions
        return positions if self.end is None else positions[self.start : self.end]

    def made(self, vertices: Vertices) -> Draw:
        """Return the draw with arrays."""
        (draw,) = moved_draws(self.form.like, [(vertices, None, matrices_of([self])[0], self.modelview_kind)])
        return separated(draw, self.counts) if self.counts else draw


class MovedDraw(NamedTuple):
    """A draw that differs from an earlier one, `like`, in its vertices, indices and modelview matrix only.

    Its vertices have arrays of the same attributes.
    """

    like: Draw
    vertices: Vertices
    indices: np.ndarray | None
    modelview: bytes
    modelview_kind: int


def matrices_of(draws: Sequence[LateDraw | MovedDraw]) -> np.ndarray:
    """Return the modelview matrices (D, 4, 4), read-only; (1, 4, 4) if all draws have the same."""
    own = [draw.modelview for draw in draws]
    distinct = own[:1] if len(set(map(id, own))) == 1 else own
    dtype = np.float32 if len(own[0]) == SINGLE else np.float64
    return np.frombuffer(b"".join(distinct), dtype).reshape(-1, 4, 4)
