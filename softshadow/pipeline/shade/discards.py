"""Fragments of a draw: those that polygon stipple and smooth points leave out are not among them."""

from __future__ import annotations

import numpy as np

from softshadow.pipeline.raster.ordered import list_fragments
from softshadow.pipeline.records import Fragments, Geometry, Region
from softshadow.pipeline.shade.interpolate import inputs_at
from softshadow.pipeline.shade.shading import attribute_planes_of
from softshadow.pipeline.shade.visible_spans import spans_of

PLACE_COLUMNS = 4


def fragments_in(geometry: Geometry, region: Region) -> Fragments:
    """Return the fragments of a draw inside the region, in drawing order, each row from left to right."""
    return without_discarded(geometry, list_fragments(geometry.triangles, region))


def without_discarded(geometry: Geometry, fragments: Fragments) -> Fragments:
    """Return the fragments that are not left out (GL 2.1, sec. 3.5.2: stippled fragments are not produced)."""
    discards = geometry.discards
    if discards is None or not len(fragments.row):
        return fragments
    kept = np.ones(len(fragments.row), bool)
    if discards.pattern is not None:
        side = len(discards.pattern)
        kept &= discards.pattern[fragments.row % side, fragments.column % side]
    if discards.outside is not None:
        spans, places = spans_of(fragments), slice(discards.places, discards.places + PLACE_COLUMNS)
        inputs = inputs_at(spans, attribute_planes_of(geometry, spans), geometry.flat)
        kept &= ~discards.outside(inputs[:, places])
    return Fragments(*(part[kept] for part in fragments))
