"""Depth and stencil in one object or two, as on Mesa: completeness, sizes, packed pixels, copies and blits."""

from typing import Any

import numpy as np
import pytest

from softshadow.testing import compare

pytestmark = pytest.mark.mesa

SIZE = WIDTH, HEIGHT = 16, 12
FLOAT, FIXED = "GL_DEPTH32F_STENCIL8", "GL_DEPTH24_STENCIL8"
PLAIN = ["GL_DEPTH_COMPONENT16", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32", "GL_DEPTH_COMPONENT32F"]
DEPTHS, STENCILS = [*PLAIN, FIXED, FLOAT], ["GL_STENCIL_INDEX8", FIXED, FLOAT]
BOTH, DEPTH, STENCIL = "GL_DEPTH_STENCIL_ATTACHMENT", "GL_DEPTH_ATTACHMENT", "GL_STENCIL_ATTACHMENT"
POINTS = ([BOTH], [DEPTH], [STENCIL], [DEPTH, STENCIL])
KINDS = ("renderbuffer", "texture")


def image(gl: Any, kind: str, internal: str) -> int:
    """Return the name of a new renderbuffer or texture of zeros, which stays bound."""
    if kind == "renderbuffer":
        name = gl.glGenRenderbuffers(1)
        gl.glBindRenderbuffer(gl.GL_RENDERBUFFER, name)
        gl.glRenderbufferStorage(gl.GL_RENDERBUFFER, getattr(gl, internal), *SIZE)
        return int(name)
    pixels = (gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT)
    if internal in STENCILS:
        pixels = (gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8)
    if internal == "GL_STENCIL_INDEX8":
        pixels = (gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
    name = gl.glGenTextures(1)
    gl.glBindTexture(gl.GL_TEXTURE_2D, name)
    gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, internal), *SIZE, 0, *pixels, None)
    return int(name)


def attach(gl: Any, point: str, kind: str, name: int) -> None:
    at = (gl.GL_FRAMEBUFFER, getattr(gl, point))
    if kind == "renderbuffer":
        gl.glFramebufferRenderbuffer(*at, gl.GL_RENDERBUFFER, name)
    else:
        gl.glFramebufferTexture2D(*at, gl.GL_TEXTURE_2D, name, 0)


def new_object(gl: Any) -> int:
    """Return the name of a new framebuffer object, bound, without colours."""
    name = gl.glGenFramebuffers(1)
    gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, name)
    gl.glDrawBuffer(gl.GL_NONE)
    gl.glReadBuffer(gl.GL_NONE)
    return int(name)


def answer_or_error(gl: Any, call: Any) -> int:
    """Return the result of a call, or its error code negated."""
    try:
        return int(call() or 0)
    except gl.GLError:
        return -int(gl.glGetError())


def described(gl: Any) -> list[np.ndarray]:
    """Return the status of the bound object, what is attached to both points and, if it is complete, its bits."""
    status = int(gl.glCheckFramebufferStatus(gl.GL_FRAMEBUFFER))
    found = [status]
    for name in (gl.GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE, gl.GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME):
        query = (gl.GL_FRAMEBUFFER, getattr(gl, BOTH), name)
        found.append(answer_or_error(gl, lambda query=query: gl.glGetFramebufferAttachmentParameteriv(*query)))
    if status == gl.GL_FRAMEBUFFER_COMPLETE:
        found += [int(gl.glGetIntegerv(name)) for name in (gl.GL_DEPTH_BITS, gl.GL_STENCIL_BITS)]
    return [np.array(found)]


def same_on_mesa(program: Any) -> None:
    comparison = compare(program, SIZE)
    assert comparison, str(comparison)


