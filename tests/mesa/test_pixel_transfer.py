"""glPixelTransfer and glPixelMap change pixels as on Mesa, on every way that pixels take."""

from typing import Any

import numpy as np
import pytest

from mesa.random_images import PACKED_KINDS, PIXEL_FORMATS, PIXEL_TYPES, client_pixels, packed_words
from mesa.random_writer import Writer
from softshadow import gl
from softshadow.testing import compare

pytestmark = pytest.mark.mesa

WIDTH, HEIGHT = 12, 7
WIDE = ("GL_UNSIGNED_INT", "GL_INT")  # whose products Mesa lets overflow at 1
SETTINGS = ["scaled", "mapped", "both"]
DEPTHS = ["GL_DEPTH_COMPONENT16", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32F", "GL_DEPTH24_STENCIL8"]


def check(program: Any, size: tuple[int, int] = (WIDTH, HEIGHT)) -> None:
    """Compare the buffers and answers of a program with Mesa's."""
    comparison = compare(program, size)
    assert comparison, str(comparison)


def setting(gl: Any, kind: str) -> None:
    """Scales and biases of colours, depths and indices, pixel maps, or both."""
    rng = np.random.default_rng(len(kind))
    if kind != "mapped":
        for channel in ("RED", "GREEN", "BLUE", "ALPHA", "DEPTH"):
            gl.glPixelTransferf(getattr(gl, f"GL_{channel}_SCALE"), rng.uniform(0.5, 1.6))
            gl.glPixelTransferf(getattr(gl, f"GL_{channel}_BIAS"), rng.uniform(-0.3, 0.3))
        gl.glPixelTransferi(gl.GL_INDEX_SHIFT, 1)
        gl.glPixelTransferi(gl.GL_INDEX_OFFSET, -3)
    if kind != "scaled":
        gl.glPixelTransferi(gl.GL_MAP_COLOR, gl.GL_TRUE)
        gl.glPixelTransferi(gl.GL_MAP_STENCIL, gl.GL_TRUE)
        maps(gl)


def maps(gl: Any) -> None:
    """Tables of several sizes."""
    rng = np.random.default_rng(3)
    for size, name in ((5, "R"), (16, "G"), (256, "B"), (2, "A")):
        values = rng.uniform(-0.2, 1.2, size).astype(np.float32)
        gl.glPixelMapfv(getattr(gl, f"GL_PIXEL_MAP_{name}_TO_{name}"), size, values)
    for size, name in ((4, "R"), (16, "G"), (256, "B"), (1, "A")):
        gl.glPixelMapfv(getattr(gl, f"GL_PIXEL_MAP_I_TO_{name}"), size, rng.uniform(0, 1, size).astype(np.float32))
    gl.glPixelMapfv(gl.GL_PIXEL_MAP_S_TO_S, 64, rng.integers(0, 256, 64).astype(np.float32))


def pixels(pixel_format: str, kind: str) -> np.ndarray:
    """Random pixels of a type, the ends of its range among them."""
    rng = np.random.default_rng(8)
    if kind in PACKED_KINDS:
        return packed_words(rng, WIDTH, HEIGHT, kind)
    made = client_pixels(Writer(rng), WIDTH, HEIGHT, PIXEL_FORMATS.get(pixel_format, 1), kind)
    made[0, 0] = 1 if kind == "GL_FLOAT" else np.iinfo(made.dtype).max
    return made


def pairs(every: bool) -> list[tuple[str, str]]:
    """Formats and types; of the wide integers only those that `every` asks for."""
    plain = [(f, t) for f in PIXEL_FORMATS for t in PIXEL_TYPES if every or t not in WIDE]
    return plain + [(formats[-1], kind) for kind, (_, formats) in PACKED_KINDS.items()]


def define(gl: Any, internal: str, pixel_format: str, kind: str, image: np.ndarray) -> None:
    """Define the bound texture."""
    names = (getattr(gl, pixel_format), getattr(gl, kind))
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal), WIDTH, HEIGHT, 0, *names, image)


