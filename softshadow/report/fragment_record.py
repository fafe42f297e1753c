"""Every fragment of a frame's window, from one replay: what a page needs to tell the history of any pixel.

A page computes coverage, depth and tests again from the triangles in the window (templates/fragment.js). Shading it
cannot: alpha, where it is tested, and colours are recorded in layers. Layer k of a draw holds, for each pixel, the
value of the k-th of the draw's fragments there.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from softshadow import pipeline
from softshadow import tokens as gl
from softshadow.context import Frame
from softshadow.framebuffer import DEFAULT, Framebuffer, Storage
from softshadow.inspection.history import INDEPENDENT_OF_WINDOW
from softshadow.inspection.reasons import clear_reason, outside
from softshadow.inspection.step import object_of
from softshadow.pipeline import commands
from softshadow.pipeline.commands import Clear, Command, Draw
from softshadow.pipeline.execute import execute
from softshadow.pipeline.geometry.facing import CULL_BACK, CULL_FRONT, culling
from softshadow.pipeline.geometry.geometry import process_geometry
from softshadow.pipeline.raster.fragment_ops import FragmentOps, fragment_ops
from softshadow.pipeline.raster.ordered import list_fragments, process_fragments
from softshadow.pipeline.raster.region import buffer_cells, covered, depth_range_of, region_of
from softshadow.pipeline.records import (
    ALPHA_FAILED,
    DEPTH_FAILED,
    NO_VERTEX,
    PASSED,
    SCISSORED,
    STENCIL_FAILED,
    Fragments,
    Geometry,
    Region,
)
from softshadow.pipeline.shade.blend import compared_alpha
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.visible_spans import spans_of
from softshadow.report.reason_templates import reason_templates

MOST_FRAGMENTS = 8 << 20  # of one draw; more take too much memory
LINE = 2  # in place of a facing: neither front nor back
# what the last fragment of a step was, in the map of fates; 0 is no fragment
FATES = ("no fragment", "drawn", "passed, no colour", "scissor", "alpha failed", "stencil failed", "depth failed",
         "culled")  # fmt: skip
DRAWN, PASSED_WITHOUT_COLOR, CULLED = 1, 2, 7
FATE_OF_VERDICT = {SCISSORED: 3, ALPHA_FAILED: 4, STENCIL_FAILED: 5, DEPTH_FAILED: 6}


class TooManyFragments(Exception):
    """A draw has more fragments than a page can hold."""


@dataclass
class Triangles:
    """The triangles of a draw that cover pixels: corners (T, 6), depth (T, 4), sides (T, 2): which of the two stencil
    states applies (1 front), and the facing; ids (T,): number of the primitive in the draw."""

    corners: np.ndarray
    depth: np.ndarray
    sides: np.ndarray
    ids: np.ndarray


@dataclass
class DrawEvent:
    """A draw: its state as numbers and words, its triangles, and its layers of alpha and colour."""

    step: int
    draw: int
    object: str
    region: Region
    culled: int
    depth_range: tuple[float, float]
    ops: tuple[FragmentOps, FragmentOps]  # back, front
    words: dict[int, dict[str, str]]  # by facing
    colored: bool
    triangles: Triangles
    alphas: list[np.ndarray] = field(default_factory=list)
    extra: dict[str, dict[int, str]] = field(default_factory=dict)  # by column of the table: texts by primitive
    colors: list[tuple[np.ndarray, np.ndarray]] = field(default_factory=list)  # (H, W, 3), and where written (H, W)


@dataclass
class ClearEvent:
    """A clear: where, the values it writes, None for what it leaves alone, and the words."""

    step: int
    region: Region
    color: tuple[list[int], list[bool]] | None
    depth: float | None
    stencil: tuple[int, int] | None  # value and mask
    words: tuple[str, str]  # inside and outside the scissor box


@dataclass
class WriteEvent:
    """Any other command that changed the window: its buffers afterwards."""

    step: int
    name: str
    buffers: tuple[np.ndarray, np.ndarray, np.ndarray]  # colour (H, W, 3), depth in buffer units, stencil


@dataclass
class StepCounts:
    """The fragments of one step in the window: their number per pixel by fate, and the fate of the last one."""

    last: np.ndarray
    counts: dict[str, np.ndarray]


@dataclass
class FragmentRecord:
    """All events of a frame in order; `largest` is the depth of 1 in buffer units, `single` whether depth is float32."""

    start: WriteEvent
    largest: int
    single: bool
    events: list[DrawEvent | ClearEvent | WriteEvent]
    steps: list[StepCounts]


def record_fragments(frame: Frame) -> FragmentRecord:
    """Return all fragments of a frame's window.

    Raises
    ------
    TooManyFragments             a draw has more than `MOST_FRAGMENTS`
    """
    storage = frame.fresh_storage()
    window, (width, height) = storage.window, frame.size
    assert window.depth is not None
    shape = (height, width)
    steps = [
        StepCounts(np.zeros(shape, np.uint8), {fate: np.zeros(shape, np.uint16) for fate in COUNTED_FATES})
        for _ in frame.steps
    ]
    record = FragmentRecord(
        WriteEvent(0, "start", _contents(window)), window.depth.format.largest,
        window.depth.cells.dtype == np.float32, [], steps,
    )  # fmt: skip
    ends, draws = [end for _, end in frame.steps], 0
    for index, command in enumerate(frame.commands[: ends[-1] if ends else 0]):
        step = bisect_right(ends, index)
        record.events += _carried_out(command, storage, step, draws, steps[step])
        draws += isinstance(command, Draw)
    return record


COUNTED_FATES = ("drawn", "depth failed", "stencil failed")


def _carried_out(
    command: Command, storage: Storage, step: int, draw: int, counts: StepCounts
) -> Iterator[DrawEvent | ClearEvent | WriteEvent]:
    """Carry out a command, and yield its event if it concerns the window."""
    window = storage.window
    of_window = isinstance(command, Draw | Clear) and command.state.draw_framebuffer == DEFAULT
    if isinstance(command, Draw) and of_window:
        yield from _draw(command, storage, step, draw, counts)
    elif isinstance(command, Clear) and of_window:
        yield _clear(command, storage, step)
    elif isinstance(command, (*INDEPENDENT_OF_WINDOW, Draw, Clear, commands.CopyToTexture)):
        execute(command, storage)
    else:
        before = _contents(window)
        execute(command, storage)
        after = _contents(window)
        if not all(np.array_equal(a, b) for a, b in zip(before, after, strict=True)):
            yield WriteEvent(step, type(command).__name__, after)


def _contents(window: Framebuffer) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return copies of the window's colours (H, W, 3), depths in buffer units and stencil values."""
    color, depth, stencil = window.image(gl.GL_COLOR_ATTACHMENT0), window.depth, window.stencil
    assert color is not None
    assert depth is not None
    assert stencil is not None
    return color.view[..., :3].copy(), depth.view.copy(), stencil.view.copy()


