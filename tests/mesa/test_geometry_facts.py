"""Facts about coverage, clipping, offset and textures from conformance tests hold here and on Mesa."""

from typing import Any

import numpy as np
import pytest

from mesa.conformance import FULL, FUNCTIONS, SIZE, holds, passes, quad, red
from softshadow.testing import compare

pytestmark = pytest.mark.mesa


def added(gl: Any) -> None:
    """Count fragments in the stencil buffer."""
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilOp(gl.GL_INCR, gl.GL_INCR, gl.GL_INCR)


@pytest.mark.parametrize("seed", range(4))
def test_pixels_on_the_shared_edges_of_a_quad_are_filled_once(seed: int) -> None:
    """dEQP-GLES3.functional.rasterization.fill_rules.basic_quad, basic_quad_reverse, projected, clipped_full."""
    rng = np.random.default_rng(seed)
    corners = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * (1 if seed < 2 else 1.5)
    middle = rng.integers(-8, 8, 2) / 8  # on the corner of a pixel: edges run through samples
    w = rng.choice([1.0, 1.0, 0.5, 2.0], 5)

    def program(gl: Any) -> None:
        added(gl)
        gl.glBegin(gl.GL_TRIANGLES)
        for side in range(4):
            for index in [(4, side, (side + 1) % 4), (4, (side + 1) % 4, side)][seed % 2]:
                x, y = middle if index == 4 else corners[index]
                gl.glVertex4f(x * w[index], y * w[index], 0, w[index])
        gl.glEnd()

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.stencil, 1)


@pytest.mark.parametrize("offset", [0.0, 0.25, 0.5, 0.75])
def test_rectangle_covers_the_centres_inside_it_and_one_of_two_opposite_edges(offset: float) -> None:
    """dEQP-GLES3.functional.rasterization.primitives.triangles, piglit fragment-center, quad-invariance."""
    side = 4
    low, high = ((a + offset) / 8 - 1 for a in (4, 4 + side))

    def program(gl: Any) -> None:
        added(gl)
        quad(gl, 0, (low, low, high, high))

    compared = compare(program, SIZE)
    assert compared, str(compared)
    assert np.count_nonzero(compared.ours.stencil) == side * side


@pytest.mark.parametrize("mode", ["GL_FRONT", "GL_BACK", "GL_FRONT_AND_BACK"])
def test_culled_facing_leaves_nothing(mode: str) -> None:
    """dEQP-GLES3.functional.rasterization.culling.*: front, back and both, under both windings."""

    def program(gl: Any) -> None:
        added(gl)
        gl.glEnable(gl.GL_CULL_FACE)
        gl.glCullFace(getattr(gl, mode))
        quad(gl, 0, (-1, -1, 0, 1))
        quad(gl, 0, (0, -1, 1, 1), clockwise=True)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.stencil[:, :8], int(mode == "GL_BACK"))
    holds(compared.ours.stencil[:, 8:], int(mode == "GL_FRONT"))


def test_triangle_reaching_far_outside_covers_the_window_once() -> None:
    """dEQP-GLES3.functional.clipping.polygon.large_poly_clip_viewport_center, *_corner."""

    def program(gl: Any) -> None:
        added(gl)
        gl.glBegin(gl.GL_TRIANGLES)
        for x, y in ((-1e6, -1e6), (1e6, -1e6), (0, 1e6)):
            gl.glVertex3f(x, y, 0)
        gl.glEnd()

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.stencil, 1)


def test_triangle_outside_near_and_far_is_cut_there() -> None:
    """dEQP-GLES3.functional.clipping.polygon.poly_z_clip: of a ramp from z = -2 to 2 only the middle half stays."""

    def program(gl: Any) -> None:
        added(gl)
        gl.glBegin(gl.GL_QUADS)
        for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
            gl.glVertex3f(x, y, 2 * x)
        gl.glEnd()

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.stencil[:, 4:12], 1)
    holds(compared.ours.stencil[:, [0, 1, 2, 3, 12, 13, 14, 15]], 0)


# near, far, eye-space side of the frustum, and the depth that a quad beyond it is clamped to
CLAMPED = [(0.25, 1.0, -2, 0.25), (0.0, 0.75, 2, 0.75), (0.75, 0.0, -2, 0.75), (1.0, 0.25, 2, 0.25), (0.5, 0.5, 2, 0.5)]


@pytest.mark.parametrize(("near", "far", "z", "depth"), CLAMPED)
def test_depth_clamp_keeps_what_is_cut_otherwise_at_the_end_of_the_depth_range(
    near: float, far: float, z: float, depth: float
) -> None:
    """piglit depth_clamp, depth-clamp-range: near before and behind far."""

    def program(gl: Any) -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_ALWAYS)
        gl.glDepthRange(near, far)
        quad(gl, z, (-1, -1, 0, 1))
        gl.glEnable(gl.GL_DEPTH_CLAMP)
        quad(gl, z, (0, -1, 1, 1))

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.depth[:, :8], FULL)
    assert np.abs(compared.ours.depth[:, 8:].astype(int) - round(depth * FULL)).max() <= 1


