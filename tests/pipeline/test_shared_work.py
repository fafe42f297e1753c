"""Threads: whatever they share, and however small the pieces are, the buffers are those of one thread."""

import importlib

import numpy as np
import pytest

import softshadow as ss
from softshadow import gl
from softshadow.pipeline import choose, set_threads, threads, use_short_cuts
from softshadow.pipeline.memory import threads as pool
from softshadow.pipeline.shade.visible_spans import BandsOfIds

# what is shared from how much work on; here, anything is, in small pieces
SMALL = {
    "buffers.accumulation": {"PIXELS_PER_TASK": 100},
    "choose": {"WORTH_BANDS": 0, "WORTH_THREADS": 0, "WORTH_BANDS_IN_TILES": 0, "WORTH_SHARING": 1},
    "fast.batch.vertex_stage": {"VERTICES_PER_TASK": 8},
    "fast.forward": {"WORTH_BANDS": 0},
    "fast.stencil_tiles": {"WORTH_SHARING": 0, "SHARED_TRIANGLES": 8},
    "memory.threads": {"PART_SIZE": 8},
    "raster.bins": {"FEW_VISITS": 300, "FEW_BANDS": 1},
    "shade.interpolate": {"TRIANGLES_PER_TASK": 2},
    "shade.shading": {"PARTS_PER_THREAD": 5, "WORTH_SHARING": 0, "CHUNK": 300},
    "shade.visible_spans": {"PIXELS_PER_PART": 500, "WORTH_SHARING": 0, "WORTH_COLLECTING": 0},
}

SHARING = [
    "buffers.accumulation", "fast.batch.vertex_stage", "fast.depth_only", "fast.forward", "fast.stencil_tiles",
    "geometry.triangle_setup", "raster.fill", "shade.interpolate", "shade.shading", "shade.visible_spans",
]  # fmt: skip

RUNS = [
    ("planar-accumulated", {"samples": 2}, {"forward"}),
    ("volume-zfail", {}, {"stencil_tiles", "fill", "triangle_setup"}),
    ("volume-wedges", {}, {"fill", "interpolate"}),
    ("map-pcf", {}, {"fill", "shading", "visible_spans"}),
]


@pytest.fixture
def in_small_pieces(monkeypatch):
    """Let three threads share whatever they can; return the names of the files that shared something."""
    before, shared, share = threads(), set(), pool.share

    def noted_share(work, n_pieces, pays=True):
        if n_pieces > 1 and pays:
            shared.add(work.__code__.co_filename.rpartition("/")[2].removesuffix(".py"))
        return share(work, n_pieces, pays)

    def begin():
        for name, constants in SMALL.items():
            for constant, value in constants.items():
                monkeypatch.setattr(importlib.import_module(f"softshadow.pipeline.{name}"), constant, value)
        for name in SHARING:
            monkeypatch.setattr(importlib.import_module(f"softshadow.pipeline.{name}"), "share", noted_share)
        set_threads(3)
        return shared

    yield begin
    set_threads(before)


@pytest.mark.parametrize(("technique", "options", "sharing"), RUNS, ids=[name for name, *_ in RUNS])
def test_shared_work_leaves_the_buffers_of_one_thread(in_small_pieces, technique, options, sharing):
    set_threads(1)
    with use_short_cuts("always"):
        alone = ss.run(technique, "torus", (96, 64), **options)
        shared = in_small_pieces()
        together = ss.run(technique, "torus", (96, 64), **options)
    assert shared >= sharing
    for a, b in zip(alone.steps, together.steps, strict=True):
        for name in ("image", "depth", "stencil"):
            np.testing.assert_array_equal(getattr(a, name), getattr(b, name), err_msg=f"{a.title}: {name}")
        for name in a.maps:
            np.testing.assert_array_equal(a.maps[name], b.maps[name], err_msg=f"{a.title}: {name}")


def mesh_over_depths(attached: bool) -> np.ndarray:
    """Return a picture of triangles over each other that shows a texture of depths: those of its target, or others."""
    rng = np.random.default_rng(3)
    gl.create_context(64, 64)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 1)
    color, depth = (gl.GL_RGBA, gl.GL_UNSIGNED_BYTE), (gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    kinds = (gl.GL_COLOR_ATTACHMENT0, gl.GL_RGBA, color), (gl.GL_DEPTH_ATTACHMENT, gl.GL_DEPTH_COMPONENT24, depth)
    for texture, (point, internal_format, kind) in enumerate((*kinds, kinds[1]), 1):
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal_format, 64, 64, 0, *kind, None)
        if texture < 3:
            gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, point, gl.GL_TEXTURE_2D, texture, 0)
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 2 if attached else 3)
    gl.glEnable(gl.GL_TEXTURE_2D)
    corners = rng.uniform(-1, 1, (6000, 3)).astype(np.float32)
    coordinates = rng.random((6000, 2)).astype(np.float32)
    gl.glEnableClientState(gl.GL_VERTEX_ARRAY)
    gl.glEnableClientState(gl.GL_TEXTURE_COORD_ARRAY)
    gl.glVertexPointer(3, gl.GL_FLOAT, 0, corners)
    gl.glTexCoordPointer(2, gl.GL_FLOAT, 0, coordinates)
    gl.glDrawArrays(gl.GL_TRIANGLES, 0, len(corners))
    return gl.glReadPixels(0, 0, 64, 64, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)


@pytest.mark.parametrize("attached", [False, True])
def test_bands_are_shaded_one_by_one_unless_their_depths_are_read(in_small_pieces, monkeypatch, attached):
    shaded = []
    finish = BandsOfIds.finish

    def noted_finish(bands, first_row, end_row):
        shaded.append(bands.shade is not None)
        finish(bands, first_row, end_row)

    set_threads(1)
    with use_short_cuts("always"):
        alone = mesh_over_depths(attached)
        in_small_pieces()
        monkeypatch.setattr(BandsOfIds, "finish", noted_finish)
        monkeypatch.setattr(choose, "LAYERS", 10_000)  # few bands in spite of many layers
        np.testing.assert_array_equal(mesh_over_depths(attached), alone)
    assert len(shaded) > 1
    assert shaded == [not attached] * len(shaded)


def test_shared_sums_are_those_of_one_thread(in_small_pieces):
    def picture():
        gl.create_context(40, 30)
        for red in (0.3, 0.9):
            gl.glClearColor(red, 0.5, 0, 1)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
            gl.glAccum(gl.GL_ACCUM, 0.5)
        gl.glAccum(gl.GL_RETURN, 1)
        return gl.glReadPixels(0, 0, 40, 30, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)

    set_threads(1)
    alone = picture()
    shared = in_small_pieces()
    np.testing.assert_array_equal(picture(), alone)
    assert shared == {"accumulation"}
