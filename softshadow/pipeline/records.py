"""What the stages of the pipeline hand to each other: named tuples of arrays and numbers, which kernels take as well.

In the order of the pipeline: triangles in the window (`Setup`, `Geometry`), where a draw may write (`Region`,
`DepthRange`, `FillBuffers`), and fragments, one by one (`Fragments`) or side by side (`Spans`).
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Mapping
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np

from softshadow.programs import Program

BACK, FRONT, EITHER = 0, 1, 2  # facings of triangles to be drawn
NO_VERTEX = -1  # in `Setup.vertices`, in place of the vertices that a line or a point does not have
NO_TRIANGLE, SEVERAL_TRIANGLES = np.int32(-1), np.int32(-2)  # in `FillBuffers.ids`, in place of a triangle's number
PASSED, SCISSORED, ALPHA_FAILED, STENCIL_FAILED, DEPTH_FAILED = range(5)
VERDICTS = ("passed", "scissor", "alpha failed", "stencil failed", "depth failed")


class Setup(NamedTuple):
    """The triangles that reach the pixels, in drawing order.

    corners (T, 6) int32: snapped X0 Y0 X1 Y1 X2 Y2 in 1/256 pixel, sample (i, j) at (256 i, 256 j), turned so that the
    area is positive (as in llvmpipe, 32 bits reach far beyond the largest viewport; their products need 64); vertices
    (T, 3) int32 in the same order; depth (T, 4): z at pixel (0, 0), dz/di, dz/dj, offset; front (T,) uint8; ids (T,)
    int32: which primitive each is, or is a half of. Lines and points are two triangles each: their vertices are
    (a, b, -1) and (a, -1, -1).
    """

    corners: np.ndarray
    vertices: np.ndarray
    depth: np.ndarray
    front: np.ndarray
    ids: np.ndarray


class Discards(NamedTuple):
    """Fragments that are left out before any test.

    pattern (32, 32) bool: the polygon stipple by row and column of the stored buffers, modulo 32, or None; places:
    the first column of values that `outside` takes, or -1; outside: from places (n, 4) to which fragments (n,) are
    outside of their smooth points.
    """

    pattern: np.ndarray | None = None
    places: int = -1
    outside: Callable[[np.ndarray], np.ndarray] | None = None


class Sprites(NamedTuple):
    """Point sprites: their coordinates run from 0 to 1 over the square of the point.

    columns: the first column of each texture unit whose coordinates are replaced; widths (ids,) of the squares in
    pixels; upwards: whether t grows with the stored rows.
    """

    columns: tuple[int, ...]
    widths: np.ndarray
    upwards: bool


class Geometry(NamedTuple):
    """What the fill and shade stages need of a draw.

    triangles: those that are not culled and have an area; window (V', 4): x, y, z, 1/w; values, back (V', k) and flat
    (k,): outputs of the vertex stage; source (T',): which assembled primitive each clipped one is a piece of;
    provoking (T',): the vertex that flat columns take; faces (T',) bool: for the lines and points of glPolygonMode,
    whether they outline front faces, else None; offset_mode: the mode of unfilled polygons whose offset applies, or 0;
    discards: which fragments stipple and smoothing leave out; line_places: the first column of values that says where
    fragments lie in smooth lines, or -1; sprites: the coordinates of point sprites; faceless: lines and points have
    triangles like those of polygons; stipple_place: the place in the line stipple after the draw.
    """

    triangles: Setup
    window: np.ndarray
    values: np.ndarray
    back: np.ndarray | None
    flat: np.ndarray
    source: np.ndarray
    provoking: np.ndarray
    program: Program
    uniforms: Mapping[str, Any]
    faces: np.ndarray | None = None
    offset_mode: int = 0
    discards: Discards | None = None
    line_places: int = -1
    sprites: Sprites | None = None
    faceless: bool = False
    stipple_place: int = 0

    def facing(self, row: int) -> bool | None:
        """Return whether a row of `triangles` belongs to a front face; None for lines and points, which have none."""
        if self.faces is not None:
            return bool(self.faces[self.triangles.ids[row]])
        has_face = self.triangles.vertices[row, 2] != NO_VERTEX and not self.faceless
        return bool(self.triangles.front[row]) if has_face else None


class Region(NamedTuple):
    """Where a draw may write: columns and rows (end exclusive) of the stored buffers, and how their rows run."""

    left: int
    right: int
    first_row: int
    end_row: int
    downwards: int


class DepthRange(NamedTuple):
    """The range that z is clamped to after the offset."""

    low: np.floating
    high: np.floating

    def same_as(self, other: DepthRange) -> bool:
        """Return whether both have the same bits: 0 is not -0."""
        return self is other or repr(self) == repr(other)


class FragmentCounts(NamedTuple):
    """How many fragments met which fate: verdicts (5,) int64, by `VERDICTS`; stencil_updates (1,) int64.

    A stencil update is a stencil value that changed. `only_passed`: nobody asks for more than how many have passed, so
    the other numbers may stay 0.
    """

    verdicts: np.ndarray
    stencil_updates: np.ndarray
    only_passed: bool = False

    @property
    def passed(self) -> int:
        """How many fragments have passed."""
        return int(self.verdicts[PASSED])

    @classmethod
    def zero(cls, only_passed: bool = False) -> FragmentCounts:
        """Return counts of 0."""
        return cls(np.zeros(len(VERDICTS), np.int64), np.zeros(1, np.int64), only_passed)


class FillBuffers(NamedTuple):
    """What the fill stage reads and writes, full rows with their padding.

    columns: 0, 1, 2 ... in the precision of depth; depth and stencil (H, pitch); ids (rows of the region, pitch) int32
    receives the number of the triangle whose fragment passed last.
    """

    columns: np.ndarray
    depth: np.ndarray
    stencil: np.ndarray
    ids: np.ndarray


class Fragments(NamedTuple):
    """Fragments in drawing order.

    row and column (n,) int32 of the stored buffers; triangle (n,) int32, a row of `Setup`.
    """

    row: np.ndarray
    column: np.ndarray
    triangle: np.ndarray


class Spans(NamedTuple):
    """Fragments of one triangle side by side in a row, one span after the other.

    row and first column `left` (S,) int32 of the stored buffers; triangle (S,) int32, a row of `Setup`; start (S + 1,)
    int64, the number of each span's first fragment, and last how many fragments there are.
    """

    row: np.ndarray
    left: np.ndarray
    triangle: np.ndarray
    start: np.ndarray

    @property
    def fragments(self) -> int:
        """How many fragments there are."""
        return int(self.start[-1])

    def part(self, first: int, end: int) -> Spans:
        """Return the spans from `first` to `end`, their fragments numbered from 0."""
        start = self.start[first : end + 1]
        if first:
            start = start - self.start[first]
        return Spans(self.row[first:end], self.left[first:end], self.triangle[first:end], start)

    def equal_parts(self, n_parts: int, beginning: int) -> list[tuple[int, int]]:
        """Return the first and end spans of parts of about equal work, at most so many, none of them empty.

        A span begins in the time that so many fragments take.
        """
        n_spans = len(self.row)

        def work(n: int) -> int:
            return int(self.start[n]) + beginning * n

        total = work(n_spans)
        cuts = [bisect_left(range(n_spans), total * part // n_parts, key=work) for part in range(1, n_parts)]
        return [(first, end) for first, end in pairwise([0, *cuts, n_spans]) if first < end]

    def chunks(self, size: int) -> np.ndarray:
        """Return where to cut (C + 1,), so that each part has about `size` fragments."""
        cuts = np.append(np.searchsorted(self.start, np.arange(0, self.fragments, size)), len(self.row))
        return cuts[np.diff(cuts, prepend=-1) > 0]  # sorted already; np.unique would import numpy.ma