@pytest.mark.parametrize(("units", "wins"), [(-1, True), (0, False), (1, False)])
def test_polygon_offset_of_one_unit_separates_equal_planes(units: int, wins: bool) -> None:
    """piglit polygon-offset, dEQP-GLES3.functional.polygon_offset.*_render_with_units: a unit is at least a step."""

    def program(gl: Any) -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_LESS)
        quad(gl, 0.3)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(0, units)
        gl.glColor4f(1, 0, 0, 1)
        quad(gl, 0.3)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(red(compared.ours), wins)


def test_offset_depth_is_clamped_to_the_range_of_the_buffer() -> None:
    """dEQP-GLES3.functional.polygon_offset.*_result_depth_clamp."""

    def program(gl: Any) -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_ALWAYS)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        for box, units in (((-1, -1, 0, 1), -1e8), ((0, -1, 1, 1), 1e8)):
            gl.glPolygonOffset(0, units)
            quad(gl, 0, box)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(compared.ours.depth[:, :8], 0)
    holds(compared.ours.depth[:, 8:], FULL)


@pytest.mark.parametrize(("slope", "wins"), [(0.0, False), (0.5, True)])
def test_offset_factor_counts_on_slopes_only(slope: float, wins: bool) -> None:
    """dEQP-GLES3.functional.polygon_offset.*_factor_0_slope, *_factor_1_slope."""

    def program(gl: Any) -> None:
        gl.glEnable(gl.GL_DEPTH_TEST)
        for factor, green in ((0, 1), (-1, 0)):
            gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
            gl.glPolygonOffset(factor, 0)
            gl.glColor4f(1, green, 0, 1)
            gl.glBegin(gl.GL_QUADS)
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                gl.glVertex3f(x, y, slope * x)
            gl.glEnd()

    compared = compare(program, SIZE)
    assert compared, str(compared)
    holds(red(compared.ours), wins)


# -- textures ----------------------------------------------------------------------------------------------------------
def depth_texture(gl: Any, depths: np.ndarray) -> None:
    gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
    height, width = depths.shape
    image = gl.GL_DEPTH_COMPONENT24, width, height, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, depths
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, *image)
    for name in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, gl.GL_NEAREST)
    for name in (gl.GL_TEXTURE_WRAP_S, gl.GL_TEXTURE_WRAP_T):
        gl.glTexParameteri(gl.GL_TEXTURE_2D, name, gl.GL_CLAMP_TO_EDGE)
    gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
    gl.glEnable(gl.GL_TEXTURE_2D)


def textured_quad(gl: Any, r: float) -> None:
    gl.glBegin(gl.GL_QUADS)
    for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)):
        gl.glTexCoord3f(x, y, r)
        gl.glVertex2f(2 * x - 1, 2 * y - 1)
    gl.glEnd()


@pytest.mark.parametrize("function", FUNCTIONS)
def test_shadow_lookup_compares_the_clamped_coordinate_with_the_texel(function: str) -> None:
    """dEQP-GLES3.functional.texture.shadow.2d.nearest.*, r below 0 and above 1 too."""
    texels = np.array([[0.0, 0.25, 0.5, 1.0]], np.float32)
    coordinates = (-0.5, 0.1, 0.4, 0.9, 1.5)

    def program(gl: Any) -> list[np.ndarray]:
        depth_texture(gl, texels)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_COMPARE_MODE, gl.GL_COMPARE_R_TO_TEXTURE)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_COMPARE_FUNC, getattr(gl, function))
        rows = []
        for r in coordinates:
            textured_quad(gl, r)
            rows.append(gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE))
        return rows

    compared = compare(program, SIZE)
    assert compared, str(compared)
    for r, image in zip(coordinates, compared.ours.returned, strict=True):
        lit = [passes(function, np.clip(r, 0, 1), float(texel)) for texel in texels[0]]
        assert (image[8, 2::4, 0] == np.where(lit, 255, 0)).all(), (r, lit)


def test_linear_filter_averages_the_results_of_the_comparison() -> None:
    """dEQP-GLES3.functional.texture.shadow.2d.linear.*: between a lit and a dark texel lies a ramp, not an edge."""

    def program(gl: Any) -> None:
        depth_texture(gl, np.array([[0.0, 1.0]], np.float32))
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_COMPARE_MODE, gl.GL_COMPARE_R_TO_TEXTURE)
        for name in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, name, gl.GL_LINEAR)
        textured_quad(gl, 0.5)

    compared = compare(program, SIZE)
    assert compared, str(compared)
    ramp = compared.ours.color[0, :, 0].astype(int)
    assert (ramp[:4] == 0).all()
    assert (ramp[12:] == 255).all()
    assert (np.diff(ramp[3:13]) > 0).all()


def test_copied_image_holds_the_pixels_of_the_window() -> None:
    """piglit copyteximage, dEQP-GLES3.functional.texture.specification.basic_copy(sub)teximage2d."""

    def program(gl: Any) -> list[np.ndarray]:
        for column in range(4):
            gl.glColor4f(column / 3, 1 - column / 3, 0.2, 1)
            quad(gl, 0, (column / 2 - 1, -1, column / 2 - 0.5, 1))
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 0, 0, *SIZE, 0)
        first = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)
        gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 2, 3, 8, 0, 4, 5)
        return [first, gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)]

    compared = compare(program, SIZE)
    assert compared, str(compared)
    first, second = compared.ours.returned
    window = compared.ours.color
    assert (first == window).all()
    assert (second[3:8, 2:6] == window[:5, 8:12]).all()
    second[3:8, 2:6] = window[3:8, 2:6]
    assert (second == window).all()
