"""Every fragment of a frame's window, from one replay: what a page needs to tell the history of any pixel.

A page computes coverage, depth and tests again from the triangles in the window (templates/fragment.js). Shading it
cannot: alpha, where it is tested, and colours are recorded in layers. Layer k of a draw holds, for each pixel, the
value of the k-th of the draw's fragments there.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from softshadow import pipeline
from softshadow import tokens as gl
from softshadow.context import Frame
from softshadow.framebuffer import DEFAULT, Framebuffer, Storage
from softshadow.inspection.reasons import clear_reason, outside
from softshadow.inspection.step import object_of
from softshadow.pipeline.commands import Clear, Command, Draw
from softshadow.pipeline.execute import execute
from softshadow.pipeline.geometry.facing import CULL_BACK, CULL_FRONT, culling
from softshadow.pipeline.geometry.geometry import process_geometry
from softshadow.pipeline.raster.fragment_ops import fragment_ops
from softshadow.pipeline.raster.ordered import process_fragments
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
from softshadow.pipeline.shade.discards import fragments_in
from softshadow.pipeline.shade.visible_spans import spans_of
from softshadow.report.fragment_events import (
    LINE,
    ClearEvent,
    DrawEvent,
    FragmentRecord,
    StepCounts,
    Triangles,
    WriteEvent,
)
from softshadow.report.reason_templates import reason_templates
from softshadow.report.triangle_origins import origins_of
from softshadow.state import State

MOST_FRAGMENTS = 8 << 20  # of one draw; more take too much memory
DRAWN, PASSED_WITHOUT_COLOR, CULLED = 1, 2, 7
FATE_OF_VERDICT = {SCISSORED: 3, ALPHA_FAILED: 4, STENCIL_FAILED: 5, DEPTH_FAILED: 6}
COUNTED_FATES = ("drawn", "depth failed", "stencil failed")


class TooManyFragments(Exception):
    """A draw has more fragments than a page can hold."""


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
    elif isinstance(command, Draw | Clear):
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
        fragments = fragments_in(geometry, everywhere)
        if not len(fragments.row):
            return
        colors = pipeline.shade(geometry, spans_of(fragments))
    alpha, alpha_ref = compared_alpha(state, window.color, colors[:, 3])
    event = _event(command, window, geometry, np.unique(fragments.triangle), alpha_ref, (step, draw))
    for layer in _layers(fragments, width):
        _draw_layer(event, state, window, geometry, fragments, layer, (alpha, colors), counts)
    yield event


def _event(
    command: Draw, window: Framebuffer, geometry: Geometry, used: np.ndarray, alpha_ref: int, place: tuple[int, int]
) -> DrawEvent:
    """Return the event of a draw without its layers; `used` are the triangles that cover pixels."""
    state, triangles = command.state, geometry.triangles
    back, front = (
        fragment_ops(state, window.depth, window.stencil, side)._replace(alpha_ref=alpha_ref)
        for side in (False, True)
    )  # fmt: skip
    colored = bool(window.colors) and any(state.color.mask)
    depth_range = depth_range_of(state, geometry.window.dtype.type)
    sides = np.stack([triangles.front[used], _facings(geometry)[used]], axis=1).astype(np.uint8)
    words = {
        facing: reason_templates(state, front if side else back, None if facing == LINE else facing == 1, colored)
        for side, facing in np.unique(sides, axis=0).tolist()
    }
    return DrawEvent(
        *place, object_of(command), region_of(state, window), culling(state.cull)[0],
        (float(depth_range.low), float(depth_range.high)), (back, front), words, colored,
        Triangles(
            triangles.corners[used], triangles.depth[used], sides,
            geometry.source[triangles.ids[used]].astype(np.int32),
        ),
        origins=origins_of(command, geometry.source[triangles.ids[used]], np.unique(sides[:, 1]).tolist()),
    )  # fmt: skip


def _draw_layer(
    event: DrawEvent, state: State, window: Framebuffer, geometry: Geometry, fragments: Fragments, layer: np.ndarray,
    shaded: tuple[np.ndarray, np.ndarray], counts: StepCounts,
) -> None:  # fmt: skip
    """Test and write the fragments with the numbers `layer`; no two are of one pixel, so their order does not matter.

    `shaded` has the compared alpha and the colour of every fragment.
    """
    shape, region, (alpha, colors) = window.size[::-1], event.region, shaded
    part, triangles = _part(fragments, layer), geometry.triangles
    is_culled = _is_culled(_facings(geometry)[part.triangle], event.culled)
    is_inside = (part.row >= region.first_row) & (part.row < region.end_row)
    is_inside &= (part.column >= region.left) & (part.column < region.right)
    is_tested = is_inside & ~is_culled
    tested, verdicts = layer[is_tested], np.empty(int(is_tested.sum()), np.uint8)
    real = geometry.window.dtype
    depth, stencil = buffer_cells(window, real)
    process_fragments(
        event.ops[1], event.ops[0], _part(fragments, tested), alpha[tested], triangles,
        depth_range_of(state, real.type), np.arange(max(depth.shape), dtype=real), depth, stencil, verdicts,
    )  # fmt: skip
    fates = np.where(is_culled, np.uint8(CULLED), np.uint8(FATE_OF_VERDICT[SCISSORED]))
    fates[is_tested] = _fates(verdicts, event.colored)
    _count(counts, part, fates)
    if any(ops.alpha_test for ops in event.ops):
        event.alphas.append(_image(part, alpha[layer], shape))
    if event.colored:
        passed = tested[verdicts == PASSED]
        written, color = _part(fragments, passed), window.image(gl.GL_COLOR_ATTACHMENT0)
        assert color is not None
        for image in window.colors:
            color_writer(state, image)(spans_of(written), colors[passed])
        values = color.cells[written.row, written.column, :3]
        is_written = _image(written, np.ones(len(passed), np.uint8), shape) > 0
        event.colors.append((_image(written, values, shape), is_written))


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
    yield from np.split(np.argsort(rank, kind="stable"), np.cumsum(np.bincount(rank))[:-1])


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
