"""Random compressed textures: uploads, changes of blocks, lookups and read-outs."""

from typing import Any

import numpy as np

from mesa.random_formats import FILTERS, MIPMAP_FILTERS, MODES, SIZE, WRAPS, Textures, prefixed

S3TC = prefixed(
    "COMPRESSED_RGB_S3TC_DXT1_EXT COMPRESSED_RGBA_S3TC_DXT1_EXT COMPRESSED_RGBA_S3TC_DXT3_EXT "
    "COMPRESSED_RGBA_S3TC_DXT5_EXT COMPRESSED_SRGB_S3TC_DXT1_EXT COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT "
    "COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT"
)
CHANNELS = prefixed(
    "COMPRESSED_RED_RGTC1 COMPRESSED_SIGNED_RED_RGTC1 COMPRESSED_RG_RGTC2 COMPRESSED_SIGNED_RG_RGTC2 "
    "COMPRESSED_LUMINANCE_LATC1_EXT COMPRESSED_SIGNED_LUMINANCE_LATC1_EXT COMPRESSED_LUMINANCE_ALPHA_LATC2_EXT "
    "COMPRESSED_SIGNED_LUMINANCE_ALPHA_LATC2_EXT COMPRESSED_LUMINANCE_ALPHA_3DC_ATI"
)
COMPRESSED = [*S3TC, *CHANNELS]
GENERIC = prefixed(
    "COMPRESSED_RGB COMPRESSED_RGBA COMPRESSED_SRGB COMPRESSED_SRGB_ALPHA COMPRESSED_RED COMPRESSED_RG "
    "COMPRESSED_ALPHA COMPRESSED_LUMINANCE COMPRESSED_LUMINANCE_ALPHA COMPRESSED_INTENSITY COMPRESSED_SLUMINANCE "
    "COMPRESSED_SLUMINANCE_ALPHA"
)
FROM_PIXELS = [*(name for name in COMPRESSED if "SIGNED" not in name), *GENERIC]
THREE_DC = 0x8837  # GL_COMPRESSED_LUMINANCE_ALPHA_3DC_ATI, which PyOpenGL does not have
OF_8_BYTES = ("DXT1", "RGTC1", "LATC1")
QUERIES = prefixed(
    "TEXTURE_WIDTH TEXTURE_HEIGHT TEXTURE_COMPRESSED TEXTURE_INTERNAL_FORMAT TEXTURE_COMPRESSED_IMAGE_SIZE "
    "TEXTURE_RED_SIZE TEXTURE_GREEN_SIZE TEXTURE_BLUE_SIZE TEXTURE_ALPHA_SIZE TEXTURE_LUMINANCE_SIZE "
    "TEXTURE_INTENSITY_SIZE TEXTURE_DEPTH_SIZE"
)


