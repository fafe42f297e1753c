"""How many fragments a step has drawn at each pixel, which tests they failed, and the last one of each pixel."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

from softshadow.errors import StateError
from softshadow.framebuffer import DEFAULT, Framebuffer, Storage
from softshadow.inspection.step import Step, object_of
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.geometry.geometry import process_geometry
from softshadow.pipeline.plan import tests_alpha
from softshadow.pipeline.raster.fragment_ops import fragment_ops
from softshadow.pipeline.raster.ordered import process_fragments
from softshadow.pipeline.raster.region import buffer_cells, depth_range_of, region_of
from softshadow.pipeline.records import VERDICTS, Fragments, Geometry
from softshadow.pipeline.shade.blend import compared_alpha
from softshadow.pipeline.shade.discards import fragments_in
from softshadow.pipeline.shade.shading import shade
from softshadow.pipeline.shade.visible_spans import spans_of

NONE = -1  # draw, triangle and verdict of a pixel without a fragment
AT_ONCE = 2 << 20  # fragments that are listed together
UNITS_OF_AREA = 2 << 16  # of the cross product of corners, per pixel
COLUMNS = tuple(VERDICTS.index(name) for name in ("passed", "alpha failed", "stencil failed", "depth failed"))


@dataclass(frozen=True, eq=False)
class FragmentMaps:
    """The fragments of a step in one framebuffer. All arrays are (H, W), row 0 on top, read-only.

    Attributes
    ----------
    by_verdict : (5, H, W) int32     how many fragments had each of `verdicts`
    verdicts : tuple of str          passed, scissor, alpha failed, stencil failed, depth failed
    last_draw : int32                the draw, by its index in the frame, of the last fragment; -1 where there is none
    last_triangle : int32            its triangle, numbered in the draw; -1
    last_verdict : int8              its place in `verdicts`; -1
    objects : dict                   the object of each draw of the step, by its index in the frame
    """

    by_verdict: np.ndarray
    verdicts: tuple[str, ...]
    last_draw: np.ndarray
    last_triangle: np.ndarray
    last_verdict: np.ndarray
    objects: dict[int, str]

    def __post_init__(self) -> None:
        for array in (self.by_verdict, self.last_draw, self.last_triangle, self.last_verdict):
            array.setflags(write=False)

    @cached_property
    def drawn(self) -> np.ndarray:
        """All fragments."""
        return np.asarray(self.by_verdict.sum(axis=0))

    @property
    def passed(self) -> np.ndarray:
        """Those that passed all tests."""
        return self.by_verdict[VERDICTS.index("passed")]

    @property
    def alpha_failed(self) -> np.ndarray:
        """Those that failed the alpha test."""
        return self.by_verdict[VERDICTS.index("alpha failed")]

    @property
    def stencil_failed(self) -> np.ndarray:
        """Those that failed the stencil test."""
        return self.by_verdict[VERDICTS.index("stencil failed")]

    @property
    def depth_failed(self) -> np.ndarray:
        """Those that failed the depth test."""
        return self.by_verdict[VERDICTS.index("depth failed")]

    @property
    def totals(self) -> dict[str, int]:
        """The numbers of fragments by verdict, as in the ledger."""
        sums = self.by_verdict.sum(axis=(1, 2), dtype=np.int64)
        return {VERDICTS[column]: int(sums[column]) for column in COLUMNS}

    def last_at(self, x: int, y: int) -> tuple[str, int, str] | None:
        """Return object, triangle and verdict of a pixel's last fragment; None where there is none."""
        draw = int(self.last_draw[y, x])
        if draw == NONE:
            return None
        return self.objects[draw], int(self.last_triangle[y, x]), self.verdicts[self.last_verdict[y, x]]

    def __repr__(self) -> str:
        height, width = self.last_draw.shape
        counts = ", ".join(f"{count} {verdict}" for verdict, count in self.totals.items())
        return f"FragmentMaps({width} x {height}: {counts})"


