"""What lines and points of a run differ in; equals `geometry.geometry.process_geometry`, see fast/test_batch.py."""

from __future__ import annotations

from collections.abc import Sequence
from operator import attrgetter

import numpy as np

from softshadow import tokens as gl
from softshadow.pipeline.alike_draws import of_each, vertex_counts
from softshadow.pipeline.commands import NO_UNIFORMS, Draw
from softshadow.pipeline.fast.batch.admission import PLAIN_POINTS
from softshadow.pipeline.fast.batch.assembly import primitive_counts
from softshadow.pipeline.fast.batch.run import Run
from softshadow.pipeline.fast.batch.table import REAL
from softshadow.pipeline.geometry.assembly import begins_stipple, pieces_begin_stipple
from softshadow.pipeline.geometry.geometry import vertex_inputs
from softshadow.pipeline.geometry.line_stipple import CONTINUES
from softshadow.pipeline.geometry.lines_and_points import size_of_points
from softshadow.programs.fixed_function import point_sizes


def sizes_of_points(run: Run, draws: Sequence[Draw]) -> np.ndarray | None:
    """Return the sizes of points (V,) where they depend on the distance or differ between draws, else None."""
    if run.state.points.attenuation != PLAIN_POINTS.attenuation:
        sizes = [point_sizes(draw.state, vertex_inputs(draw, NO_UNIFORMS)) for draw in draws]
        return np.concatenate([each for each in sizes if each is not None])
    polygon = run.state.polygon
    states = of_each(draws, attrgetter("state"))
    if all(state.polygon is polygon for state in states):
        return None
    return np.repeat(np.array(list(map(size_of_points, states)), REAL), vertex_counts(draws))


def widths_of_lines(run: Run, draws: Sequence[Draw], source: np.ndarray) -> np.ndarray | None:
    """Return the widths (L,) of clipped lines where one is not that of the run, else None."""
    widths = of_each(draws, attrgetter("state.polygon.line_width"))
    if set(widths) == {run.state.polygon.line_width}:
        return None
    return np.repeat(np.array(widths, np.float64), primitive_counts(draws))[source]


def stipple_places(draws: Sequence[Draw], source: np.ndarray) -> np.ndarray:
    """Return the places of clipped lines in the line stipple, as for draws on their own.

    A strip or loop whose first line is clipped goes on where the draw before it ended.
    """
    counts = primitive_counts(draws)
    of_line = np.repeat(np.arange(len(draws)), counts)[source]
    firsts = (np.cumsum(counts) - counts)[of_line]
    separate = np.array([draw.mode == gl.GL_LINES for draw in draws])[of_line]
    before = np.array([draw.stipple_place for draw in draws], np.int32)[of_line]
    goes_on = np.diff(of_line, prepend=-1) == 0
    return np.where(separate | (source == firsts), 0, np.where(goes_on, CONTINUES, before)).astype(np.int32)


def stipple_of_polygons(
    draws: Sequence[Draw], codes: np.ndarray, triangles: np.ndarray, source: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return which pieces of clipped triangles begin the line stipple anew, and `outline`'s places, both (T',).

    codes (V,), triangles (T, 3): of all draws; source (T',): the triangle that each piece comes from.
    """
    counts = primitive_counts(draws)
    first = np.concatenate([begins_stipple(draw.mode, count) for draw, count in zip(draws, counts, strict=True)])
    of_piece = np.repeat(np.arange(len(draws)), counts)[source]
    before = np.array([draw.stipple_place for draw in draws], np.int32)[of_piece]
    places = np.where(np.diff(of_piece, prepend=-1) != 0, before, np.int32(CONTINUES))
    return pieces_begin_stipple(first, codes != 0, triangles, source), places