def _clear(command: Clear, storage: Storage, step: int) -> ClearEvent:
    """Clear, and return what was written, read from a pixel inside the scissor box."""
    state, window = command.state, storage.window
    execute(command, storage)
    region, (color, depth, stencil) = region_of(state, window), _contents(window)
    inside = region.left < region.right and region.first_row < region.end_row
    place = (region.first_row, region.left) if inside else (0, 0)
    mask = [bool(on) for on in state.color.mask[:3]]
    clears = {bit: bool(command.mask & bit) for bit in (
        gl.GL_COLOR_BUFFER_BIT, gl.GL_DEPTH_BUFFER_BIT, gl.GL_STENCIL_BUFFER_BIT)}  # fmt: skip
    return ClearEvent(
        step,
        region,
        (color[place].tolist(), mask) if clears[gl.GL_COLOR_BUFFER_BIT] and any(mask) else None,
        float(depth[place]) if clears[gl.GL_DEPTH_BUFFER_BIT] and state.depth.write else None,
        (int(stencil[place]), state.stencil.front.write_mask & 0xFF) if clears[gl.GL_STENCIL_BUFFER_BIT] else None,
        (clear_reason(command, window), f"glClear: {outside(state.scissor)}"),
    )


def _draw(command: Draw, storage: Storage, step: int, draw: int, counts: StepCounts) -> Iterator[DrawEvent]:
    """Draw layer by layer, and yield what the page needs of it; nothing if no triangle covers a pixel."""
    window, state = storage.window, command.state
    width, height = window.size
    with np.errstate(all="ignore"):  # as in pipeline.draw
        geometry = process_geometry(command, window, storage, replace(state.cull, enabled=False))
        if not len(geometry.triangles.ids):
            return
        everywhere = Region(0, width, 0, height, int(window.flipped))
        if covered(geometry.triangles, everywhere)[1] > MOST_FRAGMENTS:
            raise TooManyFragments(f"draw {draw} has more than {MOST_FRAGMENTS} fragments")
        fragments = list_fragments(geometry.triangles, everywhere)
        if not len(fragments.row):
            return
        colors = pipeline.shade(geometry, spans_of(fragments))
    front, back = (fragment_ops(state, window.depth, window.stencil, side) for side in (True, False))
    alpha, alpha_ref = compared_alpha(state, window.color, colors[:, 3])
    front, back = front._replace(alpha_ref=alpha_ref), back._replace(alpha_ref=alpha_ref)
    real = geometry.window.dtype.type
    colored = bool(window.colors) and any(state.color.mask)
    depth_range, (culled, _) = depth_range_of(state, real), culling(state.cull)
    facings, used = _facings(geometry), np.unique(fragments.triangle)
    event = DrawEvent(
        step, draw, object_of(command), region_of(state, window), culled,
        (float(depth_range.low), float(depth_range.high)), (back, front), {}, colored,
        Triangles(
            geometry.triangles.corners[used], geometry.triangles.depth[used],
            np.stack([geometry.triangles.front[used], facings[used]], axis=1).astype(np.uint8),
            geometry.source[geometry.triangles.ids[used]].astype(np.int32),
        ),
    )  # fmt: skip
    for side, facing in np.unique(event.triangles.sides, axis=0).tolist():
        ops = front if side else back
        event.words[facing] = reason_templates(state, ops, None if facing == LINE else bool(facing), colored)

    is_culled = _is_culled(facings, culled)[fragments.triangle]
    region = event.region
    is_inside = (fragments.row >= region.first_row) & (fragments.row < region.end_row)
    is_inside &= (fragments.column >= region.left) & (fragments.column < region.right)
    columns = np.arange(max(window.depth.cells.shape), dtype=real) if window.depth is not None else None
    depth, stencil = buffer_cells(window, np.dtype(real))
    color = window.image(gl.GL_COLOR_ATTACHMENT0)
    assert color is not None
    for layer in _layers(fragments, width):
        # an earlier fragment of the layer is none of the same pixel, so their order does not matter
        tested = layer[is_inside[layer] & ~is_culled[layer]]
        part, verdicts = _part(fragments, tested), np.empty(len(tested), np.uint8)
        process_fragments(
            front, back, part, alpha[tested], geometry.triangles, depth_range, columns, depth, stencil, verdicts
        )
        passed = tested[verdicts == PASSED]
        written, spans = _part(fragments, passed), spans_of(_part(fragments, passed))
        for image in window.colors if colored else ():
            color_writer(state, image)(spans, colors[passed])
        fates = np.full(len(fragments.row), FATE_OF_VERDICT[SCISSORED], np.uint8)
        fates[is_culled] = CULLED
        fates[tested] = _fates(verdicts, colored)
        _count(counts, _part(fragments, layer), fates[layer])
        if front.alpha_test or back.alpha_test:
            event.alphas.append(_image(_part(fragments, layer), alpha[layer], (height, width)))
        if colored:
            values = color.cells[written.row, written.column, :3]
            is_written = _image(written, np.ones(len(passed), np.uint8), (height, width)) > 0
            event.colors.append((_image(written, values, (height, width)), is_written))
    yield event


