"""Raster positions and bitmaps give the buffers and answers of Mesa."""

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

PATTERN = bytes([0b01111110, 0b01000010, 0b01011010, 0b11111111, 0, 0b10101010, 0b11001100, 0x81])


def raster_state(gl):
    """All that can be asked about the raster position."""
    names = ("POSITION", "COLOR", "TEXTURE_COORDS")
    values = [np.array(gl.glGetFloatv(getattr(gl, f"GL_CURRENT_RASTER_{name}"))) for name in names]
    valid = bool(gl.glGetBooleanv(gl.GL_CURRENT_RASTER_POSITION_VALID))
    return [*values, valid, float(gl.glGetFloatv(gl.GL_CURRENT_RASTER_DISTANCE))]


def letter(gl):
    gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
    gl.glBitmap(8, 8, 1, 2, 9.3, 0.4, PATTERN)


def check(program, size=(64, 48)):
    comparison = compare(program, size)
    assert comparison, str(comparison)


def perspective(gl):
    gl.glMatrixMode(gl.GL_PROJECTION)
    gl.gluPerspective(60, 1.3, 0.5, 10)
    gl.glMatrixMode(gl.GL_MODELVIEW)
    gl.glTranslatef(0, 0, -3)


@pytest.mark.parametrize("seed", range(4))
def test_letters_at_raster_positions(seed):
    def program(gl):
        rng = np.random.default_rng(seed)
        perspective(gl)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glRectf(-1, -0.4, 1, 0.2)
        if seed == 1:
            gl.glEnable(gl.GL_DEPTH_CLAMP)
        if seed == 2:
            gl.glEnable(gl.GL_CLIP_PLANE1)
            gl.glClipPlane(gl.GL_CLIP_PLANE1, [1.0, 0.2, 0.1, 0.1])
            gl.glDepthRange(0.9, 0.2)
            gl.glViewport(5, 3, 40, 41)
        if seed == 3:
            gl.glEnable(gl.GL_BLEND)
            gl.glBlendFunc(gl.GL_SRC_ALPHA, gl.GL_ONE)
            gl.glEnable(gl.GL_FOG)
            gl.glEnable(gl.GL_CULL_FACE)
            gl.glCullFace(gl.GL_FRONT)
            gl.glPolygonMode(gl.GL_FRONT_AND_BACK, gl.GL_LINE)
        answers = []
        for k in range(12):
            gl.glColor4f(*rng.random(4))
            gl.glTexCoord2f(*rng.random(2))
            if k % 3:
                gl.glRasterPos3f(*rng.uniform(-1.4, 1.4, 3))
            else:
                gl.glWindowPos3f(*rng.uniform(0, 50, 2), rng.uniform(-0.2, 1.2))
            answers += raster_state(gl)
            letter(gl)
            letter(gl)
            answers += raster_state(gl)
        return answers

    check(program)


@pytest.mark.parametrize("seed", range(6))
def test_lit_raster_positions(seed):
    def program(gl):
        rng, colors = np.random.default_rng(seed), []
        for capability in (gl.GL_LIGHTING, gl.GL_LIGHT0, gl.GL_LIGHT1):
            gl.glEnable(capability)
        for k in range(12):
            gl.glLoadIdentity()
            gl.glRotatef(20 * k, 1, 0.3, 0.2)
            if k % 4 == 3:
                gl.glScalef(0.5, 0.6, 0.7)
            gl.glLightfv(gl.GL_LIGHT0, gl.GL_POSITION, [*rng.uniform(-1, 1, 3), seed % 2])
            gl.glLightfv(gl.GL_LIGHT0, gl.GL_AMBIENT, rng.random(4))
            gl.glLightfv(gl.GL_LIGHT0, gl.GL_SPOT_DIRECTION, rng.uniform(-1, 1, 3))
            gl.glLightf(gl.GL_LIGHT0, gl.GL_SPOT_CUTOFF, [180, 60, 90][k % 3])
            gl.glLightf(gl.GL_LIGHT0, gl.GL_SPOT_EXPONENT, k % 5)
            gl.glLightf(gl.GL_LIGHT0, gl.GL_LINEAR_ATTENUATION, k % 3 * 0.3)
            gl.glLightfv(gl.GL_LIGHT1, gl.GL_DIFFUSE, rng.random(4))
            gl.glLightfv(gl.GL_LIGHT1, gl.GL_SPECULAR, rng.random(4))
            gl.glMaterialfv(gl.GL_FRONT, gl.GL_DIFFUSE, rng.random(4))
            gl.glMaterialfv(gl.GL_FRONT, gl.GL_SPECULAR, rng.random(4))
            gl.glMaterialfv(gl.GL_FRONT, gl.GL_EMISSION, rng.random(4) * 0.2)
            gl.glMaterialf(gl.GL_FRONT, gl.GL_SHININESS, k % 7 * 3)
            gl.glLightModeli(gl.GL_LIGHT_MODEL_LOCAL_VIEWER, k % 5 == 4)
            gl.glNormal3f(*rng.uniform(-1, 1, 3))
            gl.glRasterPos3f(*rng.uniform(-0.5, 0.5, 3))
            colors.append(np.array(gl.glGetFloatv(gl.GL_CURRENT_RASTER_COLOR)))
            letter(gl)
        return colors

    check(program)


def test_bitmaps_in_lists_and_without_bits():
    def program(gl):
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glNewList(1, gl.GL_COMPILE)
        gl.glBitmap(8, 8, 0, 0, 10, 0, PATTERN)
        gl.glEndList()
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 4)
        gl.glWindowPos2i(3, 3)
        gl.glCallLists([1, 1, 1])
        gl.glBitmap(0, 0, 0, 0, -31, 20, None)
        gl.glEnable(gl.GL_COLOR_LOGIC_OP)
        gl.glLogicOp(gl.GL_XOR)
        gl.glCallList(1)
        return raster_state(gl)

    check(program)


@pytest.mark.parametrize(("alignment", "row_length", "skip"), [(1, 0, 0), (4, 0, 0), (2, 30, 3), (8, 21, 9)])
def test_rows_of_bits_in_client_memory(alignment, row_length, skip):
    bits = np.random.default_rng(2).integers(0, 256, 400, dtype=np.uint8)

    def program(gl):
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, alignment)
        gl.glPixelStorei(gl.GL_UNPACK_ROW_LENGTH, row_length)
        gl.glPixelStorei(gl.GL_UNPACK_SKIP_PIXELS, skip)
        gl.glPixelStorei(gl.GL_UNPACK_SKIP_ROWS, skip)
        gl.glWindowPos2f(2.9999, 3.5)
        gl.glBitmap(13, 7, 0.25, 0.5, 0, 0, bits)
        gl.glBitmap(13, 7, -20, -0.5, 0, 0, bits.tobytes())

    check(program)


def test_the_attribute_stack_keeps_the_raster_position_with_the_current_values():
    def program(gl):
        answers = []
        for mask in (gl.GL_CURRENT_BIT, gl.GL_ALL_ATTRIB_BITS, gl.GL_ENABLE_BIT):
            for change in ("raster", "window", "color"):
                gl.glWindowPos2f(1, 2)
                gl.glColor3f(1, 0, 0)
                gl.glPushAttrib(mask)
                if change == "window":
                    gl.glWindowPos2f(7, 8)
                else:
                    gl.glRasterPos2f(0.1, 0.2)
                if change == "color":
                    gl.glColor3f(0, 1, 0)
                gl.glPopAttrib()
                answers += raster_state(gl)
        return answers

    check(program)
