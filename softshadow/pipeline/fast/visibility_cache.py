"""Visibility that is used again: a draw that was filled before, over the same depths, is only shaded.

Soft shadows by light samples draw the same surfaces over a cleared buffer once for each of many lights. What the fill
leaves, depths, stencil values and who is seen where, is a pure function of the triangles in the window, the state of
the tests, and what the planes held before. All of these are compared bit for bit, but for the planes: an image knows
what it holds by a name for it (`Image.contents`), which is lost as soon as anybody takes its cells. So a plane has the
same name twice only where it was cleared to the same value, and then drawn to by the same draws.

A draw is kept the second time it is seen. One that was kept and not used again is not kept any more: frames in which
nothing is drawn twice pay for one copy once.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer, Storage
from softshadow.image import Image
from softshadow.pipeline.geometry.triangle_setup import Setup
from softshadow.pipeline.raster.fill import Region
from softshadow.pipeline.raster.fragment_ops import FragmentOps
from softshadow.pipeline.raster.spans import DepthRange
from softshadow.pipeline.shade.visible_spans import Spans

CACHE_BYTES = 64 << 20  # of one storage: 50 draws that fill 640x480 pixels
SEEN = 512  # draws whose fingerprints are known
UNREAD = "unread"  # stands for what a plane holds that a draw does not look at


class FillInputs(NamedTuple):
    """What decides about a fill besides the planes: both sides' operations, the triangles and where they may draw."""

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
        """Return whether all is equal, bit for bit."""
        states = [(each.front, each.back, each.region, repr(each.depth_range)) for each in (self, other)]  # 0 is not -0
        return states[0] == states[1] and all(map(_same_bits, self.triangles, other.triangles))

    def fingerprint(self) -> int:
        """Return a number that equal inputs share, and others hardly ever."""
        corners, depth = self.triangles.corners, self.triangles.depth
        ends = corners[0].tobytes(), corners[-1].tobytes(), depth[0].tobytes(), depth[-1].tobytes()
        return hash((self.front, self.back, self.region, self.depth_range, len(corners), *ends))


def _same_bits(a: np.ndarray, b: np.ndarray) -> bool:
    as_bits = f"u{a.dtype.itemsize}"
    return a is b or (a.dtype == b.dtype and np.array_equal(a.view(as_bits), b.view(as_bits)))


@dataclass(eq=False)
class CacheEntry:
    """What a fill left: the planes' contents by name, rows of them where they were written, and the spans."""

    inputs: FillInputs
    after: tuple[object, object]
    depth: np.ndarray | None
    stencil: np.ndarray | None
    spans: Spans
    uses: int = 0

    @property
    def bytes(self) -> int:
        arrays = (self.depth, self.stencil, *self.spans, *self.inputs.triangles)
        return sum(array.nbytes for array in arrays if array is not None)


Key = tuple[int, object, object]  # fingerprint of a draw, and what depths and stencil values were before it


@dataclass(eq=False)
class VisibilityCache:
    """The fills that one storage keeps, and by fingerprint the draws that were seen: True where keeping may pay."""

    kept: dict[Key, CacheEntry] = field(default_factory=dict)  # in the order of their last use
    seen: dict[int, bool] = field(default_factory=dict)

    def use(self, key: Key, inputs: FillInputs) -> CacheEntry | None:
        """Return the fill that was kept of equal inputs over equal planes."""
        kept = self.kept.get(key)
        if kept is None or not kept.inputs.same_as(inputs):
            return None
        self.kept[key] = self.kept.pop(key)
        kept.uses += 1
        self.seen[key[0]] = True
        return kept

    def forget(self, key: Key) -> None:
        """Let go of a fill; where it was of no use, the draw is not kept again."""
        if not self.kept.pop(key).uses:
            self.seen[key[0]] = False

    def keep(self, key: Key, kept: CacheEntry) -> None:
        """Keep a fill; the longest unused ones make room for it."""
        self.kept[key] = kept
        while sum(each.bytes for each in self.kept.values()) > CACHE_BYTES:
            self.forget(next(iter(self.kept)))

    def pays(self, fingerprint: int) -> bool:
        """Return whether to keep a draw: it was seen before, and was not kept in vain."""
        if fingerprint not in self.seen:
            self.seen[fingerprint] = True
            if len(self.seen) > SEEN:
                del self.seen[next(iter(self.seen))]
            return False
        return self.seen[fingerprint]


def clear_visibility_cache(storage: Storage) -> None:
    """Let go of all fills that a storage keeps: what is drawn next is filled as if it were new."""
    visibility = storage.visibility_cache
    if visibility is not None:
        for key in list(visibility.kept):
            visibility.forget(key)


def cached_fill(inputs: FillInputs, target: Framebuffer, storage: Storage, fill: Callable[[], Spans]) -> Spans:
    """Fill, or take from memory what the fill would leave; returns the spans of visible fragments.

    Parameters
    ----------
    fill : carries the fill out on the planes of `target`
    """
    visibility = storage.visibility_cache = storage.visibility_cache or VisibilityCache()
    names = _contents(target.depth), _contents(target.stencil)
    before = names[0] if inputs.tests_depth else UNREAD, names[1] if inputs.tests_stencil else UNREAD
    key = inputs.fingerprint(), *before
    kept = visibility.use(key, inputs)
    if kept is not None:
        for image, rows, name in (
            (target.depth, kept.depth, kept.after[0]),
            (target.stencil, kept.stencil, kept.after[1]),
        ):
            if image is not None and rows is not None:
                image.write_later(inputs.region.first_row, rows, name)
        return kept.spans
    spans = fill()
    keeps = visibility.pays(key[0]) and None not in before
    depth = _after_fill(target.depth, inputs.region, names[0], inputs.writes_depth, keeps)
    stencil = _after_fill(target.stencil, inputs.region, names[1], inputs.tests_stencil, keeps)
    if keeps:
        after = _contents(target.depth), _contents(target.stencil)
        visibility.keep(key, CacheEntry(inputs, after, depth, stencil, spans))
    return spans


def _contents(image: Image | None) -> object:
    return None if image is None else image.contents


def _after_fill(image: Image | None, region: Region, name: object, changed: bool, keeps: bool) -> np.ndarray | None:
    """Name what a plane holds after the fill; return a copy of its rows where it has changed and is to be kept."""
    if image is None:
        return None
    if not changed:
        image.contents = name  # the fill has taken the cells, but left them as they were
        return None
    if not keeps:
        return None
    rows: np.ndarray = image.cells[region.first_row : region.end_row].copy()
    image.contents = object()
    return rows
