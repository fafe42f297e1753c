"""Filtered maps in programs: what moments and powers tell about the depths that they were made of."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from mesa_points import same_bits
from programs.test_map_visibility import SIDE, coordinates, on_mesa
from softshadow import programs
from softshadow import tokens as gl
from softshadow.image import FORMATS, Image
from softshadow.texture import Sampler, Texture

LOG2_E = np.log2(np.e)


def float_texture(texels: np.ndarray) -> Texture:
    """A texture of colours (h, w, k); the other channels are 0."""
    height, width, channels = texels.shape
    image = Image.new(FORMATS[gl.GL_RGBA32F], width, height)
    image.view[:] = 0
    image.view[..., :channels] = texels
    sampler = Sampler(min_filter=gl.GL_NEAREST, mag_filter=gl.GL_NEAREST, wrap_s=gl.GL_CLAMP_TO_EDGE)
    return Texture(1, gl.GL_TEXTURE_2D, sampler, {(0, 0): image})


def shaded(name: str, inputs: np.ndarray, **uniforms: Any) -> np.ndarray:
    program = programs.get(name)
    out = np.empty((len(inputs), 4), np.float32, order="F")
    program.shade(np.asfortranarray(inputs, np.float32), {**program.uniforms, **uniforms}, out)
    return out


def at_depths(depths: np.ndarray) -> np.ndarray:
    inputs = np.full((len(depths), 4), 0.5)
    inputs[:, 2], inputs[:, 3] = depths, 1
    return inputs


@given(st.floats(0.05, 0.95), st.floats(0.1, 0.9), st.floats(0.05, 0.9))
def test_bound_is_the_share_itself_for_two_flat_depths(share: float, receiver: float, part: float) -> None:
    blocker = receiver * part
    mean = share * receiver + (1 - share) * blocker
    squares = share * receiver**2 + (1 - share) * blocker**2
    moments = float_texture(np.array([[[mean, squares]]]))
    seen = shaded("variance-visibility", at_depths(np.array([receiver])), shadowMap=moments)[0, 3]
    variance = share * (1 - share) * (receiver - blocker) ** 2
    # the variance is a difference of squares, each rounded to 2^-24
    assert seen == pytest.approx(share, abs=1e-6 + 1e-6 / variance)


def test_bound_is_never_less_than_the_share_of_any_depths() -> None:
    rng = np.random.default_rng(1)
    for _ in range(200):
        depths, receiver = rng.random(rng.integers(1, 6)), rng.random(1)
        moments = float_texture(np.array([[[depths.mean(), (depths**2).mean()]]]))
        seen = shaded("variance-visibility", at_depths(receiver), shadowMap=moments, leastVariance=1e-6)[0, 3]
        assert (depths >= receiver).mean() - 1e-3 <= seen <= 1


def test_bleeding_reduction_only_darkens_and_keeps_full_light() -> None:
    depths = np.linspace(0, 1, 101)
    moments = float_texture(np.array([[[0.4, 0.2]]]))
    plain, reduced = (
        shaded("variance-visibility", at_depths(depths), shadowMap=moments, bleed=bleed)[:, 3] for bleed in (0.0, 0.3)
    )
    assert (reduced <= plain).all()
    assert ((reduced == 1) == (plain == 1)).all()
    assert (reduced[plain <= 0.3] == 0).all()
    assert (reduced < plain).any()


@pytest.mark.parametrize("exponent", [5.0, 40.0, 80.0])
def test_quotient_of_powers_is_near_the_share_of_the_receivers_own_depth(exponent: float) -> None:
    share, receiver, blocker = 0.3, 0.7, 0.4
    powers = share * np.exp(exponent * receiver) + (1 - share) * np.exp(exponent * blocker)
    seen = shaded(
        "exponential-visibility",
        at_depths(np.array([receiver])),
        shadowMap=float_texture(np.array([[[powers]]])),
        steepness=exponent * LOG2_E,
    )[0, 3]
    # 2^(c d) is rounded relative to the exponent, about 2^-24 times 80
    assert seen == pytest.approx(share + (1 - share) * np.exp(exponent * (blocker - receiver)), rel=1e-4)


def test_depths_are_written_as_moments_and_powers() -> None:
    depths = np.linspace(0, 1, 11, dtype=np.float32)
    moments = shaded("depth-moments", at_depths(depths))
    assert (moments[:, 0] == depths).all()
    assert (moments[:, 1] == depths * depths).all()
    powers = shaded("depth-exponential", at_depths(depths), steepness=10.0)[:, 0]
    assert powers == pytest.approx(2 ** (10.0 * depths), rel=1e-6)


@pytest.mark.parametrize("radius", [0, 1, 3])
def test_blur_along_both_axes_is_the_mean_of_a_square(radius: int) -> None:
    side = 12
    texels = np.random.default_rng(radius).random((side, side, 2), np.float32)
    centers = (np.stack(np.meshgrid(np.arange(side), np.arange(side)), axis=-1).reshape(-1, 2) + 0.5) / side
    inputs = np.zeros((side * side, 4))
    inputs[:, :2] = centers
    blurred = texels
    for s, t in ((1, 0), (0, 1)):
        steps = {"radius": radius, "stepS": s / side, "stepT": t / side}
        out = shaded("box-blur", inputs, source=float_texture(blurred), **steps)
        blurred = out.reshape(side, side, 4)[..., :2]
    windows = np.lib.stride_tricks.sliding_window_view(texels, (2 * radius + 1,) * 2, axis=(0, 1))
    inner = slice(radius, side - radius)
    assert blurred[inner, inner] == pytest.approx(windows.mean(axis=(-1, -2)), abs=1e-6)


@pytest.mark.parametrize("name", ["variance-visibility", "exponential-visibility"])
def test_cone_and_back_of_the_light_are_as_for_other_maps(name: str) -> None:
    inputs = np.array([[0.5, 0.5, 0.1, 1], [0.9, 0.5, 0.1, 1], [-0.5, -0.5, 0.1, -1]])
    texture = float_texture(np.full((1, 1, 2), 1.0))
    seen = shaded(name, inputs, shadowMap=texture, cone=0.1, behind=0.25, steepness=0.0)
    assert seen[:, 3].tolist() == [1, 0, 0.25]


def random_map(on: Any) -> None:
    """Bind a float texture of depths and squares, filtered linearly, with a border."""
    on.glBindTexture(on.GL_TEXTURE_2D, on.glGenTextures(1))
    for parameter, value in (
        (on.GL_TEXTURE_MIN_FILTER, on.GL_LINEAR),
        (on.GL_TEXTURE_MAG_FILTER, on.GL_LINEAR),
        (on.GL_TEXTURE_WRAP_S, on.GL_CLAMP_TO_BORDER),
        (on.GL_TEXTURE_WRAP_T, on.GL_CLAMP_TO_BORDER),
    ):
        on.glTexParameteri(on.GL_TEXTURE_2D, parameter, value)
    on.glTexParameterfv(on.GL_TEXTURE_2D, on.GL_TEXTURE_BORDER_COLOR, (1.0, 1.0, 0.0, 1.0))
    texels = random_texels()
    on.glTexImage2D(on.GL_TEXTURE_2D, 0, on.GL_RGBA32F, SIDE, SIDE, 0, on.GL_RGBA, on.GL_FLOAT, texels)


def random_texels() -> np.ndarray:
    depths = np.random.default_rng(8).random((SIDE, SIDE), np.float32)
    return np.stack([depths, depths * depths, depths, depths], axis=-1)


@pytest.mark.mesa
@pytest.mark.parametrize(
    ("name", "own"),
    [
        ("variance-visibility", {"leastVariance": 1e-4, "bleed": 0.2, "bias": 0.01}),
        ("exponential-visibility", {"steepness": 30.5, "bias": 0.01}),
        ("depth-moments", {}),
        ("depth-exponential", {"steepness": 90.25}),
        ("box-blur", {"radius": 2, "stepS": 1 / SIDE, "stepT": 0.0}),
    ],
)
def test_program_is_its_glsl_twin(name: str, own: dict[str, Any]) -> None:
    placed = coordinates(9)
    uniforms = own | ({"behind": 0.25, "cone": 0.3} if name.endswith("visibility") else {})
    texture = float_texture(random_texels())
    sampler = Sampler(
        min_filter=gl.GL_LINEAR,
        mag_filter=gl.GL_LINEAR,
        wrap_s=gl.GL_CLAMP_TO_BORDER,
        wrap_t=gl.GL_CLAMP_TO_BORDER,
        border_color=(1.0, 1.0, 0.0, 1.0),
    )
    maps = dict.fromkeys(programs.get(name).samplers, replace(texture, sampler=sampler))
    assert same_bits(shaded(name, placed, **uniforms, **maps), on_mesa(name, placed, uniforms, random_map))
