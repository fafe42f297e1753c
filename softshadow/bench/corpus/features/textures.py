"""Features of texture mapping."""

from __future__ import annotations

from typing import Any

import numpy as np

from softshadow import tokens  # PyOpenGL has those of extensions elsewhere
from softshadow.bench.corpus.features.feature import Feature, feature, setting
from softshadow.bench.corpus.shapes import checkers, noise
from softshadow.bench.corpus.views import upload

FILTERS = (
    "NEAREST",
    "NEAREST_MIPMAP_NEAREST",
    "LINEAR_MIPMAP_NEAREST",
    "NEAREST_MIPMAP_LINEAR",
    "LINEAR_MIPMAP_LINEAR",
)
WRAPS = ("CLAMP", "CLAMP_TO_EDGE", "CLAMP_TO_BORDER", "MIRRORED_REPEAT")
FORMATS = (
    "ALPHA8", "LUMINANCE8", "LUMINANCE8_ALPHA8", "INTENSITY8", "RGB8", "RGBA4", "RGB5_A1", "RGBA16", "SRGB8_ALPHA8",
    "RGBA16F", "RGBA32F", "COMPRESSED_RGBA_S3TC_DXT5_EXT",
)  # fmt: skip
MODES = ("REPLACE", "DECAL", "BLEND", "ADD")
COMBINATIONS = ("INTERPOLATE", "ADD_SIGNED", "SUBTRACT", "DOT3_RGB")
GENERATED = ("OBJECT_LINEAR", "EYE_LINEAR", "SPHERE_MAP")


def _filter(name: str) -> Feature:
    def prepare(gl: Any) -> None:
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, getattr(gl, f"GL_{name}"))
        largest = gl.GL_NEAREST if name.startswith("NEAREST") else gl.GL_LINEAR
        gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MAG_FILTER, largest)
        _scale_texture(gl, 6.0)

    return Feature(f"filter-{_dashed(name)}", f"a texture filtered by GL_{name}", prepare)


def _wrap(name: str) -> Feature:
    def prepare(gl: Any) -> None:
        for side in (gl.GL_TEXTURE_WRAP_S, gl.GL_TEXTURE_WRAP_T):
            gl.glTexParameteri(gl.GL_TEXTURE_2D, side, getattr(gl, f"GL_{name}"))
        _scale_texture(gl, 1.5)

    return Feature(f"wrap-{_dashed(name)}", f"texture coordinates wrapped by GL_{name}", prepare)


def _format(name: str) -> Feature:
    def prepare(gl: Any) -> None:
        image, internal = checkers(), getattr(tokens, f"GL_{name}")
        gl.glTexImage2D(gl.GL_TEXTURE_2D, 0, internal, 256, 256, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, image)

    return Feature(f"format-{_dashed(name)}", f"a texture of GL_{name}", prepare)


def _combination(name: str) -> Feature:
    settings = (
        ("TEXTURE_ENV_MODE", "COMBINE"), ("COMBINE_RGB", name), ("SRC0_RGB", "TEXTURE"), ("SRC1_RGB", "PRIMARY_COLOR"),
        ("SRC2_RGB", "CONSTANT"), ("OPERAND2_RGB", "SRC_COLOR"),
    )  # fmt: skip

    def prepare(gl: Any) -> None:
        gl.glTexEnvfv(gl.GL_TEXTURE_ENV, gl.GL_TEXTURE_ENV_COLOR, [0.3, 0.5, 0.7, 0.5])
        for parameter, value in settings:
            gl.glTexEnvi(gl.GL_TEXTURE_ENV, getattr(gl, f"GL_{parameter}"), getattr(gl, f"GL_{value}"))

    return Feature(f"combine-{_dashed(name)}", f"texture and colour combined by GL_{name}", prepare)


def _generated(name: str) -> Feature:
    def prepare(gl: Any) -> None:
        for coordinate in ("S", "T"):
            gl.glTexGeni(getattr(gl, f"GL_{coordinate}"), gl.GL_TEXTURE_GEN_MODE, getattr(gl, f"GL_{name}"))
            gl.glEnable(getattr(gl, f"GL_TEXTURE_GEN_{coordinate}"))

    return Feature(f"generated-{_dashed(name)}", f"texture coordinates by GL_{name}", prepare)


def _units(count: int) -> Feature:
    def prepare(gl: Any) -> None:
        for unit in range(1, count):
            gl.glActiveTexture(gl.GL_TEXTURE0 + unit)
            upload(gl, noise(128, unit), gl.GL_LINEAR, gl.GL_REPEAT)
            for coordinate in ("S", "T"):
                gl.glTexGeni(getattr(gl, f"GL_{coordinate}"), gl.GL_TEXTURE_GEN_MODE, gl.GL_OBJECT_LINEAR)
                gl.glEnable(getattr(gl, f"GL_TEXTURE_GEN_{coordinate}"))
            gl.glEnable(gl.GL_TEXTURE_2D)
        gl.glActiveTexture(gl.GL_TEXTURE0)

    return Feature(f"units-{count}", f"{count} texture units", prepare)


