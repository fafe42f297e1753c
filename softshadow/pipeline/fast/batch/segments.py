"""Draws of several states, set up together; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

A program that binds a texture or moves the scissor box between small draws changes nothing in their geometry. So the
draws of all states with the same geometry stage are one batch, and its triangles are cut into segments: those that are
filled and shaded under one state, one after the other.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from itertools import accumulate
from typing import Any, NamedTuple

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.alike_draws import vertex_counts
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.geometry import Batch, Setting
from softshadow.pipeline.fast.batch.run import Run, geometry_structure
from softshadow.pipeline.geometry.smooth import with_coverage
from softshadow.pipeline.raster.coverage import extent
from softshadow.pipeline.records import Geometry, Setup
from softshadow.programs import Program

COUNTED = 1 << 12  # triangles of a batch: more are drawn alone in any case (`choose.MANY_TRIANGLES`)


def geometry_key(run: Run, setting: Setting) -> Hashable:
    """Return all that the geometry of a run depends on besides its draws; runs with equal keys can be one batch."""
    return (
        *geometry_structure(run), setting.culled, setting.positive_is_front, repr(setting.offset),
        setting.flat.tobytes(),
    )  # fmt: skip


class Part(NamedTuple):
    """The triangles [first, end) of a batch, which are those of a segment.

    program, uniforms: what shades them; fragments: about how many they have, -1 if that is not known.
    """

    batch: Geometry
    first: int
    end: int
    program: Program
    uniforms: Mapping[str, Any]
    fragments: int

    def geometry(self) -> Geometry:
        """Return the triangles on their own."""
        batch = self.batch
        if self.end - self.first == len(batch.triangles.ids):
            return batch._replace(program=self.program, uniforms=self.uniforms)
        own = Setup(*[array[self.first : self.end] for array in batch.triangles])
        return batch._replace(triangles=own, program=self.program, uniforms=self.uniforms)


def whole(batch: Batch) -> Part:
    """Return the only segment of a batch."""
    geometry, fragments = batch.geometry, batch.fragments
    end = len(geometry.triangles.ids)
    if fragments < 0 and end < COUNTED:
        fragments = extent(geometry.triangles.corners, 0, end)[4] >> 8
    return Part(geometry, 0, end, geometry.program, geometry.uniforms, fragments)


def cut(batch: Batch, draws: Sequence[Draw], firsts: Sequence[int], settings: Sequence[Setting]) -> list[Part]:
    """Return the geometry of each segment of a batch.

    Parameters
    ----------
    batch : of all draws
    firsts : the first draw of each segment
    settings : of each segment: its program shades the fragments
    """
    ends_of_draws = list(accumulate(vertex_counts(draws), initial=0))
    starts = np.array([*map(ends_of_draws.__getitem__, firsts), ends_of_draws[-1]], np.int64)  # vertices
    geometry, triangles = batch.geometry, batch.geometry.triangles
    bounds, areas = np.empty(len(starts), np.int64), np.empty(len(firsts), np.int64)
    find_segments(batch.vertices, triangles.ids, triangles.corners, starts, bounds, areas)
    ends, sizes = bounds[1:].tolist(), areas.tolist()
    return [
        Part(geometry, first, end, _with_coverage(setting.program, geometry), setting.uniforms, area)
        for setting, first, end, area in zip(settings, bounds.tolist(), ends, sizes, strict=False)
    ]


def _with_coverage(program: Program, batch: Geometry) -> Program:
    """Return the program of a segment with the coverage of its batch, where lines or points are smooth."""
    if batch.line_places >= 0:
        program = with_coverage(program, batch.line_places, "line")
    if batch.discards is not None and batch.discards.places >= 0:
        program = with_coverage(program, batch.discards.places, "point")
    return program


@kernel
def find_segments(vertices, ids, corners, starts, bounds, areas):
    """Write the triangles [bounds[s], bounds[s + 1]) of each segment, and about how many pixels they have.

    The segment has the vertices [starts[s], starts[s + 1]); `vertices` are those of the triangles by their `ids`.
    """
    t = bounds[0] = 0
    for s in range(len(areas)):
        while t < len(ids) and vertices[ids[t]] < starts[s + 1]:
            t += 1
        bounds[s + 1] = t
        areas[s] = extent(corners, bounds[s], t)[4] >> 8
