"""Kernels for large images give what NumPy gives for small ones, and channels are those of the base formats."""

from collections.abc import Callable

import numpy as np
import pytest

from softshadow import color_values
from softshadow import tokens as gl
from softshadow.color_values import SOURCES, as_rgba, sum_of_colors, swizzled, to_base, to_unorm8
from softshadow.pixel_store import COMPONENTS

pytestmark = pytest.mark.interpreted
FORMATS = [format for format, names in COMPONENTS.items() if set(names) <= set("RGBAL")]


def by_both(function: Callable[[], np.ndarray], monkeypatch: pytest.MonkeyPatch) -> tuple[np.ndarray, np.ndarray]:
    """Return what a function returns of images that are small, and of large ones."""
    small = function()
    monkeypatch.setattr(color_values, "LARGE", 1)
    return small, function()


@pytest.mark.parametrize("pixel_format", FORMATS)
@pytest.mark.parametrize("base", SOURCES)
def test_pixels_become_rgba_of_a_base_format(pixel_format: int, base: int, monkeypatch: pytest.MonkeyPatch) -> None:
    pixels = np.random.default_rng(0).integers(0, 256, (3, 5, len(COMPONENTS[pixel_format])), np.uint8)
    small, large = by_both(lambda: as_rgba(pixels, pixel_format, 255, base), monkeypatch)
    np.testing.assert_array_equal(small, to_base(as_rgba(pixels, pixel_format, 255), base))
    np.testing.assert_array_equal(large, small)
    floats = pixels.astype(np.float32)
    np.testing.assert_array_equal(
        as_rgba(floats, pixel_format, 1, base), to_base(as_rgba(floats, pixel_format, 1), base)
    )


def test_rgba_is_not_copied() -> None:
    pixels = np.zeros((2, 2, 4), np.uint8)
    assert as_rgba(pixels, gl.GL_RGBA, 255, gl.GL_RGBA) is pixels


def test_bytes_are_the_nearest_to_floats(monkeypatch: pytest.MonkeyPatch) -> None:
    halfway = (np.arange(256) + 0.5) / 255
    numbers = [*halfway, *np.nextafter(np.float32(halfway), np.float32(0)), -1, 2, np.nan, np.inf, -np.inf, -0.0]
    floats = np.array(numbers, np.float32).reshape(1, -1, 1)
    small, large = by_both(lambda: to_unorm8(floats), monkeypatch)
    np.testing.assert_array_equal(large, small)


def test_sums_and_first_three_channels_of_large_images(monkeypatch: pytest.MonkeyPatch) -> None:
    rgba = np.random.default_rng(1).integers(0, 256, (5, 7, 4), np.uint8)
    for function in (lambda: sum_of_colors(rgba), lambda: swizzled(rgba, "RGB", 255)):
        with monkeypatch.context() as patch:
            small, large = by_both(function, patch)
        np.testing.assert_array_equal(large, small)
