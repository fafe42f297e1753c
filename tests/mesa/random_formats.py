"""Random textures in all internal formats: uploads, read-outs, lookups, copies and mipmaps."""

from typing import Any

import numpy as np

from mesa.random_images import PACKED_KINDS, packed_words


def prefixed(words: str) -> list[str]:
    """Return names of tokens."""
    return [f"GL_{word}" for word in words.split()]


OF_8_BITS = prefixed(
    "RGBA RGB LUMINANCE ALPHA LUMINANCE_ALPHA INTENSITY RED RG RGBA8 RGB8 ALPHA4 LUMINANCE4 "
    "INTENSITY4 LUMINANCE6_ALPHA2"
)
OF_FEW_BITS = prefixed("RGBA2 RGBA4 RGB4 RGB5 RGB5_A1 R3_G3_B2 RGB565 LUMINANCE4_ALPHA4")
OF_MORE_BITS = prefixed(
    "RGB10 RGB10_A2 RGB12 RGB16 RGBA12 RGBA16 ALPHA12 ALPHA16 LUMINANCE12 LUMINANCE16 LUMINANCE12_ALPHA4 "
    "LUMINANCE12_ALPHA12 LUMINANCE16_ALPHA16 INTENSITY12 INTENSITY16 R16 RG16"
)
SRGB = prefixed("SRGB SRGB8 SRGB_ALPHA SRGB8_ALPHA8 SLUMINANCE SLUMINANCE8 SLUMINANCE_ALPHA SLUMINANCE8_ALPHA8")
FLOATS = prefixed(
    "RGBA16F RGB16F RG16F R16F ALPHA16F_ARB LUMINANCE16F_ARB INTENSITY16F_ARB LUMINANCE_ALPHA16F_ARB RGBA32F R32F "
    "ALPHA32F_ARB LUMINANCE32F_ARB INTENSITY32F_ARB LUMINANCE_ALPHA32F_ARB"
)
FORMATS = [*OF_8_BITS, *OF_FEW_BITS, *OF_MORE_BITS, *SRGB, *FLOATS]
TYPES = {
    "GL_UNSIGNED_BYTE": np.uint8, "GL_BYTE": np.int8, "GL_UNSIGNED_SHORT": np.uint16, "GL_SHORT": np.int16,
    "GL_UNSIGNED_INT": np.uint32, "GL_INT": np.int32, "GL_HALF_FLOAT": np.float16, "GL_FLOAT": np.float32,
}  # fmt: skip
PIXEL_FORMATS = {
    "GL_RGBA": 4, "GL_BGRA": 4, "GL_ABGR_EXT": 4, "GL_RGB": 3, "GL_BGR": 3, "GL_RG": 2, "GL_RED": 1, "GL_GREEN": 1,
    "GL_ALPHA": 1, "GL_LUMINANCE": 1, "GL_LUMINANCE_ALPHA": 2,
}  # fmt: skip
SIZES = [f"GL_TEXTURE_{name}_SIZE" for name in ("RED", "GREEN", "BLUE", "ALPHA", "LUMINANCE", "INTENSITY", "DEPTH")]
WRAPS = ["GL_REPEAT", "GL_CLAMP_TO_EDGE", "GL_CLAMP", "GL_CLAMP_TO_BORDER", "GL_MIRRORED_REPEAT"]
FILTERS = ["GL_NEAREST", "GL_LINEAR"]
MIPMAP_FILTERS = [f"{within}_MIPMAP_{between}" for within in FILTERS for between in ("NEAREST", "LINEAR")]
MODES = ["GL_REPLACE", "GL_MODULATE", "GL_DECAL", "GL_BLEND", "GL_ADD"]
SIZE = (48, 40)
FINITE = np.uint32(0x7FDFFBFF)  # no exponent with its highest bit: neither infinities nor what is not a number


