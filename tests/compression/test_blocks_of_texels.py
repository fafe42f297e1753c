"""Blocks become the texels that the specifications of S3TC and RGTC name, and images of few colours come back."""

import numpy as np
import pytest

from softshadow import tokens as gl
from softshadow.compression import COMPRESSED, decoded, encoded

RED, BLUE = 0xF800, 0x001F  # of 5, 6 and 5 bits
STEP = 1  # llvmpipe's sevenths and fifths are multiples of 1/256: at most so much below the exact ones


def color_block(first: int, second: int, codes: list[int]) -> np.ndarray:
    """Return an image of one block (1, 1, 8) with the codes of its first row in all rows."""
    row = sum(code << 2 * place for place, code in enumerate(codes))
    return np.array([first & 255, first >> 8, second & 255, second >> 8, *[row] * 4], np.uint8).reshape(1, 1, 8)


def texels(block: np.ndarray, format: int) -> list[list[int]]:
    """Return the first row of the texels of one block."""
    return decoded(block, COMPRESSED[format], 4, 4)[0].tolist()  # type: ignore[no-any-return]


def test_four_colors_lie_between_the_ends() -> None:
    row = texels(color_block(RED, BLUE, [0, 1, 2, 3]), gl.GL_COMPRESSED_RGB_S3TC_DXT1_EXT)
    assert row == [[255, 0, 0, 255], [0, 0, 255, 255], [170, 0, 84, 255], [85, 0, 169, 255]]


def test_three_colors_leave_a_code_for_black_or_nothing() -> None:
    block = color_block(BLUE, RED, [0, 1, 2, 3])
    opaque = texels(block, gl.GL_COMPRESSED_RGB_S3TC_DXT1_EXT)
    assert opaque == [[0, 0, 255, 255], [255, 0, 0, 255], [128, 0, 128, 255], [0, 0, 0, 255]]
    assert texels(block, gl.GL_COMPRESSED_RGBA_S3TC_DXT1_EXT) == [*opaque[:3], [0, 0, 0, 0]]


@pytest.mark.parametrize(("first", "second", "steps"), [(240, 9, 7), (9, 240, 5)])
def test_numbers_of_a_channel_lie_between_the_ends(first: int, second: int, steps: int) -> None:
    bits = sum(code << 3 * place for place, code in enumerate(range(8)))  # of the first two rows
    block = np.array([first, second, *bits.to_bytes(3, "little"), 0, 0, 0], np.uint8).reshape(1, 1, 8)
    values = decoded(block, COMPRESSED[gl.GL_COMPRESSED_RED_RGTC1], 4, 4)[:2, :, 0].reshape(-1).astype(int)
    exact = [first, second] + [(first * (steps - step) + second * step) / steps for step in range(1, steps)]
    assert np.abs(values[: steps + 1] - exact).max() <= STEP
    assert values[steps + 1 :].tolist() == ([] if steps == 7 else [0, 255])


@pytest.mark.parametrize("name", ["RGB_S3TC_DXT1", "RGBA_S3TC_DXT1", "RGBA_S3TC_DXT3", "RGBA_S3TC_DXT5"])
def test_images_of_two_colors_come_back(name: str) -> None:
    compressed = COMPRESSED[getattr(gl, f"GL_COMPRESSED_{name}_EXT")]
    colors = np.array([[255, 0, 0, 255], [0, 0, 255, 255]], np.uint8)
    image = colors[np.random.default_rng(2).integers(0, 2, (13, 7))]
    blocks = encoded(image, compressed)
    assert blocks.shape == (4, 2, compressed.block_bytes)
    assert np.array_equal(decoded(blocks, compressed, 7, 13), image)


def test_signed_numbers_are_fractions_from_minus_one_to_one() -> None:
    block = np.array([127, 0x80, 0b00001000, 0, 0, 0, 0, 0], np.uint8).reshape(1, 1, 8)  # 127, -128
    row = texels(block, gl.GL_COMPRESSED_SIGNED_RED_RGTC1)
    assert row[:2] == [[1, 0, 0, 1], [-1, 0, 0, 1]]