@pytest.mark.parametrize("stencil_kind", KINDS)
@pytest.mark.parametrize("depth_kind", KINDS)
def test_depth_and_stencil_in_two_objects_are_as_unsupported_as_on_mesa(depth_kind, stencil_kind):
    def program(gl: Any) -> list[np.ndarray]:
        found = []
        for depth in DEPTHS:
            for stencil in STENCILS:
                new_object(gl)
                attach(gl, DEPTH, depth_kind, image(gl, depth_kind, depth))
                attach(gl, STENCIL, stencil_kind, image(gl, stencil_kind, stencil))
                found += described(gl)
                assert found[-1][0] == gl.GL_FRAMEBUFFER_UNSUPPORTED
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return found

    same_on_mesa(program)


@pytest.mark.parametrize("kind", KINDS)
def test_one_object_at_one_or_both_points_is_as_complete_as_on_mesa(kind):
    def program(gl: Any) -> list[np.ndarray]:
        found = []
        for internal in (*DEPTHS, "GL_STENCIL_INDEX8"):
            for points in POINTS:
                new_object(gl)
                name = image(gl, kind, internal)
                for point in points:
                    found.append(np.array(answer_or_error(gl, lambda at=(point, kind, name): attach(gl, *at))))
                found += described(gl)
            for channel in ("RED", "DEPTH", "STENCIL"):
                if kind == "renderbuffer":
                    size = getattr(gl, f"GL_RENDERBUFFER_{channel}_SIZE")
                    found.append(np.array(int(gl.glGetRenderbufferParameteriv(gl.GL_RENDERBUFFER, size))))
                else:
                    size = getattr(gl, f"GL_TEXTURE_{channel}_SIZE")
                    found.append(np.array(int(gl.glGetTexLevelParameteriv(gl.GL_TEXTURE_2D, 0, size))))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return found

    same_on_mesa(program)


