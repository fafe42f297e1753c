"""Draws of several states, set up together; equals `geometry.geometry.process_geometry`, see fast/test_batch.py.

A program that binds a texture or moves the scissor box between small draws changes nothing in their geometry. So the
draws of all states with the same geometry stage are one batch, and its triangles are cut into segments: those that are
filled and shaded under one state, one after the other.
"""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from typing import NamedTuple

import numpy as np

from softshadow.jit import kernel
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.batch.geometry import Setting
from softshadow.pipeline.fast.batch.run import Run, geometry_structure
from softshadow.pipeline.raster.coverage import extent
from softshadow.pipeline.records import Geometry, Setup


def geometry_key(run: Run, setting: Setting) -> Hashable:
    """Return all that the geometry of a run depends on besides its draws; runs with equal keys can be one batch."""
    return (
        *geometry_structure(run), setting.scale.tobytes(), setting.shift.tobytes(), setting.culled,
        setting.positive_is_front, repr(setting.offset), setting.flat.tobytes(),
    )  # fmt: skip


class Part(NamedTuple):
    """The triangles of a segment, and about how many fragments they have."""

    geometry: Geometry
    fragments: int


def cut(geometry: Geometry, draws: Sequence[Draw], firsts: Sequence[int], settings: Sequence[Setting]) -> list[Part]:
    """Return the geometry of each segment of a batch.

    Parameters
    ----------
    geometry : of all draws of the batch
    firsts : the first draw of each segment
    settings : of each segment: its program shades the fragments
    """
    ends_of_draws = np.cumsum([len(draw.vertices.position) for draw in draws])
    starts = np.append(0, ends_of_draws)[np.asarray(firsts)]  # the first vertex of each segment
    triangles = geometry.triangles
    segments = np.searchsorted(starts, geometry.provoking[triangles.ids], side="right") - 1
    bounds = np.searchsorted(segments, np.arange(len(starts) + 1))
    areas = np.empty(len(starts), np.int64)
    write_areas(triangles.corners, bounds, areas)
    parts = []
    for setting, first, end, area in zip(settings, bounds.tolist(), bounds[1:].tolist(), areas.tolist(), strict=False):
        own = Setup(*[array[first:end] for array in triangles])
        parts.append(Part(geometry._replace(triangles=own, program=setting.program, uniforms=setting.uniforms), area))
    return parts


@kernel
def write_areas(corners, bounds, areas):
    """Write about how many pixels the triangles [bounds[s], bounds[s + 1]) of each segment have."""
    for s in range(len(areas)):
        areas[s] = extent(corners, bounds[s], bounds[s + 1])[4] >> 8
