"""Texture sampling: the kernels against the oracle and against Mesa on random data, and rules of GL."""

from typing import Any

import numpy as np
import pytest

from mesa_points import POINTS, fragments_on_mesa, same_bits
from oracle import texture as oracle
from softshadow import tokens as gl
from softshadow.errors import StateError
from softshadow.image import FORMATS, Image
from softshadow.programs import sampling
from softshadow.texture import Sampler, Texture

WRAPS = ("GL_REPEAT", "GL_CLAMP_TO_EDGE", "GL_CLAMP_TO_BORDER", "GL_CLAMP", "GL_MIRRORED_REPEAT")
FILTERS = ("GL_NEAREST", "GL_LINEAR")
FUNCS = tuple(oracle.TESTS)
SHAPES = ((8, 16), (7, 13))
BORDER = (0.2, 0.6, 0.9, 0.4)
D24 = np.float32(2**24 - 1)


def make_texture(internal: str, cells: np.ndarray, **parameters: Any) -> Texture:
    """Return a 2-D texture with these cells and parameters; both filters are `min_filter`, by default nearest."""
    image = Image.new(FORMATS[getattr(gl, internal)], cells.shape[1], cells.shape[0])
    image.view[:] = cells
    parameters = {k: getattr(gl, v) if isinstance(v, str) else v for k, v in parameters.items()}
    parameters.setdefault("min_filter", gl.GL_NEAREST)
    parameters.setdefault("mag_filter", parameters["min_filter"])
    return Texture(1, gl.GL_TEXTURE_2D, Sampler(border_color=BORDER, **parameters), {(0, 0): image})


def sampled(texture: Texture, coordinates: np.ndarray) -> np.ndarray:
    out = np.empty((len(coordinates), 4), np.float32)
    sampling.sample(texture, coordinates, out)
    return out


