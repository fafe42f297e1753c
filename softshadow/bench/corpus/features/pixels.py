"""Features that move pixels: read, drawn, copied, uploaded in each frame."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np

from softshadow.bench.corpus.features.feature import Around, Feature, feature
from softshadow.bench.corpus.shapes import noise

SIDE = 256
# format, type, numbers per pixel, dtype: of pictures that are read, drawn and uploaded
LAYOUTS = {
    "rgba-bytes": ("GL_RGBA", "GL_UNSIGNED_BYTE", 4, np.uint8),
    "rgb-bytes": ("GL_RGB", "GL_UNSIGNED_BYTE", 3, np.uint8),
    "bgra-bytes": ("GL_BGRA", "GL_UNSIGNED_BYTE", 4, np.uint8),
    "rgba-floats": ("GL_RGBA", "GL_FLOAT", 4, np.float32),
    "luminance-bytes": ("GL_LUMINANCE", "GL_UNSIGNED_BYTE", 1, np.uint8),
}
# what is read besides colours
VALUES = {
    "depth-floats": ("GL_DEPTH_COMPONENT", "GL_FLOAT", np.float32),
    "depth-integers": ("GL_DEPTH_COMPONENT", "GL_UNSIGNED_INT", np.uint32),
    "stencil-bytes": ("GL_STENCIL_INDEX", "GL_UNSIGNED_BYTE", np.uint8),
}


def _after(name: str, title: str, begin: Callable[[Any], Callable[[], None]]) -> Feature:
    """Return a feature that does something after each drawing, without texture: `begin` prepares it and returns it.

    Mesa shows rectangles of pixels with the textures in use, softshadow without (docs/exactness.md).
    """

    def prepare(gl: Any) -> Around:
        gl.glPixelStorei(gl.GL_PACK_ALIGNMENT, 1)
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        act = begin(gl)

        @contextmanager
        def around() -> Iterator[None]:
            yield
            gl.glDisable(gl.GL_TEXTURE_2D)
            act()
            gl.glEnable(gl.GL_TEXTURE_2D)

        return around

    return Feature(name, title, prepare)


def _image(layout: str) -> np.ndarray:
    _, _, count, dtype = LAYOUTS[layout]
    image = np.ascontiguousarray(noise(SIDE)[..., :count])
    return image if dtype is np.uint8 else image.astype(dtype) / dtype(255)


def _read(layout: str) -> Feature:
    format, kind, count, dtype = LAYOUTS[layout]

    def begin(gl: Any) -> Callable[[], None]:
        pixels = np.zeros((480, 640, count), dtype)
        names = getattr(gl, format), getattr(gl, kind)
        return lambda: gl.glReadPixels(0, 0, 640, 480, *names, pixels)

    return _after(f"read-{layout}", f"pictures read as {layout}", begin)


def _read_values(values: str) -> Feature:
    format, kind, dtype = VALUES[values]

    def begin(gl: Any) -> Callable[[], None]:
        pixels = np.zeros((480, 640), dtype)
        names = getattr(gl, format), getattr(gl, kind)
        return lambda: gl.glReadPixels(0, 0, 640, 480, *names, pixels)

    return _after(f"read-{values}", f"buffers read as {values}", begin)


def _drawn(layout: str) -> Feature:
    format, kind, _, _ = LAYOUTS[layout]

    def begin(gl: Any) -> Callable[[], None]:
        image, names = _image(layout), (getattr(gl, format), getattr(gl, kind))

        def act() -> None:
            gl.glWindowPos2i(40, 40)
            gl.glDrawPixels(SIDE, SIDE, *names, image)

        return act

    return _after(f"drawn-{layout}", f"pictures of {layout} drawn by glDrawPixels", begin)


def _uploaded(layout: str) -> Feature:
    format, kind, _, _ = LAYOUTS[layout]

    def begin(gl: Any) -> Callable[[], None]:
        image, names = _image(layout), (getattr(gl, format), getattr(gl, kind))
        return lambda: gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, SIDE, SIDE, *names, image)

    return _after(f"uploaded-{layout}", f"a texture replaced by {layout} in each frame", begin)


def _copied_pixels(gl: Any) -> Callable[[], None]:
    def act() -> None:
        gl.glWindowPos2i(300, 200)
        gl.glCopyPixels(0, 0, SIDE, SIDE, gl.GL_COLOR)

    return act


def _zoomed_pixels(gl: Any) -> Callable[[], None]:
    image = _image("rgba-bytes")
    gl.glPixelZoom(1.5, -1.5)

    def act() -> None:
        gl.glWindowPos2i(40, 440)
        gl.glDrawPixels(SIDE, SIDE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)

    return act


def _bitmaps(gl: Any) -> Callable[[], None]:
    bits = np.packbits(np.arange(13 * 16).reshape(13, 16) % 3 == 0, axis=1)

    def act() -> None:
        gl.glWindowPos2i(10, 10)
        for _ in range(40):
            gl.glBitmap(9, 13, 0.0, 0.0, 10.0, 0.0, bits)

    return act


def _mipmapped(gl: Any) -> Callable[[], None]:
    image = _image("rgba-bytes")
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR_MIPMAP_LINEAR)

    def act() -> None:
        gl.glTexSubImage2D(gl.GL_TEXTURE_2D, 0, 0, 0, SIDE, SIDE, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)
        gl.glGenerateMipmap(gl.GL_TEXTURE_2D)

    return act


def _texture_read(gl: Any) -> Callable[[], None]:
    image = np.zeros((SIDE, SIDE, 4), np.uint8)
    return lambda: gl.glGetTexImage(gl.GL_TEXTURE_2D, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)


def _copied_depth(gl: Any) -> Callable[[], None]:
    texture = gl.glGenTextures(1)

    def act() -> None:
        gl.glActiveTexture(gl.GL_TEXTURE1)
        gl.glBindTexture(gl.GL_TEXTURE_2D, texture)
        gl.glCopyTexImage2D(gl.GL_TEXTURE_2D, 0, gl.GL_DEPTH_COMPONENT24, 0, 0, SIDE, SIDE, 0)
        gl.glActiveTexture(gl.GL_TEXTURE0)

    return act


def _window_blit(gl: Any) -> Callable[[], None]:
    return lambda: gl.glBlitFramebuffer(0, 0, SIDE, SIDE, 300, 100, 600, 400, gl.GL_COLOR_BUFFER_BIT, gl.GL_LINEAR)


def cleared_boxes(gl: Any) -> Around:
    """Small boxes cleared after the drawing."""

    @contextmanager
    def cleared() -> Iterator[None]:
        yield
        gl.glEnable(gl.GL_SCISSOR_TEST)
        for n in range(20):
            gl.glScissor(30 * n, 10, 25, 40)
            gl.glClear(gl.GL_COLOR_BUFFER_BIT)
        gl.glDisable(gl.GL_SCISSOR_TEST)

    return cleared


FEATURES = (
    *map(_read, LAYOUTS),
    *map(_read_values, VALUES),
    *map(_drawn, LAYOUTS),
    *map(_uploaded, LAYOUTS),
    _after("copied-pixels", "pixels copied by glCopyPixels", _copied_pixels),
    _after("zoomed-pixels", "a zoomed picture drawn by glDrawPixels", _zoomed_pixels),
    _after("bitmaps", "forty bitmaps, as for a line of text", _bitmaps),
    _after("mipmapped", "mipmaps made in each frame", _mipmapped),
    _after("texture-read", "a texture read by glGetTexImage", _texture_read),
    _after("copied-depth", "depths copied to a texture", _copied_depth),
    _after("window-blit", "a part of the window, scaled by a linear blit", _window_blit),
    feature(cleared_boxes),
)