def fragment_maps(step: Step, framebuffer: int = DEFAULT) -> FragmentMaps:
    """Return the fragments of a step in a framebuffer; its commands are replayed, fragment by fragment.

    Raises
    ------
    StateError                   the framebuffer had images of several sizes in the step
    """
    first = step.first_command
    commands = step.frame.commands
    draw = sum(isinstance(command, Draw) for command in commands[:first])
    end = step.frame.steps[step.index][1]
    size: tuple[int, int] | None = step.frame.size if framebuffer == DEFAULT else None
    counts = last = np.empty(0)
    flipped, objects = True, {}
    for index in range(first, end):
        command = commands[index]
        if not isinstance(command, Draw):
            continue
        if command.state.draw_framebuffer == framebuffer:
            storage = step.replay.storage_after(index)
            target = storage.framebuffers[framebuffer]
            if size not in (None, target.size):
                raise StateError(f"fragments of framebuffer {framebuffer}: it has two sizes in step {step.title!r}")
            size, flipped = target.size, target.flipped
            if not len(counts):
                counts, last = empty_maps(size)
            objects[draw] = object_of(command)
            add_fragments(command, target, storage, draw, counts, last)
        draw += 1
    if not len(counts):
        counts, last = empty_maps(size or (0, 0))
    rows = np.s_[:, :] if flipped else np.s_[:, ::-1]
    counts, last = np.ascontiguousarray(counts[rows]), np.ascontiguousarray(last[rows])
    return FragmentMaps(counts, VERDICTS, last[0], last[1], last[2].astype(np.int8), objects)


def empty_maps(size: tuple[int, int]) -> tuple[np.ndarray, np.ndarray]:
    """Return counts (5, H, W) of 0, and the last draw, triangle and verdict (3, H, W), which are -1."""
    width, height = size
    return np.zeros((len(VERDICTS), height, width), np.int32), np.full((3, height, width), NONE, np.int32)


def add_fragments(
    command: Draw, target: Framebuffer, storage: Storage, draw: int, counts: np.ndarray, last: np.ndarray
) -> None:
    """Add the fragments of a draw to the maps; the buffers stay as they are."""
    with np.errstate(all="ignore"):  # as in pipeline.draw
        geometry = process_geometry(command, target, storage)
        if not len(geometry.triangles.ids):
            return
        real = geometry.window.dtype
        depth, stencil = (cells.copy() for cells in buffer_cells(target, real))
        columns = np.arange(max(depth.shape), dtype=real)
        for part, fragments in listed(command, target, geometry):
            front, back = (
                fragment_ops(command.state, target.depth, target.stencil, facing) for facing in (True, False)
            )
            alpha = np.zeros(len(fragments.row), np.uint8)
            if tests_alpha(command.state):
                colors = shade(part, spans_of(fragments))
                alpha, reference = compared_alpha(command.state, target.color, colors[:, 3])
                front, back = front._replace(alpha_ref=reference), back._replace(alpha_ref=reference)
            verdicts, depth_range = np.empty(len(fragments.row), np.uint8), depth_range_of(command.state, real.type)
            process_fragments(
                front, back, fragments, alpha, part.triangles, depth_range, columns, depth, stencil, verdicts
            )
            row, column = fragments.row, fragments.column
            np.add.at(counts, (verdicts, row, column), 1)
            sources = part.source[part.triangles.ids[fragments.triangle]]
            for number, values in enumerate((np.full(len(row), draw), sources, verdicts)):
                last[number][row, column] = values  # of several fragments of a pixel the last one stays


def listed(command: Draw, target: Framebuffer, geometry: Geometry) -> Iterator[tuple[Geometry, Fragments]]:
    """Yield parts of a draw's triangles with their fragments, not too many at once."""
    triangles, region = geometry.triangles, region_of(command.state, target)
    x0, y0, x1, y1, x2, y2 = triangles.corners.astype(np.int64).T
    areas = np.abs((x1 - x0) * (y2 - y0) - (x2 - x0) * (y1 - y0)) // UNITS_OF_AREA
    part = np.cumsum(areas) // AT_ONCE
    cuts = [0, *(np.flatnonzero(np.diff(part)) + 1), len(part)]
    for first, end in pairwise(cuts):
        some = geometry._replace(triangles=type(triangles)(*(array[first:end] for array in triangles)))
        fragments = fragments_in(some, region)
        if len(fragments.row):
            yield some, fragments
