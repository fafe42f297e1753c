"""Draws that repeat an earlier fill are only shaded; equals `raster.fill.fill`, see fast/test_visibility_cache.py.

Soft shadows by light samples draw the same surfaces over a cleared buffer once for each of many lights. The result of a
fill (depths, stencil values, visible triangles) is a pure function of the triangles in the window, the state of the
tests, and the buffers before. All inputs are compared bit for bit; buffers are compared by a version token
(`Image.version`), which is lost as soon as the cells are taken. So two buffers have equal tokens only where both were
cleared to the same value and then drawn to by the same draws.

A draw is cached the second time it is seen, and not again after a few times without a hit, or after an entry was
evicted without one: draws that are not repeated, or over other buffers each time, pay for few copies.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer, Storage
from softshadow.image import Image
from softshadow.pipeline.memory.comparison import same_bits
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.records import DepthRange, Region, Setup
from softshadow.pipeline.shade.visible_spans import VisibleSpans

CACHE_BYTES = 64 << 20  # of one storage: 50 draws that fill 640x480 pixels
SEEN = 512  # draws whose fingerprints are known
MOST_MISSES = 3  # times that a draw is cached without a hit
UNREAD = "unread"  # token of a buffer that a draw does not read


class FillInputs(NamedTuple):
    """The inputs of a fill besides the buffers."""

    front: FragmentOps
    back: FragmentOps
    triangles: Setup
    region: Region
    depth_range: DepthRange

    @property
    def tests_depth(self) -> bool:
        """Whether depths are read."""
        return bool(self.front.depth_test or self.back.depth_test)

    @property
    def writes_depth(self) -> bool:
        """Whether depths may change."""
        return bool(self.front.depth_write or self.back.depth_write)

    @property
    def tests_stencil(self) -> bool:
        """Whether stencil values are read, and may change."""
        return bool(self.front.stencil_test or self.back.stencil_test)

    def same_as(self, other: FillInputs) -> bool:
        """Return whether all inputs are equal, bit for bit."""
        ours, theirs = [(each.front, each.back, each.region) for each in (self, other)]
        are_equal = ours == theirs and self.depth_range.same_as(other.depth_range)
        return are_equal and have_same_fragments(self.triangles, other.triangles)

    def fingerprint(self) -> int:
        """Return a hash of the inputs, from a few of the triangles."""
        corners, depth = self.triangles.corners, self.triangles.depth
        ends = corners[0].tobytes(), corners[-1].tobytes(), depth[0].tobytes(), depth[-1].tobytes()
        return hash((self.front, self.back, self.region, self.depth_range, len(corners), *ends))


def have_same_fragments(a: Setup, b: Setup) -> bool:
    """Return whether triangles have the same fragments; those of two parts of a batch have other vertices and ids."""
    arrays = (a.corners, b.corners), (a.depth, b.depth), (a.front, b.front)
    return all(same_bits(*pair) for pair in arrays)


@dataclass(eq=False)
class CacheEntry:
    """The result of a fill: tokens of depth and stencil, their rows where they were written, and the visible spans.

    `ties` is not empty if two depths may have been equal.
    """

    inputs: FillInputs
    after: tuple[object, object]
    depth: np.ndarray | None
    stencil: np.ndarray | None
    spans: VisibleSpans
    ties: list[int]
    hits: int = 0

    @cached_property
    def bytes(self) -> int:
        """The size of the arrays in bytes."""
        arrays = (self.depth, self.stencil, *self.spans.joined, *self.inputs.triangles)
        return sum(array.nbytes for array in arrays if array is not None)


Key = tuple[int, object, object]  # fingerprint of a draw, and the tokens of depth and stencil before it


@dataclass(eq=False)
class VisibilityCache:
    """The cached fills of one storage.

    `seen` are the fingerprints of draws, and how many times they were cached since their last hit; `surfaces` are those
    of `drawn_surfaces`; `bytes` is the size of all entries.
    """

    entries: dict[Key, CacheEntry] = field(default_factory=dict)  # in the order of their last use
    seen: dict[int, int] = field(default_factory=dict)
    surfaces: list[Any] = field(default_factory=list)
    bytes: int = 0

    def look_up(self, key: Key, inputs: FillInputs) -> CacheEntry | None:
        """Return the cached fill of equal inputs over equal buffers, or None."""
        entry = self.entries.get(key)
        if entry is None or not entry.inputs.same_as(inputs):
            return None
        self.entries[key] = self.entries.pop(key)
        entry.inputs = inputs  # the same arrays as at the next draw, if the triangles are cached, too
        entry.hits += 1
        self.seen[key[0]] = 0
        return entry

    def evict(self, key: Key) -> None:
        """Remove an entry; without a hit, the draw is not cached again."""
        entry = self.entries.pop(key)
        self.bytes -= entry.bytes
        if not entry.hits:
            self.seen[key[0]] = MOST_MISSES

    def add(self, key: Key, entry: CacheEntry) -> None:
        """Add an entry; the least recently used ones are evicted to make room."""
        replaced = self.entries.pop(key, None)
        self.entries[key] = entry
        self.seen[key[0]] = self.seen.get(key[0], 0) + 1
        self.bytes += entry.bytes - (replaced.bytes if replaced else 0)
        while self.bytes > CACHE_BYTES:
            self.evict(next(iter(self.entries)))

    def pays(self, fingerprint: int) -> bool:
        """Return whether to cache a draw: it was seen before, and was not cached too often without a hit."""
        if fingerprint not in self.seen:
            self.seen[fingerprint] = 0
            if len(self.seen) > SEEN:
                del self.seen[next(iter(self.seen))]
            return False
        return self.seen[fingerprint] < MOST_MISSES


def clear_visibility_cache(storage: Storage) -> None:
    """Remove all entries of a storage's cache."""
    cache = storage.visibility_cache
    if cache is not None:
        cache.surfaces.clear()
        for key in list(cache.entries):
            cache.evict(key)


