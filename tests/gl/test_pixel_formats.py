"""Uploads, read-outs and copies have the bits of Mesa, for every pair of formats and types.

Named differences, left out here: colours of float images as GL_INT and GL_UNSIGNED_INT (Mesa's product overflows at 1
and answers 0), the same for luminance; unsized colour formats given GL_UNSIGNED_SHORT (Mesa keeps 16 bits).
"""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = WIDTH, HEIGHT = 12, 8
TYPES = {
    "GL_UNSIGNED_BYTE": np.uint8,
    "GL_BYTE": np.int8,
    "GL_UNSIGNED_SHORT": np.uint16,
    "GL_SHORT": np.int16,
    "GL_UNSIGNED_INT": np.uint32,
    "GL_INT": np.int32,
    "GL_HALF_FLOAT": np.float16,
    "GL_FLOAT": np.float32,
}
WIDE = ("GL_UNSIGNED_INT", "GL_INT")
COMPONENTS = {
    "GL_RED": 1, "GL_GREEN": 1, "GL_BLUE": 1, "GL_ALPHA": 1, "GL_RG": 2, "GL_RGB": 3, "GL_BGR": 3, "GL_RGBA": 4,
    "GL_BGRA": 4, "GL_LUMINANCE": 1, "GL_LUMINANCE_ALPHA": 2,
}  # fmt: skip
COLORS = (
    "GL_RGBA8", "GL_RGB8", "GL_RG8", "GL_R8", "GL_RGBA32F", "GL_RGB32F", "GL_RG32F", "GL_R32F",
    "GL_ALPHA8", "GL_LUMINANCE8", "GL_LUMINANCE8_ALPHA8", "GL_INTENSITY8",
)  # fmt: skip
RENDERABLE = COLORS[:8]
DEPTHS = (
    "GL_DEPTH_COMPONENT16",
    "GL_DEPTH_COMPONENT24",
    "GL_DEPTH_COMPONENT32",
    "GL_DEPTH_COMPONENT32F",
    "GL_DEPTH24_STENCIL8",
)


def client_pixels(type: str, components: int, seed: int = 7) -> np.ndarray:
    """Random pixels over the whole range of a type, floats beyond [0, 1], with the ends of the range among them."""
    rng, dtype = np.random.default_rng(seed), TYPES[type]
    shape = (HEIGHT, WIDTH, components) if components > 1 else (HEIGHT, WIDTH)
    if np.dtype(dtype).kind == "f":
        pixels = rng.uniform(-0.3, 1.4, shape).astype(dtype)
        pixels[0, :4] = np.reshape([0, 1, -1, 2], (4, 1) if components > 1 else 4)
        return pixels
    bounds = np.iinfo(dtype)
    pixels = rng.integers(bounds.min, bounds.max, shape, dtype=dtype, endpoint=True)
    pixels[0, 0], pixels[0, 1] = bounds.max, bounds.min
    return pixels


def texture(gl: Any, internal: str, format: str, type: str, pixels: np.ndarray) -> int:
    """A texture with one level of these pixels, bound."""
    name = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    height, width = pixels.shape[:2]
    tokens = (getattr(gl, token) for token in (internal, format, type))
    internal_token, format_token, type_token = tokens
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal_token, width, height, 0, format_token, type_token, pixels)
    return name


def attach(gl: Any, name: int, internal: str) -> None:
    """Bind a framebuffer object around a texture."""
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
    point = gl.GL_COLOR_ATTACHMENT0
    if internal.startswith("GL_DEPTH"):
        point = gl.GL_DEPTH_STENCIL_ATTACHMENT if "STENCIL" in internal else gl.GL_DEPTH_ATTACHMENT
        gl.glDrawBuffer(gl.GL_NONE)
        gl.glReadBuffer(gl.GL_NONE)
    gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, point, gl.GL_TEXTURE_2D, name, 0)


def stored(gl: Any, internal: str) -> np.ndarray:
    """The bound texture's texels: RGBA as floats, or depth."""
    format = gl.GL_DEPTH_COMPONENT if internal.startswith("GL_DEPTH") else gl.GL_RGBA
    return gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, format, gl.GL_FLOAT)


def same_on_mesa(program: Any) -> None:
    """Fail with the first difference of a program whose list of arrays is the result."""
    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


@pytest.mark.parametrize("internal", COLORS)
def test_uploaded_colours_are_mesas(internal):
    def program(gl: Any) -> list[np.ndarray]:
        answers = []
        for format, components in COMPONENTS.items():
            for type in TYPES:
                texture(gl, internal, format, type, client_pixels(type, components))
                answers.append(stored(gl, internal))
        return answers

    same_on_mesa(program)