class Textures:
    """Texture calls with random arguments on a namespace of GL."""

    def __init__(self, gl: Any, seed: int) -> None:
        self.gl, self.rng = gl, np.random.default_rng(seed)
        for name in ("GL_UNPACK_ALIGNMENT", "GL_PACK_ALIGNMENT"):
            gl.glPixelStorei(self.named(name), 1)

    def named(self, name: str) -> int:
        return int(getattr(self.gl, name))

    def pick(self, names: list[str]) -> str:
        return names[int(self.rng.integers(len(names)))]

    def pair(self) -> tuple[str, str]:
        """Return a pixel format and a type."""
        if self.rng.random() < 0.35:
            kind = self.pick(sorted(PACKED_KINDS))
            return self.pick(list(PACKED_KINDS[kind][1])), kind
        return self.pick(list(PIXEL_FORMATS)), self.pick(list(TYPES))

    def pixels(self, pair: tuple[str, str], width: int, height: int) -> tuple[int, int, np.ndarray]:
        """Return pixel format, type and an image."""
        pixel_format, kind = pair
        if kind in PACKED_KINDS:
            image = packed_words(self.rng, width, height, kind)
            if kind == "GL_UNSIGNED_INT_10F_11F_11F_REV":
                image &= FINITE
        else:
            shape, dtype = (height, width, PIXEL_FORMATS[pixel_format]), np.dtype(TYPES[kind])
            if dtype.kind == "f":
                image = (self.rng.random(shape) * 1.2 - 0.1).astype(dtype)
            else:
                limits = np.iinfo(dtype)
                image = self.rng.integers(limits.min, limits.max, shape, endpoint=True).astype(dtype)
        return self.named(pixel_format), self.named(kind), image

    def new(self, target: str = "GL_TEXTURE_2D") -> int:
        self.gl.glBindTexture(self.named(target), self.gl.glGenTextures(1))
        return self.named(target)

    def read(self, pair: tuple[str, str] = ("GL_RGBA", "GL_FLOAT"), level: int = 0) -> np.ndarray:
        pixels = self.gl.glGetTexImage(self.gl.GL_TEXTURE_2D, level, *map(self.named, pair))
        return np.asarray(pixels)

    def float_target(self, width: int, height: int) -> None:
        """Draw to floats."""
        gl, target = self.gl, self.new()
        gl.glTexImage2D(target, 0, gl.GL_RGBA32F, width, height, 0, gl.GL_RGBA, gl.GL_FLOAT, None)
        gl.glTexParameteri(target, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
        gl.glBindFramebuffer(gl.GL_FRAMEBUFFER, gl.glGenFramebuffers(1))
        texture = int(gl.glGetIntegerv(gl.GL_TEXTURE_BINDING_2D))
        gl.glFramebufferTexture2D(gl.GL_FRAMEBUFFER, gl.GL_COLOR_ATTACHMENT0, target, texture, 0)
        gl.glBindTexture(target, 0)


def uploads(seed: int, formats: list[str], n: int = 12) -> Any:
    """Return a program that defines textures, changes a part of each, and reads them in two ways."""

    def program(gl: Any) -> list[np.ndarray]:
        make, told = Textures(gl, seed), []
        for _ in range(n):
            target, internal = make.new(), make.pick(formats)
            gl.glTexImage2D(target, 0, make.named(internal), 16, 8, 0, *make.pixels(make.pair(), 16, 8))
            gl.glTexSubImage2D(target, 0, 3, 2, 5, 4, *make.pixels(make.pair(), 5, 4))
            sizes = [gl.glGetTexLevelParameteriv(target, 0, make.named(name)) for name in SIZES]
            sizes.append(gl.glGetTexLevelParameteriv(target, 0, gl.GL_TEXTURE_INTERNAL_FORMAT))
            told += [np.array([int(size) for size in sizes]), make.read(), make.read(make.pair())]
        return told

    return program


def transfers(seed: int, formats: list[str]) -> Any:
    """Return a program that defines textures from colour indices, and from pixels that are scaled on the way."""

    def program(gl: Any) -> list[np.ndarray]:
        make, told = Textures(gl, seed), []
        for name in "RGBA":
            gl.glPixelMapfv(make.named(f"GL_PIXEL_MAP_I_TO_{name}"), 16, make.rng.random(16).astype(np.float32))
        for internal in formats:
            target, kind = make.new(), make.pick(["GL_UNSIGNED_BYTE", "GL_UNSIGNED_SHORT", "GL_FLOAT"])
            indices = make.rng.integers(0, 16, (8, 16)).astype(TYPES[kind])
            gl.glTexImage2D(target, 0, make.named(internal), 16, 8, 0, gl.GL_COLOR_INDEX, make.named(kind), indices)
            told.append(make.read())
            gl.glPixelTransferf(gl.GL_RED_SCALE, 0.7)
            gl.glPixelTransferf(gl.GL_BLUE_BIAS, 0.2)
            gl.glTexImage2D(target, 0, make.named(internal), 16, 8, 0, *make.pixels(make.pair(), 16, 8))
            gl.glPixelTransferf(gl.GL_RED_SCALE, 1)
            gl.glPixelTransferf(gl.GL_BLUE_BIAS, 0)
            told.append(make.read())
        return told

    return program


def lookups(seed: int, formats: list[str]) -> Any:
    """Return a program that draws triangles with a texture, to bytes or to floats."""

    def program(gl: Any) -> np.ndarray:
        make = Textures(gl, seed)
        rng = make.rng
        if rng.random() < 0.5:
            make.float_target(*SIZE)
        kind = make.pick(["2D", "2D", "2D", "1D", "3D", "CUBE_MAP"])
        target, internal = make.new(f"GL_TEXTURE_{kind}"), make.named(make.pick(formats))
        pair, filters = make.pair(), [make.pick(FILTERS + MIPMAP_FILTERS), make.pick(FILTERS)]
        if rng.random() < 0.6:
            filters[1] = "GL_LINEAR" if filters[0].startswith("GL_LINEAR") else "GL_NEAREST"
        for level in range(5 if "MIPMAP" in filters[0] else 1):
            side, depth = 16 >> level, max(4 >> level, 1)
            if kind == "1D":
                gl.glTexImage1D(target, level, internal, side, 0, *make.pixels(pair, side, 1))
            elif kind == "3D":
                pixels = make.pixels(pair, side, side * depth)
                gl.glTexImage3D(target, level, internal, side, side, depth, 0, *pixels)
            else:
                for face in range(6) if kind == "CUBE_MAP" else (None,):
                    place = target if face is None else gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X + face
                    gl.glTexImage2D(place, level, internal, side, side, 0, *make.pixels(pair, side, side))
        for name, value in zip(("GL_TEXTURE_MIN_FILTER", "GL_TEXTURE_MAG_FILTER"), filters, strict=True):
            gl.glTexParameteri(target, make.named(name), make.named(value))
        for axis in "STR":
            gl.glTexParameteri(target, make.named(f"GL_TEXTURE_WRAP_{axis}"), make.named(make.pick(WRAPS)))
        gl.glTexParameterfv(target, gl.GL_TEXTURE_BORDER_COLOR, (rng.random(4) * 2 - 0.5).astype(np.float32))
        if kind == "2D" and rng.random() < 0.15:
            gl.glTexParameterf(target, gl.GL_TEXTURE_MAX_ANISOTROPY_EXT, 4.0)
        if kind == "CUBE_MAP" and rng.random() < 0.5:
            gl.glEnable(gl.GL_TEXTURE_CUBE_MAP_SEAMLESS)
        gl.glEnable(target)
        gl.glTexEnvi(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_MODE, make.named(make.pick(MODES)))
        gl.glBegin(gl.GL_TRIANGLES)
        scale = rng.choice([1.0, 3.0, 0.3])
        for _ in range(9):
            gl.glColor4f(*rng.random(4))
            gl.glTexCoord3f(*(rng.random(3) * scale - 0.5))
            gl.glVertex2f(*(rng.random(2) * 2.4 - 1.2))
        gl.glEnd()
        return np.ravel(gl.glReadPixels(0, 0, *SIZE, gl.GL_RGBA, gl.GL_FLOAT))

    return program


def copies(seed: int, formats: list[str]) -> Any:
    """Return a program that copies parts of a framebuffer, of bytes or of floats, to textures."""

    def program(gl: Any) -> list[np.ndarray]:
        make, told = Textures(gl, seed), []
        if make.rng.random() < 0.4:
            make.float_target(*SIZE)
        gl.glWindowPos2i(0, 0)
        gl.glDrawPixels(*SIZE, *make.pixels(("GL_RGBA", "GL_FLOAT"), *SIZE))
        for internal in formats:
            target = make.new()
            gl.glCopyTexImage2D(target, 0, make.named(internal), 2, 3, 16, 8, 0)
            gl.glCopyTexSubImage2D(target, 0, 3, 2, 5, 1, 6, 4)
            told.append(make.read())
        return told

    return program


def mipmaps(seed: int, formats: list[str]) -> Any:
    """Return a program that computes mipmaps and reads them."""

    def program(gl: Any) -> list[np.ndarray]:
        make, told = Textures(gl, seed), []
        for internal in formats:
            target, (width, height) = make.new(), make.rng.choice([16, 8, 13, 5, 1, 6], 2).tolist()
            pair = make.pick(["GL_RGBA"]), make.pick(["GL_FLOAT", "GL_UNSIGNED_BYTE"])
            pixels = make.pixels(pair, width, height)
            gl.glTexImage2D(target, 0, make.named(internal), width, height, 0, *pixels)
            gl.glGenerateMipmap(target)
            told += [make.read(level=level) for level in range(max(width, height).bit_length())]
        return told

    return program
