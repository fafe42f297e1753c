"""What glBitmap keeps for characters: small bitmaps only, so that pictures of bits take no memory.

What is kept gives the same vertices as before.
"""

import numpy as np
import pytest

from softshadow import gl
from softshadow.gl import bitmaps, raster_draws

KEPT = (bitmaps._kept_pixels, raster_draws._attributes, raster_draws._normals, raster_draws._indices)


@pytest.mark.parametrize(("side", "keeps"), [(8, True), (96, False)])
def test_only_characters_are_kept(side: int, keeps: bool) -> None:
    for kept in KEPT:
        kept.cache_clear()
    bits = np.random.default_rng(1).integers(0, 256, (side, side // 8), np.uint8)
    with gl.create_context(side, side) as context:
        gl.glPixelStorei(gl.GL_UNPACK_ALIGNMENT, 1)
        gl.glRasterPos2f(-1, -1)
        gl.glBitmap(side, side, 0, 0, 0, 0, bits)
        drawn = context.storage.window.color.view[::-1, :, 0] > 0
    assert np.array_equal(drawn, np.unpackbits(bits, axis=1).astype(bool))
    assert [kept.cache_info().currsize > 0 for kept in KEPT] == [keeps] * len(KEPT)


@pytest.mark.parametrize("precision", ["mesa", "exact"])
def test_places_of_characters(precision: str) -> None:
    """Corners are those of moved quads, bit for bit: inside, near and far outside of the window, and drawn again."""
    rng = np.random.default_rng(2)
    characters = [bitmaps.PixelQuads(bitmaps.runs(rng.random((9, 7)) < 0.5)) for _ in range(3)]
    places = [(0, 0), (11, 5), (-3, 30), (-bitmaps.MARGIN - 5, 0), (0, 40 + bitmaps.MARGIN), (2**40, -(2**40))]
    with gl.create_context(64, 40, precision=precision) as context:
        for step in range(40):
            if step % 10 == 0:
                gl.glColor3f(*rng.random(3))
                gl.glRasterPos2f(0, 0)
            character, (left, bottom) = characters[rng.integers(3)], places[rng.integers(len(places))]
            draw = bitmaps.draw_of_pixels(context, character, left, bottom)
            moved = character.quads + np.array([left, bottom, left, bottom])
            expected = raster_draws.positions(moved, (64, 40), raster_draws.EDGES, context.real)
            assert draw.vertices.position.tobytes() == expected.tobytes()
            assert draw.vertices.position.dtype == expected.dtype
            color = np.array(context.current.raster.color, context.real)
            assert np.array_equal(draw.vertices.color, np.broadcast_to(color, (len(expected), 4)))


def test_a_text_that_is_drawn_again_has_the_same_vertices() -> None:
    character = bitmaps.PixelQuads(bitmaps.runs(np.eye(5, dtype=bool)))
    with gl.create_context(32, 32) as context:
        gl.glRasterPos2f(0, 0)
        first, again = (bitmaps.draw_of_pixels(context, character, 3, 4).vertices for _ in range(2))
    assert first is again
    assert len(character._placed) == 1


def test_few_places_of_a_character_are_kept() -> None:
    character = bitmaps.PixelQuads(bitmaps.runs(np.eye(5, dtype=bool)))
    with gl.create_context(32, 32) as context:
        gl.glRasterPos2f(0, 0)
        for left in range(3 * bitmaps.KEPT_PLACES):
            bitmaps.draw_of_pixels(context, character, left, 0)
    assert len(character._placed) <= bitmaps.KEPT_PLACES