@pytest.mark.parametrize("internal", COLORS)
def test_colours_of_textures_are_read_as_on_mesa(internal):
    def program(gl: Any) -> list[np.ndarray]:
        texture(gl, internal, "GL_RGBA", "GL_FLOAT", client_pixels("GL_FLOAT", 4))
        return [
            gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, getattr(gl, format), getattr(gl, type))
            for format in COMPONENTS
            for type in TYPES
            if type not in WIDE or not ("32F" in internal or "LUMINANCE" in format)
        ]

    same_on_mesa(program)


@pytest.mark.parametrize("internal", RENDERABLE)
def test_colours_of_framebuffers_are_read_as_on_mesa(internal):
    def program(gl: Any) -> list[np.ndarray]:
        name = texture(gl, internal, "GL_RGBA", "GL_FLOAT", client_pixels("GL_FLOAT", 4))
        attach(gl, name, internal)
        return [
            gl.glReadPixels(0, 0, *SIZE, getattr(gl, format), getattr(gl, type))
            for format in COMPONENTS
            for type in TYPES
            if type not in WIDE or not ("32F" in internal or "LUMINANCE" in format)
        ]

    same_on_mesa(program)


@pytest.mark.parametrize("internal", RENDERABLE)
def test_a_clear_writes_the_channels_that_mesa_writes(internal):
    def program(gl: Any) -> list[np.ndarray]:
        name = texture(gl, internal, "GL_RGBA", "GL_FLOAT", client_pixels("GL_FLOAT", 4))
        attach(gl, name, internal)
        gl.glClearColor(0.13, 0.27, 0.43, 0.71)
        gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        return [gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_FLOAT), stored(gl, internal)]

    same_on_mesa(program)


@pytest.mark.parametrize("internal", DEPTHS)
def test_depth_is_uploaded_and_read_as_on_mesa(internal):
    def program(gl: Any) -> list[np.ndarray]:
        answers = []
        for uploaded in TYPES:
            name = texture(gl, internal, "GL_DEPTH_COMPONENT", uploaded, client_pixels(uploaded, 1))
            attach(gl, name, internal)
            for type in TYPES:
                answers.append(gl.glReadPixels(0, 0, *SIZE, gl.GL_DEPTH_COMPONENT, getattr(gl, type)))
                answers.append(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, getattr(gl, type)))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return answers

    same_on_mesa(program)


def test_unsized_depth_takes_the_size_of_the_clients_integers():
    def program(gl: Any) -> list[np.ndarray]:
        answers = []
        for type in TYPES:
            texture(gl, "GL_DEPTH_COMPONENT", "GL_DEPTH_COMPONENT", type, client_pixels(type, 1))
            bits = gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 0, gl.GL_TEXTURE_DEPTH_SIZE)
            answers.append(np.array([bits]))
        return answers

    same_on_mesa(program)


def test_packed_depth_and_stencil_are_mesas():
    words = client_pixels("GL_UNSIGNED_INT", 1)

    def program(gl: Any) -> list[np.ndarray]:
        name = texture(gl, "GL_DEPTH24_STENCIL8", "GL_DEPTH_STENCIL", "GL_UNSIGNED_INT_24_8", words)
        attach(gl, name, "GL_DEPTH24_STENCIL8")
        packed = (gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8)
        answers = [gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, *packed), gl.glReadPixels(0, 0, *SIZE, *packed)]
        answers += [gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, getattr(gl, type)) for type in TYPES]
        gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 3, 2, 4, 3, *packed, words[:3, :4].copy())
        answers.append(gl.glReadPixels(0, 0, *SIZE, *packed))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return answers

    same_on_mesa(program)


@pytest.mark.parametrize("source", ["GL_RGBA8", "GL_RGB8", "GL_RGBA32F", "GL_R32F", *DEPTHS])
def test_copies_between_formats_are_mesas(source):
    of_depth = source.startswith("GL_DEPTH")

    def program(gl: Any) -> list[np.ndarray]:
        pixels = client_pixels("GL_FLOAT", 1 if of_depth else 4)
        name = texture(gl, source, "GL_DEPTH_COMPONENT" if of_depth else "GL_RGBA", "GL_FLOAT", pixels)
        attach(gl, name, source)
        answers = []
        for internal in (*DEPTHS[:4], "GL_DEPTH_COMPONENT") if of_depth else COLORS:
            gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
            gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal), 0, 0, *SIZE, 0)
            answers.append(stored(gl, internal))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return answers

    same_on_mesa(program)