def cached_fill(
    front: FragmentOps,
    back: FragmentOps,
    triangles: Setup,
    region: Region,
    depth_range: DepthRange,
    target: Framebuffer,
    storage: Storage,
    fill: Callable[[], VisibleSpans],
    ties: list[int],
) -> tuple[VisibleSpans, bool]:
    """Fill, or restore the result of an equal fill; return the visible spans, and whether they were cached.

    Parameters
    ----------
    fill : fills the buffers of `target` and returns the visible spans
    ties : receives numbers if two depths were equal, or could have been; `fill` adds them
    """
    inputs = FillInputs(front, back, triangles, region, depth_range)
    cache = storage.visibility_cache = storage.visibility_cache or VisibilityCache()
    tokens = _version(target.depth), _version(target.stencil)
    before = _tokens_before(inputs, target)
    key = inputs.fingerprint(), *before
    entry = cache.look_up(key, inputs)
    if entry is not None:
        for image, rows, token in (
            (target.depth, entry.depth, entry.after[0]),
            (target.stencil, entry.stencil, entry.after[1]),
        ):
            if image is not None and rows is not None:
                image.write_later(inputs.region.first_row, rows, token)
        ties += entry.ties
        return entry.spans, True
    spans = fill()
    pays = cache.pays(key[0]) and None not in before
    depth = _after_fill(target.depth, inputs.region, tokens[0], inputs.writes_depth, pays)
    stencil = _after_fill(target.stencil, inputs.region, tokens[1], inputs.tests_stencil, pays)
    if pays:
        after = _version(target.depth), _version(target.stencil)
        cache.add(key, CacheEntry(inputs, after, depth, stencil, spans, ties))
    return spans, False


def is_repeated(inputs: FillInputs, target: Framebuffer, storage: Storage) -> bool:
    """Return whether `cached_fill` pays, since an equal fill was seen before over known buffers; this one is seen."""
    cache = storage.visibility_cache = storage.visibility_cache or VisibilityCache()
    return cache.pays(inputs.fingerprint()) and None not in _tokens_before(inputs, target)


def _tokens_before(inputs: FillInputs, target: Framebuffer) -> tuple[object, object]:
    """Return the version tokens of depth and stencil, where they are read."""
    return (
        _version(target.depth) if inputs.tests_depth else UNREAD,
        _version(target.stencil) if inputs.tests_stencil else UNREAD,
    )


def _version(image: Image | None) -> object:
    return None if image is None else image.version


def _after_fill(image: Image | None, region: Region, token: object, changed: bool, copies: bool) -> np.ndarray | None:
    """Set the token of a buffer after the fill; return a copy of its rows where it has changed, if asked for one."""
    if image is None:
        return None
    if not changed:
        image.version = token  # the fill has taken the cells, but not changed them
        return None
    if not copies:
        return None
    rows: np.ndarray = image.cells[region.first_row : region.end_row].copy()
    image.version = object()
    return rows