class CompressedTextures(Textures):
    """Calls for compressed textures with random arguments on a namespace of GL."""

    def named(self, name: str) -> int:
        return THREE_DC if "3DC" in name else super().named(name)

    def blocks(self, name: str, width: int, height: int) -> np.ndarray:
        """Return random blocks; in some of them, both ends are equal or near each other."""
        size = 8 if any(part in name for part in OF_8_BYTES) else 16
        blocks = self.rng.integers(0, 256, (-(-height // 4) * -(-width // 4), size)).astype(np.uint8)
        near = self.rng.random(len(blocks)) < 0.3
        blocks[near, 1] = blocks[near, 0] + self.rng.integers(0, 2)
        return blocks.reshape(-1)

    def smooth(self, width: int, height: int) -> tuple[int, int, np.ndarray]:
        """Return pixel format, type and an image of bytes: noise, few colours, or colours near each other."""
        shape, kind = (height, width, 4), self.rng.integers(4)
        if kind == 0:
            image = self.rng.integers(0, 256, shape)
        elif kind == 1:
            image = self.rng.choice([0, 255, *self.rng.integers(0, 256, 2)], shape)
        elif kind == 2:
            image = self.rng.integers(0, 256, 4) + self.rng.integers(-6, 7, shape)
        else:
            slopes = self.rng.integers(-9, 9, (2, 4))
            image = self.rng.integers(0, 256, 4) + np.indices((height, width)).transpose(1, 2, 0) @ slopes
        return self.gl.GL_RGBA, self.gl.GL_UNSIGNED_BYTE, image.clip(0, 255).astype(np.uint8)

    def define(self, target: int, level: int, name: str, width: int, height: int) -> None:
        blocks = self.blocks(name, width, height)
        self.gl.glCompressedTexImage2D(target, level, self.named(name), width, height, 0, blocks)


def uploads(seed: int, formats: list[str], n: int = 8) -> Any:
    """Return a program that defines textures, changes some blocks of each, and reads and queries them."""

    def program(gl: Any) -> list[np.ndarray]:
        make, told = CompressedTextures(gl, seed), []
        for _ in range(n):
            target, name = make.new(), make.pick(formats)
            width, height = make.rng.choice([16, 13, 4, 3, 1, 8], 2).tolist()
            make.define(target, 0, name, width, height)
            if width > 4 and height > 4:
                part = make.rng.choice([4, width - 4]).item()
                gl.glCompressedTexSubImage2D(
                    target, 0, 4, 4, part, height - 4, make.named(name), make.blocks(name, part, height - 4)
                )
            told.append(np.array([int(gl.glGetTexLevelParameteriv(target, 0, make.named(each))) for each in QUERIES]))
            told += [gl.glGetCompressedTexImage(target, 0), make.read(), make.read(make.pair())]
        return told

    return program


def from_pixels(seed: int, formats: list[str], n: int = 8) -> Any:
    """Return a program that lets GL compress images, and parts of them, and reads and queries the results.

    Rows are whole: where a row of texels ends within a block, Mesa's codes depend on what was in memory before.
    """

    def program(gl: Any) -> list[np.ndarray]:
        make, told = CompressedTextures(gl, seed), []
        for _ in range(n):
            target, name = make.new(), make.pick(formats)
            width, height = int(make.rng.choice([16, 8, 4])), int(make.rng.choice([16, 13, 4, 3, 1, 8]))
            pair = make.pair() if make.rng.random() < 0.5 else ("GL_RGBA", "GL_UNSIGNED_BYTE")
            of_bytes = pair == ("GL_RGBA", "GL_UNSIGNED_BYTE")
            pixels = make.smooth(width, height) if of_bytes else make.pixels(pair, width, height)
            gl.glTexImage2D(target, 0, make.named(name), width, height, 0, *pixels)
            if width > 4 and height > 4:
                gl.glTexSubImage2D(target, 0, 4, 4, width - 4, height - 4, *make.smooth(width - 4, height - 4))
            is_compressed = int(gl.glGetTexLevelParameteriv(target, 0, gl.GL_TEXTURE_COMPRESSED))
            queries = [each for each in QUERIES if is_compressed or "IMAGE_SIZE" not in each]
            told.append(np.array([int(gl.glGetTexLevelParameteriv(target, 0, make.named(each))) for each in queries]))
            told += [make.read(), make.read(make.pair())]
            if is_compressed and width % 4 == height % 4 == 0:  # of others, too
                told.append(gl.glGetCompressedTexImage(target, 0))
        return told

    return program


def lookups(seed: int, formats: list[str]) -> Any:
    """Return a program that draws triangles with a compressed texture, to bytes or to floats."""

    def program(gl: Any) -> np.ndarray:
        make = CompressedTextures(gl, seed)
        rng = make.rng
        if rng.random() < 0.5:
            make.float_target(*SIZE)
        name = make.pick(formats)
        kind = make.pick(["2D", "2D", "2D", "CUBE_MAP"])
        target = make.new(f"GL_TEXTURE_{kind}")
        filters = [make.pick(FILTERS + MIPMAP_FILTERS), make.pick(FILTERS)]
        if rng.random() < 0.6:
            filters[1] = "GL_LINEAR" if filters[0].startswith("GL_LINEAR") else "GL_NEAREST"
        for level in range(5 if "MIPMAP" in filters[0] else 1):
            side = 16 >> level
            for face in range(6) if kind == "CUBE_MAP" else (None,):
                place = target if face is None else gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X + face
                make.define(place, level, name, side, side)
        for parameter, value in zip(("GL_TEXTURE_MIN_FILTER", "GL_TEXTURE_MAG_FILTER"), filters, strict=True):
            gl.glTexParameteri(target, make.named(parameter), make.named(value))
        for axis in "STR":
            gl.glTexParameteri(target, make.named(f"GL_TEXTURE_WRAP_{axis}"), make.named(make.pick(WRAPS)))
        gl.glTexParameterfv(target, gl.GL_TEXTURE_BORDER_COLOR, (rng.random(4) * 2 - 0.5).astype(np.float32))
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
