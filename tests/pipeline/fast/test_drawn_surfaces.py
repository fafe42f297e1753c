"""Light added to surfaces that were drawn before has the bits of draws that test every fragment."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from draws import ADDING, draw, random_state, random_triangles, same_window, small_triangles, vertices
from softshadow import gl as on
from softshadow import tokens as gl
from softshadow.context import Context
from softshadow.gl import create_context
from softshadow.pipeline import choose, explain_paths, plan, set_threads, threads, use_short_cuts
from softshadow.pipeline.commands import Clear, Vertices
from softshadow.pipeline.fast import drawn_surfaces
from softshadow.pipeline.memory import threads as pool
from softshadow.state import Blend, State

HIT = "earlier draws left these surfaces in the depth buffer: only their fragments are tested"
CACHED = "an equal draw over the same depths was filled before: only shaded"
SQUARE = [[-1, -1, 0, 1], [1, -1, 0, 1], [1, 1, 0, 1], [-1, -1, 0, 1], [1, 1, 0, 1], [-1, 1, 0, 1]]
BOX = ("x", "y", "width", "height")
seeds = st.integers(0, 2**32 - 1)


class Frame:
    """Random passes over two meshes: surfaces, light added to them, counts in the stencil buffer, other draws."""

    def __init__(self, seed: int, depth_format: str) -> None:
        self.rng = np.random.default_rng(seed)
        self.context = Context(48, 40, depth_format, precision="exact" if seed % 7 == 0 else "mesa")
        self.meshes = [self.mesh() for _ in range(2)]
        plain = self.context.state
        state = random_state(self.rng, plain)
        if self.rng.random() < 0.7:
            state = replace(state, polygon=plain.polygon, depth=plain.depth)
        self.state = replace(state, stencil=plain.stencil, alpha=plain.alpha, cull=plain.cull, color=plain.color)
        self.hits = 0

    def mesh(self) -> Vertices:
        triangles = random_triangles(self.rng, 6) if self.rng.random() < 0.3 else small_triangles(self.rng, 20)
        if self.rng.random() < 0.8:  # nothing at the far plane, where the cleared buffer has the same depth
            triangles.position[:, 2] *= np.float32(0.5)
            triangles.position[:, 3] = 1
        if self.rng.random() < 0.2:  # equal depths where they overlap
            triangles.position[:, 2] = np.float32(0.25)
        return triangles

    def pass_of(self, kind: int) -> State:
        rng, state = self.rng, self.state
        depth = replace(state.depth, enabled=True)
        counted = random_state(rng, state)
        if kind == 0:
            return replace(state, depth=replace(depth, func=int(rng.choice([gl.GL_LESS, gl.GL_LEQUAL])), write=True))
        if kind == 1:
            faces = replace(counted.stencil.front, sfail=gl.GL_KEEP, zfail=gl.GL_KEEP, zpass=gl.GL_KEEP)
            stencil = replace(counted.stencil, front=faces, back=faces)
            func = int(rng.choice([gl.GL_EQUAL, gl.GL_LEQUAL]))
            depth = replace(depth, func=func, write=bool(func == gl.GL_EQUAL and rng.random() < 0.5))
            if rng.random() < 0.4:
                x, y, width, height = rng.integers(0, [40, 30, 48, 40]).tolist()
                scissor = replace(state.scissor, enabled=True, x=x, y=y, width=width, height=height)
                state = replace(state, scissor=scissor)
            return replace(state, depth=depth, stencil=stencil, blend=ADDING)
        if kind == 2:
            depth, color = replace(depth, write=False), replace(state.color, mask=(False,) * 4)
            return replace(state, depth=depth, stencil=replace(counted.stencil, enabled=True), color=color)
        if kind == 3:
            color = replace(state.color, mask=(False,) * 4)
            return replace(state, depth=replace(depth, func=gl.GL_LESS, write=True), color=color)
        return replace(counted, blend=ADDING if rng.random() < 0.3 else Blend())  # any state, which may enlarge depths

    def clear_depth(self) -> None:
        state = self.state
        depth = replace(state.depth, write=True, clear=1.0)
        self.context.execute(Clear(replace(state, depth=depth), gl.GL_DEPTH_BUFFER_BIT))

    def drawn(self, passes: int = 14) -> Context:
        self.clear_depth()
        with explain_paths() as paths:
            draw(self.context, self.pass_of(0), self.meshes[0])
            for _ in range(passes):
                kind = int(self.rng.choice(5, p=[0.3, 0.4, 0.15, 0.1, 0.05]))
                draw(self.context, self.pass_of(kind), self.meshes[int(self.rng.random() < 0.3)])
                if self.rng.random() < 0.05:
                    self.clear_depth()
        self.hits = sum(HIT in path.reasons for path in paths)
        return self.context


def textbook(seed: int, depth_format: str) -> Context:
    with use_short_cuts(False):
        return Frame(seed, depth_format).drawn()


@given(seeds, st.sampled_from(["d24", "d32f"]))
def test_passes_over_known_surfaces_leave_the_bits_of_the_textbook(seed, depth_format):
    with use_short_cuts("always"):
        assert same_window(Frame(seed, depth_format).drawn(), textbook(seed, depth_format))


@given(seeds)
def test_parts_of_several_threads_leave_the_same_bits(seed):
    before = threads()
    with pytest.MonkeyPatch.context() as patch, use_short_cuts("always"):
        patch.setattr(pool, "PART_SIZE", 5)
        set_threads(3)
        try:
            assert same_window(Frame(seed, "d24").drawn(), textbook(seed, "d24"))
        finally:
            set_threads(before)


def test_many_passes_find_a_known_surface():
    with use_short_cuts("always"):
        frames = [Frame(seed, "d24") for seed in range(12)]
        for frame in frames:
            frame.drawn()
    assert sum(frame.hits for frame in frames) > 12


def lit_after(*between: Vertices, func: int = gl.GL_LESS, surface: Vertices | None = None) -> bool:
    """Return whether the surface is known that is lit after draws under `func`, and compare it with the textbook."""
    surface, contexts, hits = surface or vertices(SQUARE), [], 0
    for policy in ("always", False):
        context = Context(40, 32, "d24")
        depth = replace(context.state.depth, enabled=True)
        opaque = replace(context.state, depth=depth)
        light = replace(context.state, depth=replace(depth, func=gl.GL_LEQUAL, write=False), blend=ADDING)
        with use_short_cuts(policy), explain_paths() as paths:
            draw(context, opaque, surface)
            for triangles in between:
                draw(context, replace(opaque, depth=replace(depth, func=func)), triangles)
            draw(context, light, surface)
        contexts.append(context)
        hits += HIT in paths[-1].reasons
    assert same_window(*contexts)
    return hits == 1


def lit_in_boxes(opaque_box, light_box, *, func=gl.GL_EQUAL, write=False, depth_format="d24") -> bool:
    """Return whether the surface is known that is lit, each draw in a scissor box (x, y, width, height) or None."""
    contexts, hits = [], 0
    for policy in ("always", False):
        context = Context(40, 32, depth_format)
        plain, depth = context.state, replace(context.state.depth, enabled=True)
        boxes = [
            plain.scissor if box is None else replace(plain.scissor, **dict(zip(BOX, box, strict=True)), enabled=True)
            for box in (opaque_box, light_box)
        ]
        light = replace(plain, depth=replace(depth, func=func, write=write), blend=ADDING, scissor=boxes[1])
        with use_short_cuts(policy), explain_paths() as paths:
            draw(context, replace(plain, depth=depth, scissor=boxes[0]), vertices(SQUARE))
            draw(context, light, vertices(SQUARE))
        contexts.append(context)
        hits += HIT in paths[-1].reasons
    assert same_window(*contexts)
    return hits == 1


@pytest.mark.parametrize("box", [(0, 0, 40, 32), (3, 5, 17, 9), (39, 31, 9, 9), (7, 0, 40, 32), (0, 9, 40, 1)])
def test_a_light_within_the_region_of_a_surface_finds_it(box):
    assert lit_in_boxes(None, box)
    assert lit_in_boxes(box, box)


@pytest.mark.parametrize("box", [None, (2, 5, 17, 9), (3, 4, 17, 9), (4, 5, 17, 9), (3, 6, 17, 9)])
def test_a_light_that_leaves_the_region_of_a_surface_is_tested_anew(box):
    assert not lit_in_boxes((3, 5, 17, 9), box)


def test_equal_depths_that_are_written_again_change_nothing():
    assert lit_in_boxes(None, None, write=True)
    assert not lit_in_boxes(None, None, write=True, depth_format="d32f")  # it may be 0 in place of -0
    assert not lit_in_boxes(None, None, func=gl.GL_LEQUAL, write=True)


def test_nearer_surfaces_between_keep_what_is_known():
    nearer = np.float32(SQUARE) * [0.5, 0.5, 1, 1] - [0, 0, 0.5, 0]
    assert lit_after(vertices(nearer))


def test_a_draw_that_may_enlarge_depths_ends_what_is_known():
    farther = np.add(np.float32(SQUARE), [0, 0, 0.5, 0])
    assert not lit_after(vertices(farther), func=gl.GL_GREATER)


def test_a_surface_with_two_equal_depths_is_not_remembered():
    twice = vertices([*SQUARE, *SQUARE])
    assert not lit_after(surface=twice)


def test_few_surfaces_are_remembered():
    context = Context(16, 16, "d24")
    state = replace(context.state, depth=replace(context.state.depth, enabled=True, func=gl.GL_LESS))
    rng = np.random.default_rng(0)
    with use_short_cuts("always"):
        for _ in range(3 * drawn_surfaces.MOST_SURFACES):
            draw(context, state, random_triangles(rng, 3))
    assert len(context.storage.visibility_cache.surfaces) <= drawn_surfaces.MOST_SURFACES


def test_surfaces_of_the_frames_before_are_forgotten():
    context, rng, most = Context(16, 16, "d24"), np.random.default_rng(1), 0
    state = replace(context.state, depth=replace(context.state.depth, enabled=True, func=gl.GL_LESS))
    with use_short_cuts("always"):
        for _ in range(6):
            context.execute(Clear(state, gl.GL_DEPTH_BUFFER_BIT))
            for _ in range(2):
                draw(context, state, random_triangles(rng, 3))
            most = max(most, len(context.storage.visibility_cache.surfaces))
    assert most == 2


@pytest.mark.parametrize(("twice", "is_known"), [(False, True), (True, False)])
def test_the_surface_of_a_cached_fill_is_known_again_after_it_was_forgotten(twice, is_known):
    surface, contexts = vertices(SQUARE * 2 if twice else SQUARE), []
    for policy in ("always", False):
        context, rng = Context(40, 32, "d24"), np.random.default_rng(0)
        depth = replace(context.state.depth, enabled=True)
        opaque = replace(context.state, depth=depth)
        light = replace(context.state, depth=replace(depth, func=gl.GL_LEQUAL, write=False), blend=ADDING)
        with use_short_cuts(policy), explain_paths() as paths:
            for number in range(4):
                context.execute(Clear(opaque, gl.GL_DEPTH_BUFFER_BIT | gl.GL_COLOR_BUFFER_BIT))
                draw(context, opaque, surface)
                draw(context, light, surface)
                for _ in range(drawn_surfaces.MOST_SURFACES if number == 2 else 0):
                    draw(context, opaque, random_triangles(rng, 3))
        if policy == "always":
            filled, lit = paths[-2:]
            assert CACHED in filled.reasons
            assert (HIT in lit.reasons) == is_known
        contexts.append(context)
    assert same_window(*contexts)


@pytest.mark.parametrize("surfaces", [1, 3])
def test_draws_that_are_joined_find_the_surfaces_of_each(surfaces, monkeypatch):
    """Light is added twice to each of some spheres; the draws of all lights are one run."""
    found, windows = [], []

    def noted(*arguments):
        parts = drawn_surfaces.passing_spans(*arguments)
        found.append(0 if parts is None else len(parts))
        return parts

    monkeypatch.setattr(plan, "passing_spans", noted)
    for kernels in (choose.FILL_KERNELS, choose.SPAN_KERNELS):
        monkeypatch.setattr(kernels, "pays_after", 0)
    for policy in (True, False):
        context = create_context(320, 240)
        with use_short_cuts(policy):
            light_spheres(surfaces)
            on.glFinish()
        windows.append(context)
    assert found == [2]  # of two lights, each with all spheres
    assert same_window(*windows)


def light_spheres(surfaces: int) -> None:
    """Draw spheres without light, and then once more for each of two lights."""
    on.glClear(on.GL_COLOR_BUFFER_BIT | on.GL_DEPTH_BUFFER_BIT)
    on.glEnable(on.GL_DEPTH_TEST)
    on.glEnable(on.GL_LIGHTING)
    on.glEnable(on.GL_LIGHT0)
    for color in (0, 0.3, 0.6):
        on.glLightfv(on.GL_LIGHT0, on.GL_DIFFUSE, (color, 0.4, 0.2, 1))
        if color:
            on.glEnable(on.GL_BLEND)
            on.glBlendFunc(on.GL_ONE, on.GL_ONE)
            on.glDepthFunc(on.GL_EQUAL)
            on.glDepthMask(on.GL_FALSE)
        for index in range(surfaces):
            on.glPushMatrix()
            on.glTranslatef(0.4 * index - 0.3, 0.1, 0.1 * index)
            on.glScalef(0.8, 0.8, 0.8)  # small draws, and those of large triangles, go triangle by triangle
            on.gluSphere(on.gluNewQuadric(), 1.0, 18, 14)
            on.glPopMatrix()
    for cap in (on.GL_BLEND, on.GL_LIGHTING):
        on.glDisable(cap)
    on.glDepthFunc(on.GL_LESS)
    on.glDepthMask(on.GL_TRUE)
