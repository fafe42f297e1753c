"""Depths in whole pixels; equals `depth_rectangles.draw_depths`, see fast/test_shown_rectangles.py.

The rectangles are those of `shown_rectangles`. No fragment is listed: each has the depth of a texel, and is tested
where it is shown. Stencil values are written in the same places.
"""

from __future__ import annotations

import numpy as np

from softshadow import tokens as gl
from softshadow.framebuffer import Framebuffer, Storage
from softshadow.image import Image
from softshadow.jit import kernel
from softshadow.pipeline.commands import Draw, DrawDepths
from softshadow.pipeline.fast.shown_rectangles import Place, Shown, shown_part, shows_texels
from softshadow.pipeline.fast.span_state import has_four_bytes
from softshadow.pipeline.raster.depth import depth_units
from softshadow.pipeline.raster.fragment_ops import NO_ALPHA, FragmentOps, compare, fragment_ops, process_fragment
from softshadow.pipeline.raster.region import buffer_cells, depth_range_of
from softshadow.pipeline.records import DEPTH_FAILED, PASSED, VERDICTS, FragmentCounts, Fragments
from softshadow.pipeline.shade.color_writes import as_pixels, color_writer, colors_to_bytes, writable_bits
from softshadow.pipeline.shade.visible_spans import spans_of
from softshadow.state import State


def shows_depths(command: Draw, target: Framebuffer) -> bool:
    """Return whether the fragments of a rectangle need no triangles, nor tests of their colours."""
    front, back = (fragment_ops(command.state, target.depth, target.stencil, is_front) for is_front in (True, False))
    return (
        shows_texels(command)
        and command.vertices.position.dtype == np.float32
        and (target.depth is None or target.depth.format.dtype == np.float32)
        and front == back
        and not front.alpha_test
    )


def draw_shown_depths(
    command: DrawDepths, target: Framebuffer, storage: Storage, counts: FragmentCounts | None = None
) -> None:
    """Draw a rectangle of depths, stencil values or both that `shows_depths`; an occlusion query counts fragments."""
    state = command.draw.state
    shown, ops = shown_part(command.draw, target, storage), fragment_ops(state, target.depth, target.stencil, True)
    if shown is None:
        return
    if command.has_stencil:
        if command.has_depth and target.depth is not None:  # written without a test, if the depth mask allows it
            writing = ops._replace(
                stencil_test=0, depth_test=1, depth_func=gl.GL_ALWAYS, depth_write=int(state.depth.write)
            )
            _test(state, target, shown, writing)
        _write_stencil(state, target, shown)
        if counts is not None:
            counts.verdicts[PASSED] += shown.texels.shape[0] * shown.texels.shape[1]
        return
    verdicts = _test(state, target, shown, ops)
    if counts is not None:
        counts.verdicts[:] += np.bincount(verdicts.reshape(-1), minlength=len(VERDICTS))
    if any(state.color.mask):
        _write_color(command, target, shown.place, verdicts == PASSED)


def _test(state: State, target: Framebuffer, shown: Shown, ops: FragmentOps) -> np.ndarray:
    """Return the verdicts (h, w) uint8 of fragments; depth and stencil change."""
    depth, stencil = buffer_cells(target, np.dtype(np.float32))
    verdicts = np.empty(shown.texels.shape[:2], np.uint8)
    process_rectangle(
        ops, _channel(shown, 0), depth_range_of(state, np.float32), depth[shown.place], stencil[shown.place], verdicts
    )
    return verdicts


def _channel(shown: Shown, number: int) -> np.ndarray:
    """Return a channel of the texels; a depth texture has the same in all."""
    return shown.texels if shown.texels.ndim == 2 else shown.texels[..., number]


@kernel
def process_rectangle(ops, texels, depth_range, depth, stencil, verdicts):
    """Process one fragment for each texel (h, w), its depth; depth, stencil and verdicts (h, w) change."""
    for j in range(verdicts.shape[0]):
        for i in range(verdicts.shape[1]):
            z = depth_units(texels[j, i], depth_range, ops.depth_largest)
            if not ops.stencil_test:
                passed = compare(ops.depth_func, z, depth[j, i])
                verdicts[j, i] = PASSED if passed else DEPTH_FAILED
                if passed and ops.depth_write:
                    depth[j, i] = z
                continue
            verdict, s, stored_z = process_fragment(ops, True, NO_ALPHA, z, depth[j, i], stencil[j, i])
            verdicts[j, i] = verdict
            stencil[j, i] = s
            if ops.depth_write:
                depth[j, i] = stored_z


def _write_stencil(state: State, target: Framebuffer, shown: Shown) -> None:
    if target.stencil is not None:
        mask = np.uint8(state.stencil.front.write_mask & target.stencil.format.largest)
        cells = target.stencil.cells[shown.place]
        cells[:] = (cells & ~mask) | (_channel(shown, 1).astype(np.uint8) & mask)


def _write_color(command: DrawDepths, target: Framebuffer, place: Place, passed: np.ndarray) -> None:
    """Write the colour of the rectangle where depths have passed, (h, w) bool."""
    state, color = command.draw.state, np.array([command.color], np.float32)
    for image in target.colors:
        if state.blend.enabled or state.blend.logic_enabled or not has_four_bytes(image.format):
            _write_fragments(state, image, place, passed, color)
            continue
        pixels, writable = as_pixels(image.cells)[place], writable_bits(state, image)
        pixel = as_pixels(colors_to_bytes(color, image.format))[0]
        np.copyto(pixels, (pixels & ~writable) | (pixel & writable), where=passed)


def _write_fragments(state: State, image: Image, place: Place, passed: np.ndarray, color: np.ndarray) -> None:
    rows, columns = (
        numbers.astype(np.int32) + np.int32(side.start) for numbers, side in zip(passed.nonzero(), place, strict=True)
    )
    spans = spans_of(Fragments(rows, columns, np.zeros(len(rows), np.int32)))
    color_writer(state, image)(spans, np.tile(color, (len(rows), 1)))


__all__ = ["draw_shown_depths", "shows_depths"]