def attach(gl: Any, internal: str, pixel_format: str, image: np.ndarray) -> None:
    """Bind a framebuffer object with this colour or depth buffer."""
    gl.glBindTexture(gl.GL_TEXTURE_2D, texture := gl.glGenTextures(1))
    define(gl, internal, pixel_format, "GL_FLOAT", image)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    point = gl.GL_COLOR_ATTACHMENT0
    if pixel_format != "GL_RGBA":
        point = gl.GL_DEPTH_ATTACHMENT
        gl.glDrawBuffer(gl.GL_NONE)
        gl.glReadBuffer(gl.GL_NONE)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, point, gl.GL_TEXTURE_2D, texture, 0)
    gl.glBindTexture(gl.GL_TEXTURE_2D, 0)


@pytest.mark.parametrize("kind", SETTINGS)
@pytest.mark.parametrize("internal", ["GL_RGBA8", "GL_RGB8", "GL_RGBA32F", "GL_LUMINANCE8_ALPHA8", "GL_INTENSITY8"])
def test_uploaded_colours(internal, kind):
    def program(gl):
        setting(gl, kind)
        answers = []
        for names in pairs(True):
            define(gl, internal, *names, pixels(*names))
            answers.append(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_FLOAT))
        return answers

    check(program)


@pytest.mark.parametrize("kind", SETTINGS)
@pytest.mark.parametrize("internal", ["GL_RGBA8", "GL_RGB8", "GL_R8", "GL_RGBA32F"])
def test_colours_that_are_read(internal, kind):
    def program(gl):
        attach(gl, internal, "GL_RGBA", pixels("GL_RGBA", "GL_FLOAT"))
        setting(gl, kind)
        rectangle = (0, 0, WIDTH, HEIGHT)
        answers = [gl.glReadPixels(*rectangle, getattr(gl, f), getattr(gl, t)) for f, t in pairs(False)]
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        define(gl, internal, "GL_RGBA", "GL_FLOAT", pixels("GL_RGBA", "GL_FLOAT"))
        return [*answers, gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_FLOAT)]

    check(program)


@pytest.mark.parametrize("kind", SETTINGS)
@pytest.mark.parametrize("internal", ["window", "GL_RGBA32F"])
def test_drawn_and_copied_colours(internal, kind):
    def program(gl):
        if internal != "window":
            attach(gl, internal, "GL_RGBA", pixels("GL_RGBA", "GL_FLOAT"))
        answers, rectangle = [], (0, 0, WIDTH, HEIGHT)
        setting(gl, kind)
        gl.glWindowPos2i(0, 0)
        for pixel_format, type in [
            ("GL_RGBA", "GL_UNSIGNED_BYTE"),
            ("GL_RGB", "GL_FLOAT"),
            ("GL_LUMINANCE", "GL_SHORT"),
        ]:
            gl.glDrawPixels(*rectangle[2:], getattr(gl, pixel_format), getattr(gl, type), pixels(pixel_format, type))
            answers.append(gl.glReadPixels(*rectangle, gl.GL_RGBA, gl.GL_FLOAT))
        gl.glWindowPos2i(3, 2)
        gl.glCopyPixels(0, 0, 5, 4, gl.GL_COLOR)
        gl.glPixelZoom(-1, 1.7)
        gl.glCopyPixels(2, 1, 4, 4, gl.GL_COLOR)
        return [*answers, gl.glReadPixels(*rectangle, gl.GL_RGBA, gl.GL_FLOAT)]

    check(program)


