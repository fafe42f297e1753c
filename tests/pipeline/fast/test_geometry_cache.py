"""The geometry cache makes no difference to buffers, and equal draws of many vertices take their triangles from it."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import random_state, random_triangles, same_window, small_triangles
from softshadow import gl
from softshadow.context import Context
from softshadow.pipeline import explain_paths, use_short_cuts
from softshadow.pipeline.commands import Vertices
from softshadow.pipeline.fast import geometry_cache
from softshadow.state import ClipPlanes

HIT = "an equal draw has set up its triangles before"
MODES = (gl.GL_TRIANGLES, gl.GL_TRIANGLE_STRIP, gl.GL_QUADS, gl.GL_LINES)


@pytest.fixture(autouse=True)
def _small_draws_are_cached(monkeypatch):
    monkeypatch.setattr(geometry_cache, "FEW_VERTICES", 0)
    monkeypatch.setattr(geometry_cache, "CACHED_FROM", 2)


def positions(context: Context, rng) -> np.ndarray:
    """Return positions in and around the frustum, or only inside."""
    triangles = random_triangles(rng, 6) if rng.random() < 0.5 else small_triangles(rng, 12)
    inside = triangles.position * np.float32([0.4, 0.4, 0.4, 1]) if rng.random() < 0.7 else triangles.position
    return context.frozen(inside)


def frame(seed: int, draws: int = 24) -> tuple[Context, int]:
    """Return a context after draws of two meshes under two states with changing colours, and how many were hits."""
    rng = np.random.default_rng(seed)
    context = gl.create_context(40, 32)
    gl.glEnable(gl.GL_DEPTH_TEST)
    meshes = [positions(context, rng) for _ in range(2)]
    plane = ClipPlanes((True,) + (False,) * 5, ((1.0, 0.3, 0.1, 0.6),) + ((0.0,) * 4,) * 5)
    states = [random_state(rng, context.state) for _ in range(2)]
    states[1] = replace(states[1], clip_planes=plane if rng.random() < 0.3 else states[1].clip_planes)
    modes = [int(mode) for mode in rng.choice(MODES, 2)]
    with explain_paths() as paths:
        for _ in range(draws):
            position, context.state = meshes[rng.integers(2)], states[rng.integers(2)]
            if rng.random() < 0.2:
                gl.glViewport(*rng.integers(0, 3, 2).tolist(), 36, 30)
            if rng.random() < 0.2:
                gl.glMatrixMode(gl.GL_MODELVIEW)
                gl.glScalef(1.0, float(rng.choice([1.0, -1.0])), 1.0)
            color = context.frozen(rng.random((len(position), 4)))
            normal = context.frozen(np.zeros((len(position), 3)))
            context.draw(modes[rng.integers(2)], Vertices(position, color, normal, ()))
    return context, sum(HIT in path.reasons for path in paths)


@given(st.integers(0, 2**32 - 1))
def test_buffers_are_those_without_the_cache(seed):
    with use_short_cuts("always"):
        cached, _ = frame(seed)
    with use_short_cuts(False):
        expected, _ = frame(seed)
    assert same_window(cached, expected)


def test_many_draws_are_hits():
    with use_short_cuts("always"):
        assert sum(frame(seed)[1] for seed in range(8)) > 10
    with use_short_cuts(False):
        assert frame(0)[1] == 0


def draw_again_and_again(monkeypatch, cached_from: int) -> int:
    monkeypatch.setattr(geometry_cache, "CACHED_FROM", cached_from)
    rng, context = np.random.default_rng(3), gl.create_context(40, 32)
    mesh = context.frozen(small_triangles(rng, 12).position * np.float32([0.4, 0.4, 0.4, 1]))
    with use_short_cuts("always"), explain_paths() as paths:
        for _ in range(6):
            color = context.frozen(rng.random((len(mesh), 4)))
            context.draw(gl.GL_TRIANGLES, Vertices(mesh, color, context.frozen(np.zeros((len(mesh), 3))), ()))
    return sum(HIT in path.reasons for path in paths)


@pytest.mark.parametrize("cached_from", [1, 2, 3])
def test_a_draw_is_cached_when_it_was_seen_often_enough(monkeypatch, cached_from):
    assert draw_again_and_again(monkeypatch, cached_from) == 6 - cached_from


def test_the_cache_stays_within_its_bytes(monkeypatch):
    monkeypatch.setattr(geometry_cache, "CACHE_BYTES", 4000)
    with use_short_cuts("always"):
        for seed in range(4):
            context, _ = frame(seed)
            cache = context.storage.geometry_cache
            assert cache.bytes == sum(entry.bytes for entry in cache.entries.values()) <= 4000
