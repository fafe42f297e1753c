"""Lookups of histories: they are those that the picture was drawn with."""

import numpy as np
import pytest

import softshadow as ss
from softshadow.inspection import pixel_history
from softshadow.techniques.drawing import world_points
from softshadow.testing.comparison import run_recorded

SIZE = (96, 72)
STEP = 1e-5  # shares are sums of float32 weights
BY_MAP = (
    "map-distance", "map-pcf", "map-cube", "map-silhouette", "map-variance", "map-exponential", "map-pcss",
)  # fmt: skip


def decided(run, x, y):
    """The lookups of the fragment that has added the light."""
    return next(row.lookups for row in reversed(run.pixel(x, y).rows) if row.lookups)


def pixels(mask, count=25):
    y, x = np.nonzero(mask)
    chosen = np.random.default_rng(7).permutation(len(y))[:count]
    return [(int(x[n]), int(y[n])) for n in chosen]


@pytest.mark.thin(2)
@pytest.mark.parametrize("scene", ["boxes", "spotlight", "soft-slab"])
@pytest.mark.parametrize(("name", "options"), [*((n, {}) for n in BY_MAP), ("map-pcf", {"bilinear": True})])
def test_what_a_program_finds_visible_is_the_picture(name, options, scene):
    run = ss.run(name, scene, size=SIZE, **options)
    for x, y in pixels(run.valid):
        (lookup,) = decided(run, x, y)
        assert lookup.visible == pytest.approx(run.visibility[y, x], abs=STEP)
        overruled = run.maps["unknown"][y, x] if "unknown" in run.maps else False
        if scene == "boxes" and name != "map-silhouette" and not overruled and lookup.visible != 1:
            assert lookup.lit == pytest.approx(lookup.visible, abs=STEP)


@pytest.mark.parametrize("filter", ["nearest", "linear"])
def test_comparisons_of_the_texture_unit_are_the_alpha_that_is_tested(filter):
    run = ss.run("map", "boxes", size=SIZE, filter=filter)
    found = 0
    for x, y in pixels(run.valid):
        for row in run.pixel(x, y).rows:
            for lookup in row.lookups:
                assert lookup.lit == pytest.approx(row.alpha, abs=STEP)
                assert lookup.compare == "LEQUAL"
                assert lookup.bias is None  # it is part of the texture matrix
                assert len(lookup.taps) == (4 if filter == "linear" else 1)
                found += 1
    assert found > 10


def test_taps_have_the_texels_of_the_map():
    run = ss.run("map-pcf", "boxes", size=SIZE, bias=0.002)
    for x, y in pixels(run.valid):
        (lookup,) = decided(run, x, y)
        assert len(lookup.taps) == 9
        assert lookup.bias == pytest.approx(0.002)
        for tap in lookup.taps:
            if tap.inside:
                assert tap.stored == pytest.approx(run.maps["ZS"][tap.y, tap.x], abs=2e-7)  # rounded in another way
                assert tap.gl_y == 511 - tap.y
            assert tap.lit == (np.float32(tap.depth) <= np.float32(tap.stored))


@pytest.mark.parametrize(("name", "shown"), [("map-cube", "ZS {face}"), ("map-distance", "distances")])
def test_caster_of_a_lookup_is_what_the_texel_s_own_history_tells(name, shown):
    run = ss.run(name, "boxes", size=SIZE)
    for x, y in pixels(run.shadow_mask, 8):
        (lookup,) = decided(run, x, y)
        history = run.map_pixel(shown.format(face=lookup.face), lookup.x, lookup.y)
        last = [row for row in history if row.verdict == "passed"][-1]
        assert (lookup.caster, lookup.caster_triangle) == (last.object, last.triangle)
        written = last.color_after[0] if name == "map-distance" else last.depth_after
        assert written == pytest.approx(lookup.stored, abs=2e-7)  # rounded in another way when it is read


def test_lookup_words_name_the_numbers():
    run = ss.run("map-cube", "boxes", size=SIZE)
    ((x, y),) = pixels(run.visibility == 0, 1)
    (lookup,) = decided(run, x, y)
    text = str(run.pixel(x, y)).replace("\n      ", " ")
    assert f"texel ({lookup.x}, {lookup.y}) of face {lookup.face} of the map of light stores" in text
    assert "farther, so in shadow" in text


