"""Percentage-closer filtering: one base and offsets select the same texels as separate lookups."""

import numpy as np
import pytest

from programs.test_sampling import SHAPES, WRAPS, bytes_of, coordinates, make_texture
from softshadow.programs import percentage_closer, sampling

pytestmark = pytest.mark.interpreted

SQUARE = (16, 16)  # texels one step of 1/16 apart on both axes: side by side
FORMATS = ("GL_DEPTH_COMPONENT16", "GL_DEPTH_COMPONENT24", "GL_DEPTH_COMPONENT32", "GL_DEPTH_COMPONENT32F", "GL_RGBA8")
LARGEST = {"GL_DEPTH_COMPONENT16": 2**16 - 1, "GL_DEPTH_COMPONENT24": 2**24 - 1, "GL_DEPTH_COMPONENT32": 2**32 - 1}


@pytest.fixture(autouse=True)
def quiet():
    """Ignore NumPy's warnings about invalid numbers, as inside a draw."""
    with np.errstate(all="ignore"):
        yield


def cells_of(internal, shape):
    if internal == "GL_RGBA8":
        return bytes_of(1, shape)
    units = np.random.default_rng(1).random(shape)
    return np.rint(units * LARGEST[internal]) if internal in LARGEST else units


def places():
    """Return coordinates, some on texel edges, some NaN or infinite."""
    positions = coordinates(3, 60)
    positions[-2:, :2] = np.nan, np.inf
    return positions


@pytest.mark.parametrize("radius", [1, 2])
@pytest.mark.parametrize("shape", [*SHAPES, SQUARE])
@pytest.mark.parametrize("wrap", WRAPS)
@pytest.mark.parametrize("internal", FORMATS)
def test_texels_round_a_place_are_those_of_separate_lookups(internal, wrap, shape, radius, monkeypatch):
    texture = make_texture(internal, cells_of(internal, shape), wrap_s=wrap, wrap_t=wrap)
    arguments = texture, places(), places()[:, 2].copy(), radius, np.float32(1 / 16)
    assert percentage_closer.is_plain(texture)
    together = percentage_closer.count_lit(*arguments)
    monkeypatch.setattr(percentage_closer, "is_plain", lambda _: False)
    assert np.array_equal(together, percentage_closer.count_lit(*arguments))
    assert 0 < together.sum() < (2 * radius + 1) ** 2 * len(together)


def test_texels_of_some_places_lie_side_by_side_and_of_some_outside(monkeypatch):
    kinds_seen, classify = [], percentage_closer.classify

    def listening(*arguments):
        classify(*arguments)
        kinds_seen.extend(arguments[-1])

    monkeypatch.setattr(percentage_closer, "classify", listening)
    cells = cells_of("GL_DEPTH_COMPONENT24", SQUARE)
    texture = make_texture("GL_DEPTH_COMPONENT24", cells, wrap_s="GL_CLAMP_TO_BORDER")
    percentage_closer.count_lit(texture, places(), places()[:, 2].copy(), 2, np.float32(1 / 16))
    kinds = percentage_closer.ADJACENT, percentage_closer.OUTSIDE, percentage_closer.MIXED
    assert set(kinds_seen) == set(kinds)


@pytest.mark.parametrize(
    "parameters",
    [
        {"min_filter": "GL_LINEAR"},
        {"compare_mode": "GL_COMPARE_R_TO_TEXTURE"},
        {"depth_mode": "GL_ALPHA"},
        {"min_filter": "GL_NEAREST_MIPMAP_NEAREST", "mag_filter": "GL_NEAREST"},
    ],
)
def test_what_is_not_one_texel_as_it_is_takes_separate_lookups(parameters):
    texture = make_texture("GL_DEPTH_COMPONENT24", cells_of("GL_DEPTH_COMPONENT24", SHAPES[0]), **parameters)
    assert not percentage_closer.is_plain(texture)


@pytest.mark.parametrize("compare_mode", ["GL_NONE", "GL_COMPARE_R_TO_TEXTURE"])
@pytest.mark.parametrize("min_filter", ["GL_NEAREST", "GL_LINEAR"])
@pytest.mark.parametrize("internal", FORMATS)
def test_a_lookup_of_one_channel_is_the_first_of_four(internal, min_filter, compare_mode):
    texture = make_texture(internal, cells_of(internal, SHAPES[0]), min_filter=min_filter, compare_mode=compare_mode)
    four, one = np.empty((60, 4), np.float32), np.empty((60, 1), np.float32)
    sampling.sample(texture, places(), four)
    sampling.sample(texture, places(), one)
    assert np.array_equal(four[:, :1], one, equal_nan=True)