def coordinates(seed: int, count: int) -> np.ndarray:
    """Return (count, 3) float32 in [-3, 3], a quarter on texel edges and centres; r slightly beyond [0, 1]."""
    rng = np.random.default_rng(seed)
    places = rng.uniform(-3, 3, (count, 3))
    places[: count // 4] = np.rint(places[: count // 4] * 32) / 32
    places[:, 2] = rng.uniform(-0.1, 1.1, count)
    return places.astype(np.float32)


def bytes_of(seed: int, shape: tuple[int, int]) -> np.ndarray:
    return np.random.default_rng(seed).integers(0, 256, (*shape, 4), dtype=np.uint8)


def depths_of(seed: int, shape: tuple[int, int]) -> np.ndarray:
    """Return depths in units of a 24-bit format."""
    return np.random.default_rng(seed).integers(0, 2**24, shape).astype(np.float32)


@pytest.mark.interpreted
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("filter_name", FILTERS)
@pytest.mark.parametrize("wrap", WRAPS)
def test_colours_are_the_oracles(wrap, filter_name, shape):
    cells, points = bytes_of(1, shape), coordinates(2, 150)
    wraps, linear = (wrap, WRAPS[(WRAPS.index(wrap) + shape[0]) % 5]), filter_name == "GL_LINEAR"
    out = sampled(make_texture("GL_RGBA8", cells, min_filter=filter_name, wrap_s=wraps[0], wrap_t=wraps[1]), points)
    step, border = np.float32(1) / np.float32(255), np.array(BORDER, np.float32)
    fixed = linear and set(wraps) <= {"GL_REPEAT", "GL_CLAMP_TO_EDGE"}
    for (s, t, _), color in zip(points, out, strict=True):
        if fixed:
            expected = oracle.sample_fixed(cells, s, t, wraps).astype(np.float32) * step
        else:
            expected = oracle.sample(cells.astype(np.float32) * step, s, t, wraps, linear, border)
        assert same_bits(color, expected), (s, t)


@pytest.mark.interpreted
@pytest.mark.parametrize("filter_name", FILTERS)
@pytest.mark.parametrize("func", FUNCS)
def test_depth_comparison_is_the_oracles(func, filter_name):
    index = FUNCS.index(func)
    wraps, shape = (WRAPS[index % 5], WRAPS[(index + 2) % 5]), SHAPES[index % 2]
    cells, points = depths_of(3, shape), coordinates(4, 120)
    cells[::2] = np.rint(points[0, 2].clip(0, 1) * D24)  # so that equality happens
    texture = make_texture(
        "GL_DEPTH_COMPONENT24", cells, min_filter=filter_name, wrap_s=wraps[0], wrap_t=wraps[1],
        compare_mode="GL_COMPARE_R_TO_TEXTURE", compare_func=func, depth_mode="GL_INTENSITY",
    )  # fmt: skip
    depths = cells * (np.float32(1) / D24)
    points[::3, 2] = depths[0, 0]
    out = sampled(texture, points)
    for (s, t, r), lit in zip(points, out[:, 0], strict=True):
        expected = oracle.compare(depths, s, t, r, wraps, filter_name == "GL_LINEAR", func, np.float32(BORDER[0]))
        assert lit == expected, (s, t, r)


MESA_COLORS = (
    [("GL_RGBA8", s, t, shape) for s, t in zip(WRAPS, WRAPS[1:] + WRAPS[:1], strict=True) for shape in SHAPES]
    + [("GL_RGBA8", w, w, (7, 13)) for w in WRAPS[:2]]
    + [("GL_RGBA32F", w, w, (8, 13)) for w in WRAPS]
    + [(f"GL_{name}8", "GL_CLAMP_TO_BORDER", "GL_REPEAT", (8, 7)) for name in ("RGB", "LUMINANCE", "INTENSITY", "R")]
)


@pytest.mark.thin(3)
@pytest.mark.mesa
@pytest.mark.parametrize("filter_name", FILTERS)
@pytest.mark.parametrize(("internal", "wrap_s", "wrap_t", "shape"), MESA_COLORS)
def test_colours_are_mesas(internal, wrap_s, wrap_t, shape, filter_name):
    is_float = internal.endswith("F")
    cells = np.random.default_rng(5).normal(size=(*shape, 4)).astype(np.float32) if is_float else bytes_of(5, shape)
    points = coordinates(6, POINTS)
    texture = make_texture(internal, cells, min_filter=filter_name, wrap_s=wrap_s, wrap_t=wrap_t)
    ours = sampled(texture, points)
    if internal in ("GL_RGB8", "GL_LUMINANCE8", "GL_R8"):
        ours[:, 3] = 1  # GL_REPLACE keeps the fragment's own alpha
    kind = "GL_FLOAT" if is_float else "GL_UNSIGNED_BYTE"
    assert same_bits(ours, replaced_on_mesa(internal, "GL_RGBA", kind, cells, texture.sampler, points))


MESA_DEPTHS = (
    [("GL_DEPTH_COMPONENT24", w, mode, "GL_LEQUAL") for w in WRAPS for mode in ("GL_NONE", "GL_COMPARE_R_TO_TEXTURE")]
    + [("GL_DEPTH_COMPONENT24", "GL_CLAMP_TO_BORDER", "GL_COMPARE_R_TO_TEXTURE", f) for f in FUNCS]
    + [("GL_DEPTH_COMPONENT32F", "GL_CLAMP", mode, "GL_LESS") for mode in ("GL_NONE", "GL_COMPARE_R_TO_TEXTURE")]
    + [(f"GL_DEPTH_COMPONENT{bits}", "GL_REPEAT", "GL_NONE", "GL_LESS") for bits in (16, 32)]
)


@pytest.mark.mesa
@pytest.mark.parametrize("filter_name", FILTERS)
@pytest.mark.parametrize(("internal", "wrap", "mode", "func"), MESA_DEPTHS)
def test_depths_are_mesas(internal, wrap, mode, func, filter_name):
    depths, points = np.random.default_rng(7).random((8, 13), np.float32), coordinates(8, POINTS)
    largest = FORMATS[getattr(gl, internal)].largest
    cells = np.floor(depths.astype(np.float64) * largest) if largest else depths  # Mesa truncates
    if largest > D24:
        cells = cells // 512 * 512
    texture = make_texture(
        internal, cells, min_filter=filter_name, wrap_s=wrap, wrap_t="GL_REPEAT", compare_mode=mode, compare_func=func,
        depth_mode="GL_INTENSITY",
    )  # fmt: skip
    theirs = replaced_on_mesa(internal, "GL_DEPTH_COMPONENT", "GL_FLOAT", depths, texture.sampler, points)
    assert same_bits(sampled(texture, points), theirs)


@pytest.mark.mesa
@pytest.mark.parametrize("depth_mode", ["GL_LUMINANCE", "GL_ALPHA", "GL_RED"])
def test_depth_modes_are_mesas(depth_mode):
    depths, points = np.random.default_rng(9).random((8, 8), np.float32), coordinates(10, POINTS)
    texture = make_texture("GL_DEPTH_COMPONENT24", np.floor(depths * D24), depth_mode=depth_mode)
    ours = sampled(texture, points)
    if depth_mode == "GL_ALPHA":
        ours[:, :3] = 1  # GL_REPLACE keeps the fragment's own colour
    theirs = replaced_on_mesa("GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT", "GL_FLOAT", depths, texture.sampler, points)
    assert same_bits(ours, theirs)


def replaced_on_mesa(
    internal: str, pixel_format: str, kind: str, data: np.ndarray, sampler: Sampler, points: np.ndarray
) -> np.ndarray:
    """Return the colours (POINTS, 4) of white fragments on Mesa after GL_REPLACE with the image and sampler."""

    def setup(on: Any) -> None:
        on.glBindTexture(on.GL_TEXTURE_2D, on.glGenTextures(1))
        size = data.shape[1], data.shape[0]
        formats = getattr(on, pixel_format), getattr(on, kind)
        on.glTexImage2D(on.GL_TEXTURE_2D, 0, getattr(on, internal), *size, 0, *formats, data)
        for name, value in (
            (on.GL_TEXTURE_MIN_FILTER, sampler.min_filter),
            (on.GL_TEXTURE_MAG_FILTER, sampler.mag_filter),
            (on.GL_TEXTURE_WRAP_S, sampler.wrap_s),
            (on.GL_TEXTURE_WRAP_T, sampler.wrap_t),
            (on.GL_TEXTURE_COMPARE_MODE, sampler.compare_mode),
            (on.GL_TEXTURE_COMPARE_FUNC, sampler.compare_func),
            (on.GL_DEPTH_TEXTURE_MODE, sampler.depth_mode),
        ):
            on.glTexParameteri(on.GL_TEXTURE_2D, name, value)
        on.glTexParameterfv(on.GL_TEXTURE_2D, on.GL_TEXTURE_BORDER_COLOR, sampler.border_color)
        on.glEnable(on.GL_TEXTURE_2D)
        on.glTexEnvi(on.GL_TEXTURE_ENV, on.GL_TEXTURE_ENV_MODE, on.GL_REPLACE)

    texcoord = np.concatenate([points, np.ones((len(points), 1), np.float32)], axis=1)
    return fragments_on_mesa(setup, {"texcoord": texcoord})


def test_channels_follow_the_base_format():
    cells = np.full((1, 1, 4), (51, 102, 153, 204), np.uint8)
    expected = {
        "GL_RGBA8": (51, 102, 153, 204),
        "GL_RGB8": (51, 102, 153, 255),
        "GL_RG8": (51, 102, 0, 255),
        "GL_R8": (51, 0, 0, 255),
        "GL_ALPHA8": (0, 0, 0, 204),
        "GL_LUMINANCE8": (51, 51, 51, 255),
        "GL_LUMINANCE8_ALPHA8": (51, 51, 51, 204),
        "GL_INTENSITY8": (51, 51, 51, 51),
    }
    for internal, color in expected.items():
        assert tuple(np.rint(sampled(make_texture(internal, cells), np.zeros((1, 3), np.float32))[0] * 255)) == color


def test_an_incomplete_texture_is_black_and_opaque():
    one_level = make_texture(
        "GL_RGBA8", bytes_of(0, (4, 4)), min_filter="GL_LINEAR_MIPMAP_LINEAR", mag_filter="GL_LINEAR"
    )
    assert not sampling.is_complete(one_level)
    assert sampled(one_level, np.zeros((2, 3), np.float32)).tolist() == [[0, 0, 0, 1]] * 2
    assert not sampling.is_complete(Texture(1, gl.GL_TEXTURE_2D))
    for level in (1, 2):
        internal_format = one_level.images[0, 0].internal_format
        one_level.images[0, level] = Image.new(FORMATS[gl.GL_RGBA8], 4 >> level, 4 >> level, internal_format)
    assert sampling.is_complete(one_level)


def test_what_needs_a_level_of_detail_says_what_to_set():
    mixed = make_texture("GL_RGBA8", bytes_of(0, (4, 4)), min_filter="GL_NEAREST", mag_filter="GL_LINEAR")
    with pytest.raises(StateError, match="GL_TEXTURE_MIN_FILTER and GL_TEXTURE_MAG_FILTER differ"):
        sampled(mixed, np.zeros((1, 3), np.float32))