def test_lookup_of_a_distance_map_tells_both_distances():
    bias = 0.03125
    run = ss.run("map-distance", "boxes", size=SIZE, bias=bias, normal_bias=0.0)
    points = world_points(run.scene, run.depth[::-1], SIZE)[::-1]
    away = np.linalg.norm(points - run.scene.lights[0].position[:3], axis=-1) - bias
    far = run.maps["distances"].max()
    near, beyond = pixels(run.shadow_mask & (away < far), 8), pixels(run.shadow_mask & (away > 1.001 * far), 2)
    for x, y in near + beyond:
        (lookup,) = decided(run, x, y)
        assert (lookup.measure, lookup.compare, lookup.lit) == ("distance", "LEQUAL", 0)
        assert lookup.stored == run.maps["distances"][lookup.y, lookup.x] == run.maps["stored distance"][y, x]
        assert lookup.depth == run.maps["compared distance"][y, x]
        assert lookup.depth == pytest.approx(min(away[y, x], far), rel=1e-3)  # the depth buffer rounds the point
        words = " ".join(str(run.pixel(x, y)).split())
        assert f"of the map of light stores distance {lookup.stored:.5g}"[:-1] in words
        assert f"(drawn by {lookup.caster}, triangle {lookup.caster_triangle})" in words
        own = (
            f"at least {far:.5g}, where the map ends"
            if (x, y) in beyond
            else f"{lookup.depth + bias:.5g} - {bias:g} bias"
        )
        assert f"this point has {own}: farther, so in shadow" in words
    assert beyond


def own_program(gl_):
    """A student's program: a depth texture of two halves, compared with r = 0.5 everywhere."""
    gl_.glBindTexture(gl_.GL_TEXTURE_2D, gl_.glGenTextures(1))
    depths = np.array([[0.25, 0.75]], np.float32)
    gl_.glTexImage2D(
        gl_.GL_TEXTURE_2D, 0, gl_.GL_DEPTH_COMPONENT24, 2, 1, 0, gl_.GL_DEPTH_COMPONENT, gl_.GL_FLOAT, depths
    )
    for parameter, value in (
        (gl_.GL_TEXTURE_MIN_FILTER, gl_.GL_NEAREST),
        (gl_.GL_TEXTURE_MAG_FILTER, gl_.GL_NEAREST),
        (gl_.GL_TEXTURE_COMPARE_MODE, gl_.GL_COMPARE_R_TO_TEXTURE),
        (gl_.GL_TEXTURE_COMPARE_FUNC, gl_.GL_GEQUAL),
    ):
        gl_.glTexParameteri(gl_.GL_TEXTURE_2D, parameter, value)
    gl_.glEnable(gl_.GL_TEXTURE_2D)
    gl_.glBegin(gl_.GL_QUADS)
    for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
        gl_.glTexCoord3f(s, t, 0.5)
        gl_.glVertex2f(2 * s - 1, 2 * t - 1)
    gl_.glEnd()


def test_lookups_of_a_program_of_one_s_own():
    _, frame = run_recorded(own_program, (8, 4))
    for x, lit in ((1, 1.0), (6, 0.0)):
        row = pixel_history(frame, x, 2)[-1]
        (lookup,) = row.lookups
        assert (lookup.lit, lookup.compare, lookup.x, lookup.depth) == (lit, "GEQUAL", x // 4, 0.5)
        assert row.color_after == (round(255 * lit),) * 3
        assert f"GEQUAL is {'true' if lit else 'false'}" in " ".join(str(pixel_history(frame, x, 2)).split())


def test_lookups_of_the_course_s_program_have_its_bias():
    _, frame = run_recorded(shadow_map_program, (64, 64))
    history = pixel_history(frame, 32, 32)
    (lookup,) = history[-1].lookups
    assert lookup.bias == pytest.approx(0.125)
    assert lookup.depth == pytest.approx(0.5 - 0.125)
    assert (lookup.lit, lookup.stored) == (0.0, pytest.approx(0.25, abs=1e-6))


def shadow_map_program(gl_):
    """The course's program "shadow-map" over a texture of depth 0.25: the point has 0.5 less 0.125."""
    gl_.glBindTexture(gl_.GL_TEXTURE_2D, gl_.glGenTextures(1))
    gl_.glTexImage2D(
        gl_.GL_TEXTURE_2D, 0, gl_.GL_DEPTH_COMPONENT24, 1, 1, 0, gl_.GL_DEPTH_COMPONENT, gl_.GL_FLOAT,
        np.full((1, 1), 0.25, np.float32),
    )  # fmt: skip
    for parameter in (gl_.GL_TEXTURE_MIN_FILTER, gl_.GL_TEXTURE_MAG_FILTER):
        gl_.glTexParameteri(gl_.GL_TEXTURE_2D, parameter, gl_.GL_NEAREST)
    program = gl_.program("shadow-map")
    gl_.glUseProgram(program)
    matrix = np.array([[0, 0, 0, 0.5], [0, 0, 0, 0.5], [0, 0, 0, 0.5], [0, 0, 0, 1]], np.float32)
    gl_.glUniformMatrix4fv(gl_.glGetUniformLocation(program, "lightMatrix"), 1, gl_.GL_TRUE, matrix)
    gl_.glUniform1f(gl_.glGetUniformLocation(program, "bias"), 0.125)
    gl_.glRectf(-1, -1, 1, 1)
