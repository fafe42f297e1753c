"""States of segments as tables of numbers; equals `raster.ordered.process_fragments`, see fast/test_segments.py.

A segment is triangles that are drawn under one state. Kernels take the states of several segments as arrays with a row
per state, so that one call draws all of them: to hand the arguments of one state over takes as long as a small draw.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from softshadow.framebuffer import Framebuffer
from softshadow.jit import read_only
from softshadow.pipeline.fast.drawn_surfaces import only_lessens_depths
from softshadow.pipeline.fast.span_state import NEEDED, UNITS, StateNumbers, span_state
from softshadow.pipeline.fast.span_tests import alpha_tests, span_tests, with_float_reference
from softshadow.pipeline.fast.span_texels import texels_of
from softshadow.pipeline.fast.special_fragments import NO_SPECIAL, discards_some, needed_places, special_numbers
from softshadow.pipeline.raster.fragment_ops import ALWAYS, FragmentOps
from softshadow.pipeline.records import Geometry
from softshadow.programs.fixed_function import Unit
from softshadow.state import State

TEXTURES = 16  # of the segments of one call
# columns of a table of segments: rows of the tables of states and of `flats`, triangles, where they may write, textures
STATE, FLATS, FIRST, END, LEFT, RIGHT, FIRST_ROW, END_ROW, OWN_TEXTURES = range(9)
IN_ORDER = tuple(range(UNITS))  # the textures of a segment that is drawn alone
MOST_KNOWN = 256  # sequences of states whose tables are kept: an animation has the same in all frames
COST_OF_PLAIN, COST_OF_TEXTURE = 2, 5  # some ns each
OF_SPANS = -1  # in column FIRST: the segment is spans, as many as column END says
# columns of `tests`: whether depth and stencil are tested before shading, and after it; the integer that z = 1 becomes
DEPTH_BEFORE, STENCIL_BEFORE, DEPTH_AFTER, STENCIL_AFTER, DEPTH_LARGEST = range(5)
NO_DEPTH, NO_STENCIL = np.zeros((1, 1), np.float32), np.zeros((1, 1), np.uint8)  # where there is no such buffer
NO_TEXELS = np.zeros(1, np.int32)  # of a unit that is not in use

Tables = tuple[np.ndarray, ...]


class SegmentState(NamedTuple):
    """The fragment state of a segment, but for its textures and scissor box.

    tables: its numbers, with one row per array (`state_tables`); special: of `special_fragments.special_numbers`;
    writes_depth, only_lessens: whether its draws write depths, make none larger; cost: of a fragment, where that of a
    plain one is `COST_OF_PLAIN`.
    """

    tables: Tables
    special: np.ndarray
    writes_depth: bool
    only_lessens: bool
    cost: int


def segment_state(
    state: State,
    front: FragmentOps,
    back: FragmentOps,
    target: Framebuffer,
    geometry: Geometry,
    units: list[Unit] | None,
    known: list[SegmentState],
) -> SegmentState | None:
    """Return the fragment state of a segment, or None where the kernels do not cover it.

    Parameters
    ----------
    front, back : the per-fragment operations of each facing
    units : the texture units in use, None where a program is no fixed function
    known : keeps what a plan has
    """
    special = special_numbers(geometry)
    if known and (special is known[0].special or special.tobytes() == known[0].special.tobytes()):
        return known[0]
    depth = target.depth
    if depth is not None and depth.format.dtype != np.float32:
        return None
    numbers = covered_state(state, target, geometry, units)
    if numbers is None:
        return None
    cost = COST_OF_PLAIN + COST_OF_TEXTURE * len(units or [])
    if front.stencil_test or back.stencil_test:
        cost //= 2  # those that fail take an eighth of the time
    what = bool(front.depth_write or back.depth_write), only_lessens_depths(front, back), cost
    if front.alpha_test and target.colors[0].format.kind == "float":
        if np.isnan(state.alpha.ref):
            return None
        front, back = with_float_reference(front, state.alpha.ref), with_float_reference(back, state.alpha.ref)
    if discards_some(special) and not front.alpha_test:  # they are left out with those that fail the alpha test
        front, back = (ops._replace(alpha_test=1, alpha_func=ALWAYS) for ops in (front, back))
    if special is not NO_SPECIAL:
        switches = numbers.switches.copy()
        switches[NEEDED] |= needed_places(special)
        numbers = numbers._replace(switches=switches)
    known[:] = [SegmentState(tables_of(front, back, *numbers, special), special, *what)]
    return known[0]


def covered_state(
    state: State, target: Framebuffer, geometry: Geometry, units: list[Unit] | None
) -> StateNumbers | None:
    """Return the numbers of a draw's fragment state, or None where the textbook has to shade.

    The kernels take the fixed function in float32 and one colour buffer, which no unit samples, of bytes or of floats.
    `units` are those in use, None where a program is no fixed function.
    """
    colors = target.colors
    if units is None or geometry.window.dtype != np.float32 or len(colors) != 1:
        return None
    if any(image is attached.image for unit in units for image in unit.texture.images.values()
           for attached in target.attachments.values()):  # fmt: skip
        return None
    return span_state(state, units, colors[0].format, len(geometry.flat))


def tables_of(
    front: FragmentOps, back: FragmentOps, switches: np.ndarray, numbers: np.ndarray, special: np.ndarray
) -> Tables:
    """Return the numbers of one state, see `state_tables`."""
    return (*_test_tables(front, back), *[read_only(array[None]) for array in (switches, numbers, special)])


@lru_cache(maxsize=256)
def _test_tables(front: FragmentOps, back: FragmentOps) -> Tables:
    before, after = span_tests(front, back), alpha_tests(front, back)
    tests = np.array([before.depth, before.stencil, after.depth, after.stencil, front.depth_largest], np.int64)
    arrays = tests, before.numbers, before.byte_numbers, after.numbers, after.byte_numbers, after.alpha
    return tuple(read_only(array[None]) for array in arrays)


_known_tables: dict[tuple[int, ...], tuple[Sequence[SegmentState], Tables]] = {}  # the latest, by the states' ids


def state_tables(states: Sequence[SegmentState]) -> Tables:
    """Return the numbers of states as read-only arrays with a row per state.

    They are: tests (U, 5) int64; the numbers (U, 2, c) int32 and bytes (U, 2, c) uint8 of the tests before shading, and
    of those after it (`fragment_numbers.numbers_of`); the alpha test (U, 5) int32; switches (U, s) int64 and numbers
    (U, n) float32 (`span_state`); the special numbers (U, 35) int32.
    """
    if len(states) == 1:
        return states[0].tables
    place = tuple(map(id, states))
    known = _known_tables.get(place)
    if known is None:
        if len(_known_tables) >= MOST_KNOWN:
            _known_tables.clear()
        arrays = zip(*[one.tables for one in states], strict=True)
        known = _known_tables[place] = states, tuple([read_only(np.concatenate(each)) for each in arrays])
    return known[1]


def texels_of_units(units: list[Unit] | None) -> list[np.ndarray]:
    """Return the present texels of the textures of units."""
    return [texels_of(unit.texture) for unit in units or []]


def padded_textures(textures: Sequence[np.ndarray]) -> tuple[np.ndarray, ...]:
    """Return the texels of at most `TEXTURES` textures as kernels take them."""
    return (*textures, *[NO_TEXELS] * (TEXTURES - len(textures)))