def _facings(geometry: Geometry) -> np.ndarray:
    """Return the facing of every triangle in the window: 1 front, 0 back, `LINE`."""
    triangles = geometry.triangles
    if geometry.faces is not None:
        return geometry.faces[triangles.ids].astype(np.uint8)
    return np.where(triangles.vertices[:, 2] != NO_VERTEX, triangles.front, np.uint8(LINE))


def _is_culled(facings: np.ndarray, culled: int) -> np.ndarray:
    return ((facings == 1) & bool(culled & CULL_FRONT)) | ((facings == 0) & bool(culled & CULL_BACK))


def _layers(fragments: Fragments, width: int) -> Iterator[np.ndarray]:
    """Yield the numbers of each pixel's first fragment, then of each pixel's second one, and so on."""
    pixels = fragments.row.astype(np.int64) * width + fragments.column
    order = np.argsort(pixels, kind="stable")
    starts = np.flatnonzero(np.diff(pixels[order], prepend=-1))
    rank = np.empty(len(pixels), np.int64)
    rank[order] = np.arange(len(pixels)) - np.repeat(starts, np.diff(starts, append=len(pixels)))
    for layer in range(int(rank.max()) + 1):
        yield np.flatnonzero(rank == layer)


def _part(fragments: Fragments, numbers: np.ndarray) -> Fragments:
    return Fragments(*(each[numbers] for each in fragments))


def _image(fragments: Fragments, values: np.ndarray, shape: tuple[int, int]) -> np.ndarray:
    """Return the values of fragments, one per pixel, as an image; 0 elsewhere."""
    image = np.zeros(shape + values.shape[1:], np.uint8)
    image[fragments.row, fragments.column] = values
    return image


def _fates(verdicts: np.ndarray, colored: bool) -> np.ndarray:
    """Return the numbers in `FATES` of verdicts."""
    table = np.zeros(5, np.uint8)
    for verdict, fate in FATE_OF_VERDICT.items():
        table[verdict] = fate
    table[PASSED] = DRAWN if colored else PASSED_WITHOUT_COLOR
    return table[verdicts]


def _count(counts: StepCounts, fragments: Fragments, fates: np.ndarray) -> None:
    """Add the fragments of a layer, one per pixel, to the counts of a step."""
    counts.last[fragments.row, fragments.column] = fates
    passed = (fates == DRAWN) | (fates == PASSED_WITHOUT_COLOR)
    for name, chosen in (
        ("drawn", passed),
        ("depth failed", fates == FATE_OF_VERDICT[DEPTH_FAILED]),
        ("stencil failed", fates == FATE_OF_VERDICT[STENCIL_FAILED]),
    ):
        counts.counts[name][fragments.row[chosen], fragments.column[chosen]] += np.uint16(1)