def draw_something(gl: Any) -> None:
    """Three triangles of many colours and depths that count in the stencil buffer."""
    gl.glEnable(gl.GL_DEPTH_TEST)
    gl.glEnable(gl.GL_STENCIL_TEST)
    gl.glStencilFunc(gl.GL_ALWAYS, 5, 255)
    gl.glStencilOp(gl.GL_KEEP, gl.GL_INCR, gl.GL_REPLACE)
    gl.glBegin(gl.GL_TRIANGLES)
    for x, y, z, *color in np.random.default_rng(8).uniform(-1.5, 1.5, (9, 7)).tolist():
        gl.glColor4f(*color)
        gl.glVertex3f(x, y, z)
    gl.glEnd()


def test_the_window_is_read_as_on_mesa():
    def program(gl: Any) -> list[np.ndarray]:
        draw_something(gl)
        answers = [
            gl.glReadPixels(0, 0, *SIZE, getattr(gl, format), getattr(gl, type))
            for format in (*COMPONENTS, "GL_DEPTH_COMPONENT", "GL_STENCIL_INDEX")
            for type in TYPES
            if type not in WIDE or "LUMINANCE" not in format
        ]
        outside = np.full((20, 30, 4), 77, np.uint8)
        gl.glReadPixels(-3, -5, 30, 20, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, outside)
        return [*answers, outside]

    same_on_mesa(program)


@pytest.mark.parametrize("internal", [*DEPTHS, *COLORS])
def test_copies_of_the_window_are_mesas(internal):
    def program(gl: Any) -> list[np.ndarray]:
        draw_something(gl)
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        answers = []
        for rectangle in ((0, 0, *SIZE), (2, 3, 7, 4), (-5, -2, 30, 20)):
            gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal), *rectangle, 0)
            answers.append(stored(gl, internal))
        gl.glCopyTexSubImage2D(gl.GL_TEXTURE_2D, 0, 5, 6, 3, 2, 20, 9)
        return [*answers, stored(gl, internal)]

    same_on_mesa(program)


@pytest.mark.parametrize(("skip_rows", "skip_pixels", "row_length"), [(0, 0, 0), (2, 1, 9), (1, 3, 12)])
def test_a_part_of_an_image_is_uploaded_as_on_mesa(skip_rows, skip_pixels, row_length):
    image = client_pixels("GL_UNSIGNED_BYTE", 4)

    def program(gl: Any) -> list[np.ndarray]:
        gl.glPixelStorei(gl.GL_UNPACK_SKIP_ROWS, skip_rows)
        gl.glPixelStorei(gl.GL_UNPACK_SKIP_PIXELS, skip_pixels)
        gl.glPixelStorei(gl.GL_UNPACK_ROW_LENGTH, row_length)
        gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
        arguments = (gl.GL_TEXTURE_2D, 0, gl.GL_RGBA8, 5, 4, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)
        gl.glTexImage2D(*arguments)
        return [stored(gl, "GL_RGBA8")]

    same_on_mesa(program)


@pytest.mark.parametrize("internal", DEPTHS)
def test_drawn_depth_is_sampled_as_on_mesa(internal):
    drawn = np.random.default_rng(3).uniform(0, 1, WIDTH) ** 4

    def program(gl: Any) -> list[np.ndarray]:
        name = texture(gl, internal, "GL_DEPTH_COMPONENT", "GL_FLOAT", np.zeros((HEIGHT, WIDTH), np.float32))
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, gl.GL_NEAREST)
        attach(gl, name, internal)
        gl.glEnable(gl.GL_DEPTH_TEST)
        gl.glDepthFunc(gl.GL_ALWAYS)
        for column, z in enumerate(drawn.tolist()):
            gl.glDepthRange(z, z)
            gl.glViewport(column, 0, 1, HEIGHT)
            gl.glRectf(-1, -1, 1, 1)
        colors = texture(gl, "GL_RGBA32F", "GL_RGBA", "GL_FLOAT", np.zeros((HEIGHT, WIDTH, 4), np.float32))
        attach(gl, colors, "GL_RGBA32F")
        gl.glViewport(0, 0, *SIZE)
        gl.glBindTexture(gl.GL_TEXTURE_2D, name)
        gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, gl.GL_REPLACE)
        gl.glBegin(gl.GL_QUADS)
        for s, t in ((0, 0), (1, 0), (1, 1), (0, 1)):
            gl.glTexCoord2f(s, t)
            gl.glVertex2f(2 * s - 1, 2 * t - 1)
        gl.glEnd()
        answers = [gl.glReadPixels(0, 0, *SIZE, gl.GL_RED, gl.GL_FLOAT), stored(gl, internal)]
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return answers

    same_on_mesa(program)