@pytest.mark.parametrize("kind", SETTINGS)
@pytest.mark.parametrize("type", sorted(PIXEL_TYPES))
def test_colour_indices_become_colours(type, kind):
    rng = np.random.default_rng(2)
    indices = rng.integers(0, 255, (HEIGHT, WIDTH)).astype(PIXEL_TYPES[type])

    def program(gl):
        setting(gl, kind)
        maps(gl)
        define(gl, "GL_RGBA8", "GL_COLOR_INDEX", type, indices)
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(WIDTH, HEIGHT, gl.GL_COLOR_INDEX, getattr(gl, type), indices)
        return [gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE)]

    check(program)


@pytest.mark.parametrize("kind", SETTINGS)
@pytest.mark.parametrize("internal", DEPTHS)
def test_depths(internal, kind):
    def program(gl):
        answers = []
        for type in PIXEL_TYPES:
            gl.glPixelTransferf(gl.GL_DEPTH_SCALE, 1)
            gl.glPixelTransferf(gl.GL_DEPTH_BIAS, 0)
            attach(gl, internal, "GL_DEPTH_COMPONENT", pixels("GL_DEPTH_COMPONENT", "GL_FLOAT"))
            setting(gl, kind)
            depth = gl.GL_DEPTH_COMPONENT, getattr(gl, type)
            answers.append(gl.glReadPixels(0, 0, WIDTH, HEIGHT, *depth))
            define(gl, internal, "GL_DEPTH_COMPONENT", type, pixels("GL_DEPTH_COMPONENT", type))
            answers.append(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *depth))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return answers

    check(program)


@pytest.mark.parametrize("kind", SETTINGS)
def test_stencil_values_and_packed_depths(kind):
    words = np.random.default_rng(6).integers(0, 2**32, (HEIGHT, WIDTH), dtype=np.uint32)

    def program(gl):
        setting(gl, kind)
        packed = gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(WIDTH, HEIGHT, *packed, words)
        rectangle = (0, 0, WIDTH, HEIGHT)
        answers = [gl.glReadPixels(*rectangle, *packed)]
        answers += [gl.glReadPixels(*rectangle, gl.GL_STENCIL_INDEX, getattr(gl, type)) for type in PIXEL_TYPES]
        define(gl, "GL_DEPTH24_STENCIL8", "GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8", words)
        for parameter, value in (("DEPTH_SCALE", 1), ("DEPTH_BIAS", 0), ("INDEX_SHIFT", 0), ("INDEX_OFFSET", 0)):
            gl.glPixelTransferi(getattr(gl, f"GL_{parameter}"), value)
        gl.glPixelTransferi(gl.GL_MAP_STENCIL, 0)
        return [*answers, gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *packed)]

    check(program)


@pytest.mark.parametrize("kind", SETTINGS)
def test_copies_of_depths_to_textures(kind):
    def program(gl):
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT)
        gl.glWindowPos2i(0, 0)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDrawPixels(WIDTH, HEIGHT, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT, pixels("GL_DEPTH_COMPONENT", "GL_FLOAT"))
        answers = []
        for internal in DEPTHS[:2]:
            setting(gl, kind)
            gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal), 0, 0, WIDTH, HEIGHT, 0)
            gl.glPixelTransferf(gl.GL_DEPTH_SCALE, 1)
            gl.glPixelTransferf(gl.GL_DEPTH_BIAS, 0)
            answers.append(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT))
        return answers

    check(program)


@pytest.mark.parametrize("kind", SETTINGS)
@pytest.mark.parametrize("internal", ["GL_RGBA8", "GL_LUMINANCE8", "GL_RGBA32F"])
def test_copies_of_colours_to_textures_are_uploads_of_the_same_colours(internal, kind):
    """Not compared: Mesa transfers the first row only, and leaves memory of other things in the others."""
    image = pixels("GL_RGBA", "GL_UNSIGNED_BYTE")
    with gl.create_context(WIDTH, HEIGHT):
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(WIDTH, HEIGHT, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)
        setting(gl, kind)
        gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal), 0, 0, WIDTH, HEIGHT, 0)
        copied = gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_FLOAT)
        define(gl, internal, "GL_RGBA", "GL_UNSIGNED_BYTE", image)
        np.testing.assert_array_equal(copied, gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_FLOAT))