def anisotropic(gl: Any) -> None:
    """An anisotropic filter with four samples at most."""
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR_MIPMAP_LINEAR)
    gl.glTexParameterf(gl.GL_TEXTURE_2D, tokens.GL_TEXTURE_MAX_ANISOTROPY_EXT, 4.0)
    _scale_texture(gl, 6.0)


def lod_bias(gl: Any) -> None:
    """A level of detail with a bias."""
    gl.glTexParameteri(gl.GL_TEXTURE_2D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_LINEAR_MIPMAP_LINEAR)
    gl.glTexEnvf(gl.GL_TEXTURE_FILTER_CONTROL, gl.GL_TEXTURE_LOD_BIAS, 1.5)


def texture_1d(gl: Any) -> None:
    """A texture of one dimension."""
    gl.glBindTexture(gl.GL_TEXTURE_1D, gl.glGenTextures(1))
    gl.glTexParameteri(gl.GL_TEXTURE_1D, gl.GL_TEXTURE_MIN_FILTER, gl.GL_NEAREST)
    gl.glTexParameteri(gl.GL_TEXTURE_1D, gl.GL_TEXTURE_MAG_FILTER, gl.GL_NEAREST)
    row = np.ascontiguousarray(noise(64)[0])
    gl.glTexImage1D(gl.GL_TEXTURE_1D, 0, gl.GL_RGBA, 64, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, row)
    gl.glDisable(gl.GL_TEXTURE_2D)
    gl.glEnable(gl.GL_TEXTURE_1D)


def texture_3d(gl: Any) -> None:
    """A texture of three dimensions."""
    gl.glBindTexture(gl.GL_TEXTURE_3D, gl.glGenTextures(1))
    for parameter in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_3D, parameter, gl.GL_LINEAR)
    block = np.stack([noise(32, seed) for seed in range(32)])
    gl.glTexImage3D(gl.GL_TEXTURE_3D, 0, gl.GL_RGBA, 32, 32, 32, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, block)
    for coordinate in ("S", "T", "R"):
        gl.glTexGeni(getattr(gl, f"GL_{coordinate}"), gl.GL_TEXTURE_GEN_MODE, gl.GL_OBJECT_LINEAR)
        gl.glEnable(getattr(gl, f"GL_TEXTURE_GEN_{coordinate}"))
    gl.glTexGenfv(gl.GL_R, gl.GL_OBJECT_PLANE, [0.0, 0.0, 1.0, 0.0])
    gl.glEnable(gl.GL_TEXTURE_3D)


def cube_map(gl: Any) -> None:
    """A cube map that the mesh reflects."""
    gl.glBindTexture(gl.GL_TEXTURE_CUBE_MAP, gl.glGenTextures(1))
    for parameter in (gl.GL_TEXTURE_MIN_FILTER, gl.GL_TEXTURE_MAG_FILTER):
        gl.glTexParameteri(gl.GL_TEXTURE_CUBE_MAP, parameter, gl.GL_LINEAR)
    for face in range(6):
        target = gl.GL_TEXTURE_CUBE_MAP_POSITIVE_X + face
        gl.glTexImage2D(target, 0, gl.GL_RGBA, 64, 64, 0, gl.GL_RGBA, gl.GL_UNSIGNED_BYTE, noise(64, face))
    for coordinate in ("S", "T", "R"):
        gl.glTexGeni(getattr(gl, f"GL_{coordinate}"), gl.GL_TEXTURE_GEN_MODE, gl.GL_REFLECTION_MAP)
        gl.glEnable(getattr(gl, f"GL_TEXTURE_GEN_{coordinate}"))
    gl.glEnable(gl.GL_TEXTURE_CUBE_MAP)


def texture_matrix(gl: Any) -> None:
    """Texture coordinates that a matrix divides by a fourth one."""
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glLoadMatrixf(np.array([[2, 0.3, 0, 0.2], [0, 2, 0, 0.3], [0, 0, 1, 0], [0.1, 0.2, 0, 1]], np.float32))
    gl.glMatrixMode(gl.GL_MODELVIEW)


def _scale_texture(gl: Any, factor: float) -> None:
    gl.glMatrixMode(gl.GL_TEXTURE)
    gl.glScalef(factor, factor, 1.0)
    gl.glMatrixMode(gl.GL_MODELVIEW)


def _dashed(name: str) -> str:
    return name.lower().replace("_", "-")


FEATURES = (
    setting("no-texture", "no texture", glDisable=("GL_TEXTURE_2D",)),
    *map(_filter, FILTERS),
    *map(_wrap, WRAPS),
    *map(_format, FORMATS),
    *(
        setting(f"env-{mode.lower()}", f"texture environment GL_{mode}",
              glTexEnvi=("GL_TEXTURE_ENV", "GL_TEXTURE_ENV_MODE", f"GL_{mode}"))
        for mode in MODES
    ),
    *map(_combination, COMBINATIONS),
    *map(_generated, GENERATED),
    *map(_units, (2, 3, 4)),
    *map(feature, (anisotropic, lod_bias, texture_1d, texture_3d, cube_map, texture_matrix)),
)  # fmt: skip