def packed_pixels(seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Return random pixels for the two packed types; floats reach beyond [0, 1]."""
    rng = np.random.default_rng(seed)
    words = rng.integers(0, 2**32, (HEIGHT, WIDTH), dtype=np.uint32)
    words[0, :2] = 0, 2**32 - 1
    floats = np.zeros((HEIGHT, WIDTH), [("depth", np.float32), ("stencil", np.uint32)])
    floats["depth"], floats["stencil"] = rng.uniform(-0.3, 1.3, (HEIGHT, WIDTH)), words
    floats["depth"][0, :3] = 0, 1, 1e-9
    return words, floats


@pytest.mark.parametrize("internal", [*DEPTHS, "GL_DEPTH_COMPONENT", "GL_DEPTH_STENCIL"])
def test_packed_pixels_go_into_every_depth_format_as_on_mesa(internal):
    words, floats = packed_pixels(1)

    def program(gl: Any) -> list[np.ndarray]:
        found = []
        types = (gl.GL_UNSIGNED_INT_24_8, gl.GL_FLOAT_32_UNSIGNED_INT_24_8_REV)
        for type, pixels in zip(types, (words, floats), strict=True):
            name = gl.glGenTextures(1)
            gl.glBindTexture(gl.GL_TEXTURE_2D, name)
            where = (gl.GL_TEXTURE_2D, 0, getattr(gl, internal), *SIZE, 0)
            gl.glTexImage2D(*where, gl.GL_DEPTH_STENCIL, type, pixels)
            found.append(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT))
            if "STENCIL" not in internal:
                continue
            new_object(gl)
            attach(gl, BOTH, "texture", name)
            part = pixels[:4, :5].copy()
            gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 2, 1, 5, 4, gl.GL_DEPTH_STENCIL, type, part)
            for readout in types:
                found.append(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_STENCIL, readout))
                found.append(gl.glReadPixels(-2, 1, *SIZE, gl.GL_DEPTH_STENCIL, readout))
            found.append(gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE))
            for copied in (*DEPTHS, "GL_DEPTH_STENCIL"):
                gl.glBindTexture(gl.GL_TEXTURE_2D, gl.glGenTextures(1))
                gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, getattr(gl, copied), 0, 0, *SIZE, 0)
                found.append(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT, gl.GL_FLOAT))
                if "STENCIL" in copied:
                    found.append(gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_STENCIL, types[0]))
            gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return found

    same_on_mesa(program)


def test_the_window_is_read_as_packed_floats():
    def program(gl: Any) -> list[np.ndarray]:
        gl.glClearDepth(0.3)
        gl.glClearStencil(77)
        gl.glClear(gl.GL_DEPTH_BUFFER_BIT | gl.GL_STENCIL_BUFFER_BIT)
        return [gl.glReadPixels(0, 0, *SIZE, gl.GL_DEPTH_STENCIL, gl.GL_FLOAT_32_UNSIGNED_INT_24_8_REV)]

    same_on_mesa(program)


def test_blits_between_depths_of_two_formats_are_refused_as_on_mesa():
    def program(gl: Any) -> list[np.ndarray]:
        codes = []
        objects = {}
        for internal in (FIXED, FLOAT, "GL_DEPTH_COMPONENT32F", "GL_STENCIL_INDEX8"):
            points = [STENCIL] if internal == "GL_STENCIL_INDEX8" else [BOTH] if internal in STENCILS else [DEPTH]
            for kind in points if internal not in (FIXED, FLOAT) else (BOTH, STENCIL):
                objects[internal, kind] = new_object(gl)
                attach(gl, kind, "renderbuffer", image(gl, "renderbuffer", internal))
        for read in (0, *objects.values()):
            for drawn in (0, *objects.values()):
                gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, read)
                gl.glBindFramebuffer(gl.GL_DRAW_FRAMEBUFFER, drawn)
                for mask in (gl.GL_DEPTH_BUFFER_BIT, gl.GL_STENCIL_BUFFER_BIT):
                    blit = (*(0, 0, 4, 4) * 2, mask, gl.GL_NEAREST)
                    codes.append(answer_or_error(gl, lambda blit=blit: gl.glBlitFramebuffer(*blit)))
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return [np.array(codes)]

    same_on_mesa(program)


@pytest.mark.parametrize(
    ("source", "target", "left"),
    [
        ((-5, 2), (-3, 14), 7),  # at 0
        ((-5, 1), (30, 2), 3),  # at 1, mirrored
        ((-5, 1), (-3, 14), 3),  # at -3
        ((-5, 1), (14, -3), 3),  # at -1, mirrored
        ((12, 19), (-3, 14), 7),  # at 17 of 16
        ((-2, 18), (30, 2), 3),  # at 17 of 16, mirrored
    ],
)
def test_a_blit_whose_source_is_rounded_to_nothing_writes_what_mesa_writes(source, target, left):
    words, _ = packed_pixels(2)

    def program(gl: Any) -> list[np.ndarray]:
        names = []
        for pixels in (words, np.zeros_like(words)):
            names.append(new_object(gl))
            texture = image(gl, "texture", FIXED)
            whole = (gl.GL_TEXTURE_2D, 0, 0, 0, *SIZE, gl.GL_DEPTH_STENCIL, gl.GL_UNSIGNED_INT_24_8)
            gl.glTexSubImage2D(*whole, pixels)
            attach(gl, BOTH, "texture", texture)
        gl.glBindFramebuffer(gl.GL_READ_FRAMEBUFFER, names[0])
        gl.glEnable(gl.GL_SCISSOR_TEST)
        gl.glScissor(left, 0, 1, HEIGHT)
        rectangles = (source[0], 0, source[1], HEIGHT, target[0], 0, target[1], HEIGHT)
        gl.glBlitFramebuffer(*rectangles, gl.GL_STENCIL_BUFFER_BIT, gl.GL_NEAREST)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, names[1])
        found = gl.glReadPixels(0, 0, *SIZE, gl.GL_STENCIL_INDEX, gl.GL_UNSIGNED_BYTE)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, 0)
        return [found]

    same_on_mesa(program)
