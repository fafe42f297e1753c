"""Draws that repeat earlier triangles; equals `geometry.geometry.process_geometry`, see fast/test_geometry_cache.py.

Soft shadows by light samples draw the same surfaces under the same camera once for each of many lights: only the
light's matrix and its map are others. The triangles in the window are a pure function of the positions and of the state
that is compared here, bit for bit. The outputs of the vertex stage are computed anew in each draw.

A draw is cached when it is seen for the third time, as several passes over a moving mesh are not. Triangles that are
clipped are not cached: their new vertices have outputs, too.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.pipeline.commands import Draw
from softshadow.pipeline.fast.recent_triangles import RecentTriangles
from softshadow.pipeline.geometry.geometry import process_geometry, triangles_with_outputs, vertex_outputs
from softshadow.pipeline.geometry.lines import LINES
from softshadow.pipeline.mesa.polygon_rules import passes_stages
from softshadow.pipeline.mesa.provoking_vertex import first_provokes
from softshadow.pipeline.records import Geometry
from softshadow.state.common import in_full

FEW_VERTICES = 512  # draws of fewer take less time than the comparison
CACHE_BYTES = 64 << 20  # of one storage: a million triangles
SEEN = 512  # draws whose number is known
CACHED_FROM = 3  # draws that are equal, this one included


class CachedTriangles(NamedTuple):
    """Triangles of a draw without outputs of the vertex stage; `arrays` are alive, so no others get their ids."""

    geometry: Geometry
    arrays: tuple[Any, ...]

    @property
    def bytes(self) -> int:
        """The size of the arrays in bytes."""
        geometry = self.geometry
        arrays = (*geometry.triangles, geometry.window, geometry.source, geometry.provoking)
        return sum(array.nbytes for array in arrays)


@dataclass(eq=False)
class GeometryCache:
    """The cached triangles of one storage, the least recently used first, and how often draws were seen, by hash.

    `recent` are those of `recent_triangles`; `bytes` is the size of all entries.
    """

    entries: dict[Hashable, CachedTriangles] = field(default_factory=dict)
    seen: dict[int, int] = field(default_factory=dict)
    recent: RecentTriangles = field(default_factory=RecentTriangles)
    bytes: int = 0

    def look_up(self, key: Hashable) -> Geometry | None:
        """Return the cached triangles of an equal draw, or None."""
        if key not in self.entries:
            return None
        entry = self.entries[key] = self.entries.pop(key)
        return entry.geometry

    def add(self, key: Hashable, entry: CachedTriangles) -> None:
        """Add an entry; the least recently used ones make room for it."""
        self.entries[key] = entry
        self.bytes += entry.bytes
        while self.bytes > CACHE_BYTES:
            self.bytes -= self.entries.pop(next(iter(self.entries))).bytes

    def pays(self, key: Hashable) -> bool:
        """Return whether to cache a draw: an equal one was seen often enough."""
        number = hash(key)
        count = self.seen[number] = self.seen.pop(number, 0) + 1
        if len(self.seen) > SEEN:
            del self.seen[next(iter(self.seen))]
        return count >= CACHED_FROM


def recent_of(storage: Storage | None) -> RecentTriangles | None:
    """Return the triangles of the latest draws of a storage."""
    if storage is None:
        return None
    cache: GeometryCache = storage.geometry_cache or GeometryCache()
    storage.geometry_cache = cache
    return cache.recent


def cached_geometry(command: Draw, target: Framebuffer, storage: Storage) -> tuple[Geometry, bool]:
    """Return the triangles of a draw in the window, and whether they are those of an earlier one."""
    if not is_covered(command):
        return process_geometry(command, target, storage), False
    cache = storage.geometry_cache = storage.geometry_cache or GeometryCache()
    outputs = vertex_outputs(command, storage)
    varyings, key = outputs.varyings, key_of(command, target, outputs.varyings.flat_input)
    cached = cache.look_up(key)
    if cached is not None:
        values = np.ascontiguousarray(varyings.values)
        back = None if varyings.back is None else np.ascontiguousarray(varyings.back)
        return cached._replace(values=values, back=back, flat=varyings.flat, program=outputs.program,
                               uniforms=outputs.uniforms), True  # fmt: skip
    geometry = triangles_with_outputs(command, target, outputs)
    if cache.pays(key) and len(geometry.window) == len(command.vertices.position):
        bare = geometry._replace(values=NO_VALUES, back=None, uniforms={})
        cache.add(key, CachedTriangles(bare, (command.vertices.position, command.indices)))
    return geometry, False


NO_VALUES = np.empty((0, 0), np.float32)


def is_covered(command: Draw) -> bool:
    """Return whether a draw is of many filled triangles that no other draw is joined to."""
    if len(command.vertices.position) < FEW_VERTICES or command.joined_positions is not None:
        return False
    return command.mode not in (gl.GL_POINTS, *LINES) and not passes_stages(command.state)


def key_of(command: Draw, target: Framebuffer, flat_input: bool) -> Hashable:
    """Return what the triangles of a draw depend on; of the state as text, where 0 is not -0."""
    state, image = command.state, target.depth
    groups = in_full(state.viewport, state.cull, state.polygon, state.clip_planes)
    return (
        id(command.vertices.position), id(command.indices), command.mode, command.modelview.tobytes(),
        command.projection.tobytes(), command.projection_kind, groups, state.depth.clamp, state.alpha.enabled,
        command.offset_slope, command.offset_unit, flat_input, first_provokes(state), target.size, target.flipped,
        bool(target.colors), None if image is None else image.format,
    )  # fmt: skip
