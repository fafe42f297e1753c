"""Blocks of fragments with anisotropic filters get the bits of the shading stage."""

import pytest

import fixed_function_pictures
from fixed_function_pictures import FLOAT_FORMATS, FORMATS
from softshadow import gl
from softshadow.pipeline import choose
from test_span_shading import assert_same

INSIDE = (gl.GL_REPEAT, gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP, gl.GL_MIRRORED_REPEAT)


@pytest.fixture(autouse=True)
def _anisotropic(monkeypatch):
    monkeypatch.setattr(choose.SPAN_KERNELS, "pays_after", 0)
    values = {"TARGETS": (gl.GL_TEXTURE_2D,), "WRAPS": INSIDE, "ANISOTROPY": 8.0, "DEPTH_SHARE": 0}
    values |= {"COORDINATES": 0.02}  # else most ellipses have thousands of texels
    for name, value in values.items():
        monkeypatch.setattr(fixed_function_pictures, name, value)


@pytest.mark.parametrize("coordinates", [0.005, 0.03])
def test_texels_are_bytes(coordinates, monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "COORDINATES", coordinates)
    shadings = [assert_same(seed, units=1 + seed % 2, size=(40, 30), ordered=seed % 3 == 0) for seed in range(24)]
    assert shadings.count({"fixed-function kernel"}) > len(shadings) / 2  # others have levels without a mipmap filter


def test_texels_are_floats(monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "FORMATS", FLOAT_FORMATS)
    monkeypatch.setattr(fixed_function_pictures, "TEXELS", (-2.0, 3.0))
    shadings = [assert_same(seed, units=1 + seed % 2, size=(40, 30), tested=seed % 4 == 1) for seed in range(30)]
    assert shadings.count({"fixed-function kernel"}) > len(shadings) / 2


def test_rectangles_have_places_in_texels(monkeypatch):
    values = {"TARGETS": (gl.GL_TEXTURE_RECTANGLE,), "FORMATS": (*FORMATS, *FLOAT_FORMATS), "COORDINATES": 0.02}
    values |= {"MIN_FILTERS": (gl.GL_NEAREST, gl.GL_LINEAR), "WRAPS": (gl.GL_CLAMP_TO_EDGE, gl.GL_CLAMP) * 2}
    for name, value in values.items():
        monkeypatch.setattr(fixed_function_pictures, name, value)
    shadings = [assert_same(seed, units=1, size=(40, 30)) for seed in range(30)]
    assert {"fixed-function kernel"} in shadings


def test_borders_and_depths_are_left_to_the_textbook(monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "WRAPS", (*INSIDE, gl.GL_CLAMP_TO_BORDER))
    monkeypatch.setattr(fixed_function_pictures, "DEPTH_SHARE", 0.5)
    shadings = [assert_same(seed, units=1, size=(40, 30)) for seed in range(30)]
    assert {"program"} in shadings


def test_ellipses_are_larger_than_a_row_of_a_block(monkeypatch):
    monkeypatch.setattr(fixed_function_pictures, "COORDINATES", 0.3)
    monkeypatch.setattr(fixed_function_pictures, "MIN_FILTERS", (gl.GL_LINEAR,))  # without smaller levels
    for seed in range(40):
        assert_same(seed, units=1, size=(12, 8), n_triangles=3)
