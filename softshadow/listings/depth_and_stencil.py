"""The tools that decide which surface is seen: stencil buffer, polygon offset, depth range.

Slides CA:104-145, CA:214-288 and CA:648-703.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from softshadow.listings.listing import Listing, Steps
from softshadow.listings.stage import LOWER, STAGE, Stage, Thing, begin_frame, draw, moved
from softshadow.scene.shapes import box

RED, GREEN = (0.8, 0.2, 0.2), (0.2, 0.8, 0.2)
SMALLEST_STEP = 1 / (2**24 - 1)  # of the depth buffer
SLOPES = (
    (0.6, 0.2),
    (-0.6, -0.2),
)  # change of window z across the window: one quad goes back towards the right, the other comes nearer
SKELETON = Thing(moved(box(0.7, 0.5, 0.7, name="skeleton"), 0.0, 0.5, 0.0), (0.9, 0.9, 0.9))


# -- stencil -----------------------------------------------------------------------------------------------------------
def stencil_setup(gl: Any, corrected: frozenset[str]) -> Steps:
    """CA:214-226: query the bits, then clear: glStencilMask affects the clear, glStencilFunc does not, as printed.

    Asking for a window with a stencil buffer is left to the context (E57: the class is QSurfaceFormat).
    """
    bits = np.array([gl.glGetIntegerv(gl.GL_STENCIL_BITS)])
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_NEVER, 0, 0)
    gl.glClearStencil(0xFF)
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)  # all bits, whatever glStencilFunc says
    yield "a clear under glStencilFunc"

    gl.glStencilMask(0x0F)
    gl.glClearStencil(0)
    gl.glClear(gl.GL_STENCIL_BUFFER_BIT)  # the lower four bits
    yield "a clear under glStencilMask"
    return [bits]


def two_quads(gl: Any, corrected: frozenset[str]) -> Steps:
    """CA:262-286: mark a quad with 1, then draw a second one where there is no mark."""
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 1, 255)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_REPLACE)
    draw_quad(gl, RED, -0.7, -0.7, 0.3, 0.3)
    yield "the first quad marks its pixels"

    gl.glStencilFunc(gl.GL_EQUAL, 0, 255)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_KEEP, gl.GL_KEEP)
    draw_quad(gl, GREEN, -0.3, -0.3, 0.7, 0.7)
    yield "the second quad where there is no mark"


def draw_quad(
    gl: Any, color: tuple[float, float, float], left: float, bottom: float, right: float, top: float,
    slope: tuple[float, float] = (0.0, 0.0),
) -> None:  # fmt: skip
    """Draw a rectangle in normalized device coordinates; `slope` is dz/dx and dz/dy around its middle."""
    gl.glColor3f(*color)
    gl.glBegin(gl.GL_QUADS)
    for x, y in ((left, bottom), (right, bottom), (right, top), (left, top)):
        gl.glVertex3f(x, y, slope[0] * (x - (left + right) / 2) + slope[1] * (y - (bottom + top) / 2))
    gl.glEnd()


# -- polygon offset ----------------------------------------------------------------------------------------------------
def offset_formula(gl: Any, corrected: frozenset[str]) -> Steps:
    """CA:104-145, Evitar problemes de z-fighting: the formula of glPolygonOffset(1, 1), applied by moving quads.

    A is drawn as it is, B (larger) is moved: z' = z + dz·factor + r·units should put B behind A. E32: r is what a
    driver can resolve, two steps on Mesa; here it is one step, as on the slide.
    """
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    _, _, width, height = gl.glGetIntegerv(gl.GL_VIEWPORT)
    factor, units = 1.0, 1.0
    for middle, (dz_dx, dz_dy), name in zip((-0.5, 0.5), SLOPES, ("falling", "rising"), strict=True):
        draw_quad(gl, RED, middle - 0.3, -0.6, middle + 0.3, 0.6, (dz_dx, dz_dy))
        per_pixel = (dz_dx / width, dz_dy / height)  # z and x both run from -1 to 1, so the halves cancel
        if "E31" in corrected:
            slope = max(
                abs(per_pixel[0]), abs(per_pixel[1])
            )  # E31: without abs, a surface that comes nearer is pulled nearer
        else:
            slope = max(per_pixel)  # ∂z = max(∂z/∂x, ∂z/∂y)
        if "E30" in corrected:
            constant = SMALLEST_STEP * units  # E30: r times units, as on the second slide (CA:124)
        else:
            constant = 1 / SMALLEST_STEP * units  # z' = z + 1/r · units (CA:110): larger than every depth
        offset = slope * factor + constant
        gl.glPushMatrix()
        gl.glTranslatef(0.0, 0.0, 2 * offset)
        draw_quad(gl, GREEN, middle - 0.4, -0.8, middle + 0.4, 0.8, (dz_dx, dz_dy))
        gl.glPopMatrix()
        yield f"A, and B moved back: a {name} slope"


def offset_quiz(gl: Any, corrected: frozenset[str]) -> Steps:
    """CA:648-665: A without, B with an offset of (1, 1): where they coincide A wins. The quads of `offset_formula`."""
    gl.glClear(gl.GL_COLOR_BUFFER_BIT | gl.GL_DEPTH_BUFFER_BIT)
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glDepthFunc(gl.GL_LEQUAL)  # without the offset B would win, because it is drawn later
    for middle, slope, name in zip((-0.5, 0.5), SLOPES, ("falling", "rising"), strict=True):
        draw_quad(gl, RED, middle - 0.3, -0.6, middle + 0.3, 0.6, slope)  # drawObject(A)
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(1, 1)
        draw_quad(gl, GREEN, middle - 0.4, -0.8, middle + 0.4, 0.8, slope)  # drawObject(B)
        gl.glDisable(gl.GL_POLYGON_OFFSET_FILL)
        yield f"A, and B with an offset: a {name} slope"


# -- visibility quiz ---------------------------------------------------------------------------------------------------
def depth_range(gl: Any, corrected: frozenset[str], stage: Stage = STAGE) -> Steps:
    """CA:690-703: the skeleton in the nearer half of the depth range, the skin around it in the farther half."""
    begin_frame(gl, stage)
    gl.glDepthRange(0.0, 0.5)
    draw(gl, [SKELETON])
    yield "the skeleton"

    gl.glDepthRange(0.5, 1.0)
    draw(gl, [LOWER])
    gl.glDepthRange(0, 1)
    yield "the skin"


def option(
    gl: Any,
    corrected: frozenset[str],
    stage: Stage = STAGE,
    *,
    before: Callable[[Any], None],
    after: Callable[[Any], None],
) -> Steps:
    """CA:694-697: a call before the skeleton is drawn, then the skin; as the slide says, none of the four helps.

    E45: switching the depth test off helps if the skeleton is drawn last (but it does not sort its own faces).
    """
    begin_frame(gl, stage)
    if "E45" in corrected:
        draw(gl, [LOWER])
        yield "the skin"
    before(gl)
    draw(gl, [SKELETON])
    after(gl)
    yield "the skeleton"
    if "E45" not in corrected:
        draw(gl, [LOWER])
        yield "the skin"


def depth_test_off(gl: Any, corrected: frozenset[str]) -> Steps:
    """CA:694, option a."""
    yield from option(
        gl, corrected,
        before=lambda gl: gl.glDisable(gl.GL_DEPTH_TEST), after=lambda gl: gl.glEnable(gl.GL_DEPTH_TEST),
    )  # fmt: skip


def offset_skeleton(gl: Any, corrected: frozenset[str]) -> Steps:
    """CA:695, option b; also enables the offset, which the slide does not print."""

    def before(gl: Any) -> None:
        gl.glEnable(gl.GL_POLYGON_OFFSET_FILL)
        gl.glPolygonOffset(1, 1)

    yield from option(gl, corrected, before=before, after=lambda gl: gl.glDisable(gl.GL_POLYGON_OFFSET_FILL))


def whole_depth_range(gl: Any, corrected: frozenset[str]) -> Steps:
    """CA:696, option c: the default depth range."""
    yield from option(gl, corrected, before=lambda gl: gl.glDepthRange(0, 1), after=lambda gl: None)


def depth_mask_off(gl: Any, corrected: frozenset[str]) -> Steps:
    """CA:697, option d."""
    yield from option(
        gl, corrected,
        before=lambda gl: gl.glDepthMask(gl.GL_FALSE), after=lambda gl: gl.glDepthMask(gl.GL_TRUE),
    )  # fmt: skip


LISTINGS = (
    Listing("stencil-setup", "Bits of the stencil buffer, and its clear", "tools", "CA:214-226", stencil_setup),
    Listing("stencil-quads", "A second quad where the first is not", "tools", "CA:262-286", two_quads),
    Listing(
        "offset-formula", "Polygon offset by its formula", "tools", "CA:104-145", offset_formula,
        {"E30": "r times units, not divided by r", "E31": "the slope is an absolute value"},
    ),
    Listing("offset-quiz", "Quiz: which of A and B wins", "tools", "CA:648-665", offset_quiz),
    Listing("skeleton", "Quiz: a skeleton seen through its skin", "tools", "CA:690-703", depth_range),
    Listing(
        "skeleton-depth-test", "Quiz, option a: depth test off", "tools", "CA:694", depth_test_off,
        {"E45": "the skeleton is drawn last"},
    ),
    Listing("skeleton-offset", "Quiz, option b: polygon offset", "tools", "CA:695", offset_skeleton),
    Listing("skeleton-depth-range", "Quiz, option c: glDepthRange(0, 1)", "tools", "CA:696", whole_depth_range),
    Listing("skeleton-depth-mask", "Quiz, option d: no depth written", "tools", "CA:697", depth_mask_off),
)  # fmt: skip
