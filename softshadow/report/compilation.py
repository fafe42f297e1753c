"""Half of what a tour compiles, compiled by a second process: in one, Numba compiles a kernel at a time.

The first stop begins with the kernels of geometry and fill. Meanwhile ``python -m softshadow.report.compilation`` calls
those of shading and of the later stops, in the order in which the tour will, on a row of pixels or a triangle; the tour
then finds them in the cache. Should both compile a kernel at once, both write the same code.
"""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from typing import Any

import numpy as np

from softshadow import tokens as gl
from softshadow.image import FORMATS, Format, Image
from softshadow.pipeline import threads
from softshadow.pipeline.raster.bins import sort_into_bands
from softshadow.pipeline.records import Region, Setup, Spans
from softshadow.pipeline.shade.color_writes import color_writer
from softshadow.pipeline.shade.interpolate import inputs_at, planes_of
from softshadow.pipeline.shade.visible_spans import visible_spans
from softshadow.programs.cube_maps import on_faces
from softshadow.programs.llvmpipe_math import powers
from softshadow.programs.percentage_closer import count_lit
from softshadow.programs.sampling import divide, sample
from softshadow.scene.shapes import box
from softshadow.scene.silhouette import light_distances
from softshadow.state import Blend, State
from softshadow.texture import Sampler, Texture

SIDE = 16


@contextmanager
def compiling_ahead() -> Iterator[None]:
    """Inside, a second process compiles, too, where draws may use two threads. It ends with the block at the latest.

    Code is handed over in the cache folder, so there must be one (`cache_folder`).
    """
    helper = None
    if threads() > 1:
        with suppress(OSError):  # no process to be had: then this one compiles everything
            helper = subprocess.Popen(
                [sys.executable, "-m", __name__],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
            )
    try:
        yield
    finally:
        if helper is not None:
            helper.kill()
            helper.wait()


def compile_shading_and_maps() -> None:
    """Call what the tour will call, with the types that its draws have."""
    spans = visible_spans(np.zeros((1, SIDE), np.int32), 0)
    interpolate_one_triangle(spans)
    write_colors(spans, FORMATS[gl.GL_RGBA8], Blend())
    numbers = np.ones(SIDE, np.float32)
    powers(numbers, numbers, np.empty_like(numbers))
    write_colors(spans, FORMATS[gl.GL_RGBA8], Blend(True, gl.GL_SRC_ALPHA, gl.GL_ONE_MINUS_SRC_ALPHA))
    look_up(FORMATS[gl.GL_RGBA8], min_filter=gl.GL_LINEAR, mag_filter=gl.GL_LINEAR)
    write_colors(spans, FORMATS[gl.GL_RGBA8], Blend(True, dst_rgb=gl.GL_ONE, dst_alpha=gl.GL_ONE))
    mesh = box()
    light_distances(mesh, np.array([0.0, 5.0, 0.0, 1.0]))
    mesh.topology.face_bodies  # noqa: B018 - computed when asked for
    sort_into_bands(np.zeros((1, 6), np.int32), [(0, 1)], Region(0, SIDE, 0, SIDE, 0))
    depth, nearest = FORMATS[gl.GL_DEPTH_COMPONENT24], {"min_filter": gl.GL_NEAREST, "mag_filter": gl.GL_NEAREST}
    look_up(depth, compare_mode=gl.GL_COMPARE_R_TO_TEXTURE, **nearest)
    place = divide(np.ones((SIDE, 4), np.float32))
    map_ = look_up(depth, **nearest)
    count_lit(map_, place, place[:, 2], 1, np.float32(1 / SIDE))
    write_colors(spans, FORMATS[gl.GL_RGBA32F], Blend())
    on_faces(np.ones((SIDE, 3), np.float32), by_reciprocal=False)


def interpolate_one_triangle(spans: Spans) -> None:
    """Interpolate four values of one triangle."""
    corners, depth = np.zeros((1, 6), np.int32), np.zeros((1, 4), np.float32)
    one, front = np.zeros(1, np.int32), np.ones(1, np.uint8)
    values, flat = np.ones((3, 4), np.float32), np.zeros(4, bool)
    triangle = Setup(corners, np.array([[0, 1, 2]], np.int32), depth, front, one)
    inputs_at(spans, planes_of(spans, triangle, values, values, None, flat, one), flat)


def write_colors(spans: Spans, format: Format, blend: Blend) -> None:
    """Write the spans into a buffer of a format."""
    writer = color_writer(replace(State(), blend=blend), Image.new(format, SIDE, 1))
    writer(spans, np.zeros((4, spans.fragments), np.float32).T)


def look_up(format: Format, **parameters: Any) -> Texture:
    """Sample a texture of a format, and return it."""
    texture = Texture(1, gl.GL_TEXTURE_2D, Sampler(**parameters), {(0, 0): Image.new(format, SIDE, SIDE)})
    sample(texture, np.zeros((3, SIDE), np.float32).T, np.empty((4, SIDE), np.float32).T)
    return texture


if __name__ == "__main__":
    compile_shading_and_maps()