def test_state_lists_and_the_attribute_stack():
    names = [f"GL_{c}_{p}" for c in ("RED", "GREEN", "BLUE", "ALPHA", "DEPTH") for p in ("SCALE", "BIAS")]
    names += ["GL_MAP_COLOR", "GL_MAP_STENCIL", "GL_INDEX_SHIFT", "GL_INDEX_OFFSET", "GL_MAX_PIXEL_MAP_TABLE"]
    tables = [f"GL_PIXEL_MAP_{a}_TO_{b}" for a, b in ("II", "SS", "IR", "IG", "IB", "IA", "RR", "GG", "BB", "AA")]

    def program(gl):
        def state():
            return [float(gl.glGetFloatv(getattr(gl, name))) for name in names] + [
                int(gl.glGetIntegerv(getattr(gl, f"{name}_SIZE"))) for name in tables
            ]

        before = state()
        gl.glNewList(1, gl.GL_COMPILE)
        setting(gl, "both")
        gl.glEndList()
        unchanged = state()
        gl.glPushAttrib(gl.GL_PIXEL_MODE_BIT)
        gl.glCallList(1)
        changed = state()
        gl.glPopAttrib()
        codes = []
        for call in (
            lambda: gl.glPixelMapfv(gl.GL_PIXEL_MAP_I_TO_R, 3, np.zeros(3, np.float32)),
            lambda: gl.glPixelMapfv(gl.GL_PIXEL_MAP_R_TO_R, 300, np.zeros(300, np.float32)),
            lambda: gl.glPixelMapfv(gl.GL_RED_BIAS, 4, np.zeros(4, np.float32)),
            lambda: gl.glPixelTransferf(gl.GL_PIXEL_MAP_R_TO_R, 1.0),
        ):
            try:
                call()
            except gl.GLError as error:
                codes.append(int(error.err))
        return [np.array(values) for values in (before, unchanged, changed, state(), codes)]

    check(program)


@pytest.mark.parametrize("name", ["II", "SS", "IR", "RR", "AA"])
def test_tables_in_other_types(name):
    def program(gl):
        table, answers = getattr(gl, f"GL_PIXEL_MAP_{name[0]}_TO_{name[1]}"), []
        values = np.array([0, 1, 255, 65535], np.uint32)
        gl.glPixelMapuiv(table, 4, values * np.uint32(65537 if name in ("RR", "IR") else 1))
        answers += [gl.glGetPixelMapfv(table), gl.glGetPixelMapusv(table), gl.glGetPixelMapuiv(table)]
        gl.glPixelMapusv(table, 4, values.astype(np.uint16))
        answers += [gl.glGetPixelMapfv(table), gl.glGetPixelMapusv(table)]
        return [np.array(answer).reshape(-1) for answer in answers]

    check(program)


@pytest.mark.parametrize("channel", range(3))
def test_numbers_beyond_32_bits_are_looked_up_at_the_first_entry(channel):
    words = pixels("GL_RGB", "GL_UNSIGNED_INT_10F_11F_11F_REV").copy()
    shift, largest = ((0, 0x7C0), (11, 0x7C0), (22, 0x3E0))[channel]
    words[::3, ::2] = words[::3, ::2] & np.uint32(~(0x7FF << shift) & 0xFFFFFFFF) | np.uint32(
        largest << shift
    )  # infinity

    def program(gl: Any) -> None:
        setting(gl, "mapped")
        gl.glDrawPixels(WIDTH, HEIGHT, gl.GL_RGB, gl.GL_UNSIGNED_INT_10F_11F_11F_REV, words)
        gl.glPixelTransferi(gl.GL_MAP_COLOR, gl.GL_FALSE)

    check(program)
